// @ts-check
// A body in motion: a box that turns, played or stepped through, beside the drift of what should be conserved.
import { chart } from "./chart.js";
import { View, html, make } from "../picture.js";

/** @typedef {import("../picture.js").Point} Point */

const SIZE = 130;
/** Rows played in a second; with reduced motion a step a second. */
const RATE = 20;
/** Names of methods in words. @type {Record<string, string>} */
const METHODS = { "dmv10": "discrete Moser-Veselov, order 10", "rkmk4": "Runge-Kutta-Munthe-Kaas, order 4", "rkmk853": "Runge-Kutta-Munthe-Kaas, order 8", "projected4": "Runge-Kutta and projection, order 4",
  "cf4": "commutator-free, order 4", "kick4": "kicks between free motions, order 4", "simo-wong": "Simo and Wong, order 2" };
const inWords = (/** @type {string} */ method) => METHODS[method] ? `${method} (${METHODS[method]})` : method;
/** The corners of the faces of a box, as signs. @type {Point[][]} */
const FACES = [0, 1, 2].flatMap((k) => [1, -1].map((side) => [[1, 1], [1, -1], [-1, -1], [-1, 1]].map((signs) => {
  const corner = /** @type {Point} */ ([0, 0, 0]);
  [corner[k], corner[(k + 1) % 3], corner[(k + 2) % 3]] = [side, signs[0], signs[1]];
  return corner;
})));

export class MotionView {
  #view = new View();
  /** @type {any} */ #data = null;
  #at = 0;
  #playing = 0;
  #quantity = "";

