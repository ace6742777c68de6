// @ts-check
// Drawing: elements of SVG, and the projection of points in space along a direction of view.

/** @typedef {[number, number, number]} Point */

/** @param {string} tag @param {Record<string, string | number>} attributes @param {...(Node | string)} children */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

/** @param {string} tag @param {Record<string, string>} attributes @param {...(Node | string)} children */
export function html(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Orthographic projection; angles in degrees. */
export class View {
  azimuth = 28;
  elevation = 20;

  /** Unit vectors towards the eye, right and up. @returns {[Point, Point, Point]} */
  axes() {
    const [a, e] = [this.azimuth, this.elevation].map((angle) => angle * Math.PI / 180);
    const [sa, ca, se, ce] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)];
    return [[ce * ca, ce * sa, se], [-sa, ca, 0], [-se * ca, -se * sa, ce]];
  }

  /** Right and down on the screen, and towards the eye. @param {Point} x @returns {Point} */
  place(x) {
    const [eye, right, up] = this.axes().map((axis) => axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2]);
    return [right, -up, eye];
  }

  /** The point right and down on the screen, in the plane of the centre. @param {number} right @param {number} down @returns {Point} */
  back(right, down) {
    const [, r, u] = this.axes();
    return [r[0] * right - u[0] * down, r[1] * right - u[1] * down, r[2] * right - u[2] * down];
  }

  /** @param {number} right @param {number} up degrees */
  turn(right, up) {
    this.azimuth = (this.azimuth - right) % 360;
    this.elevation = Math.max(-90, Math.min(90, this.elevation - up));
  }

  /** Turns by the arrow keys; whether it was one. @param {KeyboardEvent} event */
  key(event) {
    const turn = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] }[event.key];
    if (!turn || event.shiftKey || event.ctrlKey || event.altKey || event.metaKey) return false;
    event.preventDefault();
    this.turn(turn[0], turn[1]);
    return true;
  }

  /** A line through points, with their scale. @param {Point[]} points @param {number} scale @param {string} kind */
  line(points, scale, kind) {
    const places = points.map((x) => this.place(x)).map(([x, y]) => `${(x * scale).toFixed(1)},${(y * scale).toFixed(1)}`);
    return make("polyline", { points: places.join(" "), class: kind });
  }

  /** An arrow between points. @param {Point} from @param {Point} to @param {number} scale @param {string} kind */
  arrow(from, to, scale, kind) {
    const [a, b] = [this.place(from), this.place(to)];
    const [x, y] = [(b[0] - a[0]) * scale, (b[1] - a[1]) * scale];
    const length = Math.hypot(x, y) || 1, head = Math.min(9, 0.5 * length);
    const [u, v] = [x / length, y / length], [p, q] = [b[0] * scale, b[1] * scale];
    const corner = (/** @type {number} */ side) => `${(p - head * (u - 0.4 * side * v)).toFixed(1)},${(q - head * (v + 0.4 * side * u)).toFixed(1)}`;
    return make("g", { class: kind },
      make("line", { x1: (a[0] * scale).toFixed(1), y1: (a[1] * scale).toFixed(1), x2: p.toFixed(1), y2: q.toFixed(1) }),
      make("polygon", { points: `${p.toFixed(1)},${q.toFixed(1)} ${corner(1)} ${corner(-1)}` }));
  }
}
