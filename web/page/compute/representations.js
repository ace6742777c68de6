// @ts-check
// Representations of the simple factors of an algebra: a weight, a product, a restriction, and the weight diagram.
import { copies } from "./cards.js";
import { drawn, element, report } from "./dom.js";

/** @typedef {import("./cards.js").Context} Context */

/** The parts of the state that belong to the card, and their labels. @type {[name: "weight" | "factors" | "subalgebra", label: string, hint: string][]} */
const FIELDS = [
  ["weight", "Representation", "8 or [1,1]"],
  ["factors", "times", "8; 3bar"],
  ["subalgebra", "restricted to", "levi 1"],
];
const FORMATS = [["LaTeX", "latex"], ["CSV", "csv"], ["JSON", "json"]];

export class RepresentationCard {
  /** The types of the simple factors, such as A2. @type {string[]} */ #types = [];
  /** The space whose factors they are. */
  #offered = "";
  /** The space of the page. */
  space = "";
  kind = {
    name: "representations", title: "Representations", second: true, report: "rep", size: 2,
    when: () => Boolean(this.#types.length) && this.space === this.#offered,
  };

  /** @param {(part: {weight: string, factors: string, subalgebra: string}) => void} changed called with the parts of the state that are entered */
  constructor(changed) {
    this.changed = changed;
    this.fields = Object.fromEntries(FIELDS.map(([name, , hint]) => [name, element("input", { type: "text", size: 9, placeholder: hint, spellcheck: false, autocomplete: "off" })]));
    const labels = FIELDS.map(([name, label]) => element("label", {}, `${label} `, this.fields[name]));
    const form = element("form", { class: "filters", submit: (/** @type {Event} */ event) => { event.preventDefault(); this.#enter(); } }, ...labels, element("button", { type: "submit", text: "Compute" }));
    this.heading = element("h2", { id: "card-representations", text: "Representations" });
    this.body = element("div", { class: "body" });
    this.message = element("p", { class: "help", role: "alert" });
    this.foot = element("div", { class: "foot" });
    this.element = element("article", { class: "card representations", tabindex: "-1", "aria-labelledby": "card-representations" }, this.heading, form, this.message, this.body, this.foot);
  }

  /** The simple factors of the algebra of the page. @param {{types: string[], semisimple: boolean}} factors */
  offer({ types, semisimple }) {
    [this.#types, this.#offered] = [types, this.space];
    this.heading.textContent = `Representations of ${semisimple ? "" : "the Levi subalgebra "}${types.join(" + ")}`;
  }

  /** What the result depends on. @param {import("./state.js").State} state */
  key({ weight, factors, subalgebra }) { return JSON.stringify([weight, factors, subalgebra]); }

  outdate() { if (this.element.dataset.key) this.element.classList.add("stale"); }

  /** A sentence instead of a result. @param {string} text */
  tell(text) {
    this.message.textContent = text;
    this.body.replaceChildren();
    this.foot.replaceChildren();
    delete this.element.dataset.key;
    this.element.classList.remove("stale");
  }

  #enter() {
    const [weight, factors, subalgebra] = FIELDS.map(([name]) => this.fields[name].value.trim());
    this.changed({ weight, factors, subalgebra });
  }

  /** @param {Context} context @param {(name: string) => void} stage */
  async compute(context, stage) {
    for (const [name] of FIELDS) if (document.activeElement !== this.fields[name]) this.fields[name].value = context.state[name];
    const request = this.#request(context);
    this.fields.weight.value ||= request.weight;
    const { answer } = await context.engine.ask({ ...request, format: "html" }, stage);
    this.message.textContent = "";
    this.body.replaceChildren(element("div", { class: "drawings" }, ...answer.pictures.map(drawn)), report(answer.text));
    this.element.classList.remove("stale");
    this.foot.replaceChildren(copies(context, this.kind, "Copy", FORMATS, request));
  }

  /** @param {Context} context */
  #request({ state: { weight, factors, subalgebra } }) {
    // by default the first fundamental representation of each factor
    const first = this.#types.flatMap((type) => Array.from({ length: Number(type.slice(1)) }, (_, node) => node ? 0 : 1));
    return { report: "rep", space: this.#types.join(" + "), weight: weight || `[${first}]`, factors, subalgebra };
  }
}
