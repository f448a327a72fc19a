"use strict";
// What was typed stays in this browser.
const keepDrafts = (form, editor) => {
  const { key } = form.dataset;

  const keep = () => {
    try {
      localStorage.setItem(key, editor.text);
    } catch { /* a browser that keeps nothing */ }
  };

  editor.changed(keep);

  return {
    keep,
    // The text that was kept, where it is another one than the page shows.
    kept() {
      try {
        const text = localStorage.getItem(key);
        return text && text !== editor.text ? text : undefined;
      } catch {
        return undefined;
      }
    },
  };
};
