"use strict";
// Filters and sorts the table that is there; without this it is a table of everyone.
{
  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  const one = (selector) => document.querySelector(selector);
  const sheet = one(".sheet"), body = sheet.tBodies[0];
  const search = one(".search input"), order = one(".order select");
  const active = one(".active"), output = one(".shown output");
  const toggles = all("[data-kind]");
  const fold = (text) => text.normalize("NFKC").toLowerCase();
  const verdicts = ["correct", "wrong", "rejected", "stopped", "not-graded", "fault"];
  const collator = new Intl.Collator(document.documentElement.lang, { numeric: true });

  const rows = [...body.rows].map((row, index) => ({
    row, index,
    text: fold(`${row.querySelector(".who").textContent} ${row.querySelector(".found").textContent} ${row.dataset.mistake}`),
    name: row.querySelector(".who bdi").textContent,
    verdict: row.dataset.verdict,
    bin: row.dataset.bin,
    score: row.dataset.score === "" ? -1 : Number(row.dataset.score),
    mistakes: row.dataset.mistake.split(" ").filter(Boolean),
    group: row.dataset.group,
  }));
  const keys = {
    0: (a, b) => a.index - b.index,
    name: (a, b) => collator.compare(a.name, b.name),
    score: (a, b) => a.score - b.score,
    verdict: (a, b) => verdicts.indexOf(a.verdict) - verdicts.indexOf(b.verdict) || b.score - a.score,
    mistake: (a, b) => (a.mistakes.length === 0) - (b.mistakes.length === 0) || collator.compare(a.mistakes.join(" "), b.mistakes.join(" ")),
  };

  // Filters: of one kind any, of all kinds each.
  const chosen = { verdict: new Set(), bin: new Set(), mistake: new Set(), group: new Set() };
  const passes = {
    verdict: (entry, set) => set.has(entry.verdict),
    bin: (entry, set) => set.has(entry.bin),
    mistake: (entry, set) => entry.mistakes.some((id) => set.has(id)),
    group: (entry, set) => entry.group !== "" && (set.has("*") || set.has(entry.group)),
  };

  const chip = (text, action, name) => {
    const item = document.createElement("li");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = text;
    if (name) button.className = name; else button.setAttribute("aria-label", `${active.dataset.remove}: ${text}`);
    button.addEventListener("click", action);
    item.append(button);
    return item;
  };
  const remember = () => {
    const state = new URLSearchParams();
    for (const [kind, set] of Object.entries(chosen)) for (const value of set) state.append(kind, value);
    if (search.value) state.set("q", search.value);
    if (order.selectedIndex) state.set("sort", order.value);
    if (!sheet.classList.contains("cards")) state.set("view", "table");
    const hash = state.toString();
    try { history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search); } catch { /* a page without an address */ }
  };
  const filter = () => {
    const words = fold(search.value).split(/\s+/).filter(Boolean);
    const kinds = Object.keys(chosen).filter((kind) => chosen[kind].size > 0);
    let shown = 0;
    for (const entry of rows) {
      const keep = kinds.every((kind) => passes[kind](entry, chosen[kind])) && words.every((word) => entry.text.includes(word));
      entry.row.hidden = !keep;
      shown += keep;
    }
    output.textContent = output.dataset.shown.replace("{shown}", shown).replace("{total}", rows.length);
    one(".empty").hidden = shown > 0;
    const labels = new Map();
    for (const toggle of toggles) {
      const { kind, value, label } = toggle.dataset;
      const pressed = chosen[kind].has(value);
      toggle.setAttribute("aria-pressed", pressed);
      if (pressed) labels.set(`${kind} ${value}`, [label, () => { chosen[kind].delete(value); filter(); search.focus(); }]);
    }
    active.replaceChildren(...[...labels.values()].map(([label, action]) => chip(label, action)));
    if (labels.size || search.value) active.append(chip(active.dataset.clear, clear, "clear"));
    remember();
  };
  const clear = () => {
    for (const set of Object.values(chosen)) set.clear();
    search.value = "";
    filter();
    search.focus();
  };

  const headers = all("th[data-sort]", sheet);
  const sort = () => {
    const [key, direction] = order.value.split(":");
    const sign = Number(direction) || 1;
    const sorted = [...rows].sort((a, b) => sign * keys[key](a, b) || a.index - b.index);
    body.append(...sorted.map((entry) => entry.row));
    for (const header of headers) {
      if (header.dataset.sort === key) header.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
      else header.removeAttribute("aria-sort");
    }
    remember();
  };
  for (const header of headers) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...header.childNodes);
    header.append(button);
    const values = [...order.options].map((option) => option.value).filter((value) => value.startsWith(`${header.dataset.sort}:`));
    button.addEventListener("click", () => {
      order.value = values[(values.indexOf(order.value) + 1) % values.length];
      sort();
    });
  }

  const views = all("[data-view]");
  const show = (view) => {
    sheet.classList.toggle("cards", view === "cards");
    for (const button of views) button.setAttribute("aria-pressed", button.dataset.view === view);
  };
  for (const button of views) button.addEventListener("click", () => { show(button.dataset.view); remember(); });

  for (const toggle of toggles) {
    toggle.disabled = toggle.hidden = false;
    toggle.addEventListener("click", () => {
      const { kind, value } = toggle.dataset;
      if (!chosen[kind].delete(value)) chosen[kind].add(value);
      filter();
      if (toggle.closest(".groups")) one("#students").scrollIntoView();
    });
  }
  search.addEventListener("input", filter);
  order.addEventListener("change", sort);
  const unfold = one(".unfold");
  if (unfold) {
    const list = one(".rows");
    list.classList.add("folded");
    unfold.hidden = false;
    unfold.addEventListener("click", () => unfold.setAttribute("aria-expanded", !list.classList.toggle("folded")));
  }
  // A link to a student or a group must find its row shown.
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#s-']");
    if (link && document.getElementById(link.hash.slice(1))?.hidden) clear();
  });

  const state = new URLSearchParams(/^#(s|g)-/.test(location.hash) ? "" : location.hash.slice(1));
  for (const kind of Object.keys(chosen)) {
    const known = new Set(toggles.filter((toggle) => toggle.dataset.kind === kind).map((toggle) => toggle.dataset.value));
    for (const value of state.getAll(kind)) if (known.has(value)) chosen[kind].add(value);
  }
  search.value = state.get("q") ?? "";
  const wished = state.get("sort") ?? "";
  if ([...order.options].some((option) => option.value === wished)) order.value = wished;
  const target = location.hash;
  show(state.get("view") === "table" ? "table" : "cards");
  one(".tools").hidden = false;
  if (order.selectedIndex) sort();
  filter();
  if (/^#(s|g)-/.test(target)) location.hash = target;
}
