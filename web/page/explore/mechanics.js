// @ts-check
// A rotating body: Euler's equations with a torque, by a Runge-Kutta method of order 4 in canonical coordinates of each step.
import { add, apply, compose, cross, exp, matrix, normalize, scale, tangent, transpose } from "./rotations.js";

/** @typedef {import("./rotations.js").Point} Point */
/** @typedef {import("./rotations.js").Quaternion} Quaternion */
/** @typedef {{g: Quaternion, w: Point}} Motion attitude, and angular velocity in the body */
/** Moments of inertia, and the torque in body components. @typedef {{J: Point, torque?: (g: Quaternion) => Point}} Body */

/** The longest step, in seconds. */
const STEP = 1 / 240;

/** One step: `g exp(s)` with `s' = T_left(s)^-1 w`, and `J w' = J w x w + M`. @param {Body} body @param {Motion} motion @param {number} h @returns {Motion} */
function step({ J, torque }, { g, w }, h) {
  const rate = (/** @type {Point} */ s, /** @type {Point} */ w) => {
    const H = /** @type {Point} */ ([J[0] * w[0], J[1] * w[1], J[2] * w[2]]);
    let force = cross(H, w);
    if (torque) force = add(force, torque(compose(g, exp(s))));
    return [tangent(s, w), /** @type {Point} */ ([force[0] / J[0], force[1] / J[1], force[2] / J[2]])];
  };
  const [s1, a1] = rate([0, 0, 0], w);
  const [s2, a2] = rate(scale(s1, h / 2), add(w, a1, h / 2));
  const [s3, a3] = rate(scale(s2, h / 2), add(w, a2, h / 2));
  const [s4, a4] = rate(scale(s3, h), add(w, a3, h));
  const mean = (/** @type {Point} */ a, /** @type {Point} */ b, /** @type {Point} */ c, /** @type {Point} */ d) =>
    scale(add(add(a, d), add(b, c), 2), h / 6);
  return { g: normalize(compose(g, exp(mean(s1, s2, s3, s4)))), w: add(w, mean(a1, a2, a3, a4)) };
}

/** The motion after a time. @param {Body} body @param {Motion} motion @param {number} time @returns {Motion} */
export function advance(body, motion, time) {
  const steps = Math.ceil(time / STEP - 1e-9);
  for (let k = 0; k < steps; k++) motion = step(body, motion, time / steps);
  return motion;
}

/** Components in space of a vector of the body. @param {Quaternion} g @param {Point} x */
export const inSpace = (g, x) => apply(matrix(g), x);
/** Components in the body of a vector of space. @param {Quaternion} g @param {Point} x */
export const inBody = (g, x) => apply(transpose(matrix(g)), x);

/** The torque of a weight on the third axis of the body: of the potential `load R33`. @param {number} load @returns {(g: Quaternion) => Point} */
export const weight = (load) => (g) => scale(cross(inBody(g, [0, 0, 1]), [0, 0, 1]), load);

/** The rotation that takes a direction to another by the shortest way. @param {Point} from @param {Point} to unit vectors @returns {Quaternion} */
export function between(from, to) {
  const axis = cross(from, to), sum = 1 + from[0] * to[0] + from[1] * to[1] + from[2] * to[2];
  return sum < 1e-9 ? [0, 1, 0, 0] : normalize([sum, axis[0], axis[1], axis[2]]);
}

/** A film that remembers its last picture: motions at rising times, and a trail. */
export class Film {
  /** @param {Body} body @param {Motion} motion @param {(motion: Motion) => Point} tip of the trail @param {number} kept seconds of the trail */
  constructor(body, motion, tip, kept) {
    this.body = body;
    this.first = motion;
    this.tip = tip;
    this.kept = kept;
    this.motion = motion;
    this.time = 0;
    /** @type {Point[]} */ this.trail = [tip(motion)];
  }

  #rewind() {
    this.motion = this.first;
    this.time = 0;
    this.trail = [this.tip(this.first)];
  }

  /** The motion at a time. @param {number} time */
  at(time) {
    if (time < this.time - 1e-9) this.#rewind();
    const gap = 1 / 60;
    while (this.time < time - 1e-9) {
      const part = Math.min(gap, time - this.time);
      this.motion = advance(this.body, this.motion, part);
      this.time += part;
      this.trail.push(this.tip(this.motion));
    }
    const most = Math.round(this.kept / gap);
    if (this.trail.length > most) this.trail.splice(0, this.trail.length - most);
    return this.motion;
  }
}

