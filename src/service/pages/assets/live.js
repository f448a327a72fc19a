"use strict";
// Follows what the server does, where an element says how: the page works without it, by being loaded again.

// Parts of the page that show what arrives are fetched anew; what is being typed or pointed at elsewhere stays.
const parts = [...document.querySelectorAll("[data-live]")].map((part) => part.id);
const PAUSE = 2000;
let waiting = 0, last = 0;
const refresh = async () => {
  last = Date.now();
  waiting = 0;
  const answer = await fetch(location.href, { headers: { accept: "text/html" } }).catch(() => null);
  if (!answer?.ok || answer.redirected) return;
  const fresh = new DOMParser().parseFromString(await answer.text(), "text/html");
  for (const id of parts) {
    const old = document.getElementById(id), part = fresh.getElementById(id);
    if (!old || !part) continue;
    const focused = old.contains(document.activeElement) ? document.activeElement.getAttribute("href") : null;
    old.replaceWith(document.adoptNode(part));
    if (focused) part.querySelector(`[href="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
  }
};
const soon = () => {
  if (parts.length && !waiting) waiting = setTimeout(refresh, Math.max(0, last + PAUSE - Date.now()));
};

const follow = (element, address) => {
  const events = new EventSource(address);
  const status = element.querySelector("[role=status]");
  const bar = element.querySelector("progress");
  const show = (event) => {
    const { files, graded, failed } = JSON.parse(event.data);
    if (bar) {
      bar.max = Math.max(files, 1);
      bar.value = graded + failed;
    }
    if (status) status.textContent = element.dataset.words.replace("{done}", graded + failed).replace("{files}", files);
    soon();
  };
  events.addEventListener("change", soon);
  events.addEventListener("progress", show);
  events.addEventListener("done", (event) => {
    show(event);
    events.close();
    location.reload();
  });
  addEventListener("pagehide", () => events.close());
};
for (const element of document.querySelectorAll("[data-events]")) follow(element, element.dataset.events);
const watched = document.querySelector("[data-live]:not([data-live=''])");
if (watched) follow(watched, watched.dataset.live);
// A form that asks before it does what cannot be undone.
for (const form of document.querySelectorAll("form[data-ask]")) {
  form.addEventListener("submit", (event) => {
    if (!confirm(form.dataset.ask)) event.preventDefault();
  });
}
// A list that filters as soon as it is chosen from.
for (const field of document.querySelectorAll("form[data-auto] select")) {
  field.addEventListener("change", () => field.form.requestSubmit());
}
