// @ts-check
// Cards: the results in a fixed order, each with its copies, a link, and its definition.
import { copy, confirm } from "../export.js";
import { button, drawn, element, fragment, report } from "./dom.js";
import { settings } from "./state.js";

/** @typedef {import("./state.js").State} State @typedef {import("./chips.js").Reading} Reading */
/** @typedef {{ask(request: object, stage?: (name: string) => void): Promise<any>}} Asking */
/** @typedef {{state: State, reading: Reading, engine: Asking, link: (card: string) => string, say: (text: string) => void}} Context */
/** @typedef {{name: string, title: string, second?: boolean, when: (reading: Reading) => boolean, report: string, show?: string, size: number, most?: number, kind?: (reading: Reading) => string}} Kind */

/** The rows of a list that are shown at first. */
const ROWS = 12;
/** More components are not copied: the report would be longer than 16 MB. */
const COPIED = 300000;

/** The cards in their order. @type {Kind[]} */
export const KINDS = [
  { name: "brackets", title: "Brackets", when: ({ kind, frame }) => kind !== "chart" || frame !== "coordinate", report: "card", show: "structure", size: 2 },
  { name: "metric", title: "Metric", when: ({ has_metric }) => has_metric, report: "card", show: "metric", size: 2 },
  { name: "structure", title: "Structure", second: true, when: ({ kind }) => kind !== "chart", report: "info", size: 3 },
  { name: "connection", title: "Connection", when: () => true, report: "card", show: "affinities", size: 3 },
  { name: "torsion", title: "Torsion", when: () => true, report: "card", show: "torsion", size: 1 },
  { name: "curvature", title: "Curvature", when: () => true, report: "card", show: "curvature", size: 2 },
  { name: "ricci", title: "Ricci tensor", when: () => true, report: "card", show: "ricci", size: 2 },
  { name: "scalar_curvature", title: "Scalar curvature", when: ({ has_metric }) => has_metric, report: "card", show: "scalar_curvature", size: 1 },
  { name: "properties", title: "Properties", second: true, when: () => true, report: "properties", size: 2, most: 60 },
  { name: "equations", title: "Equations of motion", second: true, when: ({ dimension }) => dimension <= 30, report: "equations", size: 2, kind: ({ has_metric }) => has_metric ? "" : "autoparallel" },
];

/** The part of a request that names the space. @param {State} state */
export const named = ({ space, connection, metric, set }) => ({ input: space, connection, metric, set: settings(set) });

const FORMATS = [["LaTeX", "latex"], ["CSV", "csv"], ["JSON", "json"], ["Python", "python"], ["TOML", "toml"]];

export class Card {
  #filter = "";
  /** @type {Context | null} */ #context = null;
  count = 0;
  /** Whether the reader wants all rows. */
  #whole = false;
  /** Whether the reader wants a result that takes long. */
  asked = false;
  /** The types of the simple factors of the algebra, and whether they are all of it. */
  factors = { types: /** @type {string[]} */ ([]), semisimple: false };

  /** @param {Kind} kind */
  constructor(kind) {
    this.kind = kind;
    this.body = element("div", { class: "body" });
    this.foot = element("div", { class: "foot" });
    this.heading = element("h2", { text: kind.title, id: `card-${kind.name}` });
    this.element = element("article", { class: `card ${kind.name}`, tabindex: "-1", "aria-labelledby": `card-${kind.name}` }, this.heading, this.body, this.foot);
    this.body.append(element("p", { class: `quiet${kind.second ? " later" : ""}`, text: kind.second ? "Computed when it is in view." : "…" }));
  }

