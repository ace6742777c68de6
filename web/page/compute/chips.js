// @ts-check
// The connection and the metric as chips: one of each kind is pressed.
import { button, element } from "./dom.js";
import { Grid, LARGEST, entries, written } from "./grid.js";

/** The largest dimension of a metric of letters. */
const LETTERS = 12;
/** Parts of one of the slider of lambda: it has all fractions with denominators up to 4, and 1/6, 1/8, 1/12. */
const PARTS = 24;
/** The values of lambda of the canonical connections. @type {Record<string, string>} */
const LAMBDA = { plus: "1", zero: "1/2", minus: "0", natural: "1/2", canonical: "0" };
/** The names of zero and minus on a homogeneous space. @type {Record<string, string>} */
const HOMOGENEOUS = { zero: "natural", minus: "canonical" };

/** @typedef {{name: string, basis: string[], coordinates: string[], parameters: string[], dimension: number, kind: string, connection: string, metric: string[][] | null, has_metric: boolean, killing: boolean, connection_is_default: boolean, frame: string}} Reading */

export class Chips {
  /** @type {Reading | null} */ #reading = null;
  /** @type {string} */ #metric = "";
  /** @type {Record<string, HTMLButtonElement>} */ #connections = {};
  /** @type {Record<string, HTMLButtonElement>} */ #metrics = {};
  /** The reading without a metric of the page. */
  #own = false;

