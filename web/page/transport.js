// @ts-check
// The ball of rotation vectors by several connections: a path, a transported vector, autoparallels from the start of the path.
import { View, html, make } from "./picture.js";

/** @typedef {import("./picture.js").Point} Point */

const SIZE = 130;
const KEYS = "Arrow keys turn the ball. With Shift they move the end of the path; Enter adds a point, Backspace removes one.";

/** Three decimals of a point that is drawn or moved, not farther out. @param {Point} point @returns {Point} */
const brief = (point) => /** @type {Point} */ (point.map((x) => Math.trunc(1000 * x) / 1000 + 0));

export class TransportView {
  #view = new View();
  /** @type {any} */ #data = null;
  /** @type {Point[]} */ #points = [];
  /** @type {SVGElement[]} */ #pictures = [];
  #drawing = false;

  /** @param {HTMLElement} box @param {(path: string) => void} change */
  constructor(box, change) {
    this.box = box;
    this.change = change;
    this.draw = html("button", { type: "button", "aria-pressed": "false" }, "Draw a path");
    this.draw.addEventListener("click", () => {
      this.#drawing = !this.#drawing;
      this.draw.setAttribute("aria-pressed", String(this.#drawing));
      this.box.classList.toggle("drawing", this.#drawing);
    });
    this.panels = html("div", { class: "panels" });
    box.replaceChildren(html("p", { class: "buttons" }, this.draw, html("small", {}, KEYS)), this.panels);
  }

  /** @param {any} data the answer of the engine */
  show(data) {
    this.#data = data;
    this.#points = data.points;
    if (this.#pictures.length !== data.panels.length) {
      this.#pictures = data.panels.map(() => this.#picture());
      this.panels.replaceChildren(...this.#pictures.map((picture) => html("figure", {}, picture, html("figcaption"))));
    }
    data.panels.forEach((/** @type {any} */ { about }, /** @type {number} */ i) => {
      this.#pictures[i].setAttribute("aria-label", `${about} ${KEYS}`);
      const caption = this.#pictures[i].nextElementSibling;
      if (caption) caption.textContent = about;
    });
    this.redraw();
  }

  #picture() {
    const reach = 1.3 * SIZE;
    const picture = /** @type {SVGElement} */ (make("svg", { viewBox: `${-reach} ${-reach} ${2 * reach} ${2 * reach}`, role: "img", tabindex: 0, class: "ball" }));
    /** @type {Point[] | null} */ let drawn = null;
    const at = (/** @type {PointerEvent} */ event) => {
      const { left, top, width } = picture.getBoundingClientRect();
      const unit = 2.6 * this.#data.radius / width;
      let [x, y] = [(event.clientX - left) * unit - 1.3 * this.#data.radius, (event.clientY - top) * unit - 1.3 * this.#data.radius];
      const far = Math.hypot(x, y) / (0.999 * this.#data.radius);
      if (far > 1) [x, y] = [x / far, y / far];
      return brief(this.#view.back(x, y));
    };
    picture.addEventListener("pointerdown", (event) => {
      picture.setPointerCapture(event.pointerId);
      drawn = this.#drawing ? [at(event)] : null;
    });
    picture.addEventListener("pointermove", (event) => {
      if (!picture.hasPointerCapture(event.pointerId)) return;
      if (!drawn) {
        this.#view.turn(0.5 * event.movementX, -0.5 * event.movementY);
        this.redraw();
        return;
      }
      const [next, last] = [at(event), drawn[drawn.length - 1]];
      if (Math.hypot(next[0] - last[0], next[1] - last[1], next[2] - last[2]) < 0.2) return;
      drawn.push(next);
      this.#move(drawn);
    });
    picture.addEventListener("keydown", (event) => this.#key(event));
    return picture;
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (this.#view.key(event)) return this.redraw();
    const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
    const points = [...this.#points], end = points[points.length - 1];
    if (step && event.shiftKey) {
      const [x, y, z] = this.#view.back(step[0], step[1]);
      const moved = brief([end[0] + x, end[1] + y, end[2] + z]);
      if (Math.hypot(...moved) > this.#data.radius) return;
      points[points.length - 1] = moved;
    } else if (event.key === "Enter") points.push(end);
    else if (event.key === "Backspace" && points.length > 2) points.pop();
    else return;
    event.preventDefault();
    this.#move(points);
  }

  /** @param {Point[]} points */
  #move(points) {
    this.#points = points;
    if (points.length > 1) this.change(points.map((point) => point.join(", ")).join("; "));
  }

  redraw() {
    const { radius, path, panels } = this.#data, scale = SIZE / radius, view = this.#view;
    panels.forEach((/** @type {any} */ { rays, own, arrows }, /** @type {number} */ i) => {
      const axes = ["1", "2", "3"].flatMap((name, k) => {
        const end = /** @type {Point} */ ([0, 0, 0]);
        end[k] = 1.12 * radius;
        const [x, y] = view.place(end).map((part) => part * scale * 1.06);
        return [view.line([[0, 0, 0], end], scale, "axis"), make("text", { x: x.toFixed(1), y: (y + 4).toFixed(1) }, `Ψ${name}`)];
      });
      const lines = (/** @type {Point[][]} */ pieces, /** @type {string} */ kind) => pieces.map((points) => view.line(points, scale, kind));
      this.#pictures[i].replaceChildren(
        make("circle", { r: SIZE, class: "rim" }), ...axes,
        ...rays.flatMap((/** @type {Point[][]} */ pieces) => lines(pieces, "ray")),
        ...(own ? lines(own, "own") : []), ...lines(path, "path"),
        ...arrows.map((/** @type {[Point, Point]} */ [from, to], /** @type {number} */ k) =>
          view.arrow(from, to, scale, k === 0 ? "start" : k === arrows.length - 1 ? "end" : "carried")));
    });
  }
}
