"use strict";
// The page on which a student works: puts its parts together.
{
  const form = document.querySelector("form.work");
  const textarea = form.elements.text;
  const result = document.querySelector("[data-result]");
  const state = document.getElementById("state");
  const { starter, failed } = form.dataset;
  const editor = editGlsl(form.querySelector("[data-editor]"), textarea);
  const drafts = keepDrafts(form, editor);
  document.documentElement.classList.add("scripted");

  const body = () => {
    const data = new FormData();
    data.set("csrf", form.elements.csrf.value);
    files.into(data);
    return data;
  };

  const mark = (marks) => {
    editor.mark(marks);
    textarea.setAttribute("aria-invalid", String(marks.some((mark) => mark.kind === "error")));
  };

  const standing = keepStanding(form);
  const grading = gradeText({ form, result, state, body, mark, show: editor.show });
  handInHere({ form, result, body, grading, refresh: standing.refresh });

  const files = pickFiles(form, editor, {
    async taken() {
      drafts.keep();
      await grading.loaded();
      // On a small window the result is below: go there.
      if (matchMedia("(max-width: 62rem)").matches) result.scrollIntoView();
    },
    refused: grading.say,
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
    drafts.keep();
  });

  result.addEventListener("click", (event) => {
    const line = /^#L(\d+)$/.exec(event.target.closest?.("a")?.getAttribute("href") ?? "");
    if (!line) return;
    event.preventDefault();
    editor.go(Number(line[1]));
  });

  textarea.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      grading.again();
    }
  });

  // A page that is shown with a text of its own, such as an earlier attempt, keeps it.
  const kept = drafts.kept();
  if (form.dataset.own !== undefined) {
    grading.loaded();
  } else if (kept !== undefined) {
    editor.fill(kept);
    grading.loaded();
  }
}
