// A browser for the tests of the front: visits an address, and tells what went wrong there. CHROMIUM names the browser.
import { chromium } from "playwright-core";
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { after, before } from "node:test";
import { serve } from "./server.mjs";

const AXE = fs.readFileSync(path.join(import.meta.dirname, "../node_modules/axe-core/axe.min.js"), "utf8");
export let browser;
export let server;
/** Sizes of a phone and of a laptop. */
export const PHONE = { width: 360, height: 740 };
export const LAPTOP = { width: 1366, height: 768 };

before(async () => {
  server = await serve();
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
});
after(async () => {
  await browser?.close();
  server?.close();
});

/** A page at a state, with the view of the address mounted. Clocks stand still unless `moving`. */
export async function visit(hash = "", { moving = false, at = server.address, ...options } = {}) {
  const context = await browser.newContext({ viewport: LAPTOP, reducedMotion: moving ? "no-preference" : "reduce", serviceWorkers: "block", ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(30000);
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => { if (message.type() === "error") page.problems.push(message.text()); });
  page.on("request", (request) => { if (!request.url().startsWith(at) && !/^(data|blob):/.test(request.url())) page.problems.push(`foreign: ${request.url()}`); });
  await page.goto(at + hash);
  if (options.javaScriptEnabled !== false) await page.waitForFunction(() => document.body.dataset.view && (document.body.dataset.view !== "explore" || document.querySelector("#contents li")));
  return page;
}

/** Nothing went wrong, and nothing is wider than the window. */
export async function sound(page) {
  assert.deepEqual(page.problems, []);
  const [wide, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= window, `${wide} in ${window}`);
}

/** Waits for two frames: what a hand moves is drawn in the next. */
export const drawn = (page) => page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));

/** What axe-core objects to. */
export async function violations(page) {
  await page.evaluate(AXE);
  const { violations } = await page.evaluate(() => axe.run());
  return violations.map(({ id, nodes }) => [id, nodes[0].html.slice(0, 200)]);
}

/** Drags with the mouse from the middle of an element. */
export async function drag(page, element, right, down, steps = 5) {
  const { x, y, width, height } = await element.boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  for (let k = 1; k <= steps; k++) await page.mouse.move(x + width / 2 + right * k / steps, y + height / 2 + down * k / steps);
  await page.mouse.up();
  await drawn(page);
}

/** Swipes with a finger. */
export async function swipe(page, x, y, right, down) {
  const client = await page.context().newCDPSession(page);
  await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
  for (let k = 1; k <= 10; k++) await client.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [{ x: x + right * k / 10, y: y + down * k / 10 }] });
  // a finger that rests before it leaves does not throw the page
  for (let k = 0; k < 5; k++) {
    await page.waitForTimeout(40);
    await client.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [{ x: x + right + k % 2, y: y + down }] });
  }
  await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await page.waitForTimeout(100);
  await drawn(page);
}
