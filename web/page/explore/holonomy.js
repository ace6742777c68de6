// @ts-check
// Holonomy is area: a loop turns a vector by a quarter of the area that it encloses, for the zero connection.
import { Path, add, angle, cross, dot, family, norm, scale, unit } from "./rotations.js";
import { BOX, Ball, REACH, UNIT } from "./ball.js";

/** @typedef {import("./rotations.js").Point} Point */

const [P, Q] = /** @type {Point[]} */ ([[2.0, -1.03, -0.5], [-1.95, -0.3, 1.49]]);
/** Rotations as near as half their angle: the group is a sphere of this radius, opposite points identified. */
const CURVED = 2;

/** The loop, its area, and the angle between a vector in its plane and the vector that returns. @param {number} size @param {Point} p */
export function loop(size, p) {
  const [a, b] = [scale(p, size), scale(Q, size)];
  const path = new Path([[0, 0, 0], a, b, [0, 0, 0]]);
  const first = unit(p), second = unit(add(Q, first, -dot(Q, first)));
  const u = scale(add(scale(first, 0.5), second, 0.85), -1.25);
  const back = path.carried(family(0.5), u, 1);
  // the area of the sector under the arc from a to b: the integral of R^2 (1 - cos(r / R)) over the angle at e
  let area = 0;
  const steps = 400, edge = Array.from({ length: steps + 1 }, (_, k) => path.point((path.lengths[0] + path.lengths[1] * k / steps) / path.length));
  for (let k = 0; k < steps; k++) {
    const height = (/** @type {Point} */ x) => 1 - Math.cos(norm(x) / CURVED);
    area += CURVED * CURVED * angle(edge[k], edge[k + 1]) * (height(edge[k]) + height(edge[k + 1])) / 2;
  }
  const normal = cross(first, second), turn = Math.atan2(dot(cross(u, back), normal), dot(u, back));
  return { path, a, b, u, back, edge, area, turn: turn < -1e-12 ? turn + 2 * Math.PI : turn };
}

/** @type {import("./stage.js").Spec} */
export default {
  id: "holonomy",
  title: "Holonomy is area",
  text: 'Carry a <span class="gold">vector</span> around a loop by the <span class="zero">zero</span> connection. It comes back <span class="zero">turned</span>, by a quarter of the area that the loop encloses.',
  more: 'Curvature is this turn per area, measured on ever smaller loops. Here it is the same in every plane: rotations at half their angle are a sphere of radius 2, and a sphere of radius <i>r</i> turns a vector by area / <i>r</i>². Drag <i>p</i>, or shrink the loop.',
  formula: '<math><mi>turn</mi><mo>=</mo><mfrac><mi>area</mi><msup><mi>r</mi><mn>2</mn></msup></mfrac></math> <math><mi>r</mi><mo>=</mo><mn>2</mn></math>',
  tensors: "space=so3&connection=zero&show=curvature",
  control: { label: "size", min: 0.1, max: 1.15, step: 0.01, value: 1, words: (v) => `${Math.round(100 * v)} %` },
  camera: [52, 26],
  points: { p: P },
  move: (name, x, { v }) => norm(x) * Math.max(1, v) > REACH ? scale(x, REACH / (norm(x) * Math.max(1, v))) : x,
  hands: { unit: UNIT, box: BOX, size: ({ v }) => v },
  play: "Carry",
  duration: 4,
  rest: 4,
  draw({ v, t, points: { p } }, camera, prefix) {
    const { path, a, b, u, edge, turn } = loop(v, p), share = t / 4, ball = new Ball(camera, `${prefix}0`);
    ball.area([[0, 0, 0], a, ...edge.filter((_, k) => k % 20 === 0), b], "zero", 0.2);
    ball.path(path, share);
    ball.carried(path, family(0.5), u, "zero", share);
    for (const x of [/** @type {Point} */ ([0, 0, 0]), a, b]) ball.dot(x, "ink", 2.4);
    ball.label([0, 0, 0], "e", "name", [-6, 10]);
    ball.label(a, "p", "name", [0, 15]);
    const words = `turned by ${(turn * 180 / Math.PI).toFixed(1)}°`;
    return [{ svg: ball.drawn(), caption: "", about: `Ball of rotation vectors: a vector carried around a triangle by the zero connection comes back ${words}` }];
  },
  readout({ v, points: { p } }) {
    const { area, turn } = loop(v, p);
    return `area <b>${area.toFixed(3)}</b>, turn <b>${turn.toFixed(3)}</b> rad = ${(turn * 180 / Math.PI).toFixed(1)}°<br>turn / area = <b>${(turn / area).toFixed(4)}</b>`;
  },
};
