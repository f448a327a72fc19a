"use strict";
// Grades what is in the editor as it changes, and keeps it in this browser.
{
  const form = document.querySelector("form.work");
  const textarea = form.elements.text;
  const picker = form.elements.file;
  const result = document.querySelector("[data-result]");
  const state = document.getElementById("state");
  const { draft, starter, key, grading, failed, draftword, large } = form.dataset;
  const editor = editGlsl(form.querySelector("[data-editor]"), textarea);
  const PAUSE = 350; // milliseconds without a key after which the text is graded
  const LARGEST_SHOWN = 200_000; // bytes
  const brief = [...result.childNodes];
  document.documentElement.classList.add("scripted");

  let file; // the file as it was chosen, until its text is changed
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
    if (file) data.set("file", file, file.name);
    else data.set("text", textarea.value);
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

  const keep = () => {
    try {
      localStorage.setItem(key, textarea.value);
    } catch { /* a browser that keeps nothing */ }
  };

  textarea.addEventListener("input", () => {
    file = undefined;
    picker.value = "";
    keep();
    clearTimeout(timer);
    timer = setTimeout(grade, PAUSE);
  });

  const take = async (chosen) => {
    if (chosen.size <= LARGEST_SHOWN) {
      editor.fill(decoded(await chosen.arrayBuffer()));
    } else {
      say(large);
    }
    clearTimeout(timer);
    isLoaded = true;
    file = chosen;
    // What is handed in is the file itself, byte by byte.
    const transfer = new DataTransfer();
    transfer.items.add(chosen);
    picker.files = transfer.files;
    await grade();
    // On a small window the result is below: go there.
    if (matchMedia("(max-width: 62rem)").matches) result.scrollIntoView();
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
  textarea.addEventListener("paste", (event) => {
    const [pasted] = event.clipboardData?.files ?? [];
    if (!pasted) return;
    event.preventDefault();
    take(pasted);
  });

  let depth = 0;
  const carries = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  addEventListener("dragenter", (event) => { if (carries(event)) { depth += 1; form.classList.add("dropping"); } });
  addEventListener("dragleave", (event) => { if (carries(event) && (depth -= 1) <= 0) { depth = 0; form.classList.remove("dropping"); } });
  addEventListener("dragover", (event) => { if (carries(event)) event.preventDefault(); });
  addEventListener("drop", (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    depth = 0;
    form.classList.remove("dropping");
    const [dropped] = event.dataTransfer.files;
    if (dropped) take(dropped);
  });

  const reset = form.querySelector("[data-do=starter]");
  reset.hidden = false;
  reset.addEventListener("click", async () => {
    const answer = await fetch(starter);
    if (!answer.ok) return say(failed, "failed");
    editor.fill(await answer.text());
    current?.abort();
    clearTimeout(timer);
    result.replaceChildren(...brief);
    player = undefined;
    editor.mark([]);
    say("");
    keep();
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
  const handedOut = textarea.defaultValue;
  let kept = null;
  try {
    kept = localStorage.getItem(key);
  } catch { /* as above */ }
  if (form.dataset.own !== undefined) {
    isLoaded = true;
    grade();
  } else if (kept && kept !== handedOut) {
    editor.fill(kept);
    clearTimeout(timer);
    grade();
  }
}
