// @ts-check
// A picture of space as SVG text: orthographic projection, depth order, fading by depth, shaded solids, arrows with heads, labels.
import { add, cross, dot, norm, scale, unit } from "./rotations.js";

/** @typedef {import("./rotations.js").Point} Point */
/** @typedef {{opacity?: number, width?: number, dash?: string, flat?: boolean}} Look */

/** Direction towards the light, on the screen: right, down, towards the eye. @type {Point} */
const LIGHT = unit([-0.45, -0.65, 0.62]);
const f = (/** @type {number} */ x) => String(Math.round(10 * x) / 10);

/** Where the eye is; angles in degrees. */
export class Camera {
  constructor(azimuth = 28, elevation = 18) {
    this.azimuth = azimuth;
    this.elevation = elevation;
  }

  /** Unit vectors right, up, and towards the eye. @returns {[Point, Point, Point]} */
  axes() {
    const a = this.azimuth * Math.PI / 180, e = this.elevation * Math.PI / 180;
    const [sa, ca, se, ce] = [Math.sin(a), Math.cos(a), Math.sin(e), Math.cos(e)];
    return [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
  }

  /** @param {number} right @param {number} up degrees */
  turn(right, up) {
    this.azimuth = (this.azimuth - right) % 360;
    this.elevation = Math.max(-89, Math.min(89, this.elevation + up));
  }
}

export class Scene {
  /** @type {{order: number, text: string}[]} */ #items = [];
  #labels = "";

  /** @param {Camera} camera @param {number} size units of the picture for a unit of space @param {Point} [centre] */
  constructor(camera, size, centre = [0, 0, 0]) {
    const [right, up, eye] = camera.axes();
    this.right = right;
    this.up = up;
    this.eye = eye;
    this.size = size;
    this.centre = centre;
  }

  /** Right and down in the picture, and towards the eye in units of space. @param {Point} x @returns {Point} */
  place(x) {
    const y = add(x, this.centre, -1);
    return [this.size * dot(y, this.right), -this.size * dot(y, this.up), dot(y, this.eye)];
  }

