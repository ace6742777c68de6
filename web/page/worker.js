// @ts-check
// The engine, away from the page: readings and cards of tensors first, reports, structure and motions on demand. After a panic it is not called
// again: the page starts another worker.
// @ts-ignore the build writes the modules
import init, { call } from "../engine/tables.js";

/** Requests that the first module answers. */
const FIRST = ["reading", "names", "card"];

let panic = "";
const shown = console.error;
console.error = (...words) => { panic = words.join(" ").split("\n")[0]; shown(...words); };

/** Memories of the modules. @type {WebAssembly.Memory[]} */
const memories = [];
/** The largest memory of a module, in bytes, as it is built. */
const LIMIT = 2 ** 30;
/** The identifier of the request that runs. */
let running = 0;
/** The other modules, once they are asked for. @type {Record<string, Promise<(request: string) => string> | undefined>} */
const others = {};

const stage = (/** @type {string} */ name) => postMessage({ kind: "stage", id: running, name });
// the engine calls it
Object.assign(globalThis, { stage });

/** A module, with the bytes that have arrived on the way. @param {URL} address */
async function fetched(address) {
  const response = await fetch(address);
  if (!response.ok || !response.body) throw new Error(`${address.pathname}: ${response.status}`);
  let loaded = 0, told = 0;
  const counted = response.body.pipeThrough(new TransformStream({
    transform(part, stream) {
      loaded += part.length;
      if (loaded - told > 1e5) postMessage({ kind: "loading", megabytes: ((told = loaded) / 1e6).toFixed(1) });
      stream.enqueue(part);
    },
  }));
  return new Response(counted, { headers: { "content-type": "application/wasm" } });
}

const first = init({ module_or_path: fetched(new URL("../engine/tables_bg.wasm", import.meta.url)) }).then((/** @type {any} */ engine) => {
  memories.push(engine.memory);
  return call;
});
first.then(() => postMessage({ kind: "ready" }), (/** @type {unknown} */ error) => postMessage({ kind: "failed", message: String(error) }));

/** Another module: `engine` has all reports but those of `representations`. @param {"engine" | "representations"} name */
const other = (name) => others[name] ??= loaded(name);

/** Loads a module. @param {"engine" | "representations"} name */
async function loaded(name) {
  stage(name === "engine" ? "loading the second part of the engine" : "loading the part of the engine for representations");
  // @ts-ignore the build writes the modules
  const engine = await (name === "engine" ? import("../engine/engine.js") : import("../engine/representations.js"));
  const address = name === "engine" ? new URL("../engine/engine_bg.wasm", import.meta.url) : new URL("../engine/representations_bg.wasm", import.meta.url);
  memories.push((await engine.default({ module_or_path: fetched(address) })).memory);
  return engine.call;
}

onmessage = async ({ data: { id, request } }) => {
  const start = performance.now();
  running = id;
  /** @type {(request: string) => string} */
  let answering;
  const name = request.report === "rep" ? "representations" : "engine";
  try {
    answering = FIRST.includes(request.report) ? await first : await other(name);
  } catch (error) {
    others[name] = undefined;
    return postMessage({ kind: "unloaded", id, message: String(error) });
  }
  const answer = () => postMessage({ kind: "answer", id, answer: JSON.parse(answering(JSON.stringify(request))), ms: performance.now() - start });
  try {
    try {
      answer();
    } catch (error) {
      // the first module refuses spaces that only the second one has
      if (typeof error !== "string" || !JSON.parse(error).elsewhere) throw error;
      answering = await other("engine");
      answer();
    }
  } catch (error) {
    if (typeof error === "string") postMessage({ kind: "refused", id, refusal: JSON.parse(error) });
    else postMessage({ kind: "crashed", id, message: exhausted(error) ? "it needs more than 1 GiB of memory" : panic || String(error) });
  }
};

/** Whether a trap means that the memory is used up. A failed allocation traps without a panic, and one large block may fail
 * when half of the memory is still free. @param {unknown} error */
function exhausted(error) {
  const traps = error instanceof WebAssembly.RuntimeError && !panic;
  return memories.some((memory) => memory.buffer.byteLength > (traps ? LIMIT / 2 : LIMIT - LIMIT / 16));
}
