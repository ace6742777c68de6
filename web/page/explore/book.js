// @ts-check
// The tumbling book: in space the angular momentum stands still; in the body the angular velocity runs on the ellipsoid of energy.
import { dot, matrix, norm, scale, unit } from "./rotations.js";
import { Scene } from "./scene.js";
import { MOMENTS, book, ellipsoid, moved } from "./solids.js";
import { Film, between, inSpace } from "./mechanics.js";

/** @typedef {import("./rotations.js").Point} Point */

/** Starts near the long, the middle and the short axis. @type {Point[]} */
const STARTS = [[3, 0.12, 0.1], [0.04, 2.6, 0.04], [0.1, 0.12, 2.2]];
const AXES = ["long", "middle", "short"];

const momentum = (/** @type {Point} */ w) => /** @type {Point} */ (w.map((x, i) => x * MOMENTS[i]));
const energy = (/** @type {Point} */ w) => dot(w, momentum(w)) / 2;

/** The film of a start. @param {number} v */
export function film(v) {
  const w = STARTS[v], g = between(unit(momentum(w)), [0, 0, 1]);
  return new Film({ J: MOMENTS }, { g, w }, ({ w }) => w, 12);
}

/** Curves of constant `sum J_i x_i^2 = c` on the unit sphere: closed ones about the first or the third axis, and the circles between. @param {number} c */
export function level(c) {
  const [a, b, d] = MOMENTS, round = Array.from({ length: 49 }, (_, k) => 2 * Math.PI * k / 48);
  return [1, -1].map((side) => round.map((t) => {
    if (Math.abs(c - b) < 1e-9) {
      const tilt = Math.atan2(Math.sqrt(b - a), Math.sqrt(d - b));
      return /** @type {Point} */ ([Math.cos(t) * Math.cos(tilt), Math.sin(t), side * Math.cos(t) * Math.sin(tilt)]);
    }
    if (c < b) {
      const [y, z] = [Math.sqrt((c - a) / (b - a)) * Math.cos(t), Math.sqrt((c - a) / (d - a)) * Math.sin(t)];
      return /** @type {Point} */ ([side * Math.sqrt(Math.max(0, 1 - y * y - z * z)), y, z]);
    }
    const [x, y] = [Math.sqrt((d - c) / (d - a)) * Math.cos(t), Math.sqrt((d - c) / (d - b)) * Math.sin(t)];
    return /** @type {Point} */ ([x, y, side * Math.sqrt(Math.max(0, 1 - x * x - y * y))]);
  }));
}

/** @type {import("./stage.js").Spec} */
export default {
  id: "book",
  title: "The tumbling book",
  text: 'Throw a book spinning about its middle axis, and it flips. Seen from space the angular momentum <span class="violet">H</span> stands still while the angular velocity <span class="gold">ω</span> wanders. Seen from the book, <span class="gold">ω</span> runs along a curve on the ellipsoid of constant energy.',
  more: 'The curves are <em>polhodes</em>, where |H| is constant too. About the long and the short axis they are small loops: the spin stays near its axis. At the middle axis two of them cross: <span class="gold">ω</span> leaves, goes round to the other side, and comes back.',
  formula: '<math><mi>J</mi><mover accent="true"><mi>ω</mi><mo>˙</mo></mover><mo>=</mo><mi>J</mi><mi>ω</mi><mo>×</mo><mi>ω</mi></math>',
  tensors: "space=tumbling%20book",
  control: { label: "spin about the", value: 1, choices: ["long axis", "middle axis", "short axis"] },
  camera: [32, 20],
  play: "Play",
  duration: Infinity,
  rest: 2.9,
  draw(state, camera, prefix) {
    const run = /** @type {Film} */ (state.memo ??= film(state.v)), { g, w } = run.at(state.t);
    const H = inSpace(g, momentum(w)), omega = inSpace(g, w), at = moved(matrix(g));
    const space = new Scene(camera, 62);
    space.solid(book(at), [0, 0, 0], 0);
    const up = unit(H);
    space.arrow([0, 0, 0], scale(up, 1.45), "violet", { width: 2.6 }, dot(up, space.eye) > 0 ? 1 : -1);
    space.arrow([0, 0, 0], scale(omega, 1.35 / norm(STARTS[state.v])), "gold", { width: 2.6 }, dot(omega, space.eye) > 0 ? 1.1 : -0.9);
    space.label(scale(up, 1.45), "H", "violet", [-7, 0]);
    space.label(scale(omega, 1.35 / norm(STARTS[state.v])), "ω", "gold", [7, 3]);
    const T = energy(w), semi = /** @type {Point} */ (MOMENTS.map((J) => Math.sqrt(2 * T / J))), body = new Scene(camera, 84 / semi[0]);
    const seen = (/** @type {Point} */ x) => dot(momentum(x), body.eye) > 0;
    const [a, b, d] = MOMENTS;
    for (const share of [0.08, 0.3, 0.6]) {
      for (const c of [a + share * (b - a), d - share * (d - b)]) {
        for (const line of level(c)) body.line(line.map((x) => /** @type {Point} */ (x.map((part, i) => part * semi[i]))), "quiet", { width: 0.7, seen });
      }
    }
    for (const line of level(b)) body.line(line.map((x) => /** @type {Point} */ (x.map((part, i) => part * semi[i]))), "quiet", { width: 1, dash: "3 2", seen });
    body.line(run.trail, "gold", { width: 2, seen });
    ["1", "2", "3"].forEach((name, i) => {
      const end = /** @type {Point} */ ([0, 0, 0]);
      end[i] = semi[i];
      if (!seen(end)) end[i] = -end[i];
      body.label(end, `${AXES[i]} axis`, "axis", [0, -3]);
    });
    body.arrow([0, 0, 0], w, "gold", { width: 2.4, opacity: seen(w) ? 1 : 0.5 }, 9);
    const { below, above } = ellipsoid(body, semi, `${prefix}1`);
    const tilt = Math.round(Math.acos(Math.max(-1, Math.min(1, w[state.v] / norm(w)))) * 180 / Math.PI);
    return [
      { svg: space.text([-100, -100, 200, 200]), caption: "in space", about: `A book spinning about its ${AXES[state.v]} axis, ${tilt} degrees from where it began; the angular momentum points up` },
      { svg: body.text([-100, -100, 200, 200], below, above), caption: "in the book", about: "The ellipsoid of energy with polhodes, and the angular velocity on one of them" },
    ];
  },
  readout(state) {
    const run = /** @type {Film} */ (state.memo ?? film(state.v)), { w } = run.at(state.t);
    const away = Math.acos(Math.max(-1, Math.min(1, w[state.v] / norm(w)))) * 180 / Math.PI;
    return `<span class="gold">ω</span> is <b>${away.toFixed(0)}°</b> from the ${AXES[state.v]} axis<br>energy <b>${energy(w).toFixed(4)}</b>, |H| <b>${norm(momentum(w)).toFixed(4)}</b>, both constant`;
  },
};