  /** @param {HTMLElement} box @param {{connection: (text: string, moving: boolean) => void, metric: (text: string, moving: boolean) => void}} changed */
  constructor(box, changed) {
    this.changed = changed;
    const chip = (/** @type {string} */ text, /** @type {() => void} */ act, /** @type {string} */ kind = "") => button(text, act, { class: `chip ${kind}`, "aria-pressed": "false" });
    this.#connections = {
      plus: chip("plus", () => changed.connection("plus", false), "plus"), zero: chip("zero", () => changed.connection(this.#named("zero"), false), "zero"),
      minus: chip("minus", () => changed.connection(this.#named("minus"), false), "minus"), lambda: chip("λ", () => this.#lambda(false)),
      "levi-civita": chip("Levi-Civita", () => changed.connection("levi-civita", false)),
    };
    this.range = element("input", { type: "range", min: "0", max: String(PARTS), step: "1", "aria-label": "lambda" });
    this.range.addEventListener("input", () => this.#lambda(true));
    this.value = element("output");
    this.slider = element("span", { class: "lambda" }, this.range, this.value);
    this.#metrics = {
      none: chip("none", () => this.#choose("")), identity: chip("identity", () => this.#choose("identity")), killing: chip("Killing", () => this.#choose("killing")),
      diagonal: chip("diagonal", () => this.#choose(this.#letters())), full: chip("full", () => this.#open()),
    };
    this.box = element("div", { class: "grid scroll", hidden: true, tabindex: "0", role: "group", "aria-label": "Entries of the metric" });
    this.grid = new Grid(this.box, (metric) => { this.#metric = metric; this.changed.metric(metric, true); });
    this.metrics = element("div", { class: "pick", role: "group", "aria-label": "Metric" }, element("span", { class: "what", text: "Metric" }), ...Object.values(this.#metrics));
    this.connections = element("div", { class: "pick", role: "group", "aria-label": "Connection" }, element("span", { class: "what", text: "Connection" }), ...Object.values(this.#connections), this.slider);
    box.append(this.connections, this.metrics, this.box);
  }

  /** Shows what holds. @param {Reading} reading @param {string} connection @param {string} metric what the page chose, if it did */
  show(reading, connection, metric) {
    const other = this.#reading?.name !== reading.name || this.#reading?.dimension !== reading.dimension;
    this.#reading = reading;
    this.#metric = metric;
    const n = reading.dimension, chart = reading.kind === "chart";
    const held = /^lambda/.test(reading.connection) ? "lambda" : reading.connection;
    for (const [name, chip] of Object.entries(this.#connections)) press(chip, name === held || this.#named(name) === held);
    for (const name of ["zero", "minus"]) this.#connections[name].textContent = this.#named(name);
    const levi = this.#connections["levi-civita"];
    levi.title = reading.has_metric ? "" : "chooses the metric identity too";
    for (const name of ["plus", "zero", "minus", "lambda"]) this.#connections[name].hidden = chart || name === "plus" && this.#homogeneous;
    // the slider shows a value only where one holds
    const lambda = LAMBDA[reading.connection] ?? /^lambda\s*=\s*(\S+)$/.exec(connection)?.[1];
    this.slider.hidden = chart || lambda === undefined;
    if (lambda !== undefined) {
      const [above, below = "1"] = lambda.split("/"), at = Number(above) / Number(below);
      if (document.activeElement !== this.range && Number.isFinite(at)) this.range.value = String(PARTS * at);
      this.range.setAttribute("aria-valuetext", `lambda = ${lambda}`);
      this.value.textContent = `λ = ${lambda}`;
    }
    this.metrics.hidden = chart;
    this.#own = reading.has_metric && !metric;
    this.#metrics.none.textContent = this.#own ? "its own" : "none";
    this.#metrics.killing.disabled = !reading.killing;
    this.#metrics.killing.title = reading.killing ? "" : "its Killing form is degenerate, or the dimension is above 80";
    this.#metrics.diagonal.disabled = n > LETTERS;
    this.#metrics.diagonal.title = n > LETTERS ? `with letters up to dimension ${LETTERS}` : this.#homogeneous ? "one letter, so that it is invariant" : "";
    this.#metrics.full.disabled = n > LARGEST;
    this.#metrics.full.title = n > LARGEST ? `a grid up to dimension ${LARGEST}` : "";
    const kind = !metric ? "none" : metric === "identity" || metric === "killing" ? metric : /^diag/.test(metric) && this.box.hidden ? "diagonal" : "full";
    for (const [name, chip] of Object.entries(this.#metrics)) press(chip, name === kind);
    if (kind === "full" && n <= LARGEST && (this.box.hidden || other)) this.#open(false);
    if (chart || kind !== "full" || n > LARGEST) this.box.hidden = true;
  }

  /** Whether the space is a quotient of groups. */
  get #homogeneous() { return this.#reading?.frame === "reductive"; }

  /** The name of a canonical connection in this space. @param {string} name */
  #named(name) { return this.#homogeneous && HOMOGENEOUS[name] || name; }

  /** @param {boolean} moving */
  #lambda(moving) {
    const text = fraction(Number(this.range.value));
    this.value.textContent = `λ = ${text}`;
    this.changed.connection(`lambda=${text}`, moving);
  }

  /** @param {string} metric */
  #choose(metric) {
    this.box.hidden = true;
    this.changed.metric(metric, false);
  }

  /** A diagonal metric of letters that are not in use. */
  #letters() {
    const { basis, parameters, dimension: n } = /** @type {Reading} */ (this.#reading);
    const used = [...basis, ...parameters], free = "abcdefghpqrsuvw".split("").filter((letter) => !used.includes(letter));
    // different letters are rarely invariant under the isotropy group
    if (this.#homogeneous) return `diag(${Array(n).fill(free[0]).join(", ")})`;
    const letters = n <= free.length ? free.slice(0, n) : basis.map((_, at) => `g${at + 1}`);
    return `diag(${letters.join(", ")})`;
  }

  /** Opens the grid of entries. @param {boolean} [tell] */
  #open(tell = true) {
    const { basis, dimension: n, metric } = /** @type {Reading} */ (this.#reading);
    const rows = entries(this.#metric, n) ?? metric ?? entries("identity", n) ?? [];
    this.box.hidden = false;
    this.grid.show(basis, rows);
    for (const [name, chip] of Object.entries(this.#metrics)) press(chip, name === "full");
    if (tell && !this.#metric) this.changed.metric(written(rows), false);
  }
}

/** @param {HTMLElement} chip @param {boolean} on */
const press = (chip, on) => chip.setAttribute("aria-pressed", String(on));

/** @param {number} parts @returns {string} */
export function fraction(parts) {
  const divisor = (/** @type {number} */ a, /** @type {number} */ b) => { while (b) [a, b] = [b, a % b]; return a; };
  const common = divisor(parts, PARTS) || 1;
  return PARTS / common === 1 ? String(parts / common) : `${parts / common}/${PARTS / common}`;
}
