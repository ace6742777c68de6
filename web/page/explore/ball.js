// @ts-check
// The ball of rotation vectors: every point is a rotation about its direction, by its distance from the centre.
import { Path, add, angle, cross, norm, scale, tangent, unit } from "./rotations.js";
import { Scene, circle } from "./scene.js";

/** @typedef {import("./rotations.js").Point} Point */
/** @typedef {import("./rotations.js").Connection} Connection */
/** @typedef {import("./scene.js").Camera} Camera */

/** Radius of the ball in the picture, in a box of 200 units. */
export const RADIUS = 86;
/** @type {[number, number, number, number]} */
export const BOX = [-100, -100, 200, 200];
/** The farthest point that a hand may reach. */
export const REACH = 0.97 * Math.PI;
/** Units of the picture for a radian. */
export const UNIT = RADIUS / Math.PI;

/** Gradients of a shaded ball; names are of one picture. @param {string} name */
const shading = (name) => `<defs><radialGradient id="${name}-body" cx="36%" cy="30%" r="78%"><stop offset="0" class="stop-lit"/><stop offset="0.6" class="stop-body"/><stop offset="1" class="stop-shade"/></radialGradient>`
  + `<radialGradient id="${name}-gloss" cx="34%" cy="24%" r="42%"><stop offset="0" class="stop-gloss" stop-opacity="0.5"/><stop offset="1" class="stop-gloss" stop-opacity="0"/></radialGradient></defs>`;

/** A scene of the ball, with its equator, two meridians and axes. */
export class Ball extends Scene {
  /**
   * @param {Camera} camera @param {string} name a name of the picture in the document
   * @param {{unit: number, radius: number, centre?: Point}} [part] instead of the ball, the disc about the centre with this radius, in this scale
   */
  constructor(camera, name, part) {
    super(camera, part?.unit ?? UNIT, part?.centre);
    this.name = name;
    this.part = part;
    const [x, y, z] = /** @type {Point[]} */ ([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    this.area(circle(x, y, part?.radius ?? Math.PI, 40), "disc", 1, -9);
    if (part) {
      for (const share of [1, 2 / 3, 1 / 3]) this.line(circle(x, y, share * part.radius, 40), "grid", { width: 0.7 });
      for (const axis of [x, y]) this.line([scale(axis, -part.radius), scale(axis, part.radius)], "grid", { width: 0.7 });
      return;
    }
    for (const [a, b] of [[x, y], [y, z], [z, x]]) this.line(circle(a, b, Math.PI, 40), "grid", { width: 0.7, reach: Math.PI });
  }

  /** The path, with its shadow on the disc of rotations about horizontal axes. @param {Path} path @param {number} [share] what has been travelled */
  path(path, share = 1) {
    const points = Array.from({ length: 61 }, (_, k) => path.point(k / 60));
    this.line(points.map(([x, y]) => /** @type {Point} */ ([x, y, 0])), "shadow", { width: 2.4 });
    this.line(points, "ink", { width: 1.5, reach: Math.PI, opacity: share < 1 ? 0.35 : 1 });
    if (share < 1 && share > 0) this.line(Array.from({ length: 41 }, (_, k) => path.point(share * k / 40)), "ink", { width: 2, reach: Math.PI });
  }

  /** The tangent vector with left components `u` at `x`. @param {Point} x @param {Point} u @param {string} kind @param {import("./scene.js").Look} [look] @param {number} [order] */
  vector(x, u, kind, look, order) { this.arrow(x, add(x, tangent(x, u)), kind, look, order); }

  /** The vector carried along the path: its start in gold, copies on the way, and where it is. @param {Path} path @param {Connection} connection @param {Point} u @param {string} kind @param {number} [share] */
  carried(path, connection, u, kind, share = 1) {
    const stops = 9;
    for (let k = 1; k < stops; k++) {
      if (k / stops < share) this.vector(path.point(k / stops), path.carried(connection, u, k / stops), kind, { opacity: 0.5, width: 1.4 });
    }
    const start = path.point(0), depth = this.place(start)[2];
    this.vector(start, u, "gold", { width: 3.6 }, depth);
    const end = path.carried(connection, u, share);
    // over the gold one, where it returns unturned
    if (share > 0) this.vector(path.point(share), end, kind, { width: 1.8 }, share === 1 ? depth + 0.01 : undefined);
    const turn = angle(u, end);
    if (share === 1 && turn > 0.05) this.sector(path.point(1), u, end, turn);
  }

  /** The arc between two vectors at a point. @param {Point} at @param {Point} from @param {Point} to @param {number} turn */
  sector(at, from, to, turn) {
    const a = unit(from), c = unit(cross(from, to)), b = cross(c, a), radius = 0.45 * norm(from);
    const points = Array.from({ length: 17 }, (_, k) => add(add(at, a, radius * Math.cos(turn * k / 16)), b, radius * Math.sin(turn * k / 16)));
    this.area([at, ...points], "gold", 0.22);
    this.line(points, "gold", { width: 1.2 });
  }

  /** The picture. */
  drawn() {
    const { name } = this;
    if (this.part) return this.text(BOX);
    return this.text(BOX, `${shading(name)}<circle r="${RADIUS}" fill="url(#${name}-body)"/>`,
      `<circle r="${RADIUS}" fill="url(#${name}-gloss)"/><circle class="s rim" r="${RADIUS}" stroke-width="1"/>`);
  }
}

/** A point within the reach of the hand. @param {Point} x @returns {Point} */
export const within = (x) => norm(x) > REACH ? scale(x, REACH / norm(x)) : x;
