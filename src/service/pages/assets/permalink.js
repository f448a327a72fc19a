"use strict";
// Shows a link to this service as the whole address, which can be sent to somebody, with a button that copies it.
const copyLink = (anchor) => {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = anchor.dataset.copy;
  // Without a certificate a page has no clipboard; then it copies what is selected.
  const copied = async () => {
    try {
      await navigator.clipboard.writeText(anchor.href);
      return true;
    } catch {
      getSelection().selectAllChildren(anchor);
      return document.execCommand("copy");
    }
  };
  button.addEventListener("click", async () => {
    if (await copied()) button.textContent = anchor.dataset.copied;
  });
  anchor.textContent = anchor.href;
  anchor.after(" ", button);
};
document.querySelectorAll(".permalink").forEach(copyLink);
