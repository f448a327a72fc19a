"use strict";
// Grades the texts of the page and shows what comes of them. It works on the page's elements, the texts to send (`body`) and
// the editors that mark lines.
const gradeText = ({ form, result, state, body, sheets }) => {
  const PAUSE = 350; // milliseconds without a key after which the text is graded
  const words = form.dataset;
  const shown = result.querySelector("[data-shown]");
  const interruption = result.querySelector("[data-interruption]");
  const brief = shown.querySelector(".brief");
  let timer = 0;
  let current; // the request under way
  let player;
  let isHeld = false; // while a text is handed in
  let isWaiting = false; // whether a text waits for that to end

  const say = (text, kind = "") => {
    state.textContent = text;
    state.dataset.kind = kind;
  };

  // What an error page says.
  const problem = async (answer) => {
    const page = new DOMParser().parseFromString(await answer.text(), "text/html");
    return page.querySelector("[data-problem]")?.textContent.trim();
  };
  const waits = async (answer) => {
    outdate();
    say((answer && await problem(answer)) || words.offline, "waiting");
  };

  const stop = () => {
    clearTimeout(timer);
    timer = 0;
    current?.abort();
  };

  // `isTyped`: the text is one at which somebody types, who is not to lose the report of what worked before.
  const grade = async (isTyped) => {
    stop();
    if (isHeld) {
      isWaiting = true;
      return;
    }
    if (!words.draft) {
      outdate();
      return say(words.ungraded);
    }
    const mine = (current = new AbortController());
    const ask = (send) => untilAnswered(send, mine.signal, waits);
    say(words.grading, "busy");
    result.setAttribute("aria-busy", "true");
    try {
      const headers = { accept: "text/html", "x-part": "1" };
      let answer = await ask((signal) => fetch(words.draft, { method: "POST", body: body(), signal, headers }));
      while (answer.status === 202) {
        await new Promise((done) => setTimeout(done, 1000 * (Number(answer.headers.get("retry-after")) || 1)));
        const address = answer.headers.get("location");
        answer = await ask((signal) => fetch(address, { signal, headers: { accept: "text/html" } }));
      }
      if (!answer.ok) {
        outdate();
        return say((await problem(answer)) || words.failed, "failed");
      }
      const page = new DOMParser().parseFromString(await answer.text(), "text/html");
      if (mine.signal.aborted) return;
      await present(page, { signal: mine.signal, isTyped });
    } catch (error) {
      if (error.name !== "AbortError") say(words.failed, "failed");
    } finally {
      if (current === mine) result.removeAttribute("aria-busy");
    }
  };

  // Shows the report of a page or a part of one.
  const present = async (page, { signal, isTyped = false, said = words.draftword }) => {
    const part = page.querySelector("article.report");
    if (!part) return say(words.failed, "failed");
    const article = document.adoptNode(part);
    // The pictures are ready before they are seen, so that nothing flickers; a slow one is not waited for.
    const pictures = [...article.querySelectorAll("img.sheet")];
    await Promise.race([Promise.allSettled(pictures.map((picture) => picture.decode())), new Promise((done) => setTimeout(done, 400))]);
    if (signal?.aborted) return;
    const runs = article.dataset.drawn !== undefined;
    if (isTyped && !runs && !shown.querySelector("article.report:not([data-drawn])")) interrupt(article);
    else replace(article);
    const marks = JSON.parse(article.dataset.marks ?? "[]");
    sheets.mark(marks);
    if (!isTyped) sheets.show(marks);
    say(`${article.dataset.summary} · ${said}`, article.dataset.mark);
  };

  // The report that stands there is of an earlier text.
  const outdate = () => shown.classList.toggle("stale", shown.querySelector("article.report") !== null);

  const clear = () => {
    shown.querySelector("article.report")?.remove();
    shown.classList.remove("stale");
    interruption.replaceChildren();
    brief.hidden = false;
  };

  const replace = (article) => {
    const open = new Set([...shown.querySelectorAll("details")].flatMap((details, index) => (details.open ? [index] : [])));
    clear();
    brief.hidden = true;
    shown.append(article);
    [...article.querySelectorAll("details")].forEach((details, index) => { details.open = open.has(index); });
    const moving = article.querySelector(".player");
    if (moving) player = movePictures(moving, player) ?? player;
  };

  // What stands there stays, and what is wrong with the text stands above it in one line, which can be opened.
  const interrupt = (article) => {
    const wasOpen = interruption.querySelector("[aria-expanded=true]") !== null;
    const first = article.querySelector(".messages .error") ?? article;
    const line = document.createElement("p");
    const link = first.querySelector(".where a")?.cloneNode(true);
    const message = first.querySelector(".message") ?? first.querySelector(".verdict p:last-child");
    const text = document.createElement("span");
    text.append(...[...(message?.childNodes ?? [])].map((node) => node.cloneNode(true)));
    line.append(...(link ? [link, " "] : []), text);
    const more = document.createElement("button");
    more.type = "button";
    more.className = "quiet";
    more.textContent = words.more;
    const open = (isOpen) => {
      more.setAttribute("aria-expanded", String(isOpen));
      article.hidden = !isOpen;
    };
    more.addEventListener("click", () => open(article.hidden));
    open(wasOpen);
    article.replaceChildren(...article.querySelectorAll(".messages"));
    interruption.replaceChildren(line, more, article);
    outdate();
  };

  // The editor tells of a text when an input method has done; one that begins within the pause is waited for as well.
  const typed = () => {
    stop();
    isWaiting = isHeld;
    if (!isWaiting) timer = setTimeout(() => (sheets.isComposing ? typed() : grade(true)), PAUSE);
  };

  // Nothing is graded until it is released: then a text that was typed meanwhile is.
  const hold = () => {
    stop();
    isHeld = true;
  };
  // The signal that ends when another text is there than the one that was handed in; none where it is there already.
  const release = () => {
    isHeld = false;
    if (isWaiting) return typed();
    current = new AbortController();
    return current.signal;
  };

  addEventListener("offline", () => { if (!isHeld) say(words.offline, "waiting"); });
  addEventListener("online", () => {
    if (!isHeld && state.dataset.kind === "waiting" && !result.hasAttribute("aria-busy")) grade(true);
  });

  return {
    say,
    hold,
    release,
    problem,
    present,
    // The text was typed at; it came at once, as a file or an earlier attempt does; it is to be graded without a pause.
    typed,
    loaded: () => grade(false),
    again: () => grade(true),
    // Back to what stood there at first.
    clear() {
      stop();
      clear();
      player = undefined;
      sheets.mark([]);
      say("");
    },
  };
};
