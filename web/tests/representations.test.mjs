// The card of representations in a browser: a weight, a product, a restriction, their diagram and their links.
import assert from "node:assert/strict";
import { test } from "node:test";
import { compute, text } from "./computed.mjs";
import { PHONE, sound, violations } from "./visit.mjs";

const CARD = ".card.representations";
const ready = (page, words) => page.waitForFunction(([card, words]) => document.querySelector(`${card} .report`)?.textContent.includes(words), [CARD, words]);

test("an octet and its square are on the page, and in the address", async () => {
  const page = await compute("space=SU(3)&card=representations&weight=8");
  await ready(page, "dimension");
  assert.equal(await text(page, `${CARD} h2`), "Representations of A2");
  // six weights on a hexagon and the double weight 0
  assert.equal(await page.locator(`${CARD} svg circle`).count(), 7);
  assert.match(await page.title(), /Representations of/);
  await page.fill(`${CARD} input >> nth=1`, "8");
  await page.keyboard.press("Enter");
  await ready(page, "10bar");
  assert.match(page.url(), /weight=8&factors=8/);
  await page.reload();
  await ready(page, "10bar");
  assert.equal(await page.inputValue(`${CARD} input >> nth=1`), "8");
  assert.deepEqual(await violations(page), []);
  await sound(page);
});

test("a restriction names its components; a fault stands under the fields", async () => {
  const page = await compute("space=G2&card=representations&weight=7&subalgebra=SU(3)");
  await ready(page, "3bar");
  await page.fill(`${CARD} input >> nth=2`, "E8");
  await page.keyboard.press("Enter");
  await page.waitForFunction((card) => document.querySelector(`${card} [role=alert]`)?.textContent, CARD);
  assert.match(await text(page, `${CARD} [role=alert]`), /E8/);
  await page.fill(`${CARD} input >> nth=2`, "principal");
  await page.keyboard.press("Enter");
  await ready(page, "weighted diagram 2,2");
  assert.equal(await text(page, `${CARD} [role=alert]`), "");
  await sound(page);
});

test("a sum of factors has one representation of all; a solvable algebra has no card", async () => {
  const page = await compute("space=so(4)&card=representations", { viewport: PHONE });
  await ready(page, "dimension");
  assert.equal(await text(page, `${CARD} h2`), "Representations of A1 + A1");
  assert.equal(await page.inputValue(`${CARD} input >> nth=0`), "[1,1]");
  await page.fill("#space-input", "heisenberg(3)");
  await page.keyboard.press("Enter");
  await page.locator(CARD).waitFor({ state: "hidden" });
  await sound(page);
});
