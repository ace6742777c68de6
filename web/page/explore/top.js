// @ts-check
// The heavy top: gravity pulls it down, and it moves sideways.
import { matrix } from "./rotations.js";
import { Scene, circle } from "./scene.js";
import { moved, revolved } from "./solids.js";
import { Film, inSpace, weight } from "./mechanics.js";

/** @typedef {import("./rotations.js").Point} Point */

/** Moments of inertia about the pivot, and the moment of the weight. @type {Point} */
export const INERTIA = [1, 1, 0.5];
export const LOAD = 1.4;
const TILT = 0.75;
/** Radius and height of the outline. @type {[number, number][]} */
const PROFILE = [[0, 0], [0.2, 0.2], [0.5, 0.53], [0.57, 0.62], [0.52, 0.7], [0.06, 0.8], [0, 0.8]];
const TIP = 1.12;

/** The film of a top that is let go with this spin. @param {number} spin */
export function film(spin) {
  const g = /** @type {import("./rotations.js").Quaternion} */ ([Math.cos(TILT / 2), Math.sin(TILT / 2), 0, 0]);
  return new Film({ J: INERTIA, torque: weight(LOAD) }, { g, w: [0, 0, spin] }, ({ g }) => inSpace(g, [0, 0, TIP]), 14);
}

/** @type {import("./stage.js").Spec} */
export default {
  id: "top",
  title: "The heavy top",
  text: 'Let a spinning top go. Its weight should tip it over; instead its <span class="gold">axis</span> moves sideways and nods. The faster the spin, the smaller the nods and the slower the walk around the vertical.',
  more: 'The torque of the weight turns the angular momentum, and that lies almost along the axis. A fast top walks at the rate of the weight moment over the spin momentum, <span class="unbroken"><i>m g l</i> / (J₃ Ω₃)</span>, and its <span class="gold">trace</span> has cusps because it started at rest.',
  formula: '<math><mover accent="true"><mi>H</mi><mo>˙</mo></mover><mo>=</mo><mi>r</mi><mo>×</mo><mi>m</mi><mi>g</mi></math> <math><mi>walk</mi><mo>≈</mo><mfrac><mrow><mi>m</mi><mi>g</mi><mi>l</mi></mrow><mrow><msub><mi>J</mi><mn>3</mn></msub><msub><mi>Ω</mi><mn>3</mn></msub></mrow></mfrac></math>',
  tensors: "space=heavy%20top",
  control: { label: "spin", min: 2.5, max: 14, step: 0.1, value: 7, words: (v) => `Ω₃ = ${v.toFixed(1)}` },
  camera: [30, 16],
  play: "Play",
  duration: Infinity,
  rest: 8,
  draw(state, camera, prefix) {
    const run = /** @type {Film} */ (state.memo ??= film(state.v)), { g } = run.at(state.t), at = moved(matrix(g));
    const scene = new Scene(camera, 76, [0, 0, 0.22]), [x, y] = /** @type {Point[]} */ ([[1, 0, 0], [0, 1, 0]]);
    scene.area(circle(x, y, 1.12), "disc", 1, -9);
    scene.line(circle(x, y, 1.12), "grid", { width: 0.7 });
    scene.line(run.trail.map(([a, b]) => /** @type {Point} */ ([a, b, 0])), "shadow", { width: 2 });
    scene.arrow([0, 0, 0], [0, 0, 1.3], "quiet", { width: 1.1, opacity: 0.6 }, -1);
    scene.line(run.trail, "gold", { width: 1.6, cut: 6, reach: 1.4 });
    scene.solid(revolved(PROFILE, at, ["brass", "steel", "brass", "steel", "brass", "steel"]), at([0, 0, 0.5]));
    const tip = at([0, 0, TIP]), end = at([0, 0, 0.8]);
    scene.line([end, tip], "ink", { width: 3, cut: 1 });
    scene.dot(tip, "gold", 3);
    scene.dot([0, 0, 0], "ink", 2);
    return [{ svg: scene.text([-100, -100, 200, 200]), caption: "", about: `A top with spin ${state.v.toFixed(1)}, its axis ${(Math.acos(tip[2] / TIP) * 180 / Math.PI).toFixed(0)} degrees from the vertical, with the trace of its tip` }];
  },
  readout(state) {
    const run = /** @type {Film} */ (state.memo ?? film(state.v)), { g, w } = run.at(state.t), axis = inSpace(g, [0, 0, 1]);
    const first = run.trail[0], last = run.trail[run.trail.length - 1];
    let turned = 0;
    for (let k = 1; k < run.trail.length; k++) {
      const [a, b] = [run.trail[k - 1], run.trail[k]];
      turned += Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    }
    const time = (run.trail.length - 1) / 60, rate = time > 1 ? (turned / time).toFixed(2) : "…";
    return `axis <b>${(Math.acos(Math.min(1, axis[2])) * 180 / Math.PI).toFixed(1)}°</b> from the vertical, spin <b>${w[2].toFixed(2)}</b> (constant)<br>walk <b>${first === last ? "…" : rate}</b> rad/s; <span class="unbroken">m g l / (J₃ Ω₃)</span> = <b>${(LOAD / (INERTIA[2] * state.v)).toFixed(2)}</b>`;
  },
};
