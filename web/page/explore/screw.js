// @ts-check
// Screw motions: one-parameter subgroups of the motions of space turn about a line and slide along it.
import { add, cross, dot, exp, matrix, scale, unit } from "./rotations.js";
import { Scene } from "./scene.js";
import { book, moved } from "./solids.js";

/** @typedef {import("./rotations.js").Point} Point */

/** A point of the axis, its direction, and where the body starts. */
const [AXIS, WAY, PLACE] = /** @type {Point[]} */ ([[0, 0, 0], unit([0.12, 0.1, 1]), [0.92, 0, 0]]);
/** The end of the motion: full turns. */
const TURNS = 2;

/** The motion at an angle, with a slide of `pitch` a radian: `x -> R x + b`. @param {number} pitch @param {number} theta */
export function screw(pitch, theta) {
  const R = matrix(exp(scale(WAY, theta)));
  const place = (/** @type {Point} */ x) => add(add(AXIS, moved(R)(add(x, AXIS, -1))), WAY, pitch * theta);
  return { R, place };
}

/** The twist of the screw: angular velocity and the velocity of the origin. @param {number} pitch @returns {[Point, Point]} */
export const twist = (pitch) => [WAY, add(cross(AXIS, WAY), WAY, pitch)];

/** @type {import("./stage.js").Spec} */
export default {
  id: "screw",
  title: "Screw motions",
  text: 'Turn about a <span class="gold">line</span> and slide along it at the same time: a screw. Every constant motion in space is one, and so any two positions of a body are joined by a screw (Chasles).',
  more: 'The slide per radian is the pitch <i>h</i>. At <i>h</i> = 0 it is a pure rotation and its <span class="plus">paths</span> are circles; a large pitch comes close to a translation. In SE(3) a screw is the exponential of one twist, (ω, v) with h = ω · v / |ω|².',
  formula: '<math><mi>h</mi><mo>=</mo><mfrac><mrow><mi>ω</mi><mo>·</mo><mi>v</mi></mrow><mrow><mo stretchy="false">|</mo><mi>ω</mi><msup><mo stretchy="false">|</mo><mn>2</mn></msup></mrow></mfrac></math> <math><mi>exp</mi><mo stretchy="false">(</mo><mi>ω</mi><mo>,</mo><mi>v</mi><mo stretchy="false">)</mo></math>',
  tensors: "space=se3&connection=zero",
  control: { label: "pitch h", min: -0.16, max: 0.16, step: 0.01, value: 0.1, words: (v) => `h = ${v.toFixed(2).replace("-", "−")}` },
  camera: [28, 20],
  play: "Move",
  duration: 7,
  rest: 2.6,
  draw({ v, t }, camera) {
    const scene = new Scene(camera, 62), theta = (t / 7 - 0.5) * 2 * Math.PI * TURNS;
    scene.line(Array.from({ length: 25 }, (_, k) => add(AXIS, WAY, (k / 12 - 1) * 1.45)), "gold", { width: 1.4, cut: 2, dash: "5 3" });
    const helix = (/** @type {Point} */ x, /** @type {string} */ kind) => scene.line(Array.from({ length: 97 }, (_, k) =>
      screw(v, (k / 96 - 0.5) * 2 * Math.PI * TURNS).place(x)), kind, { width: 1.5, cut: 4, reach: 1.4 });
    const corner = (/** @type {number} */ a, /** @type {number} */ b) => add(PLACE, [0.36 * a, 0.25 * b, 0]);
    helix(corner(1, 1), "plus");
    helix(corner(-1, -1), "zero");
    const draw = (/** @type {number} */ theta, /** @type {number} */ opacity) => {
      const { place } = screw(v, theta), centre = place(PLACE), start = scene;
      const faces = book((x) => place(add(PLACE, x)), 0.38);
      if (opacity === 1) start.solid(faces, centre);
      else faces.forEach(({ points, kind }) => { if (kind !== "mark") start.line([...points, points[0]], "quiet", { width: 0.6, opacity }); });
    };
    for (const k of [0, 1, 2, 3, 4, 5, 6, 7, 8]) draw((k / 8 - 0.5) * 2 * Math.PI * TURNS, 0.35);
    draw(theta, 1);
    const { place } = screw(v, theta), now = place(corner(1, 1)), [omega, velocity] = twist(v);
    scene.arrow([0, 0, 0], scale(WAY, 0.75), "gold", { width: 2.6 });
    scene.label(scale(WAY, 0.75), "ω", "gold", [-7, 0]);
    scene.arrow(now, add(now, add(velocity, cross(omega, now)), 0.45), "plus", { width: 2.2 });
    return [{ svg: scene.text([-100, -100, 200, 200]), caption: "", about: `A book on a screw of pitch ${v.toFixed(2)} about a tilted axis, with the helices of two of its corners` }];
  },
  readout({ v }) {
    const [omega, velocity] = twist(v);
    return `h = ω · v / |ω|² = <b>${(dot(omega, velocity) / dot(omega, omega)).toFixed(2)}</b><br>${v === 0 ? "a pure rotation" : `one turn slides by <b>${(2 * Math.PI * v).toFixed(2)}</b>`}`.replaceAll("-", "−");
  },
};