  /** The request of the card. @param {Context} context */
  #request({ state, reading }) {
    const { kind } = this;
    return kind.report === "card" ? { report: "card", card: kind.name, filter: this.#filter, ...named(state) }
      : { report: kind.report, motion: kind.kind?.(reading) ?? "", ...named(this.#shown(state, reading)) };
  }

  /** The state with the connection that its chips show: by default the engine writes equations of motion with another one.
   * @param {State} state @param {Reading} reading */
  #shown(state, { connection, connection_is_default, has_metric }) {
    return this.kind.report === "equations" && has_metric && connection_is_default ? { ...state, connection } : state;
  }

  /** Computes and shows the card. @param {Context} context @param {(name: string) => void} stage */
  async compute(context, stage) {
    // another space has other indices
    if (context.state.space !== this.#context?.state.space) [this.#whole, this.#filter] = [false, ""];
    this.#context = context;
    const { answer } = await context.engine.ask(this.#request(context), stage);
    this.#keep(() => this.#show(answer));
  }

  /** Writes into the card; the focus of a part that goes is on its counterpart, or on the card. @param {() => void} write */
  #keep(write) {
    const held = /** @type {HTMLElement | null} */ (document.activeElement), inside = this.element.contains(held);
    write();
    if (!inside || held?.isConnected) return;
    const same = [.../** @type {NodeListOf<HTMLElement>} */ (this.element.querySelectorAll("button, input, summary"))]
      .find((part) => part.matches(held?.tagName ?? "") && name(part) === name(held));
    (same ?? this.element).focus({ preventScroll: true });
  }

  /** @param {any} answer */
  #show(answer) {
    if (this.kind.report === "card") this.#tensor(JSON.parse(answer.text));
    else if (this.kind.name === "structure") this.#structure(answer);
    else if (this.kind.name === "properties") this.#properties(answer.text);
    else this.body.replaceChildren(report(answer.text));
    this.#shorten();
    this.element.classList.remove("stale");
  }

  /** Hides the rows of long lists behind a button. */
  #shorten() {
    if (this.#whole) return;
    for (const list of this.body.querySelectorAll("ul, ol, tbody, .report dl")) {
      const rest = [...list.children].slice(ROWS);
      // a button takes as much room as two rows
      if (rest.length < 3 || list.closest("details")) continue;
      for (const row of rest) row.toggleAttribute("hidden", true);
      const show = button(`Show all ${list.children.length}`, () => this.#keep(() => {
        this.#whole = true;
        for (const row of this.body.querySelectorAll("[hidden]")) row.removeAttribute("hidden");
        for (const other of this.body.querySelectorAll(".all")) other.remove();
      }), { class: "all" });
      (list.closest("table") ?? list).after(show);
    }
  }

  /** Marks the card as that of an earlier input. */
  outdate() { if (this.element.dataset.key) this.element.classList.add("stale"); }

  /** A sentence instead of a result. @param {string} text @param {...Node} more */
  tell(text, ...more) {
    this.#keep(() => {
      this.body.replaceChildren(element("p", { class: "quiet", text }), ...more);
      this.foot.replaceChildren();
    });
    // a sentence is not a result, which would be marked later as that of an earlier input
    delete this.element.dataset.key;
    this.element.classList.remove("stale");
  }

  /** @param {any} card */
  #tensor(card) {
    if (card.absent) return this.tell("This tensor is not defined here.");
    this.count = Math.max(card.count, this.#filter ? this.count : 0);
    if (this.kind.name !== "connection") this.heading.textContent = card.title;
    this.body.replaceChildren(...fragment(card.html));
    for (const paragraph of this.body.querySelectorAll(":scope > p")) {
      if (card.summarized) sort(paragraph);
      if ([...paragraph.childNodes].some(({ nodeType, textContent }) => nodeType === Node.TEXT_NODE && textContent?.trim())) paragraph.classList.add("prose");
    }
    if (card.summarized || this.#filter) this.body.prepend(this.#filters([...card.letters]));
    if (card.summarized && this.#filter) this.body.append(element("p", { class: "help", text: "Too many components have these indices: choose one more index." }));
    this.#feet(card.definition, FORMATS);
  }

  /** Fields for indices. @param {string[]} letters */
  #filters(letters) {
    const now = this.#filter.split(",");
    const fields = letters.map((letter, at) => element("label", {}, element("i", { text: letter }), element("input", { type: "text", inputmode: "numeric", size: 3, value: now[at] ?? "", placeholder: "all", "aria-label": `index ${letter}` })));
    const apply = async () => {
      const values = fields.map((field) => /** @type {HTMLInputElement} */ (field.querySelector("input")).value.trim());
      const before = this.#filter;
      this.#filter = values.some(Boolean) ? values.join(",") : "";
      box.querySelector(".help")?.remove();
      try {
        if (this.#context) await this.compute(this.#context, () => {});
      } catch (problem) {
        // the indices that were refused are not asked for again
        this.#filter = before;
        const { kind, refusal } = /** @type {any} */ (problem);
        if (kind === "refused") box.append(element("p", { class: "help", role: "alert", text: refusal.message }));
      }
    };
    const box = element("form", { class: "filters", submit: (/** @type {Event} */ event) => { event.preventDefault(); apply(); } }, element("span", { text: "Indices" }), ...fields, element("button", { type: "submit", text: "List" }));
    return box;
  }

  /** @param {any} answer */
  #structure({ text, pictures, types }) {
    const box = report(text), rows = [...box.querySelectorAll("tbody tr")].map((row) => [...row.children]);
    const badges = element("p", { class: "badges" }), table = element("dl", { class: "facts" });
    for (const [notion, answer, witness] of rows) {
      const name = notion.textContent ?? "", words = answer.textContent ?? "";
      if (name === "it is" || name === "it is not") {
        badges.append(...words.split(", ").filter((word) => word !== "-").flatMap((word) => [element("span", { class: `badge ${name === "it is" ? "yes" : "no"}`, text: word }), " "]));
        continue;
      }
      // the diagram is drawn below
      if (name === "Dynkin diagram" || words === "-") continue;
      const remark = witness.childNodes.length ? [element("span", { class: "remark" }, ...witness.childNodes)] : [];
      table.append(element("dt", {}, ...notion.childNodes), element("dd", {}, ...answer.childNodes, " ", ...remark));
    }
    const rest = folded("all of its structure", table);
    // letters of the metric only, and those with a value, are not in the brackets
    const { state = null, reading = null } = this.#context ?? {}, words = (/** @type {string} */ text) => new Set(text.match(/[A-Za-z]\w*/g));
    const outside = (/** @type {string} */ name) => words(state?.metric ?? "").has(name) && !words(state?.space ?? "").has(name);
    const letters = (reading?.parameters ?? []).filter((name) => !outside(name) && !(name in (state?.set ?? {})));
    const generic = letters.length ? [element("p", { class: "quiet", text: `for generic values of ${letters.join(", ")}` })] : [];
    const semisimple = [...badges.querySelectorAll(".yes")].some(({ textContent }) => textContent === "semisimple");
    this.factors = { types, semisimple };
    this.body.replaceChildren(badges, ...generic, ...short(table, semisimple), element("div", { class: "drawings" }, ...pictures.map(drawn)), rest);
    this.#feet("", FORMATS.filter(([, format]) => format !== "csv"));
    if (pictures.length) this.foot.querySelector(".copies")?.append(button("SVG", () => copy(pictures[0].svg), { class: "small" }));
  }

  /** @param {string} text */
  #properties(text) {
    const rows = [...report(text).querySelectorAll("tbody tr")].map((row) => [...row.children]);
    const badges = element("div", { class: "badges" }), facts = element("dl", { class: "facts" });
    const witness = element("p", { class: "witness", "aria-live": "polite" });
    for (const [name, holds, detail] of rows) {
      const answer = holds.textContent;
      if (!answer) {
        facts.append(element("dt", {}, ...name.childNodes), element("dd", {}, ...detail.childNodes));
        continue;
      }
      const badge = element("button", { type: "button", class: `badge ${answer}`, "aria-expanded": "false" }, ...name.childNodes);
      badge.addEventListener("click", () => {
        const open = badge.getAttribute("aria-expanded") === "true";
        for (const other of badges.querySelectorAll("button")) other.setAttribute("aria-expanded", "false");
        badge.setAttribute("aria-expanded", String(!open));
        const words = [...detail.childNodes].map((node) => node.cloneNode(true));
        witness.replaceChildren(...(open ? [] : [answer === "yes" ? "It holds" : "It fails", words.length ? ": " : ".", ...words]));
      });
      badges.append(badge, " ");
    }
    const rest = facts.children.length ? [folded("more facts", facts)] : [];
    this.body.replaceChildren(badges, witness, ...rest);
    this.#feet("", FORMATS.filter(([, format]) => format !== "csv"));
  }

  /** Copies, a link, and the definition. @param {string} definition @param {string[][]} formats */
  #feet(definition, formats) {
    if (!this.#context) return;
    const { reading, state } = this.#context, { kind } = this, tables = kind.report === "card";
    const allowed = formats.filter(([, format]) => reading.kind !== "chart" || !["python", "toml"].includes(format));
    const request = { report: tables ? "table" : kind.report, show: tables ? kind.show : "", motion: kind.kind?.(reading) ?? "", ...named(this.#shown(state, reading)) };
    const long = this.count > COPIED, how = definition ? [element("details", { class: "how" }, element("summary", { text: "How is this defined?" }), ...fragment(definition))] : [];
    this.foot.replaceChildren(copies(this.#context, kind, long ? "Choose indices to copy components." : "Copy", long ? [] : allowed, request), ...how);
  }
}

/** Buttons that copy a report in formats, and one for the link to its card.
 * @param {Context} context @param {{name: string, title: string}} kind @param {string} words @param {string[][]} formats @param {object} request */
export function copies({ engine, say, link }, { name, title }, words, formats, request) {
  const buttons = formats.map(([label, format]) => button(label, async ({ currentTarget }) => {
    try {
      const { answer } = await engine.ask({ ...request, format });
      await copy(format === "latex" ? equations(answer.text) : answer.text);
      confirm(/** @type {HTMLElement} */ (currentTarget), "copied");
      say(`${title}: copied as ${label}.`);
    } catch (problem) {
      const { refusal, message } = /** @type {any} */ (problem);
      say(`${title} could not be copied: ${refusal?.message ?? message ?? problem}`);
    }
  }, { class: "small" }));
  const linked = button("Link", async () => {
    await copy(link(name));
    confirm(linked, "copied");
    say("The link to this card is copied.");
  }, { class: "small" });
  return element("p", { class: "copies" }, element("span", { class: "quiet", text: words }), ...buttons, linked);
}

/** Sorts the values of a summary by size, if all of them are numbers. @param {Element} paragraph */
function sort(paragraph) {
  const values = [...paragraph.querySelectorAll("math")].map((math) => {
    const [, above, below = "1"] = /^(-?[\d.]+)(?:\/(\d+))?$/.exec(math.getAttribute("alttext") ?? "") ?? [];
    return { math, value: Number(above) / Number(below) };
  });
  if (values.some(({ value }) => Number.isNaN(value))) return;
  const places = values.map(({ math }) => {
    const place = document.createComment("");
    math.replaceWith(place);
    return place;
  });
  values.sort((a, b) => a.value - b.value).forEach(({ math }, k) => places[k].replaceWith(math));
}

/** The name of a control. @param {Element | null} control */
const name = (control) => control?.getAttribute("aria-label") ?? control?.textContent;

/** The displayed equations of a document of LaTeX, or the document if it has none. @param {string} text */
export const equations = (text) => text.match(/\\begin\{(align\*?|equation\*?|gather\*?)\}[^]*?\\end\{\1\}/g)?.join("\n") ?? text;

/** Facts behind a summary; those that are wider than the card can be scrolled by keys. @param {string} summary @param {HTMLElement} facts */
const folded = (summary, facts) => element("details", { toggle: () => {
  for (const fact of facts.querySelectorAll("dd")) if (fact.scrollWidth > fact.clientWidth) fact.tabIndex = 0;
} }, element("summary", { text: summary }), facts);

/** The first facts of a structure: its type, its Killing form and its name. @param {HTMLElement} facts @param {boolean} semisimple */
function short(facts, semisimple) {
  /** Facts about the Levi subalgebra, which is the whole algebra only if that is semisimple. */
  const levi = ["Dynkin type", "simple ideals"];
  const wanted = ["identification", "Killing form", "Dynkin type", "simple ideals", "Betti numbers"];
  /** Longer facts are not for the first look. */
  const longest = 90;
  const box = element("dl", { class: "facts first" });
  for (const term of [...facts.querySelectorAll("dt")]) {
    const value = term.nextElementSibling;
    if (!value || !wanted.includes(term.textContent ?? "")) continue;
    value.querySelector(".remark")?.remove();
    // a determinant that is too long for a line
    for (const part of value.childNodes) if (part.nodeType === Node.TEXT_NODE) part.textContent = (part.textContent ?? "").replace(/, determinant a number of \d+ characters/, "");
    if ((value.textContent ?? "").length > longest) continue;
    if (!semisimple && levi.includes(term.textContent ?? "")) term.append(" of the Levi subalgebra");
    box.append(term, value);
  }
  return box.children.length ? [box] : [];
}
