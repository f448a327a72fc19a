"use strict";
// The versions of the file in sight: seeing them, and going back to one. Beside the file stands what there is to know of its
// drafts.
const showVersions = (sheets, { restored }) => {
  const dialog = document.querySelector("dialog.versions");
  const note = document.querySelector(".note-of-drafts");
  const words = dialog.dataset;
  const list = dialog.querySelector("ol");
  const preview = dialog.querySelector("pre");
  const restore = dialog.querySelector("[data-do=restore]");
  const name = dialog.querySelector(".name");
  let chosen;

  const tell = (sheet, text) => {
    sheet.note = text;
    if (sheet !== sheets.current) return;
    note.querySelector("span").textContent = text;
    note.hidden = !text;
  };
  sheets.opened((sheet) => tell(sheet, sheet.note ?? ""));

  const choose = (version, button) => {
    const { text } = sheets.current.editor;
    chosen = version;
    list.querySelector("[aria-current]")?.removeAttribute("aria-current");
    button.setAttribute("aria-current", "true");
    restore.disabled = version.text === text;
    // Lines that the editor does not have are tinted.
    const present = new Set(text.split("\n"));
    preview.replaceChildren(...version.text.split("\n").map((line) => {
      const row = document.createElement(present.has(line) ? "span" : "mark");
      row.textContent = `${line}\n`;
      return row;
    }));
    const first = preview.querySelector("mark") ?? preview.firstChild;
    preview.scrollTop = first.offsetTop - preview.offsetTop - preview.clientHeight / 2;
  };

  const row = (version) => {
    const button = document.createElement("button");
    const when = document.createElement("time");
    const what = document.createElement("small");
    button.type = "button";
    when.dateTime = new Date(version.at).toISOString();
    when.textContent = draftTime.format(version.at);
    const shown = version.text === sheets.current.editor.text ? ` · ${words.shown}` : "";
    const of = version.of ? draftTime.format(version.of) : version.name;
    what.textContent = `${words[version.kind] ?? ""}${of ? ` ${of}` : ""}${shown}`;
    button.append(when, what);
    button.addEventListener("click", () => choose(version, button));
    const item = document.createElement("li");
    item.append(button);
    return item;
  };

  const open = () => {
    const sheet = sheets.current;
    tell(sheet, "");
    if (name) name.textContent = sheet.name;
    const all = sheet.drafts.versions();
    list.replaceChildren(...all.map(row));
    dialog.querySelector(".none").hidden = all.length > 0;
    dialog.querySelector(".panes").hidden = !all.length;
    restore.disabled = true;
    preview.replaceChildren();
    dialog.showModal();
    if (!all.length) return;
    const other = Math.max(0, all.findIndex((version) => version.text !== sheet.editor.text));
    choose(all[other], list.children[other].firstChild);
    list.children[other].firstChild.focus();
  };

  note.querySelector("[data-do=dismiss]").addEventListener("click", () => tell(sheets.current, ""));
  dialog.querySelector("[data-do=close]").addEventListener("click", () => dialog.close());
  restore.addEventListener("click", () => {
    const sheet = sheets.current;
    dialog.close();
    sheet.editor.fill(chosen.text);
    sheet.drafts.keep({ kind: "version", of: chosen.at });
    restored(sheet);
  });
  for (const button of document.querySelectorAll("[data-do=versions]")) {
    button.hidden = false;
    button.addEventListener("click", open);
  }

  return { words, tell };
};
