"use strict";
// Follows what the server does, where an element says how: the page works without it, by being loaded again.
for (const element of document.querySelectorAll("[data-events]")) {
  const events = new EventSource(element.dataset.events);
  const status = element.querySelector("[role=status]");
  const bar = element.querySelector("progress");
  const show = (event) => {
    const { files, graded, failed } = JSON.parse(event.data);
    if (bar) {
      bar.max = Math.max(files, 1);
      bar.value = graded + failed;
    }
    if (status) status.textContent = element.dataset.words.replace("{done}", graded + failed).replace("{files}", files);
  };
  events.addEventListener("progress", show);
  events.addEventListener("done", (event) => {
    show(event);
    events.close();
    location.reload();
  });
  addEventListener("pagehide", () => events.close());
}
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
