"use strict";
// The files of the homework, each in an editor. Of several, one is in sight, and tabs say which.
const openSheets = (form, { grade }) => {
  const KINDS = ["error", "warning", "rubric"]; // of marks, the gravest first
  const tabs = form.querySelector(".tabs");
  const listeners = [];

  const all = [...form.querySelectorAll("[data-editor]")].map((host, index) => {
    const textarea = host.querySelector("textarea");
    const tab = document.getElementById(`${textarea.id}-tab`);
    const { key, output, starter, file: name } = host.dataset;
    return { index, host, textarea, tab, key, output, starter, name, editor: editGlsl(host, textarea, { grade }) };
  });
  let current = all[0];

  const open = (sheet) => {
    current = sheet;
    for (const { host, tab } of tabs ? all : []) {
      host.toggleAttribute("data-behind", host !== sheet.host);
      tab.setAttribute("aria-selected", String(host === sheet.host));
      tab.tabIndex = host === sheet.host ? 0 : -1;
    }
    for (const listener of listeners) listener(sheet);
  };

  if (tabs) {
    tabs.setAttribute("role", "tablist");
    for (const sheet of all) {
      sheet.tab.setAttribute("role", "tab");
      sheet.tab.setAttribute("aria-controls", sheet.host.id);
      sheet.host.setAttribute("role", "tabpanel");
      sheet.host.setAttribute("aria-labelledby", sheet.tab.id);
      sheet.tab.addEventListener("click", () => open(sheet));
    }
    tabs.addEventListener("keydown", (event) => {
      const last = all.length - 1;
      const steps = { ArrowLeft: current.index - 1, ArrowRight: current.index + 1, Home: 0, End: last };
      if (!(event.key in steps)) return;
      event.preventDefault();
      open(all[(steps[event.key] + all.length) % all.length]);
      current.tab.focus();
    });
    open(current);
  }

  return {
    all,
    get current() {
      return current;
    },
    get isComposing() {
      return all.some((sheet) => sheet.editor.isComposing);
    },
    open,
    // Calls the listener with the file that comes into sight.
    opened(listener) {
      listeners.push(listener);
    },
    // Calls the listener with a file whose text a person has changed.
    changed(listener) {
      for (const sheet of all) sheet.editor.changed(() => listener(sheet));
    },
    // Marks lines, { file, line, column, length, kind }, each in its own file; a tab shows the gravest kind of its file.
    mark(found) {
      for (const sheet of all) {
        const own = found.filter((mark) => mark.file === sheet.index);
        sheet.editor.mark(own);
        if (!tabs) continue;
        const kind = KINDS.find((one) => own.some((mark) => mark.kind === one)) ?? "";
        sheet.tab.dataset.mark = kind;
        sheet.tab.querySelector("span").textContent = kind && ` ${tabs.dataset[kind]}`;
      }
    },
    // Goes to a line of the file with this index.
    go(index, line) {
      open(all[index]);
      all[index].editor.go(line);
    },
    // Brings a mark into sight: the first of the file that is, else of another. Nothing moves under a person who is in an
    // editor.
    show(found) {
      if (!found.length || form.querySelector("[data-editor]:focus-within")) return;
      const { file, line } = found.find((mark) => mark.file === current.index) ?? found[0];
      open(all[file]);
      all[file].editor.show(line);
    },
  };
};
