"use strict";
// Files that are chosen, dropped or pasted into the page. The service says what a file reads, with the decoder that
// grades it: what is no text never enters the editor. What is handed in is the file itself, byte by byte, until its text
// is changed in the editor.
const pickFiles = (form, editor, taken) => {
  const picker = form.elements.file;
  const note = form.querySelector(".note-of-file");
  const { read, reading, unread, several, unreadable, empty, large, most, file: wanted } = form.dataset;
  let file; // the file whose text the editor shows, as it was when it was chosen
  let asked = 0;

  const tell = (text) => {
    note.querySelector("span").textContent = text;
    note.hidden = !text;
  };
  note.querySelector("button").addEventListener("click", () => tell(""));

  // The field holds what is sent, also where the browser sends the form.
  const hold = (chosen) => {
    file = chosen;
    const transfer = new DataTransfer();
    if (file) transfer.items.add(file);
    picker.files = transfer.files;
  };

  const take = async (files) => {
    const mine = (asked += 1);
    const chosen = files.length > 1 ? files.find((one) => one.name === wanted) : files[0];
    const refuse = (why) => {
      if (mine !== asked) return;
      hold(file);
      tell(why);
    };
    if (!chosen) return refuse(several);
    if (!chosen.size) return refuse(`${chosen.name}: ${empty}`);
    if (chosen.size > Number(most)) return refuse(`${chosen.name}: ${large}`);
    tell(reading);
    let copy;
    try {
      copy = new File([await chosen.arrayBuffer()], chosen.name, { type: chosen.type });
    } catch {
      return refuse(`${chosen.name}: ${unreadable}`); // a folder, or a file that is gone
    }
    let answer, said;
    try {
      const body = new FormData();
      body.set("csrf", form.elements.csrf.value);
      body.set("file", copy, copy.name);
      answer = await fetch(read, { method: "POST", body, headers: { accept: "application/json" } });
      said = answer.ok ? await answer.text() : (await answer.json()).detail;
    } catch {
      return refuse(`${chosen.name}: ${unread}`);
    }
    if (mine !== asked) return;
    if (!answer.ok) return refuse(`${chosen.name}: ${said}`);
    tell("");
    editor.fill(said);
    hold(copy);
    taken(copy);
  };

  picker.addEventListener("change", () => { if (picker.files.length) take([...picker.files]); else hold(file); });

  const carries = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  form.addEventListener("paste", (event) => {
    const pasted = [...(event.clipboardData?.files ?? [])];
    // Programs that copy text as well give a picture of it along.
    if (!pasted.length || event.clipboardData.getData("text/plain")) return;
    event.preventDefault();
    event.stopPropagation();
    take(pasted);
  }, { capture: true });

  let depth = 0;
  const over = (entered) => {
    depth = entered ? depth + 1 : Math.max(0, depth - 1);
    form.classList.toggle("dropping", depth > 0);
  };
  addEventListener("dragenter", (event) => { if (carries(event)) over(true); });
  addEventListener("dragleave", (event) => { if (carries(event)) over(false); });
  addEventListener("dragover", (event) => { if (carries(event)) event.preventDefault(); });
  addEventListener("drop", (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    event.stopPropagation();
    depth = 1;
    over(false);
    take([...event.dataTransfer.files]);
  }, { capture: true });

  const forget = () => {
    asked += 1; // a file that is still being read comes too late
    tell("");
    hold(undefined);
  };
  // A browser may bring back the field of an earlier visit.
  hold(undefined);
  editor.changed(() => {
    if (file) hold(undefined);
    tell("");
  });

  return {
    forget,
    // Puts what is to be sent into a form: the file as it was chosen, else the text of the editor.
    into(data) {
      if (file) data.set("file", file, file.name);
      else data.set("text", editor.text);
    },
  };
};
