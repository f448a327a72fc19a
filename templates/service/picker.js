"use strict";
// Files that are chosen, dropped or pasted into the page. What is handed in is the file itself, byte by byte, until its
// text is changed in the editor.
const pickFiles = (form, editor, { taken, refused }) => {
  const picker = form.elements.file;
  const LARGEST_SHOWN = 200_000; // bytes
  let file; // the file as it was chosen, until its text is changed

  const forget = () => {
    file = undefined;
    picker.value = "";
  };

  const take = async (chosen) => {
    if (chosen.size <= LARGEST_SHOWN) {
      editor.fill(decoded(await chosen.arrayBuffer()));
    } else {
      refused(form.dataset.large);
    }
    file = chosen;
    const transfer = new DataTransfer();
    transfer.items.add(chosen);
    picker.files = transfer.files;
    taken(chosen);
  };

  const decoded = (bytes) => {
    const view = new Uint8Array(bytes);
    const label = view[0] === 0xff && view[1] === 0xfe ? "utf-16le" : view[0] === 0xfe && view[1] === 0xff ? "utf-16be" : "utf-8";
    try {
      return new TextDecoder(label, { fatal: true }).decode(bytes).replace(/\r\n?/g, "\n");
    } catch {
      return new TextDecoder("shift_jis").decode(bytes).replace(/\r\n?/g, "\n");
    }
  };

  picker.addEventListener("change", () => { if (picker.files[0]) take(picker.files[0]); });
  form.addEventListener("paste", (event) => {
    const [pasted] = event.clipboardData?.files ?? [];
    if (!pasted) return;
    event.preventDefault();
    event.stopPropagation();
    take(pasted);
  }, { capture: true });

  let depth = 0;
  const carries = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragenter", (event) => { if (carries(event)) { depth += 1; form.classList.add("dropping"); } });
  addEventListener("dragleave", (event) => { if (carries(event) && (depth -= 1) <= 0) { depth = 0; form.classList.remove("dropping"); } });
  addEventListener("dragover", (event) => { if (carries(event)) event.preventDefault(); });
  addEventListener("drop", (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    event.stopPropagation();
    depth = 0;
    form.classList.remove("dropping");
    const [dropped] = event.dataTransfer.files;
    if (dropped) take(dropped);
  }, { capture: true });

  editor.changed(forget);

  return {
    forget,
    // Puts what is to be sent into a form: the file as it was chosen, else the text of the editor.
    into(data) {
      if (file) data.set("file", file, file.name);
      else data.set("text", editor.text);
    },
  };
};
