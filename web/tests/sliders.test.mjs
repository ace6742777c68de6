// Sliders of letters: a drag by mouse or finger, arrow keys and typed values move them through every answer, and the focus stays.
import assert from "node:assert/strict";
import { test } from "node:test";
import { compute, settled } from "./computed.mjs";
import { PHONE, sound, swipe } from "./visit.mjs";

const CONTROLS = ".controls-of-space", MOTIONS = ".card.motions";
/** A state for each place of sliders: a metric, brackets, a chart, and two motions. */
const PLACES = [
  ["a metric", "space=so(3)&metric=diag(a,b,c)", CONTROLS],
  ["brackets", "space=[x,y]=a*z; [y,z]=b*x", CONTROLS],
  ["a chart", "space=Schwarzschild", CONTROLS],
  ["a free body", "space=so(3)&motion=free body&card=motions", MOTIONS],
  ["a body in a fluid", "space=se(3)&motion=body in a fluid&card=motions", MOTIONS],
];
const ranges = (page, box) => page.locator(`${box} .letter input[type=range]`);
const value = (range) => range.inputValue().then(Number);
/** The slider of the element that has the focus. */
const focused = (page) => page.evaluate(() => document.activeElement?.getAttribute("aria-label") ?? document.activeElement?.tagName);

/** Opens a state, with its sliders in view. */
async function opened(state, box, options) {
  const page = await compute(state.replaceAll("+", "%2B").replaceAll(" ", "%20"), options);
  await page.locator(box).scrollIntoViewIfNeeded();
  await ranges(page, box).first().waitFor();
  await page.waitForTimeout(300);
  return page;
}

/** Pauses until an answer of the engine has been shown. */
const answered = (page) => page.waitForTimeout(250);

/** The place of the thumb of a slider, and a place far from it. */
async function spots(range) {
  await range.evaluate((range) => range.scrollIntoView({ block: "center" }));
  const { x, y, width, height } = await range.boundingBox();
  const [low, high] = await range.evaluate(({ min, max }) => [Number(min), Number(max)]);
  // the middle of a thumb stays within the slider by half of its width
  const at = (part) => x + 8 + part * (width - 16);
  const now = (await value(range) - low) / (high - low), share = now < 0.5 ? 0.9 : 0.1;
  return { y: y + height / 2, from: at(now), to: at(share), end: low + share * (high - low), span: high - low };
}

for (const [name, state, box] of PLACES) {
  test(`every slider of ${name} follows the mouse to the end of a drag, through answers of the engine`, async () => {
    const page = await opened(state, box);
    for (const range of await ranges(page, box).all()) {
      const { y, from, to, end, span } = await spots(range);
      await page.mouse.move(from, y);
      await page.mouse.down();
      let last = await value(range);
      for (let k = 1; k <= 4; k++) {
        await page.mouse.move(from + (to - from) * k / 4, y);
        await answered(page);
        const now = await value(range);
        assert.notEqual(now, last, `move ${k} of ${await range.getAttribute("aria-label")}`);
        last = now;
      }
      await page.mouse.up();
      assert.ok(Math.abs(last - end) < 0.06 * span, `${last} instead of ${end}`);
    }
    await settled(page);
    await sound(page);
  });

  test(`every slider of ${name} follows arrow keys and typed values, and keeps the focus`, async () => {
    const page = await opened(state, box), all = await ranges(page, box).all();
    for (const range of all) {
      await range.focus();
      const label = await focused(page), seen = [await value(range)], key = seen[0] > 2 ? "ArrowLeft" : "ArrowRight";
      for (let k = 0; k < 4; k++) {
        await page.keyboard.press(key);
        await answered(page);
        seen.push(await value(range));
        assert.equal(await focused(page), label);
      }
      for (let k = 1; k < seen.length; k++) assert.ok(key === "ArrowRight" ? seen[k] > seen[k - 1] : seen[k] < seen[k - 1], seen.join(", "));
    }
    const number = page.locator(`${box} .letter input[type=text]`).first();
    await number.fill("1.7");
    await number.press("Enter");
    await answered(page);
    assert.equal(await value(all[0]), 1.7);
    assert.match(await focused(page), /^value of /);
    await sound(page);
  });

  test(`a slider of ${name} follows a finger`, async () => {
    const page = await opened(state, box, { viewport: PHONE, hasTouch: true, isMobile: true });
    const range = ranges(page, box).first(), { y, from, to, end, span } = await spots(range);
    await swipe(page, from, y, to - from, 0);
    await answered(page);
    const now = await value(range);
    assert.ok(Math.abs(now - end) < 0.08 * span, `${now} instead of ${end}`);
  });
}

test("the focus goes from the button that makes a letter of a value to its slider", async () => {
  const page = await compute("space=so(3)&metric=diag(a,b,c)&set=a=2");
  await page.locator(`${CONTROLS} button.free:visible`).focus();
  await page.keyboard.press("Enter");
  await answered(page);
  assert.equal(await focused(page), "a");
});

test("a letter that a metric and a motion share has one value", async () => {
  const page = await opened("space=tumbling book", MOTIONS), both = (name) => Promise.all([CONTROLS, MOTIONS].map((box) => value(page.locator(`${box} .letter input[aria-label="${name}"]`))));
  assert.deepEqual(await both("J2"), [1, 1]);
  await page.locator(`${MOTIONS} .letter input[aria-label="value of J2"]`).fill("3.8");
  await page.keyboard.press("Enter");
  await settled(page);
  assert.deepEqual(await both("J2"), [3.8, 3.8]);
  assert.match(page.url(), /J2=3\.8/);
  // a fraction is a number of a motion too
  await page.locator(`${CONTROLS} .letter input[aria-label="value of J1"]`).fill("3/2");
  await page.keyboard.press("Enter");
  await settled(page);
  assert.deepEqual(await both("J1"), [1.5, 1.5]);
  assert.equal(await page.locator(`${MOTIONS} > .help`).textContent(), "");
  // a number of the motion alone leaves the metric as it is
  await page.locator(`${MOTIONS} .letter input[aria-label=w1]`).focus();
  await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.doesNotMatch(page.url(), /w1/);
  assert.deepEqual(await both("J1"), [1.5, 1.5]);
  await sound(page);
});

test("the buttons of problems keep the focus", async () => {
  const page = await opened("space=so(3)&motion=free body&card=motions", MOTIONS);
  await page.locator(`${MOTIONS} .pick button`).nth(1).focus();
  await page.keyboard.press("Enter");
  await answered(page);
  assert.equal(await page.evaluate(() => document.activeElement?.textContent), "heavy top");
  assert.equal(await page.locator(`${MOTIONS} .pick [aria-pressed=true]`).textContent(), "heavy top");
});
