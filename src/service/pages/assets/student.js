"use strict";
// The page on which a student works: puts its parts together.
{
  const form = document.querySelector("form.work");
  const sheet = form.querySelector("[data-editor]");
  const result = document.querySelector("[data-result]");
  const state = document.getElementById("state");
  const { starter, output, failed } = form.dataset;
  const editor = editGlsl(sheet, form.elements.text, { grade: () => grading.again() });
  document.documentElement.classList.add("scripted");

  const body = () => {
    const data = new FormData();
    data.set("csrf", form.elements.csrf.value);
    files.into(data);
    return data;
  };

  const standing = keepStanding(form);
  const grading = gradeText({ form, result, state, body, editor });
  handInHere({ form, result, body, grading, refresh: standing.refresh });

  const drafts = keepDrafts(form, editor, {
    restored() {
      files.forget();
      grading.loaded();
    },
  });
  const files = pickFiles(form, editor, (file) => {
    drafts.keep({ kind: "file", name: file.name });
    grading.loaded();
  });

  editor.changed(grading.typed);

  const reset = form.querySelector("[data-do=starter]");
  reset.hidden = false;
  reset.addEventListener("click", async () => {
    const answer = await fetch(starter).catch(() => undefined);
    if (!answer?.ok) return grading.say(failed, "failed");
    editor.fill(await answer.text());
    files.forget();
    grading.clear();
    drafts.keep({ kind: "starter" });
    showPlace();
  });

  result.addEventListener("click", (event) => {
    const line = /^#L(\d+)$/.exec(event.target.closest?.("a")?.getAttribute("href") ?? "");
    if (!line) return;
    event.preventDefault();
    editor.go(Number(line[1]));
  });

  // Brings the last line into sight that gives the result its value: that is where the answer goes.
  const showPlace = () => {
    const code = editor.text.replace(/\/\*[^]*?\*\/|\/\/.*/g, (comment) => comment.replace(/[^\n]/g, " "));
    const gives = new RegExp(`\\b${output}\\b\\s*(\\.\\s*\\w+\\s*)?[-+*/]?=(?!=)`);
    const line = code.split("\n").findLastIndex((text) => gives.test(text)) + 1;
    if (line) editor.show(line);
  };

  // The editor is as high as what the window leaves below what stands above it.
  const measure = () => {
    const above = sheet.getBoundingClientRect().top - form.getBoundingClientRect().top;
    const desk = form.parentElement.getBoundingClientRect().top + scrollY;
    form.style.setProperty("--above", `${Math.round(desk + above)}px`);
  };
  addEventListener("resize", measure);
  measure();

  const isOther = drafts.begin();
  showPlace();
  if (isOther || form.dataset.own !== undefined) grading.loaded();
}
