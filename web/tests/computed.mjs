// What tests of the view Compute share: a page whose cards are computed, requests to the engine, and the program to compare with.
import { execFileSync } from "node:child_process";
import { visit } from "./visit.mjs";

/** The program to compare with. */
export const COMMAND = process.env.AFFINOR_COMMAND;
export const needsCommand = { skip: !COMMAND && "AFFINOR_COMMAND names no program" };
/** The output of the program. */
export const affinor = (...words) => execFileSync(COMMAND, words, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });

/** A page at a state of Compute, once its cards stand. */
export async function compute(state, options = {}) {
  const page = await visit(`#compute?${state}`, options);
  await settled(page);
  return page;
}

/** Waits until the cards that are in view, or a message, stand for a moment. */
export async function settled(page, timeout = 60000) {
  await page.evaluate(() => { delete (/** @type {any} */ (window).idleSince); });
  await page.waitForFunction(() => {
    const state = /** @type {any} */ (window);
    const answered = document.querySelector(".card:not([hidden]) .body :is(math, .badge, .components)") || document.querySelector(".refusal")?.textContent;
    const first = [...document.querySelectorAll(".card:not([hidden])")].filter((card) => !card.matches(".structure, .properties, .equations, .motions, .representations"));
    const stale = !document.querySelector(".refusal")?.textContent && first.some((card) => card.matches(".stale") || !card.dataset.key);
    const idle = answered && !stale && document.querySelector("#box .waiting")?.hidden !== false;
    state.idleSince = idle ? state.idleSince ?? performance.now() : undefined;
    return idle && performance.now() - state.idleSince > 600;
  }, undefined, { timeout });
}

/** Writes into the box as a hand does, and waits for the cards. */
export async function type(page, text) {
  await page.fill("#space-input", text);
  await page.waitForTimeout(400);
  await settled(page);
}

export const text = async (page, selector) => (await page.locator(selector).first().textContent()) ?? "";
/** The alternative texts of the formulas of a card. */
export const formulas = (page, card) => page.locator(`.card.${card} .body math`).evaluateAll((all) => all.map((math) => math.getAttribute("alttext")));

/** Answers of an engine of its own to requests one after the other. */
export const ask = (page, requests) => page.evaluate(async (requests) => {
  const script = document.querySelector('script[type="module"]').src;
  const { Engine } = await import(new URL("engine-client.js", script).href);
  const engine = new Engine(), answers = [];
  for (const request of requests) answers.push(await engine.ask(request).then(({ answer, ms }) => ({ ...answer, ms }), (problem) => ({ problem })));
  return answers;
}, requests);
