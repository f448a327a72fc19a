"use strict";
// What was typed into a file stays in this browser, in versions that one can go back to. Each version has a key of its own
// and is written by one page only, so that two tabs never write over each other.
const draftTime = new Intl.DateTimeFormat(document.documentElement.lang, { month: "short", day: "numeric", hour: "2-digit", minute: "2-digit", second: "2-digit", hourCycle: "h23" });

// The drafts of one file. `own` is the hand-in that the page shows, where it shows one; `words` are those of the page, and
// `tell` says something beside the file.
const keepDrafts = (sheet, { own, words, tell }) => {
  const { key, editor, textarea } = sheet;
  const PREFIX = `${key} version `;
  const MOST = 80; // versions that are kept
  const PAUSE = 60_000; // milliseconds without a change, or in all, after which typing begins a new version
  const LONGEST = 300_000;
  let mine; // the version that this page writes: { id, start, at, text, kind, and name of a file or time of a version }
  let next = { kind: "typed" }; // where the next version comes from

  const stored = (storage, name) => {
    try {
      return JSON.parse(storage.getItem(name));
    } catch {
      return null;
    }
  };

  // All versions, the newest first.
  const versions = () => {
    const found = [];
    try {
      for (let index = 0; index < localStorage.length; index += 1) {
        const name = localStorage.key(index);
        const version = name.startsWith(PREFIX) ? stored(localStorage, name) : null;
        if (typeof version?.text === "string") found.push({ ...version, id: name.slice(PREFIX.length) });
      }
    } catch { /* a browser that keeps nothing */ }
    return found.sort((a, b) => b.at - a.at);
  };

  // Of too many, the one that stands closest to its neighbours in time goes; the newest and the oldest stay.
  const thin = (most) => {
    const all = versions();
    while (all.length > most && all.length > 2) {
      let closest = 1;
      const gap = (index) => all[index - 1].at - all[index + 1].at;
      for (let index = 2; index < all.length - 1; index += 1) if (gap(index) <= gap(closest)) closest = index;
      localStorage.removeItem(PREFIX + all[closest].id);
      all.splice(closest, 1);
    }
  };

  const write = () => {
    const { id, ...version } = mine;
    for (let most = MOST; ; most = Math.floor(most / 2)) {
      try {
        localStorage.setItem(PREFIX + id, JSON.stringify(version));
        sessionStorage.setItem(key, JSON.stringify({ id, own }));
        return;
      } catch {
        // Full: older versions make room, as long as there are any.
        try {
          if (most > 2) { thin(most); continue; }
        } catch { /* not even that */ }
        tell(words.unkept);
        return;
      }
    }
  };

  // Keeps the text as it is now.
  const keep = (from) => {
    const now = Date.now();
    const text = editor.text;
    if (from && mine?.text === text) return;
    const goesOn = !from && mine && now - mine.at < PAUSE && now - mine.start < LONGEST;
    if (!goesOn) {
      mine = { id: crypto.randomUUID?.() ?? `${now}-${Math.random()}`, start: now, ...(from ?? next) };
      next = { kind: "typed" };
      thin(MOST);
    }
    Object.assign(mine, { at: now, text });
    write();
  };
  editor.changed(() => keep());
  const tellNewer = (version, wording) => tell(wording.replace("{}", draftTime.format(version.at)));

  // Another tab of the browser wrote a version: this one goes on with its own text, and says so.
  addEventListener("storage", (event) => {
    if (!event.key?.startsWith(PREFIX) || !event.newValue) return;
    const version = stored(localStorage, event.key);
    if (version && version.text !== editor.text) tellNewer(version, words.other);
  });

  // ---- What the page begins with ----
  // Earlier releases kept one text, under the key itself.
  try {
    const text = localStorage.getItem(key);
    if (text !== null) {
      const now = Date.now();
      localStorage.setItem(`${PREFIX}earlier`, JSON.stringify({ start: now, at: now, text, kind: "typed" }));
      localStorage.removeItem(key);
    }
  } catch { /* a browser that keeps nothing */ }

  return {
    keep,
    versions,
    // Puts the text to go on with into the editor: this tab's own, else the newest. Whether it is another one than the
    // page came with.
    begin() {
      const all = versions();
      // Typed before the scripts were there, or brought back by the browser.
      if (textarea.value !== textarea.defaultValue) {
        if (!all.some((version) => version.text === editor.text)) keep();
        return true;
      }
      let tab = null;
      try {
        tab = stored(sessionStorage, key);
      } catch { /* as above */ }
      // A page that shows an earlier attempt goes on with that, and when it is loaded again with what became of it.
      const isOpenedAnew = performance.getEntriesByType("navigation")[0]?.type === "navigate";
      const isTabs = tab && (own === undefined || (tab.own === own && !isOpenedAnew));
      const tabs = isTabs ? all.find((version) => version.id === tab.id) : undefined;
      const kept = tabs ?? (own === undefined ? all[0] : undefined);
      const isOther = kept !== undefined && kept.text !== editor.text;
      if (isOther) editor.fill(kept.text);
      if (own !== undefined && !kept) next = { kind: "attempt" };
      if (all[0] && all[0] !== kept && all[0].text !== editor.text) tellNewer(all[0], words.newer);
      return isOther;
    },
  };
};
