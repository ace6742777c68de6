// The first screen: drawn before any script, whole at a phone and a laptop, and alive under hands and keys.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { drawn as written } from "../first.mjs";
import { affinor, needsCommand } from "./computed.mjs";
import { LAPTOP, PHONE, drag, drawn, sound, swipe, violations, visit } from "./visit.mjs";
import { dist } from "./server.mjs";

const verdicts = (page) => page.locator("#hero .verdict").allInnerTexts();
const turn = async (page) => Number(/turned by ([\d.]+)/.exec((await verdicts(page))[1])?.[1]);

test("the index has the first screen as the scripts draw it: node web/first.mjs writes it", () => {
  assert.equal(fs.readFileSync(path.join(import.meta.dirname, "../page/index.html"), "utf8"), written());
});

test("the first screen is sent in at most 30 KB", () => {
  const index = fs.readFileSync(path.join(dist, "index.html"), "utf8");
  const styles = [...index.matchAll(/<link rel="stylesheet" href="([^"]*)"/g)].map(([, name]) => name);
  assert.ok(styles.length > 3);
  const size = (name) => fs.statSync(fs.existsSync(path.join(dist, `${name}.br`)) ? path.join(dist, `${name}.br`) : path.join(dist, name)).size;
  const sum = ["index.html", ...styles].reduce((sum, name) => sum + size(name), 0);
  console.log(`the first screen is sent in ${sum} bytes`);
  assert.ok(sum <= 30_000, String(sum));
});

for (const [name, viewport] of Object.entries({ phone: PHONE, laptop: LAPTOP })) {
  for (const javaScriptEnabled of [false, true]) {
    test(`the first screen is whole on a ${name}, ${javaScriptEnabled ? "with" : "before any"} script`, async () => {
      const page = await visit("", { viewport, javaScriptEnabled });
      await page.waitForTimeout(300);
      for (const part of ["#question", "#hero .view >> nth=0", "#hero .view >> nth=2", "#hero .verdict >> nth=2", "#hero .play", "#box :is(input, textarea)", "#box .chips a >> nth=-1"]) {
        const box = await page.locator(part).boundingBox();
        assert.ok(box && box.x >= 0 && box.y >= 0 && box.x + box.width <= viewport.width && box.y + box.height <= viewport.height, `${part} ${JSON.stringify(box)}`);
      }
      if (javaScriptEnabled) await sound(page);
      await page.context().close();
    });
  }
}

