// @ts-check
// Torsion: two vectors, each carried along the other; the parallelogram closes only without torsion.
import { add, carry, compose, dot, exp, family, inverse, log, norm, scale } from "./rotations.js";
import { Ball } from "./ball.js";
import { fraction } from "./parallel.js";

/** @typedef {import("./rotations.js").Point} Point */

/** The two sides; their bracket is the third axis. @type {Point[]} */
const [X, Y] = [[1, 0, 0], [0, 1, 0]];
const SIDE = 1.1;
const PARTS = 24;

/** The corners of the parallelogram of sides `s`: x and then y, y and then x, and the gap between the ends. @param {number} lambda @param {number} s */
export function parallelogram(lambda, s) {
  const by = family(lambda), [x, y] = [scale(X, s), scale(Y, s)];
  const [along, across] = [carry(by, x, y), carry(by, y, x)];
  const first = compose(exp(x), exp(along)), second = compose(exp(y), exp(across));
  return { x, y, along, across, first, second, gap: log(compose(inverse(first), second)) };
}

/** @type {import("./stage.js").Spec} */
export default {
  id: "torsion",
  title: "Torsion: the parallelogram that does not close",
  text: 'Walk along <span class="plus">x</span> and then along <span class="gold">y</span>, carried with you; or first <span class="gold">y</span> and then <span class="plus">x</span>. The two walks end apart: the <span class="violet">gap</span> is the torsion.',
  more: "For small sides <i>s</i> the gap is <i>s</i>² (2λ − 1) [x, y], and [x, y] points along the third axis. At λ = 1/2 the parallelogram closes to second order; at the ends it opens, in opposite directions.",
  formula: '<math><mi>T</mi><mo stretchy="false">(</mo><mi>x</mi><mo>,</mo><mi>y</mi><mo stretchy="false">)</mo><mo>=</mo><mo stretchy="false">(</mo><mn>2</mn><mi>λ</mi><mo>−</mo><mn>1</mn><mo stretchy="false">)</mo><mo stretchy="false">[</mo><mi>x</mi><mo>,</mo><mi>y</mi><mo stretchy="false">]</mo></math>',
  tensors: "space=so3&connection=plus&show=torsion",
  control: { label: "λ", min: 0, max: PARTS, step: 1, value: 2, words: (v) => `λ = ${fraction(PARTS - v)}`, ticks: [[0, "plus"], [PARTS / 2, "zero"], [PARTS, "minus"]] },
  camera: [32, 30],
  play: "Walk",
  duration: 4,
  rest: 4,
  draw({ v, t }, camera, prefix) {
    const { x, y, along, across, first, second } = parallelogram(1 - v / PARTS, SIDE), ball = new Ball(camera, `${prefix}0`, { unit: 58, radius: 1.6, centre: [0.35, 0.35, 0.1] }), share = t / 4;
    const side = (/** @type {import("./rotations.js").Quaternion} */ from, /** @type {Point} */ way, /** @type {number} */ part) =>
      Array.from({ length: 25 }, (_, k) => log(compose(from, exp(scale(way, part * k / 24)))));
    const [one, two] = [Math.min(1, 2 * share), Math.max(0, 2 * share - 1)], origin = exp([0, 0, 0]);
    for (const line of [side(origin, x, 1), side(exp(x), along, 1), side(origin, y, 1), side(exp(y), across, 1)]) {
      ball.line(line.map(([a, b]) => /** @type {Point} */ ([a, b, 0])), "shadow", { width: 2 });
      ball.line(line, "ink", { width: 1, opacity: 0.3 });
    }
    ball.line(side(origin, x, one), "plus", { width: 2.6, reach: 2 });
    ball.line(side(origin, y, one), "gold", { width: 2.6, reach: 2 });
    if (two > 0) {
      ball.line(side(exp(x), along, two), "gold", { width: 2.6, reach: 2 });
      ball.line(side(exp(y), across, two), "plus", { width: 2.6, reach: 2 });
    }
    // the vectors that are carried
    for (const k of [1, 2, 3]) {
      if (one * 3 < k - 1e-9) continue;
      ball.vector(scale(x, k / 3), scale(carry(family(1 - v / PARTS), scale(x, k / 3), y), 0.6), "gold", { width: 1.6, opacity: 0.45 });
      ball.vector(scale(y, k / 3), scale(carry(family(1 - v / PARTS), scale(y, k / 3), x), 0.6), "plus", { width: 1.6, opacity: 0.45 });
    }
    const [a, b] = [log(first), log(second)];
    if (share === 1) {
      if (norm(add(a, b, -1)) > 0.15) ball.arrow(a, b, "violet", { width: 2.6 });
      ball.dot(a, "ink", 2.4);
      ball.dot(b, "ink", 2.4);
      ball.label(b, "gap", "violet", [7, -4]);
    }
    ball.dot([0, 0, 0], "ink");
    ball.label([0, 0, 0], "e", "name", [-6, 10]);
    ball.label(x, "x", "plus", [-5, 12]);
    ball.label(y, "y", "gold", [6, 12]);
    return [{ svg: ball.drawn(), caption: "", about: `A parallelogram of rotation vectors for lambda = ${fraction(PARTS - v)}; its ends are ${norm(add(a, b, -1)).toFixed(2)} apart` }];
  },
  readout({ v }) {
    const lambda = 1 - v / PARTS, small = 0.01, { gap } = parallelogram(lambda, small);
    return `gap / s² along [x, y] for s = 0.01: <b>${(dot(gap, [0, 0, 1]) / small ** 2).toFixed(3)}</b><br>2λ − 1 = <b>${(2 * lambda - 1).toFixed(3)}</b>`.replaceAll("-", "−");
  },
};