  /** @param {number} order what is larger is in front @param {string} text */
  put(order, text) { this.#items.push({ order, text }); }

  /**
   * A line, cut in pieces by depth, of at most `cut` segments. With `reach` it fades away from the eye; pieces that are not `seen` are faint.
   * @param {Point[]} points @param {string} kind @param {Look & {reach?: number, cut?: number, seen?: (x: Point) => boolean}} [look]
   */
  line(points, kind, { opacity = 1, width = 1.6, dash = "", reach = 0, cut = 1e9, seen } = {}) {
    const places = points.map((x) => this.place(x));
    const level = (/** @type {number} */ i) => {
      const depth = (places[i][2] + places[i + 1][2]) / 2;
      if (seen) return seen(points[i]) ? 3 : 0;
      return reach ? Math.max(0, Math.min(3, Math.floor(2 * (depth / reach + 1)))) : Math.sign(depth);
    };
    for (let from = 0; from < places.length - 1;) {
      let to = from + 1;
      const own = level(from);
      while (to < places.length - 1 && level(to) === own && to - from < cut) to++;
      const run = places.slice(from, to + 1), depth = run.reduce((sum, x) => sum + x[2], 0) / run.length;
      const visible = opacity * (seen ? own ? 1 : 0.22 : reach ? [0.4, 0.6, 0.82, 1][own] : 1);
      this.put(depth, `<path class="s ${kind}" d="M${run.map(([x, y]) => `${f(x)} ${f(y)}`).join("L")}" stroke-width="${f(width)}"${visible < 1 ? ` opacity="${visible.toFixed(2)}"` : ""}${dash ? ` stroke-dasharray="${dash}"` : ""}/>`);
      from = to;
    }
  }

  /** A filled polygon. @param {Point[]} points @param {string} kind @param {number} [opacity] @param {number} [order] */
  area(points, kind, opacity = 1, order) {
    const places = points.map((x) => this.place(x));
    const depth = order ?? places.reduce((sum, x) => sum + x[2], 0) / places.length;
    this.put(depth, `<path class="f ${kind}" d="M${places.map(([x, y]) => `${f(x)} ${f(y)}`).join("L")}Z"${opacity < 1 ? ` opacity="${opacity}"` : ""}/>`);
  }

  /** Faces of a convex solid, shaded by a light; hidden ones are left out. @param {{points: Point[], kind: string}[]} faces @param {Point} inside a point of it @param {number} [order] */
  solid(faces, inside, order) {
    for (const { points, kind } of faces) {
      let normal = unit(cross(add(points[1], points[0], -1), add(points[2], points[1], -1)));
      if (dot(normal, add(points[0], inside, -1)) < 0) normal = scale(normal, -1);
      const towards = dot(normal, this.eye);
      if (towards <= 0) continue;
      const lit = Math.max(0, LIGHT[0] * dot(normal, this.right) - LIGHT[1] * dot(normal, this.up) + LIGHT[2] * towards);
      const d = `M${points.map((x) => this.place(x)).map(([x, y]) => `${f(x)} ${f(y)}`).join("L")}Z`;
      const depth = order ?? this.place(inside)[2] + 1e-3 * towards;
      this.put(depth, `<path class="face ${kind}" d="${d}"/><path class="dusk" d="${d}" opacity="${(0.5 * (1 - lit)).toFixed(2)}"/>`);
    }
  }

  /** An arrow with a cone as its head. @param {Point} from @param {Point} to @param {string} kind @param {Look} [look] @param {number} [order] */
  arrow(from, to, kind, { opacity = 1, width = 2.2 } = {}, order) {
    const way = add(to, from, -1), length = norm(way) * this.size;
    if (!(length > 0.5)) return;
    const head = Math.min(4 + 2.4 * width, 0.55 * length), radius = 0.4 * head, d = scale(way, 1 / norm(way));
    const base = add(to, d, -head / this.size), [a, b, c] = [from, base, to].map((x) => this.place(x));
    const [x, y] = [c[0] - b[0], c[1] - b[1]], flat = Math.hypot(x, y), away = dot(d, this.eye);
    const [u, v] = flat > 1e-6 ? [x / flat, y / flat] : [1, 0];
    const minor = radius * Math.abs(away), turn = Math.atan2(v, u) * 180 / Math.PI;
    // the tangents from the tip to the ellipse of the base
    const reach = flat > minor ? minor * minor / flat : 0, side = flat > minor ? radius * Math.sqrt(1 - (minor / flat) ** 2) : 0;
    const corner = (/** @type {number} */ s) => `${f(b[0] + reach * u - s * side * v)} ${f(b[1] + reach * v + s * side * u)}`;
    const base_ = `<ellipse class="f" rx="${f(minor)}" ry="${f(radius)}" transform="translate(${f(b[0])} ${f(b[1])}) rotate(${f(turn)})"/>`;
    const tip = `<path class="f" d="M${f(c[0])} ${f(c[1])}L${corner(1)}L${corner(-1)}Z"/>`;
    const shaft = `M${f(a[0])} ${f(a[1])}L${f(b[0])} ${f(b[1])}`;
    const drawn = [`<path class="s" d="${shaft}" stroke-width="${f(width)}"/>`, base_, tip];
    const below = away > 0 ? "" : `<ellipse class="dusk" opacity="0.3" rx="${f(minor)}" ry="${f(radius)}" transform="translate(${f(b[0])} ${f(b[1])}) rotate(${f(turn)})"/>`;
    const halo = opacity === 1 ? `<path class="halo" d="${shaft}L${f(c[0])} ${f(c[1])}" stroke-width="${f(width + 2)}"/>` : "";
    this.put(order ?? (a[2] + c[2]) / 2 + 0.02, `<g class="${kind}"${opacity < 1 ? ` opacity="${opacity.toFixed(2)}"` : ""}>${halo}${drawn.join("")}${below}</g>`);
  }

  /** @param {Point} x @param {string} kind @param {number} [radius] */
  dot(x, kind, radius = 2.6) {
    const [a, b, depth] = this.place(x);
    this.put(depth + 0.03, `<circle class="f point ${kind}" cx="${f(a)}" cy="${f(b)}" r="${radius}"/>`);
  }

  /** A name beside a point, in front of everything. @param {Point} x @param {string} text @param {string} kind @param {[number, number]} [aside] */
  label(x, text, kind, aside = [5, -5]) {
    const [a, b] = this.place(x);
    const anchor = aside[0] < -1 ? "end" : aside[0] > 1 ? "start" : "middle";
    this.#labels += `<text class="${kind}" x="${f(a + aside[0])}" y="${f(b + aside[1])}" text-anchor="${anchor}">${text}</text>`;
  }

  /** The picture within a box `[left, top, width, height]`. @param {[number, number, number, number]} box @param {string} [below] @param {string} [above] */
  text(box, below = "", above = "") {
    this.#items.sort((a, b) => a.order - b.order);
    return `<svg viewBox="${box.join(" ")}" aria-hidden="true">${below}${this.#items.map(({ text }) => text).join("")}${above}${this.#labels}</svg>`;
  }
}

/** Points of a circle about the centre, in the plane of two unit vectors. @param {Point} a @param {Point} b @param {number} radius @param {number} [parts] @param {Point} [centre] */
export function circle(a, b, radius, parts = 48, centre = [0, 0, 0]) {
  return Array.from({ length: parts + 1 }, (_, k) => {
    const t = 2 * Math.PI * k / parts;
    return add(add(centre, a, radius * Math.cos(t)), b, radius * Math.sin(t));
  });
}
