// A browser for the tests. CHROMIUM names it; `npm ci` installs none.
import { chromium } from "playwright-core";
import fs from "node:fs";
import path from "node:path";
import { execFileSync } from "node:child_process";
import { after, before } from "node:test";
import { serve } from "./server.mjs";

const AXE = fs.readFileSync(path.join(import.meta.dirname, "../node_modules/axe-core/axe.min.js"), "utf8");
/** The program to compare with. */
export const COMMAND = process.env.AFFINOR_COMMAND;
export const needsCommand = { skip: !COMMAND && "AFFINOR_COMMAND names no program" };
let browser;
export let server;

before(async () => {
  server = await serve();
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** A page at a state, once its report stands. */
export async function open(hash = "", options = {}) {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  page.foreign = [];
  page.on("request", (request) => { if (!request.url().startsWith(server.address) && !/^(data|blob):/.test(request.url())) page.foreign.push(request.url()); });
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.setDefaultTimeout(60000);
  await page.goto(server.address + hash);
  await settled(page);
  return page;
}

/** Waits until nothing has been computed for a moment: what a key or a click begins may begin a little later. */
export async function settled(page) {
  await page.evaluate(() => { delete (/** @type {any} */ (window).idleSince); });
  await page.waitForFunction(() => {
    const state = /** @type {any} */ (window);
    const stop = /** @type {any} */ (document.getElementById("stop"));
    const idle = stop.disabled && !document.getElementById("status").textContent.includes("computing");
    state.idleSince = idle ? state.idleSince ?? performance.now() : undefined;
    return idle && performance.now() - state.idleSince > 150;
  });
}
export const text = (page, id) => page.locator(`#${id}`).innerText();

/** What axe-core objects to. */
export async function violations(page) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => axe.run());
  return violations.map(({ id, nodes }) => [id, nodes[0].html]);
}

/** The output of the program. */
export const affinor = (...words) => execFileSync(COMMAND, words, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });

/** Answers of the engine in the browser, to requests one after the other. */
export const ask = (page, requests) => page.evaluate(async (requests) => {
  const { Engine } = await import("./engine-client.js");
  const engine = new Engine(), answers = [];
  for (const request of requests) answers.push(await engine.ask(request).then(({ answer, ms }) => ({ ...answer, ms }), (problem) => ({ problem })));
  return answers;
}, requests);
