"use strict";
// Keeps a preview as the folder is: a new version of the folder is a new page, and what its own files score appears when they
// are graded. What was typed is kept as a draft.
{
  const { version, graded } = document.querySelector("[data-preview]").dataset;
  const events = new EventSource(`/preview/events?version=${version}&graded=${graded !== undefined}`);
  events.addEventListener("folder", () => {
    events.close();
    location.reload();
  });
  events.addEventListener("graded", async () => {
    const answer = await fetch(location.href, { headers: { accept: "text/html" } }).catch(() => undefined);
    if (!answer?.ok) return;
    const page = new DOMParser().parseFromString(await answer.text(), "text/html");
    const fresh = page.getElementById("preview");
    if (fresh) document.getElementById("preview").replaceWith(document.adoptNode(fresh));
    // What stands above the editor has another height now.
    dispatchEvent(new Event("resize"));
  });
  addEventListener("pagehide", () => events.close());
}
