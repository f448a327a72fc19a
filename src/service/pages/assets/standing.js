"use strict";
// What may still be handed in, and until when: kept as the service has it, while the page is open.
const keepStanding = (form) => {
  const DAY = 86_400_000; // milliseconds
  const units = [["day", DAY], ["hour", 3_600_000], ["minute", 60_000], ["second", 1000]];
  const language = document.documentElement.lang;
  const formats = units.map(([unit]) => new Intl.NumberFormat(language, { style: "unit", unit, unitDisplay: "long" }));
  let timer = 0;
  let isOver = false; // whether the page has said so by itself

  // A span in its two largest units, as the service writes it.
  const spoken = (span) => {
    const first = Math.min(units.findIndex(([, length]) => span >= length) >>> 0, units.length - 1);
    const counts = units.map(([, length], index) => Math.floor((index > first ? span % units[index - 1][1] : span) / length));
    const last = first === 2 ? first : Math.min(first + 1, units.length - 1);
    const said = counts.map((count, index) => (index === first || (index === last && count > 0) ? formats[index].format(count) : ""));
    return said.filter(Boolean).join(" ");
  };

  const look = () => {
    clearTimeout(timer);
    const left = document.querySelector("[data-until]");
    if (!left) return;
    const span = Number(left.dataset.until) - (Date.now() - ahead);
    if (span <= 0) return pass(left);
    left.textContent = left.dataset.text.replace("%", spoken(span));
    left.closest("li").classList.toggle("urgent", span < DAY);
    timer = setTimeout(look, span < 120_000 ? span % 1000 + 5 : 10_000);
  };

  // The moment has come. The page says so at once; the service says the rest, not to everybody in the same second.
  const pass = (left) => {
    if (!isOver) left.textContent = left.dataset.over;
    form.toggleAttribute("data-over", left.dataset.closes !== undefined);
    timer = setTimeout(refresh, isOver ? 1000 : 3000 * Math.random());
    isOver = true;
  };

  // By how much the clock of this machine is ahead of the service's.
  const measured = (page) => Date.now() - Number(page.querySelector("[data-now]").dataset.now);
  let ahead = measured(document);

  const refresh = async () => {
    clearTimeout(timer);
    try {
      const answer = await fetch(location.pathname, { headers: { accept: "text/html" } });
      if (!answer.ok) throw new Error(answer.statusText);
      const page = new DOMParser().parseFromString(await answer.text(), "text/html");
      const there = page.querySelector("form.work");
      if (!there) throw new Error("another page");
      ahead = measured(page);
      for (const old of document.querySelectorAll("[data-fresh]")) {
        const fresh = page.getElementById(old.id);
        if (fresh && !fresh.isEqualNode(old)) old.replaceWith(document.adoptNode(fresh));
      }
      for (const name of ["draft", "draftword"]) {
        if (there.dataset[name] === undefined) delete form.dataset[name];
        else form.dataset[name] = there.dataset[name];
      }
      form.removeAttribute("data-over");
      isOver = false;
      look();
    } catch {
      // No connection: the page goes on with what it knows.
      timer = setTimeout(refresh, 15_000);
    }
  };

  document.addEventListener("visibilitychange", () => { if (!document.hidden) refresh(); });
  look();
  return { refresh };
};
