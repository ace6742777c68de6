// @ts-check
// Solids of the pictures: a book, a top, an ellipsoid.
import { add, scale } from "./rotations.js";

/** @typedef {import("./rotations.js").Point} Point */
/** @typedef {import("./scene.js").Scene} Scene */

/** Half the edges of the book: long, middle, short. @type {Point} */
export const BOOK = [0.95, 0.66, 0.14];
/** Its moments of inertia, in proportion. @type {Point} */
export const MOMENTS = [BOOK[1] ** 2 + BOOK[2] ** 2, BOOK[0] ** 2 + BOOK[2] ** 2, BOOK[0] ** 2 + BOOK[1] ** 2];

/** The faces of a book: covers across the short edge, the spine on one long side. @param {(x: Point) => Point} move @param {number} [size] */
export function book(move, size = 1) {
  const [a, b, c] = scale(BOOK, size);
  const face = (/** @type {string} */ kind, /** @type {Point[]} */ ...points) => ({ kind, points: points.map(move) });
  const cover = (/** @type {number} */ z) => face("cover", [-a, -b, z], [a, -b, z], [a, b, z], [-a, b, z]);
  const band = (/** @type {number} */ z) => face("mark", [0.35 * a, -0.6 * b, z], [0.6 * a, -0.6 * b, z], [0.6 * a, 0.6 * b, z], [0.35 * a, 0.6 * b, z]);
  return [cover(c), cover(-c), band(c), band(-c), face("spine", [-a, -b, -c], [a, -b, -c], [a, -b, c], [-a, -b, c]),
    face("leaves", [-a, b, -c], [a, b, -c], [a, b, c], [-a, b, c]),
    face("leaves", [a, -b, -c], [a, b, -c], [a, b, c], [a, -b, c]), face("leaves", [-a, -b, -c], [-a, b, -c], [-a, b, c], [-a, -b, c])];
}

/** The faces of a solid of revolution about the third axis. @param {[number, number][]} profile radius and height @param {(x: Point) => Point} move @param {string[]} kinds of sectors */
export function revolved(profile, move, kinds) {
  const parts = 24, faces = [];
  const at = (/** @type {[number, number]} */ [r, z], /** @type {number} */ k) =>
    move([r * Math.cos(2 * Math.PI * k / parts), r * Math.sin(2 * Math.PI * k / parts), z]);
  for (let i = 0; i + 1 < profile.length; i++) {
    for (let k = 0; k < parts; k++) {
      const [low, high] = [profile[i], profile[i + 1]];
      const points = low[0] === 0 ? [at(low, k), at(high, k), at(high, k + 1)]
        : high[0] === 0 ? [at(low, k), at(low, k + 1), at(high, k)] : [at(low, k), at(low, k + 1), at(high, k + 1), at(high, k)];
      faces.push({ kind: kinds[Math.floor(k * kinds.length / parts)], points });
    }
  }
  return faces;
}

/** The outline of an ellipsoid along the axes, shaded. @param {Scene} scene @param {Point} semi @param {string} name of the picture */
export function ellipsoid(scene, semi, name) {
  const { right, up, size } = scene;
  let [xx, xy, yy] = [0, 0, 0];
  for (let i = 0; i < 3; i++) {
    const square = (semi[i] * size) ** 2;
    [xx, xy, yy] = [xx + square * right[i] ** 2, xy - square * right[i] * up[i], yy + square * up[i] ** 2];
  }
  const mean = (xx + yy) / 2, gap = Math.hypot((xx - yy) / 2, xy), turn = Math.atan2(2 * xy, xx - yy) * 90 / Math.PI;
  const radii = `rx="${Math.sqrt(mean + gap).toFixed(1)}" ry="${Math.sqrt(Math.max(0, mean - gap)).toFixed(1)}" transform="rotate(${turn.toFixed(1)})"`;
  return {
    below: `<defs><radialGradient id="${name}-body" cx="36%" cy="30%" r="78%"><stop offset="0" class="stop-lit"/><stop offset="0.6" class="stop-body"/><stop offset="1" class="stop-shade"/></radialGradient></defs><ellipse ${radii} fill="url(#${name}-body)"/>`,
    above: `<ellipse class="s rim" ${radii}/>`,
  };
}

/** Moved by the rows of a matrix, from a place. @param {import("./rotations.js").Matrix} m @param {Point} [from] @returns {(x: Point) => Point} */
export const moved = (m, from = [0, 0, 0]) => (x) => add(from, [
  m[0][0] * x[0] + m[0][1] * x[1] + m[0][2] * x[2], m[1][0] * x[0] + m[1][1] * x[1] + m[1][2] * x[2], m[2][0] * x[0] + m[2][1] * x[1] + m[2][2] * x[2]]);
