"use strict";
// The page on which a student works: puts its parts together.
{
  const form = document.querySelector("form.work");
  const box = form.querySelector(".sheet-of-code");
  const result = document.querySelector("[data-result]");
  const state = document.getElementById("state");
  const { own, failed } = form.dataset;
  const sheets = openSheets(form, { grade: () => grading.again() });
  document.documentElement.classList.add("scripted");

  const body = () => {
    const data = new FormData();
    data.set("csrf", form.elements.csrf.value);
    files.into(data);
    return data;
  };

  const standing = keepStanding(form);
  const grading = gradeText({ form, result, state, body, sheets });
  handInHere({ form, result, body, grading, refresh: standing.refresh });

  const { words, tell } = showVersions(sheets, {
    restored(sheet) {
      files.forget(sheet);
      grading.loaded();
    },
  });
  for (const sheet of sheets.all) sheet.drafts = keepDrafts(sheet, { own, words, tell: (text) => tell(sheet, text) });
  const files = pickFiles(form, sheets, (filled) => {
    for (const sheet of filled) sheet.drafts.keep({ kind: "file", name: sheet.file.name });
    grading.loaded();
  });

  sheets.changed(grading.typed);

  const handedOut = async (sheet) => {
    const answer = await fetch(sheet.starter);
    if (!answer.ok) throw new Error(answer.statusText);
    return (await answer.text()).replace(/\r\n?/g, "\n");
  };
  const reset = form.querySelector("[data-do=starter]");
  reset.hidden = false;
  reset.addEventListener("click", async () => {
    const sheet = sheets.current;
    const texts = await Promise.all(sheets.all.map(handedOut)).catch(() => undefined);
    if (!texts) return grading.say(failed, "failed");
    sheet.editor.fill(texts[sheet.index]);
    files.forget(sheet);
    sheet.drafts.keep({ kind: "starter" });
    if (sheets.all.every(({ editor, index }) => editor.text === texts[index])) grading.clear();
    else grading.loaded();
    showPlace(sheet);
  });

  result.addEventListener("click", (event) => {
    const line = /^#(?:F(\d+))?L(\d+)$/.exec(event.target.closest?.("a")?.getAttribute("href") ?? "");
    if (!line) return;
    event.preventDefault();
    sheets.go(Number(line[1] ?? 1) - 1, Number(line[2]));
  });

  // Brings the last line into sight that gives the result its value: that is where the answer goes.
  const showPlace = ({ editor, output }) => {
    const code = editor.text.replace(/\/\*[^]*?\*\/|\/\/.*/g, (comment) => comment.replace(/[^\n]/g, " "));
    const gives = new RegExp(`\\b${output}\\b\\s*(\\.\\s*\\w+\\s*)?[-+*/]?=(?!=)`);
    const line = code.split("\n").findLastIndex((text) => gives.test(text)) + 1;
    if (line) editor.show(line);
  };

  // The editor is as high as what the window leaves below what stands above it.
  const measure = () => {
    const above = box.getBoundingClientRect().top - form.getBoundingClientRect().top;
    const desk = form.parentElement.getBoundingClientRect().top + scrollY;
    form.style.setProperty("--above", `${Math.round(desk + above)}px`);
  };
  addEventListener("resize", measure);
  measure();

  const areOthers = sheets.all.filter((sheet) => sheet.drafts.begin());
  sheets.all.forEach(showPlace);
  if (areOthers.length || own !== undefined) grading.loaded();
}
