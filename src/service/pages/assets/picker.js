"use strict";
// Files that are chosen, dropped or pasted into the page. The service says which is for which slot and what it reads, with
// the decoder that grades it: what is no text never enters an editor. What is handed in is the file itself, byte by byte,
// until its text is changed in the editor.
const pickFiles = (form, sheets, taken) => {
  const picker = form.elements.file;
  const note = form.querySelector(".note-of-file");
  const { read, reading, unread, others, unreadable, empty, large, most } = form.dataset;
  let asked = 0;

  const tell = (text) => {
    note.querySelector("span").textContent = text;
    note.hidden = !text;
  };
  note.querySelector("button").addEventListener("click", () => tell(""));

  const isArchive = (file) => /\.zip$/i.test(file.name);

  // A file as it is now; none of a folder, or of one that is gone.
  const copied = async (file) => {
    try {
      return new File([await file.arrayBuffer()], file.name, { type: file.type });
    } catch {
      return undefined;
    }
  };

  const take = async (files) => {
    const mine = (asked += 1);
    picker.value = "";
    const refuse = (why) => { if (mine === asked) tell(why); };
    const [first] = files;
    // Of several, what can be no shader is left out.
    const small = files.filter((file) => file.size <= Number(most) || isArchive(file));
    if (!small.length) return refuse(`${first.name}: ${large}`);
    if (files.length === 1 && !first.size) return refuse(`${first.name}: ${empty}`);
    tell(reading);
    const copies = (await Promise.all(small.map(copied))).filter(Boolean);
    if (!copies.length) return refuse(`${first.name}: ${unreadable}`);
    let answer, said;
    try {
      const body = new FormData();
      body.set("csrf", form.elements.csrf.value);
      body.set("shown", sheets.current.index);
      for (const copy of copies) body.append("file", copy);
      answer = await fetch(read, { method: "POST", body, headers: { accept: "application/json" } });
      said = await answer.json();
    } catch {
      return refuse(`${copies.map((copy) => copy.name).join(", ")}: ${unread}`);
    }
    if (mine !== asked) return;
    if (!answer.ok) return refuse(said.detail);
    const filled = said.map(({ slot, name, text, bytes }) => {
      const sheet = sheets.all[slot];
      sheet.editor.fill(text);
      sheet.file = new File([Uint8Array.from(atob(bytes), (byte) => byte.charCodeAt(0))], name);
      return sheet;
    });
    if (!filled.includes(sheets.current)) sheets.open(filled[0]);
    const isPart = filled.length < sheets.all.length && (files.length > 1 || isArchive(first));
    tell(isPart ? others.replace("{}", filled.map((sheet) => sheet.name).join(", ")) : "");
    taken(filled);
  };

  picker.addEventListener("change", () => { if (picker.files.length) take([...picker.files]); });

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
    const dropped = [...event.dataTransfer.files];
    if (dropped.length) take(dropped);
  }, { capture: true });

  // A browser may bring back the field of an earlier visit.
  picker.value = "";
  sheets.changed((sheet) => {
    sheet.file = undefined;
    tell("");
  });

  return {
    // What is sent of this file is the text of its editor.
    forget(sheet) {
      asked += 1; // a file that is still being read comes too late
      tell("");
      sheet.file = undefined;
    },
    // Puts what is to be sent into a form, in the order of the slots: the file as it was chosen, else the text of the editor.
    into(data) {
      for (const sheet of sheets.all) data.append("text", sheet.file ?? sheet.editor.text);
    },
  };
};