  /** @param {HTMLElement} box */
  constructor(box) {
    this.picture = /** @type {SVGElement} */ (make("svg", { viewBox: "-145 -145 290 290", role: "img", tabindex: 0, class: "ball" }));
    this.picture.addEventListener("keydown", (event) => { if (this.#view.key(event)) this.redraw(); });
    this.picture.addEventListener("pointerdown", (event) => this.picture.setPointerCapture(event.pointerId));
    this.picture.addEventListener("pointermove", (event) => {
      if (!this.picture.hasPointerCapture(event.pointerId)) return;
      this.#view.turn(0.5 * event.movementX, -0.5 * event.movementY);
      this.redraw();
    });
    const button = (/** @type {string} */ name, /** @type {() => void} */ act) => {
      const element = html("button", { type: "button" }, name);
      element.addEventListener("click", act);
      return element;
    };
    this.play = button("Play", () => this.#toggle());
    this.time = /** @type {HTMLInputElement} */ (html("input", { type: "range", min: "0", step: "1", "aria-label": "Time" }));
    this.time.addEventListener("input", () => this.#go(Number(this.time.value)));
    this.clock = html("output");
    this.choice = /** @type {HTMLSelectElement} */ (html("select", { id: "quantity" }));
    this.choice.addEventListener("change", () => { this.#quantity = this.choice.value; this.#charts(); });
    this.caption = html("figcaption");
    this.charts = html("div");
    this.law = html("div", { class: "law" });
    this.table = html("div", { class: "table", tabindex: "0", role: "group", "aria-label": "largest changes" });
    box.replaceChildren(html("div", { class: "panels" },
      html("figure", {}, this.picture, html("p", { class: "buttons" },
        button("Back", () => this.#go(this.#at - 1)), this.play, button("Step", () => this.#go(this.#at + 1)), this.time, this.clock), this.caption),
      html("div", {}, this.law, html("details", {}, html("summary", {}, "conserved quantities, by method"), html("p", {}, html("label", { for: "quantity" }, "Quantity "), this.choice), this.charts, this.table))));
  }

  /** @param {any} data the answer of the engine */
  show(data) {
    this.#data = data;
    this.#at = Math.min(this.#at, data.rows.length - 1);
    this.time.max = String(data.rows.length - 1);
    const names = data.watched;
    this.choice.replaceChildren(...names.map((/** @type {string} */ name) => html("option", {}, name)));
    if (!names.includes(this.#quantity)) this.#quantity = names.includes("energy") ? "energy" : names[0] ?? "";
    this.choice.value = this.#quantity;
    this.#charts();
    this.#table();
    this.#go(this.#at);
  }

  /** Begins the animation. */
  start() { if (!this.#playing) this.#toggle(); }

  /** Ends the animation, when another report is shown. */
  stop() { if (this.#playing) this.#toggle(); }

  /** Seconds that the animation takes, and its time. */
  get length() { return this.#data.rows.length / RATE; }

  get passed() { return this.#at / RATE; }

  /** Shows a time of the animation. @param {number} time */
  go(time) { this.#go(Math.round(time * RATE)); }

  #toggle() {
    const begin = !this.#playing;
    clearInterval(this.#playing);
    this.#playing = 0;
    this.play.textContent = begin ? "Pause" : "Play";
    if (!begin) return;
    if (this.#at >= this.#data.rows.length - 1) this.#go(0);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.#playing = setInterval(() => {
      if (this.#at >= this.#data.rows.length - 1) return this.#toggle();
      this.#go(this.#at + (still ? RATE : 1));
    }, still ? 1000 : 1000 / RATE);
  }

  /** @param {number} at a row */
  #go(at) {
    this.#at = Math.max(0, Math.min(this.#data.rows.length - 1, at));
    this.time.value = String(this.#at);
    const time = this.#times()[this.#at];
    this.clock.textContent = `t = ${Number(time.toFixed(4))}`;
    for (const picture of this.charts.querySelectorAll("svg")) picture.dispatchEvent(new CustomEvent("time", { detail: time }));
    this.redraw();
  }

  /** @returns {number[]} */
  #times() {
    const t = this.#data.columns.indexOf("t");
    return this.#data.rows.map((/** @type {number[]} */ row, /** @type {number} */ k) => t < 0 ? k : row[t]);
  }

  #charts() {
    const { drifts, columns, rows } = this.#data, times = this.#times(), name = this.#quantity;
    /** @type {{name: string, values: number[]}[]} */
    const lines = drifts.filter((/** @type {any} */ drift) => drift.quantity === name)
      .map((/** @type {any} */ { method, changes }) => ({ name: method, values: changes }));
    const at = columns.indexOf(name);
    const legend = lines.map(({ name }, k) => html("li", { class: `line-${k % 5}` }, inWords(name)));
    this.choice.parentElement?.toggleAttribute("hidden", !lines.length);
    this.charts.replaceChildren(...(!lines.length ? [html("p", {}, "This problem has no quantity that should be conserved.")] : [
      html("figure", {}, chart(`Largest change of ${name} up to each time, logarithmic: ${lines.map(({ name, values }) => `${name} ${values[values.length - 1].toExponential(1)}`).join(", ")}`, times, lines, true),
        html("ul", { class: "legend" }, ...legend), html("figcaption", {}, `largest change of ${name} so far, by method`))]),
      ...(at < 0 ? [] : [html("figure", {}, chart(`${name} over time, from ${rows[0][at]} to ${rows[rows.length - 1][at]}`, times, [{ name, values: rows.map((/** @type {number[]} */ row) => row[at]) }], false),
        html("figcaption", {}, `${name} over time, by ${this.#data.method}`))]));
  }

  #table() {
    const { drifts, watched } = this.#data;
    const methods = [...new Set(drifts.map((/** @type {any} */ drift) => drift.method))];
    const cell = (/** @type {string} */ method, /** @type {string} */ name) => {
      const found = drifts.find((/** @type {any} */ drift) => drift.method === method && (drift.quantity === name || drift.refused));
      return html("td", {}, found?.refused ? found.refused : found ? found.changes[found.changes.length - 1].toExponential(1) : "");
    };
    this.table.replaceChildren(html("table", {}, html("caption", {}, "Largest changes"),
      html("thead", {}, html("tr", {}, html("th", { scope: "col" }, "method"), ...watched.map((/** @type {string} */ name) => html("th", { scope: "col" }, name)))),
      html("tbody", {}, ...methods.map((method) => html("tr", {}, html("th", { scope: "row" }, String(method)), ...watched.map((/** @type {string} */ name) => cell(String(method), name)))))));
  }

  redraw() {
    const { edges, poses, places, name, method } = this.#data, view = this.#view, at = this.#at;
    const time = this.#times()[at];
    if (!poses?.length) {
      this.picture.replaceChildren();
      this.caption.textContent = `${name}: there is no body to draw.`;
      return;
    }
    const axes = poses[at], longest = Math.hypot(...edges) || 1;
    // with a place the whole path is in the picture, and the body is small on it
    const far = places ? Math.max(...places.map((/** @type {Point} */ x) => Math.hypot(...x))) || 1 : 1;
    const centre = /** @type {Point} */ (places ? places[at].map((/** @type {number} */ x) => x / far) : [0, 0, 0]);
    const size = places ? 0.3 : 0.8;
    const half = edges.map((/** @type {number} */ edge) => Math.max(edge, 0.06 * longest) * size / longest);
    const corner = (/** @type {Point} */ signs) => /** @type {Point} */ ([0, 1, 2].map((i) =>
      centre[i] + [0, 1, 2].reduce((sum, k) => sum + signs[k] * half[k] * axes[k][i], 0)));
    const faces = FACES.map((face, k) => ({ k, places: face.map((signs) => view.place(corner(signs))) }))
      .map((face) => ({ ...face, depth: face.places.reduce((sum, place) => sum + place[2], 0) })).sort((a, b) => a.depth - b.depth);
    const trail = places ? places.slice(0, at + 1).map((/** @type {Point} */ x) => x.map((part) => part / far))
      : poses.slice(0, at + 1).map((/** @type {Point[]} */ pose) => pose[2]);
    this.picture.replaceChildren(
      make("circle", { r: SIZE, class: "rim" }),
      view.line(trail, SIZE, "path"),
      ...faces.map(({ k, places }) => make("polygon", { class: `face face-${k >> 1}`, points: places.map(([x, y]) => `${(x * SIZE).toFixed(1)},${(y * SIZE).toFixed(1)}`).join(" ") })),
      ...axes.map((/** @type {Point} */ axis, /** @type {number} */ k) =>
        view.arrow(centre, /** @type {Point} */ (axis.map((part, i) => centre[i] + part * (places ? 0.4 : 1))), SIZE, `axis-${k}`)));
    const tip = axes[2].map((/** @type {number} */ part) => part.toFixed(2)).join(", ");
    const where = places ? ` Its origin is at (${places[at].map((/** @type {number} */ x) => x.toFixed(2)).join(", ")}).` : "";
    const words = `${name} by ${inWords(method)}, at t = ${Number(time.toFixed(4))}: axis 3 of inertia points to (${tip}).${where}`;
    this.picture.setAttribute("aria-label", `${words} Arrow keys turn the view.`);
    this.caption.textContent = words;
  }
}
