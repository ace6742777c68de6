// The seven pages of Explore: one idea, one control, a picture that stays in sight, and a link to the tensors.
import assert from "node:assert/strict";
import { test } from "node:test";
import { LAPTOP, PHONE, drag, drawn, sound, swipe, violations, visit } from "./visit.mjs";
import { PAGES } from "../page/explore/pages.js";
import { start } from "../page/explore/stage.js";

const readout = (page) => page.locator("#page .readout").innerText();
const picture = (page) => page.locator("#page .pictures").innerHTML();

test("there are seven pages, named on the first screen, each one step from the next", async () => {
  const page = await visit();
  assert.deepEqual(await page.locator("#contents a").evaluateAll((links) => links.map((link) => link.hash)), PAGES.map(({ id }) => `#explore/${id}`));
  await page.locator("#contents a").first().click();
  for (const { title } of PAGES) {
    await page.waitForFunction((title) => document.title.startsWith(title.slice(0, 7)), title);
    assert.equal(await page.locator("#page h1").count(), 1);
    assert.equal(await page.locator("#question").isVisible(), false);
    await page.locator("#page .steps a").last().click();
  }
  await page.waitForFunction(() => !document.getElementById("explore").hidden);
  await page.goBack();
  await page.waitForFunction(() => document.title.startsWith("Screw"));
  await sound(page);
});

for (const { id, title } of PAGES) {
  test(`${title}: one control changes the picture and the numbers, and the address opens the same state`, async () => {
    const page = await visit(`#explore/${id}`);
    await page.locator("#page .pictures").waitFor();
    assert.equal(await page.locator("#page .controls :is(.range, .choice)").count(), 1);
    const [before, numbers] = [await picture(page), await readout(page)];
    const control = page.locator("#page .controls input").first();
    await control.focus();
    if (await page.locator("#page .choice").count()) await page.locator("#page .choice input").nth(2).check();
    else for (let k = 0; k < 3; k++) await page.keyboard.press("ArrowLeft");
    await drawn(page);
    assert.notEqual(await picture(page), before);
    assert.notEqual(await readout(page), numbers);
    if (!await page.locator("#page .choice").count()) assert.ok(await control.getAttribute("aria-valuetext"));
    await page.waitForTimeout(200);
    const again = await visit(new URL(page.url()).hash);
    await again.locator("#page .pictures").waitFor();
    assert.equal(await picture(again), await picture(page));
    assert.equal(await again.title(), await page.title());
    assert.match(await page.locator("#page .tensors").getAttribute("href"), /^#compute\?/);
    await sound(page);
  });
}

test("every page fits a phone and a laptop, its picture above its control, without a fault that axe-core finds", async () => {
  for (const [viewport, colorScheme] of [[PHONE, "light"], [LAPTOP, "dark"]]) {
    const page = await visit("", { viewport, colorScheme });
    for (const { id } of PAGES) {
      await page.evaluate((id) => { location.hash = `#explore/${id}`; }, id);
      await page.waitForFunction((id) => document.querySelector("#page .stage")?.isConnected && location.hash === `#explore/${id}` && document.querySelector("#page .readout").textContent, id);
      await page.waitForTimeout(100);
      const view = await page.locator("#page .view").last().boundingBox(), controls = await page.locator("#page .controls").boundingBox();
      assert.ok(view.y + view.height <= controls.y + 1, id);
      assert.ok(controls.y + controls.height <= viewport.height, `${id} ${controls.y + controls.height}`);
      assert.deepEqual(await violations(page), [], id);
      await sound(page);
    }
  }
});

test("on a phone the picture and its control stay while the text is read", async () => {
  const page = await visit("#explore/holonomy", { viewport: PHONE, hasTouch: true, isMobile: true });
  await page.locator("#page .pictures").waitFor();
  await swipe(page, 180, 600, 0, -300);
  assert.ok(await page.evaluate(() => scrollY) > 40);
  for (const part of [".view", ".controls"]) {
    const { y, height } = await page.locator(`#page ${part}`).first().boundingBox();
    assert.ok(y >= 0 && y + height <= PHONE.height, `${part} ${y}`);
  }
});

test("the clock of the book runs, both pictures in step, and stands still for who wants less motion", async () => {
  const still = await visit("#explore/book");
  await still.locator("#page .pictures").waitFor();
  assert.equal(await still.locator("#page .play").innerText(), "Play");
  const page = await visit("#explore/book", { moving: true });
  await page.locator("#page .pictures").waitFor();
  assert.equal(await page.locator("#page .play").innerText(), "Pause");
  const views = () => page.locator("#page .view svg").evaluateAll((all) => all.map((svg) => svg.innerHTML));
  const before = await views();
  await page.waitForTimeout(400);
  (await views()).forEach((picture, k) => assert.notEqual(picture, before[k]));
  await page.locator("#page .play").click();
  const stopped = await views();
  await page.waitForTimeout(200);
  assert.deepEqual(await views(), stopped);
  assert.match(await readout(page), /both constant/);
});

test("holonomy: any loop turns by a quarter of its area, as p is dragged", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  for (const [right, down] of [[30, -40], [-60, 10], [500, 0]]) {
    await drag(page, page.locator("#page .handle"), right, down);
    assert.match(await readout(page), /turn \/ area = 0\.2(5|49|50)/);
  }
});

test("addresses that cannot be read open the page as it begins", async () => {
  for (const hash of ["#explore/nowhere", "#explore/torsion?v=NaN", "#explore/torsion?v=1e9", "#explore?p=1,2", "#explore?p=9,9,9&v=", "#explore/book?v=7.5", "#%00", "#explore/../x", "#nothing"]) {
    const page = await visit(hash);
    await page.waitForTimeout(100);
    assert.ok(await page.locator(".view svg:visible").count() > 0, hash);
    assert.ok(!(await page.locator("main").innerText()).includes("NaN"), hash);
    await sound(page);
    await page.context().close();
  }
});

test("pictures name what they show in words, for every value of the control", async () => {
  const { Camera } = await import("../page/explore/scene.js");
  for (const { id, load } of PAGES) {
    const { default: spec } = await load(), { control } = spec;
    const [least, most] = "choices" in control ? [0, control.choices.length - 1] : [control.min, control.max];
    for (const v of [least, (least + most) / 2, most]) {
      for (const t of [0, spec.rest ?? 0, Math.min(spec.duration, 12)]) {
        const state = { ...start(spec), v: "choices" in control ? Math.round(v) : v, t };
        for (const { svg, about } of spec.draw(state, new Camera(...spec.camera), "x")) {
          assert.ok(about.length > 20, id);
          assert.doesNotMatch(svg + about + spec.readout(state), /NaN|undefined|Infinity/, `${id} ${v} ${t}`);
        }
      }
    }
  }
});
