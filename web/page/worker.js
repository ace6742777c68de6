// @ts-check
// The engine, away from the page. After a panic it is not called again: the page starts another worker.
import init, { call } from "./engine.js";

let panic = "";
const shown = console.error;
console.error = (...words) => { panic = words.join(" ").split("\n")[0]; shown(...words); };

init().then(() => postMessage({ kind: "ready" }), (error) => postMessage({ kind: "failed", message: String(error) }));

onmessage = ({ data: { id, request } }) => {
  const start = performance.now();
  try {
    const answer = call(JSON.stringify(request));
    postMessage({ kind: "answer", id, answer: JSON.parse(answer), ms: performance.now() - start });
  } catch (error) {
    if (typeof error === "string") postMessage({ kind: "refused", id, refusal: JSON.parse(error) });
    else postMessage({ kind: "crashed", id, message: panic || String(error) });
  }
};