test("plus and minus return the vector unturned, zero does not, wherever p is dragged", async () => {
  const page = await visit();
  const before = await turn(page);
  assert.ok(before > 20);
  await drag(page, page.locator("#hero .handle").first(), 60, -90);
  const [plus, , minus] = await verdicts(page);
  assert.match(plus, /returns unturned: flat, torsion\sc/);
  assert.match(minus, /returns unturned: flat, torsion\s−c/);
  assert.ok(Math.abs(await turn(page) - before) > 1);
  await page.waitForTimeout(200);
  // the address holds the state
  assert.match(page.url(), /#explore\?v=12&p=/);
  const again = await visit(new URL(page.url()).hash);
  assert.deepEqual(await verdicts(again), await verdicts(page));
  await sound(page);
});

test("p moves by arrow keys and says where it is; the view turns by its button", async () => {
  const page = await visit(), handle = page.locator("#hero .handle").first();
  await handle.focus();
  const [value, picture] = [await handle.getAttribute("aria-valuetext"), await page.locator("#hero .view").first().innerHTML()];
  await page.keyboard.press("ArrowUp");
  await drawn(page);
  assert.notEqual(await handle.getAttribute("aria-valuetext"), value);
  assert.notEqual(await page.locator("#hero .view").first().innerHTML(), picture);
  const p = await handle.getAttribute("aria-valuetext"), turned = await page.locator("#hero .view").first().innerHTML();
  await page.locator("#hero .turn").focus();
  await page.keyboard.press("ArrowLeft");
  await drawn(page);
  assert.equal(await handle.getAttribute("aria-valuetext"), p);
  assert.notEqual(await page.locator("#hero .view").first().innerHTML(), turned);
});

test("the slider blends plus, zero and minus in the middle ball, in words too", async () => {
  const page = await visit(), slider = page.locator("#hero input[type=range]");
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await drawn(page);
  assert.equal(await slider.getAttribute("aria-valuetext"), "λ = 11/24");
  assert.match((await verdicts(page))[1], /curved, torsion\s−1\/12\sc/);
  assert.match(await page.title(), /λ = 11\/24/);
  await page.keyboard.press("Home");
  await drawn(page);
  const [plus, middle] = await verdicts(page);
  assert.equal(middle, plus);
  await page.keyboard.press("End");
  await drawn(page);
  assert.equal((await verdicts(page))[1], (await verdicts(page))[2]);
});

test("a link to the first screen holds lambda and p", async () => {
  const page = await visit(), slider = page.locator("#hero input[type=range]"), handle = page.locator("#hero .handle").first();
  await slider.focus();
  for (let k = 0; k < 6; k++) await page.keyboard.press("ArrowRight");
  await handle.focus();
  await page.keyboard.press("ArrowUp");
  await page.waitForTimeout(300);
  const again = await visit(new URL(page.url()).hash);
  assert.equal(await again.locator("#hero input[type=range]").inputValue(), "18");
  assert.equal(await again.locator("#hero output").textContent(), "λ = 1/4");
  assert.equal(await again.locator("#hero .handle").first().getAttribute("aria-valuetext"), await handle.getAttribute("aria-valuetext"));
  assert.equal(await again.locator("#say").textContent(), "");
  const other = await visit("#explore/nowhere");
  assert.match(await other.locator("#say").textContent(), /no page "nowhere"/);
});

test("the slider says what it moves, from plus to minus, at every width", async () => {
  for (const viewport of [PHONE, LAPTOP]) {
    const page = await visit("", { viewport });
    assert.match(await page.locator("#hero .range label").innerText(), /middle ball/);
    const [slider, ends] = [await page.locator("#hero .range input").boundingBox(), await page.locator("#hero datalist option").evaluateAll((all) => all.map((option) => { const { x, width, height } = option.getBoundingClientRect(); return { x, width, height, name: option.label }; }))];
    assert.deepEqual(ends.map(({ name }) => name), ["plus", "zero", "minus"]);
    for (const { x, width, height } of ends) assert.ok(height > 0 && x >= slider.x - 1 && x + width <= slider.x + slider.width + 1, JSON.stringify({ x, width, height, slider }));
    // no side of the slider is filled
    assert.equal(await page.locator("#hero .range input").evaluate((range) => getComputedStyle(range).appearance), "none");
    await page.context().close();
  }
});

test("the torsion is the fraction (2 lambda - 1) c of the engine", needsCommand, async () => {
  const { verdict } = await import("../page/explore/parallel.js");
  for (const [lambda, text] of [[1 / 4, "1/4"], [2 / 3, "2/3"], [1 / 24, "1/24"], [1, "1"], [0, "0"]]) {
    const [, sign, size] = /torsion\s(−?)([\d/]*)\s?c$/.exec(verdict(lambda, 0).replace(/<[^>]*>/g, ""));
    const rows = affinor("table", "so3", "--connection", `lambda=${text}`, "--show", "torsion", "--format", "csv");
    assert.equal(/,1,2,3,,(.*)/.exec(rows)[1], `${sign ? "-" : ""}${size || 1}`, text);
  }
});

test("the names of points are at least 12 pixels tall on a phone", async () => {
  for (const hash of ["", "#explore/parallel", "#explore/holonomy"]) {
    const page = await visit(hash, { viewport: PHONE });
    await page.locator(".view text:visible").first().waitFor();
    const sizes = await page.locator(".view text.name").evaluateAll((all) => all.filter((text) => text.checkVisibility()).map((text) => parseFloat(getComputedStyle(text).fontSize) * text.ownerSVGElement.clientWidth / 200));
    assert.ok(sizes.length >= 2 && Math.min(...sizes) >= 12, `${hash} ${sizes}`);
    await page.context().close();
  }
});

test("the vector is carried in four seconds, and the clock can be stopped", async () => {
  const page = await visit(), play = page.locator("#hero .play"), picture = page.locator("#hero .view").nth(1);
  const rest = await picture.innerHTML();
  await play.click();
  await page.waitForFunction((rest) => document.querySelectorAll("#hero .view")[1].innerHTML !== rest, rest);
  assert.equal(await play.innerText(), "Pause");
  await play.click();
  assert.equal(await play.innerText(), "Carry");
  await play.click();
  await page.waitForFunction(() => document.querySelector("#hero .play").textContent === "Carry", null, { timeout: 20000 });
  assert.equal(await picture.innerHTML(), rest);
});

test("the first screen shows once what it is about, unless the reader wants less motion", async () => {
  const page = await visit("", { moving: true }), play = page.locator("#hero .play");
  assert.equal(await play.innerText(), "Pause");
  await page.waitForFunction(() => document.querySelector("#hero .play").textContent === "Carry", null, { timeout: 20000 });
  const still = await visit();
  assert.equal(await still.locator("#hero .play").innerText(), "Carry");
  await sound(page);
});

test("on a phone a vertical swipe over a ball scrolls, a horizontal one turns, and p follows the finger", async () => {
  const page = await visit("", { viewport: PHONE, hasTouch: true, isMobile: true });
  const picture = page.locator("#hero .view").first(), { x, y, width, height } = await picture.boundingBox();
  await swipe(page, x + 0.8 * width, y + 0.8 * height, 0, -200);
  assert.ok(await page.evaluate(() => scrollY) > 50);
  // the page glides on for a moment
  await page.waitForFunction(() => new Promise((resolve) => { const y = scrollY; setTimeout(() => resolve(scrollY === y), 150); }));
  await page.evaluate(() => scrollTo(0, 0));
  await drawn(page);
  const before = await picture.innerHTML(), value = () => page.locator("#hero .handle").first().getAttribute("aria-valuetext"), p = await value();
  await swipe(page, x + 0.8 * width, y + 0.8 * height, -80, 0);
  assert.notEqual(await picture.innerHTML(), before);
  assert.equal(await value(), p);
  const hand = await page.locator("#hero .handle").first().boundingBox();
  await swipe(page, hand.x + hand.width / 2, hand.y + hand.height / 2, 5, -40);
  assert.equal(await page.evaluate(() => scrollY), 0);
  assert.notEqual(await value(), p);
});

test("the first screen has no fault that axe-core finds, in light and dark, on a phone and a laptop", async () => {
  for (const viewport of [PHONE, LAPTOP]) {
    for (const colorScheme of ["light", "dark"]) {
      const page = await visit("", { viewport, colorScheme });
      assert.deepEqual(await violations(page), []);
      await page.context().close();
    }
  }
});

test("the first stop of the keyboard skips to the content", async () => {
  const page = await visit();
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Skip to the content");
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.id), "main");
});

test("a frame takes less than 20 ms of the main thread, layout and style included", async () => {
  const page = await visit(), client = await page.context().newCDPSession(page);
  await client.send("Performance.enable", { timeDomain: "threadTicks" });
  const busy = async () => (await client.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
  const move = (frames) => page.evaluate(async (frames) => {
    const slider = document.querySelector("#hero input[type=range]");
    for (let k = 0; k < frames; k++) {
      slider.value = String(k % 25);
      slider.dispatchEvent(new Event("input"));
      await new Promise((resolve) => requestAnimationFrame(resolve));
    }
  }, frames);
  await move(20);
  const before = await busy();
  await move(60);
  const each = (await busy() - before) * 1000 / 60;
  console.log(`a frame takes ${each.toFixed(1)} ms of the main thread`);
  assert.ok(each < 20, String(each));
});
