// @ts-check
// Rotations as unit quaternions, connections on the rotation group, and parallel transport along arcs of one-parameter subgroups.

/** @typedef {[number, number, number]} Point */
/** @typedef {[number, number, number, number]} Quaternion w, x, y, z */
/** @typedef {[Point, Point, Point]} Matrix rows */

/** @param {Point} a @param {Point} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Point} a @param {Point} b @returns {Point} */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** The sum `a + s b`. @param {Point} a @param {Point} b @param {number} [s] @returns {Point} */
export const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
/** @param {Point} a @param {number} s @returns {Point} */
export const scale = (a, s) => [s * a[0], s * a[1], s * a[2]];
/** @param {Point} a */
export const norm = (a) => Math.hypot(a[0], a[1], a[2]);
/** @param {Point} a @returns {Point} */
export const unit = (a) => scale(a, 1 / (norm(a) || 1));
/** The angle between vectors, accurate near 0 and pi. @param {Point} a @param {Point} b */
export const angle = (a, b) => Math.atan2(norm(cross(a, b)), dot(a, b));
/** @param {Matrix} m @param {Point} x @returns {Point} */
export const apply = (m, x) => [dot(m[0], x), dot(m[1], x), dot(m[2], x)];
/** @param {Matrix} m @returns {Matrix} */
export const transpose = (m) => [[m[0][0], m[1][0], m[2][0]], [m[0][1], m[1][1], m[2][1]], [m[0][2], m[1][2], m[2][2]]];

/** @type {Quaternion} */
export const ONE = [1, 0, 0, 0];
/** @param {Quaternion} a @param {Quaternion} b @returns {Quaternion} */
export const compose = (a, b) => [
  a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
  a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
  a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
  a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]];
/** @param {Quaternion} q @returns {Quaternion} */
export const inverse = (q) => [q[0], -q[1], -q[2], -q[3]];
/** @param {Quaternion} q @returns {Quaternion} */
export const normalize = (q) => {
  const length = Math.hypot(...q);
  return [q[0] / length, q[1] / length, q[2] / length, q[3] / length];
};

/** The rotation by a rotation vector. @param {Point} x @returns {Quaternion} */
export function exp(x) {
  const half = norm(x) / 2, sinc = half < 1e-4 ? (1 - half * half / 6) / 2 : Math.sin(half) / (2 * half);
  return [Math.cos(half), sinc * x[0], sinc * x[1], sinc * x[2]];
}

/** The rotation vector of a quaternion, with an angle of at most `2 pi`: at most `pi` for `w >= 0`. @param {Quaternion} q @returns {Point} */
export function log(q) {
  const v = /** @type {Point} */ (q.slice(1)), sine = norm(v);
  return scale(v, sine < 1e-9 ? 2 / q[0] : 2 * Math.atan2(sine, q[0]) / sine);
}

/** The columns are the rotated axes. @param {Quaternion} q @returns {Matrix} */
export function matrix([w, x, y, z]) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]];
}

/** The change of the rotation vector `x` along the left-invariant field of `u`: `T_left(x)^-1 u`. @param {Point} x @param {Point} u @returns {Point} */
export function tangent(x, u) {
  const theta = norm(x), half = theta / 2;
  const factor = theta < 1e-3 ? 1 / 12 + theta * theta / 720 : (1 - half / Math.tan(half)) / (theta * theta);
  const once = cross(x, u);
  return add(add(u, once, 0.5), cross(x, once), factor);
}

/** A connection with constant affinities: `Lambda^i_jk x^j` as a matrix, for each `x`. @typedef {(x: Point) => Matrix} Connection */

/** The connection `nabla_x y = lambda [x, y]`: plus for 1, zero for 1/2, minus for 0. @param {number} lambda @returns {Connection} */
export const family = (lambda) => ([x, y, z]) => [[0, -lambda * z, lambda * y], [lambda * z, 0, -lambda * x], [-lambda * y, lambda * x, 0]];

/** @param {Matrix} m @returns {Matrix} */
export function inverted(m) {
  const rows = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])], determinant = dot(m[0], rows[0]);
  return transpose(/** @type {Matrix} */ (rows.map((row) => scale(row, 1 / determinant))));
}

/**
 * The Levi-Civita connection of the left-invariant metric `J`, by Koszul's formula:
 * `2 g(nabla_j e_k, e_i) = g([e_j, e_k], e_i) - g([e_k, e_i], e_j) + g([e_i, e_j], e_k)`.
 * @param {Matrix} metric symmetric @returns {Connection}
 */
export function leviCivita(metric) {
  const axes = /** @type {Point[]} */ ([[1, 0, 0], [0, 1, 0], [0, 0, 1]]), raise = inverted(metric);
  const g = (/** @type {Point} */ a, /** @type {Point} */ b) => dot(apply(metric, a), b);
  return (x) => transpose(/** @type {Matrix} */ (axes.map((k) =>
    apply(raise, /** @type {Point} */ (axes.map((i) => (g(cross(x, k), i) - g(cross(k, i), x) + g(cross(i, x), k)) / 2))))));
}

/** The exponential of `-m` on `u`: a Taylor series on halved arguments. @param {Matrix} m @param {Point} u @returns {Point} */
function flow(m, u) {
  const size = Math.max(...m.map((row) => Math.abs(row[0]) + Math.abs(row[1]) + Math.abs(row[2])));
  const parts = Math.max(1, Math.ceil(size / 0.5));
  for (let part = 0; part < parts; part++) {
    let term = u;
    for (let k = 1; k < 13; k++) {
      term = scale(apply(m, term), -1 / (k * parts));
      u = add(u, term);
    }
  }
  return u;
}

/**
 * Parallel transport along the arc `g exp(s x)`, `0 <= s <= 1`, in left components: `u' = -Lambda(x) u` has constant coefficients.
 * @param {Connection} connection @param {Point} x @param {Point} u @returns {Point}
 */
export const carry = (connection, x, u) => flow(connection(x), u);

/** A path of arcs through points of the ball, lifted to unit quaternions with `w >= 0`, where the arcs stay in the ball. */
export class Path {
  /** @param {Point[]} points rotation vectors */
  constructor(points) {
    this.elements = points.map(exp);
    this.arcs = this.elements.slice(1).map((g, i) => log(compose(inverse(this.elements[i]), g)));
    this.lengths = this.arcs.map(norm);
    this.length = this.lengths.reduce((sum, x) => sum + x, 0) || 1;
  }

  /** The arc at a share of the length of the path, and the share of the arc. @param {number} share @returns {[number, number]} */
  #at(share) {
    let left = share * this.length;
    for (let i = 0; i < this.arcs.length; i++) {
      if (left <= this.lengths[i] || i === this.arcs.length - 1) return [i, Math.min(1, left / (this.lengths[i] || 1))];
      left -= this.lengths[i];
    }
    return [0, 0];
  }

  /** The rotation vector at a share of the length. @param {number} share @returns {Point} */
  point(share) {
    const [i, part] = this.#at(share);
    return log(compose(this.elements[i], exp(scale(this.arcs[i], part))));
  }

  /** Left components of the vector `u` of the start, carried to a share of the length. @param {Connection} connection @param {Point} u @param {number} share */
  carried(connection, u, share) {
    const [last, part] = this.#at(share);
    for (let i = 0; i < last; i++) u = carry(connection, this.arcs[i], u);
    return carry(connection, scale(this.arcs[last], part), u);
  }
}
