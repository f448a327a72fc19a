"use strict";
// Grades what is in the editor as it changes, and keeps it in this browser.
{
  const form = document.querySelector("form.work");
  const textarea = form.elements.text;
  const result = document.querySelector("[data-result]");
  const state = document.getElementById("state");
  const { draft, starter, grading, failed, draftword } = form.dataset;
  const editor = editGlsl(form.querySelector("[data-editor]"), textarea);
  const drafts = keepDrafts(form, editor);
  const PAUSE = 350; // milliseconds without a key after which the text is graded
  const brief = [...result.childNodes];
  document.documentElement.classList.add("scripted");

  let timer = 0;
  let current; // the request under way
  let player;
  let isLoaded = false; // whether the text came at once, from a file or an earlier attempt, and was not seen yet

  const say = (text, kind = "") => {
    state.textContent = text;
    state.dataset.kind = kind;
  };

  const body = () => {
    const data = new FormData();
    data.set("csrf", form.elements.csrf.value);
    files.into(data);
    return data;
  };

  const grade = async () => {
    clearTimeout(timer);
    if (!draft) return;
    current?.abort();
    const mine = (current = new AbortController());
    say(grading, "busy");
    result.setAttribute("aria-busy", "true");
    try {
      let answer = await fetch(draft, { method: "POST", body: body(), signal: mine.signal, headers: { accept: "text/html", "x-part": "1" } });
      while (answer.status === 202) {
        await new Promise((done) => setTimeout(done, 1000 * (Number(answer.headers.get("retry-after")) || 1)));
        answer = await fetch(answer.headers.get("location"), { signal: mine.signal, headers: { accept: "text/html" } });
      }
      const html = await answer.text();
      if (mine.signal.aborted) return;
      if (answer.status === 429 || answer.status === 503) {
        const seconds = Number(answer.headers.get("retry-after")) || 2;
        timer = setTimeout(grade, Math.min(seconds, 30) * 1000);
        say(problem(html) || grading, "busy");
        return;
      }
      if (!answer.ok) {
        say(problem(html) || failed, "failed");
        return;
      }
      await show(html, mine.signal);
    } catch (error) {
      if (error.name !== "AbortError") say(failed, "failed");
    } finally {
      if (current === mine) result.removeAttribute("aria-busy");
    }
  };

  // What an error page says.
  const problem = (html) => new DOMParser().parseFromString(html, "text/html").querySelector("[data-problem]")?.textContent.trim();

  const show = async (html, signal) => {
    const part = new DOMParser().parseFromString(html, "text/html").querySelector("article.report");
    if (!part) return say(failed, "failed");
    const article = document.adoptNode(part);
    // The pictures are ready before they are seen, so that nothing flickers; a slow one is not waited for.
    const pictures = [...article.querySelectorAll("img.sheet")];
    await Promise.race([Promise.allSettled(pictures.map((picture) => picture.decode())), new Promise((done) => setTimeout(done, 400))]);
    if (signal.aborted) return;
    const open = new Set([...result.querySelectorAll("details[open]")].map((_, index) => index));
    result.replaceChildren(article);
    [...article.querySelectorAll("details")].forEach((details, index) => { details.open = open.has(index); });
    const moving = article.querySelector(".player");
    const before = player;
    player = moving ? movePictures(moving, before) ?? before : before;
    const marks = JSON.parse(article.dataset.marks ?? "[]");
    editor.mark(marks);
    if (isLoaded && marks.length) editor.show(marks[0].line);
    isLoaded = false;
    textarea.setAttribute("aria-invalid", String(marks.some((mark) => mark.kind === "error")));
    say(`${article.dataset.summary} · ${draftword}`, article.dataset.mark);
  };

  const files = pickFiles(form, editor, {
    async taken() {
      drafts.keep();
      isLoaded = true;
      await grade();
      // On a small window the result is below: go there.
      if (matchMedia("(max-width: 62rem)").matches) result.scrollIntoView();
    },
    refused: say,
  });

  editor.changed(() => {
    clearTimeout(timer);
    timer = setTimeout(grade, PAUSE);
  });

  const reset = form.querySelector("[data-do=starter]");
  reset.hidden = false;
  reset.addEventListener("click", async () => {
    const answer = await fetch(starter);
    if (!answer.ok) return say(failed, "failed");
    editor.fill(await answer.text());
    files.forget();
    current?.abort();
    clearTimeout(timer);
    result.replaceChildren(...brief);
    player = undefined;
    editor.mark([]);
    say("");
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
      grade();
    }
  });

  form.addEventListener("submit", () => {
    clearTimeout(timer);
    current?.abort();
  });

  // A page that is shown with a text of its own, such as an earlier attempt, keeps it.
  const kept = drafts.kept();
  if (form.dataset.own !== undefined) {
    isLoaded = true;
    grade();
  } else if (kept !== undefined) {
    editor.fill(kept);
    grade();
  }
}
