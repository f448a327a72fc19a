"use strict";
// Hands in without leaving the page, and shows the receipt. What is handed in is the text at the moment of the click, under
// a key by which the service knows it again when it has to be sent twice.
const handInHere = ({ form, result, body, grading, refresh }) => {
  const words = form.dataset;
  const slot = result.querySelector("[data-receipt]");
  let isUnderWay = false;

  const newKey = () => [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  const leaving = (event) => event.preventDefault();

  const handIn = async (button) => {
    if (isUnderWay) return;
    isUnderWay = true;
    grading.hold();
    const data = body();
    const headers = { accept: "text/html", "x-part": "1", "idempotency-key": newKey() };
    const send = (signal) => fetch(form.action, { method: "POST", body: data, signal, headers });
    button?.setAttribute("aria-disabled", "true");
    addEventListener("beforeunload", leaving);
    grading.say(words.handing, "busy");
    const answer = await untilDone(send, words.unsent);
    // From here on the file is stored, or refused.
    removeEventListener("beforeunload", leaving);
    button?.removeAttribute("aria-disabled");
    isUnderWay = false;
    const view = grading.release();
    if (answer.ok) await receive(answer, view);
    else if (view) grading.say((await grading.problem(answer)) || words.failed, "failed");
    await refresh();
  };

  const untilDone = (send, gone) => {
    const waits = async (answer) => grading.say((answer && (await grading.problem(answer))) || gone, "waiting");
    return untilAnswered(send, new AbortController().signal, waits);
  };

  // Shows the receipt at once, and the report as soon as there is one: where the text is still the one that it is about.
  const receive = async (answer, view) => {
    const page = new DOMParser().parseFromString(await answer.text(), "text/html");
    const receipt = page.querySelector("[data-handed-in]");
    if (!receipt) return grading.say(words.failed, "failed");
    receipt.querySelectorAll(".permalink").forEach(copyLink);
    const isFirst = receipt.querySelector(".permalink").href !== slot.querySelector(".permalink")?.href;
    slot.replaceChildren(document.adoptNode(receipt));
    if (isFirst) lead(receipt);
    if (page.querySelector("article.report")) {
      if (view) await grading.present(page, { signal: view, said: words.handedin });
      return;
    }
    if (view && !view.aborted) grading.say(words.stored, "busy");
    if (isFirst) refresh();
    await new Promise((done) => setTimeout(done, 1000 * (Number(answer.headers.get("retry-after")) || 1)));
    const later = (signal) => fetch(answer.headers.get("location"), { signal, headers: { accept: "text/html" } });
    const next = await untilDone(later, words.offline);
    if (next.ok) await receive(next, view);
  };

  const lead = (receipt) => {
    receipt.tabIndex = -1;
    receipt.focus({ preventScroll: true });
    const { top, bottom } = receipt.getBoundingClientRect();
    if (top < 0 || bottom > innerHeight) receipt.scrollIntoView({ block: "start" });
  };

  form.addEventListener("submit", (event) => {
    event.preventDefault();
    handIn(event.submitter);
  });
};
