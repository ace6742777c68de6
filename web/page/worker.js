// @ts-check
// The engine, away from the page. After a panic it is not called again: the page starts another worker.
import init, { call } from "./engine.js";

let panic = "";
const shown = console.error;
console.error = (...words) => { panic = words.join(" ").split("\n")[0]; shown(...words); };

/** @type {WebAssembly.Memory} */
let memory;
/** The largest memory, in bytes, as the engine is built. */
const LIMIT = 2 ** 30;
/** What runs. */
let running = 0;

// the engine calls it
Object.assign(globalThis, { stage: (/** @type {string} */ name) => postMessage({ kind: "stage", id: running, name }) });

init().then((engine) => {
  memory = engine.memory;
  postMessage({ kind: "ready" });
}, (error) => postMessage({ kind: "failed", message: String(error) }));

onmessage = ({ data: { id, request } }) => {
  const start = performance.now();
  running = id;
  try {
    const answer = call(JSON.stringify(request));
    postMessage({ kind: "answer", id, answer: JSON.parse(answer), ms: performance.now() - start });
  } catch (error) {
    if (typeof error === "string") postMessage({ kind: "refused", id, refusal: JSON.parse(error) });
    else postMessage({ kind: "crashed", id, message: full() ? "it needs more than 1 GiB of memory" : panic || String(error) });
  }
};

/** Whether the memory is used up, but for a sixteenth: the request that fails may be large. */
function full() {
  return memory.buffer.byteLength > LIMIT - LIMIT / 16;
}
