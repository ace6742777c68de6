// @ts-check
// A chart of lines over time: linear, or logarithmic with a floor.
import { make } from "../picture.js";

const [WIDTH, HEIGHT, LEFT, BELOW, TOP] = [480, 240, 62, 34, 12];
/** Smaller changes are drawn here. */
const FLOOR = 1e-17;

/**
 * @param {string} about @param {number[]} times @param {{name: string, values: number[]}[]} lines @param {boolean} logarithmic
 * @returns {SVGElement}
 */
export function chart(about, times, lines, logarithmic) {
  const scaled = (/** @type {number} */ y) => logarithmic ? Math.log10(Math.max(y, FLOOR)) : y;
  const all = lines.flatMap(({ values }) => values.map(scaled)).filter(Number.isFinite);
  let [low, high] = [Math.min(...all), Math.max(...all)];
  if (!(high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high)))) [low, high] = [low - 1, high + 1];
  const first = times[0], span = times[times.length - 1] - first || 1;
  const x = (/** @type {number} */ t) => LEFT + (t - first) / span * (WIDTH - LEFT - 8);
  const y = (/** @type {number} */ v) => HEIGHT - BELOW - (scaled(v) - low) / (high - low) * (HEIGHT - BELOW - TOP);
  const label = (/** @type {number} */ at) => logarithmic ? `1e${Math.round(at)}` : String(Number(at.toPrecision(3)));
  const ticks = [0, 0.5, 1].flatMap((share) => {
    const at = low + share * (high - low), line = HEIGHT - BELOW - share * (HEIGHT - BELOW - TOP);
    const time = first + share * span;
    return [
      make("line", { x1: LEFT, x2: WIDTH - 8, y1: line, y2: line, class: "grid" }),
      make("text", { x: LEFT - 6, y: line + 4, "text-anchor": "end" }, label(at)),
      make("text", { x: x(time), y: HEIGHT - 14, "text-anchor": share === 1 ? "end" : "middle" }, String(Number(time.toPrecision(3)))),
    ];
  });
  const drawn = lines.map(({ values }, k) => make("polyline", {
    class: `line line-${k % 5}`,
    points: values.map((value, i) => `${x(times[i]).toFixed(1)},${y(value).toFixed(1)}`).join(" "),
  }));
  const now = make("line", { x1: LEFT, x2: LEFT, y1: TOP, y2: HEIGHT - BELOW, class: "now" });
  const picture = /** @type {SVGElement} */ (make("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": about, class: "chart" }, ...ticks, ...drawn, now));
  picture.addEventListener("time", (event) => {
    const at = x(/** @type {CustomEvent} */ (event).detail).toFixed(1);
    now.setAttribute("x1", at);
    now.setAttribute("x2", at);
  });
  return picture;
}
