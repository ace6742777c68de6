// @ts-check
// The paper, equation by equation: the entries of paper.html as cards that can be filtered, first the statements that are refuted.

/** The document beside the page. */
const SOURCE = new URL("../../paper.html", import.meta.url);

/** A number with its noun. @param {number} count @param {string} one @param {string} many */
const counted = (count, one, many = `${one}s`) => `${count} ${count === 1 ? one : many}`;

/** @param {HTMLElement} section @param {import("../main.js").Services} services @returns {import("../main.js").View} */
export function mount(section, services) {
  section.innerHTML = `<header class="front"><h1>Finite rotations on a Lie group, equation by equation</h1>
<p class="claim">A group has no connection and no metric of its own: they are chosen, and M(3) and “SO(3)” are the same group with two choices.</p>
<p>E. Paraskevopoulos and S. Natsiavas, <cite>Int. J. Solids and Structures</cite> 50 (2013) 57-72. Every equation is computed anew: most hold, some need a correction, and <b class="count"></b> that the paper prints or suggests are refuted. <a class="whole" href="paper.html">The whole document</a></p></header>
<form class="filter" role="search" aria-label="Entries">
<fieldset class="choice"><legend class="hidden">Show</legend>
<label><input type="radio" name="show" value="refuted" checked><span>refuted</span></label><label><input type="radio" name="show" value="corrected"><span>corrected</span></label><label><input type="radio" name="show" value="all"><span>all entries</span></label></fieldset>
<label class="find">Find <input type="search" name="find" placeholder="Rodrigues, (57)" autocomplete="off"></label></form>
<p class="found" role="status">Loading the document…</p><div class="entries"></div>`;
  const form = /** @type {HTMLFormElement} */ (section.querySelector("form")), found = /** @type {HTMLElement} */ (section.querySelector(".found"));
  const list = /** @type {HTMLElement} */ (section.querySelector(".entries"));
  /** @type {{card: HTMLElement, refuted: number, corrected: boolean, text: string}[]} */ let entries = [];
  let state = "";
  const all = document.createElement("button");
  all.type = "button";
  all.textContent = "Show all entries";
  all.addEventListener("click", () => {
    /** @type {any} */ (form.elements).show.value = "all";
    filter();
    // the button vanishes
    /** @type {HTMLElement} */ (form.querySelector(":checked")).focus();
  });

  /** Shows the entries that the form asks for. */
  function filter() {
    const data = new FormData(form), show = String(data.get("show")), words = String(data.get("find")).toLowerCase().split(/\s+/).filter(Boolean);
    let statements = 0, shown = 0, others = 0;
    for (const { card, refuted, corrected, text } of entries) {
      const named = words.every((word) => text.includes(word));
      const wanted = named && (show === "all" || (show === "refuted" ? refuted > 0 : corrected));
      card.hidden = !wanted;
      if (wanted) [statements, shown] = [statements + refuted, shown + 1];
      else if (named) others++;
    }
    found.textContent = show === "refuted" ? `${counted(statements, "refuted statement")} in ${counted(shown, "entry", "entries")}` : counted(shown, "entry", "entries");
    // the words may be in entries that the choice leaves out
    if (words.length && others) found.append(`; the words are in ${counted(others, "more entry", "more entries")}. `, all);
  }

  /** Reads the document, once. */
  const read = async () => {
    const answer = await fetch(SOURCE);
    if (!answer.ok) throw new Error(`paper.html: ${answer.status}`);
    const parsed = new DOMParser().parseFromString((await answer.text()).replace(/<style>.*?<\/style>/s, ""), "text/html");
    entries = [...parsed.querySelectorAll("article")].map((article) => {
      const card = document.createElement("article");
      card.className = "entry";
      card.tabIndex = -1;
      card.id = article.id;
      const third = /** @type {HTMLElement} */ (article.querySelector("h3")), heading = document.createElement("h2");
      // the sections of the document are left out, so an entry is one level higher
      heading.id = third.id;
      heading.append(...third.childNodes);
      third.replaceWith(heading);
      const standing = heading.querySelector(".standing");
      heading.querySelector("a")?.setAttribute("href", `#paper/${article.id}`);
      const fails = [...article.querySelectorAll(".findings .fails")];
      const rest = [...article.querySelectorAll(".findings, .functions")];
      const whole = document.createElement("details"), summary = document.createElement("summary");
      const findings = article.querySelectorAll(".findings li").length;
      summary.textContent = counted(findings, "finding");
      whole.append(summary, ...rest.map((part) => part.cloneNode(true)));
      // the formula of the entry, not the statement that fails
      if (fails.length && standing?.classList.contains("right")) {
        const other = document.createElement("span");
        other.className = "standing corrected";
        other.textContent = `${counted(fails.length, "statement")} refuted`;
        standing.textContent = "formula right";
        standing.after(" ", other);
      }
      const refuted = document.createElement("ul");
      refuted.className = "findings";
      refuted.append(...fails);
      rest.forEach((part) => part.remove());
      card.append(...article.childNodes, ...(fails.length ? [refuted] : []), whole);
      return { card, refuted: fails.length, corrected: !standing?.classList.contains("right"), text: (card.textContent ?? "").toLowerCase() };
    });
    list.replaceChildren(...entries.map(({ card }) => card));
    /** @type {HTMLElement} */ (section.querySelector(".count")).textContent = `${entries.reduce((sum, { refuted }) => sum + refuted, 0)} statements`;
    filter();
  };
  let reading = read();

  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  return {
    async open(rest) {
      state = rest;
      try {
        await reading;
      } catch (error) {
        found.textContent = `The document did not load (${/** @type {Error} */ (error).message}). Reload the page to try again.`;
        reading = read().catch((error) => { throw error; });
        reading.catch(() => {});
        return;
      }
      const card = rest ? document.getElementById(rest) : null;
      if (rest === "all" || rest === "refuted" || rest === "corrected") /** @type {any} */ (form.elements).show.value = rest;
      if (card && section.contains(card)) {
        if (card.hidden) /** @type {any} */ (form.elements).show.value = "all";
        const whole = card.querySelector("details");
        if (whole) whole.open = true;
      }
      filter();
      card?.scrollIntoView({ block: "start" });
      // a presentation begins with it
      card?.focus({ preventScroll: true });
    },
    state: () => state,
    title: () => "The paper, equation by equation",
    cards: () => entries.filter(({ card }) => !card.hidden).map(({ card }) => card),
  };
}
