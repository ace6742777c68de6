// @ts-check
// Three parallelisms: one vector, one path, three connections.
import { Path, angle, family } from "./rotations.js";
import { BOX, Ball, UNIT } from "./ball.js";

/** @typedef {import("./rotations.js").Point} Point */

/** Parts of the slider; it runs from plus on the left to minus on the right, as the balls stand. */
const PARTS = 24;
/** The vector at the start. @type {Point} */
export const VECTOR = [-0.1, 0.3, 1.3];
/** The second corner of the path. @type {Point} */
const Q = [-1.0, 0.75, 1.9];

/** A number of parts as a fraction in lowest terms. @param {number} parts */
export function fraction(parts) {
  const divisor = (/** @type {number} */ a, /** @type {number} */ b) => { while (b) [a, b] = [b, a % b]; return a; };
  const common = divisor(parts, PARTS) || 1;
  return PARTS === common ? String(parts / common) : parts ? `${parts / common}/${PARTS / common}` : "0";
}

const UNTURNED = "<span>returns unturned:</span>";

/** What becomes of a vector, in words. @param {number} lambda @param {number} turn degrees */
export function verdict(lambda, turn) {
  if (lambda === 1) return `${UNTURNED} <span><b>flat</b>, torsion <i title="c: the structure constants of the group">c</i></span>`;
  if (lambda === 0) return `${UNTURNED} <span><b>flat</b>, torsion −<i title="c: the structure constants of the group">c</i></span>`;
  const torsion = Math.round(PARTS * (2 * lambda - 1));
  const twist = torsion === 0 ? "<b>no torsion</b>" : `torsion ${torsion < 0 ? "−" : ""}${fraction(Math.abs(torsion))} <i title="c: the structure constants of the group">c</i>`;
  return `<span>turned by ${turn.toFixed(1)}°:</span> <span><b>curved</b>, ${twist}</span>`;
}

/** The path and the turn of the carried vector, in degrees. @param {Point} p @param {number} lambda */
export function turned(p, lambda) {
  const path = new Path([[0, 0, 0], p, Q, [0, 0, 0]]);
  return { path, turn: angle(VECTOR, path.carried(family(lambda), VECTOR, 1)) * 180 / Math.PI };
}

/** @param {number} v */
const chosen = (v) => 1 - v / PARTS;

/** @type {import("./stage.js").Spec} */
export default {
  id: "parallel",
  title: "Three parallelisms",
  text: 'Carry the <span class="gold">vector</span> along the path and keep it parallel to itself: by right translations it is the <span class="plus">plus</span> connection, by left translations <span class="minus">minus</span>, and half of each is <span class="zero">zero</span>.',
  more: "Two of the answers return the vector as it left, for every path: they are flat, and pay with torsion. The symmetric one has no torsion, and pays with curvature. No group prefers one of them: a connection is a choice.",
  formula: '<math><mi>T</mi><mo stretchy="false">(</mo><mi>x</mi><mo>,</mo><mi>y</mi><mo stretchy="false">)</mo><mo>=</mo><mo stretchy="false">(</mo><mn>2</mn><mi>λ</mi><mo>−</mo><mn>1</mn><mo stretchy="false">)</mo><mo stretchy="false">[</mo><mi>x</mi><mo>,</mo><mi>y</mi><mo stretchy="false">]</mo></math> <math><mi>R</mi><mo stretchy="false">(</mo><mi>x</mi><mo>,</mo><mi>y</mi><mo stretchy="false">)</mo><mi>z</mi><mo>=</mo><mi>λ</mi><mo stretchy="false">(</mo><mi>λ</mi><mo>−</mo><mn>1</mn><mo stretchy="false">)</mo><mo stretchy="false">[</mo><mo stretchy="false">[</mo><mi>x</mi><mo>,</mo><mi>y</mi><mo stretchy="false">]</mo><mo>,</mo><mi>z</mi><mo stretchy="false">]</mo></math>',
  tensors: "space=so3&connection=plus",
  control: { label: "λ of the middle ball", min: 0, max: PARTS, step: 1, value: PARTS / 2, words: (v) => `λ = ${fraction(PARTS - v)}`,
    ticks: [[0, "plus"], [PARTS / 2, "zero"], [PARTS, "minus"]] },
  camera: [38, 24],
  points: { p: [2.1, -0.8, -0.1] },
  hands: { unit: UNIT, box: BOX },
  play: "Carry",
  duration: 4,
  rest: 4,
  draw({ v, t, points: { p } }, camera, prefix) {
    const middle = chosen(v), share = t / 4;
    /** @type {[string, number][]} */
    const balls = [["plus", 1], [middle > 0.5 ? "blend" : middle < 0.5 ? "blend" : "zero", middle], ["minus", 0]];
    return balls.map(([name, lambda], k) => {
      const { path, turn } = turned(p, lambda), ball = new Ball(camera, `${prefix}${k}`);
      const kind = k === 1 ? "zero" : name;
      ball.path(path, share);
      ball.carried(path, family(lambda), VECTOR, kind, share);
      ball.dot([0, 0, 0], "ink");
      ball.dot(p, "ink", 3.4);
      ball.dot(Q, "ink", 2);
      ball.label([0, 0, 0], "e", "name", [-6, 10]);
      ball.label(p, "p", "name", [0, 17]);
      ball.label(Q, "q", "name", [0, -7]);
      const title = name === "blend" ? `λ = ${fraction(PARTS - v)}` : `${name}<span class="aside">, λ = ${lambda === 0.5 ? "1/2" : lambda}</span>`;
      return { svg: ball.drawn(), kind, caption: `<b class="${kind}">${title}</b> <span class="verdict">${verdict(lambda, turn)}</span>`,
        about: `Ball of rotation vectors: a vector at e, carried along the path from e over p and q back to e by lambda = ${fraction(Math.round(PARTS * lambda))}, ${verdict(lambda, turn).replace(/<[^>]*>/g, "")}` };
    });
  },
  readout: ({ v, points: { p } }) => `turned by <b>${turned(p, chosen(v)).turn.toFixed(1)}°</b> at λ = ${fraction(PARTS - v)}`,
};
