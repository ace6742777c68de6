// @ts-check
// The engine as a module, in Node and in browsers.
import init, { call } from "./engine.js";

/** An input that was refused, with its place in the text and help. */
export class AffinorError extends Error {
  /** @param {{message: string, place: any, help: string | null}} refusal */
  constructor({ message, place, help }) {
    super(message);
    this.name = "AffinorError";
    this.place = place;
    this.help = help;
  }
}

/** @type {Promise<unknown> | undefined} */
let ready;

async function load() {
  // the engine names the stages of a computation
  Object.assign(globalThis, { stage: () => {} });
  const module = new URL("engine_bg.wasm", import.meta.url);
  if (module.protocol !== "file:") return init({ module_or_path: module });
  const { readFile } = await import("node:fs/promises");
  return init({ module_or_path: await readFile(module) });
}

/**
 * Computes a report.
 * @param {import("./index.d.ts").Request} request
 * @returns {Promise<import("./index.d.ts").Answer>}
 */
export async function report(request) {
  for (const [key, value] of Object.entries(request)) {
    if (typeof value === "string") continue;
    const kind = Array.isArray(value) ? "a list: join its items with commas" : typeof value;
    throw new TypeError(`\`${key}\` must be a text, and is ${kind}`);
  }
  await (ready ??= load());
  try {
    return JSON.parse(call(JSON.stringify(request)));
  } catch (error) {
    if (typeof error === "string") throw new AffinorError(JSON.parse(error));
    throw error;
  }
}
