// @ts-check
// Geodesics of a left-invariant metric from the identity: free motions of a body with these moments of inertia.
import { exp, log, norm, scale } from "./rotations.js";
import { Ball } from "./ball.js";
import { advance } from "./mechanics.js";

/** @typedef {import("./rotations.js").Point} Point */

/** Directions at the start, in the plane of the first and third axes and around the equator. @type {Point[]} */
const WAYS = Array.from({ length: 14 }, (_, k) => [Math.cos(2 * Math.PI * k / 14), 0, Math.sin(2 * Math.PI * k / 14)]);
const [STEPS, LENGTH] = [90, Math.PI];

/** The geodesic of `diag(1, 1, J3)` along `w` with unit speed, until it leaves the ball. @param {number} third @param {Point} w */
export function geodesic(third, w) {
  const J = /** @type {Point} */ ([1, 1, third]), speed = Math.sqrt(w[0] ** 2 + w[1] ** 2 + third * w[2] ** 2);
  let motion = { g: exp([0, 0, 0]), w: scale(w, 1 / speed) };
  /** @type {Point[]} */ const points = [[0, 0, 0]];
  for (let k = 0; k < STEPS; k++) {
    motion = advance({ J }, motion, LENGTH / STEPS);
    if (motion.g[0] < 0) break;
    points.push(log(motion.g));
  }
  return points;
}

/** @type {import("./stage.js").Spec} */
export default {
  id: "geodesics",
  title: "Geodesics of a metric",
  text: 'A metric on the group is an inertia. Its shortest paths, the <span class="violet">geodesics</span>, are the free motions of a body with these moments. Change one moment, and they bend away from the <span class="quiet">one-parameter subgroups</span>.',
  more: "At J₃ = 1 the metric is the same in all directions; geodesics and subgroups agree. For any other J₃ they agree only along the principal axes. Points that started together and travelled equally far form the dotted front.",
  formula: '<math><mi>J</mi><mover accent="true"><mi>ω</mi><mo>˙</mo></mover><mo>=</mo><mi>J</mi><mi>ω</mi><mo>×</mo><mi>ω</mi></math>',
  tensors: "space=so3&connection=levi-civita&metric=diag(1,1,c)",
  control: { label: "J₃", min: 0.2, max: 3, step: 0.02, value: 2.2, words: (v) => `J₃ = ${v.toFixed(2)}`, ticks: [[0.2, ""], [1, ""], [3, ""]] },
  camera: [-62, 16],
  play: "Send",
  duration: 4,
  rest: 4,
  draw(state, camera, prefix) {
    const { v, t } = state, ball = new Ball(camera, `${prefix}0`), shown = Math.max(1, Math.round(STEPS * t / 4));
    /** @type {Point[][]} */
    const lines = state.memo ??= WAYS.map((w) => geodesic(v, w));
    WAYS.forEach((way) => ball.line([[0, 0, 0], scale(way, Math.PI)], "quiet", { width: 0.9, dash: "1.5 3", reach: Math.PI }));
    for (const points of lines) {
      const line = points.slice(0, shown + 1);
      ball.line(line.filter((_, k) => k % 2 === 0 || k === line.length - 1).map(([x, y]) => /** @type {Point} */ ([x, y, 0])), "shadow", { width: 1.6 });
      ball.line(line, "violet", { width: 1.9, reach: Math.PI });
      if (points.length > shown) ball.dot(line[line.length - 1], "violet", 2.2);
    }
    const front = lines.flatMap((points) => points.length > shown ? [points[shown]] : []);
    if (front.length === WAYS.length) ball.line([...front, front[0]], "violet", { width: 0.8, dash: "1 3" });
    ball.dot([0, 0, 0], "ink");
    ball.label([0, 0, 0], "e", "name", [-6, 11]);
    ball.label([0, 0, 1.06 * Math.PI], "3", "axis", [0, 0]);
    ball.label([1.08 * Math.PI, 0, 0], "1", "axis", [0, 3]);
    return [{ svg: ball.drawn(), caption: "", about: `Ball of rotation vectors with 14 geodesics of diag(1, 1, ${v.toFixed(2)}) from e, and straight one-parameter subgroups` }];
  },
  readout({ v }) {
    const way = /** @type {Point} */ ([Math.SQRT1_2, 0, Math.SQRT1_2]), points = geodesic(v, way), end = points[Math.min(40, points.length - 1)];
    const bend = Math.acos(Math.min(1, (end[0] + end[2]) * Math.SQRT1_2 / norm(end))) * 180 / Math.PI;
    return `the geodesic at 45° leaves its subgroup by <b>${bend.toFixed(1)}°</b> after ${(LENGTH * 40 / STEPS).toFixed(1)} units of length`;
  },
};
