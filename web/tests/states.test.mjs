// States of Compute that follow each other: another space, an error, a stop, a list of components, a presentation; and the focus in them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { compute, formulas, settled, text, type } from "./computed.mjs";
import { PHONE, drawn, sound, visit } from "./visit.mjs";

const tag = (page) => page.evaluate(() => document.activeElement?.tagName);
const refusal = (page) => page.waitForFunction(() => document.querySelector(".refusal")?.textContent);
const stale = (page) => page.locator(".read-as").evaluate((line) => line.checkVisibility() && getComputedStyle(line, "::before").content !== "none");

test("indices of a list are those of one space, and a refused index is not asked for again", async () => {
  const page = await compute("space=so(8)&connection=zero"), index = page.locator(".card.curvature .filters input").first();
  await index.fill("20");
  await index.press("Enter");
  await page.waitForFunction(() => !document.querySelector(".card.curvature .body strong"));
  for (const space of ["su(2)", "se(3)", "so(3)"]) {
    await type(page, space);
    assert.equal(await text(page, ".refusal"), "");
    assert.ok((await formulas(page, "curvature")).length, space);
    assert.equal(await page.locator(".card.curvature .filters").count(), 0);
  }
  await type(page, "so(8)");
  assert.equal(await index.inputValue(), "");
  await index.fill("100");
  await index.press("Enter");
  await page.waitForFunction(() => /100/.test(document.querySelector(".card.curvature .filters .help")?.textContent));
  await page.locator(".controls-of-space button:text-is('plus')").click();
  await settled(page);
  assert.equal(await text(page, ".refusal"), "");
  await sound(page);
});

test("a list of components keeps the focus", async () => {
  const page = await compute("space=so(8)&connection=zero"), index = (k) => page.locator(".card.curvature .filters input").nth(k);
  await index(0).fill("1");
  await index(0).press("Enter");
  await page.waitForFunction(() => document.querySelector(".card.curvature .filters input").value === "1");
  await settled(page);
  const label = () => page.evaluate(() => document.activeElement?.getAttribute("aria-label") ?? document.activeElement?.textContent);
  assert.equal(await label(), "index i");
  await page.locator(".card.curvature .filters button").focus();
  await page.keyboard.press("Enter");
  await page.waitForTimeout(600);
  assert.equal(await label(), "List");
});

test("a list that is too long says to choose one more index", async () => {
  const page = await compute("space=E8&connection=zero"), index = page.locator(".card.curvature .filters input").first();
  await index.fill("1");
  await index.press("Enter");
  await page.waitForFunction(() => /3\u2009828/.test(document.querySelector(".card.curvature .body strong")?.textContent));
  assert.match(await text(page, ".card.curvature .body > .help"), /choose one more index/);
});

test("a message about the text of the box is under the box, also after a letter has moved", async () => {
  for (const bad of ["[x,y]=", "nonsense", "so(3]"]) {
    const page = await compute("space=Schwarzschild"), slider = page.locator(".controls-of-space .letter input[type=range]");
    await slider.focus();
    await page.keyboard.press("ArrowRight");
    await settled(page);
    await page.fill("#space-input", bad);
    await refusal(page);
    assert.equal(await page.locator(".letter .help").evaluateAll((all) => all.map((help) => help.textContent).join("")), "");
    await page.context().close();
  }
  // a value that the space does not allow is a fault of its letter
  const page = await compute("space=so(3)&metric=diag(a,b,c)"), number = page.locator(".controls-of-space .letter input[type=text]").first();
  await number.fill("0");
  await number.press("Enter");
  await page.waitForFunction(() => document.querySelector(".letter .help").textContent);
  assert.match(await text(page, ".letter .help"), /degenerate/);
  assert.equal(await text(page, ".refusal"), "");
});

test("equations of motion are written with the connection of the chips", async () => {
  for (const [state, connection] of [["space=su(2)&metric=diag(1,2,3)", "Levi-Civita"], ["space=so(3)&metric=diag(1,2,3)&connection=plus", "plus"], ["space=so(3)&metric=diag(1,2,3)&connection=zero", "zero"],
    ["space=M(3)", "plus"], ["space=SO(3)", "zero"], ["space=se(3)", "zero"]]) {
    const page = await compute(state);
    await page.locator(".card.equations").scrollIntoViewIfNeeded();
    await page.waitForSelector(".card.equations dl", { timeout: 60000 });
    assert.equal(await text(page, "[aria-label=Connection] [aria-pressed=true]"), connection);
    const named = await page.locator(".card.equations dt").evaluateAll((all) => all.find((dt) => dt.textContent === "connection")?.nextElementSibling?.textContent);
    assert.ok(named?.toLowerCase().startsWith(connection.toLowerCase()), `${state}: ${named}`);
    await page.context().close();
  }
});

test("slides have one order at every size and begin with the first card, or with the card that has the focus", async () => {
  const orders = [];
  for (const viewport of [PHONE, { width: 1366, height: 768 }, { width: 1920, height: 1080 }]) {
    const page = await compute("space=se(3)", { viewport }), titles = [];
    await page.keyboard.press("p");
    await page.locator("dialog.presenting[open]").waitFor();
    const count = Number(/^1 of (\d+)/.exec(await text(page, "dialog .where"))?.[1]);
    for (let k = 0; k < count; k++) {
      titles.push(await text(page, "dialog .slide h2"));
      await page.keyboard.press("ArrowRight");
    }
    orders.push(titles);
    await page.context().close();
  }
  assert.equal(orders[0][0], "Brackets");
  assert.deepEqual(orders[1], orders[0]);
  assert.deepEqual(orders[2], orders[0]);
  // a link to a card, and a click into one
  const page = await compute("space=se(3)&card=curvature");
  await page.waitForFunction(() => document.activeElement?.matches(".card.curvature"));
  await page.keyboard.press("p");
  assert.equal(await text(page, "dialog .slide h2"), "Curvature");
  await page.keyboard.press("Escape");
  await page.locator(".card.torsion .body").click();
  await page.keyboard.press("p");
  assert.equal(await text(page, "dialog .slide h2"), "Torsion");
});

test("what was read is marked while a message is about another text", async () => {
  const page = await compute("space=Schwarzschild");
  assert.equal(await stale(page), false);
  await page.fill("#space-input", "foo");
  await refusal(page);
  assert.match(await text(page, "#read-as"), /^Schwarzschild/);
  assert.equal(await stale(page), true);
  await type(page, "Schwarzschild");
  assert.equal(await stale(page), false);
  // the metric is not a part of the text
  await type(page, "tumbling book");
  await page.locator(".controls-of-space button:text-is('full')").click();
  await settled(page);
  await page.locator(".grid input").first().fill("1/");
  await refusal(page);
  assert.equal(await stale(page), false);
});

test("the beginning of a name has its completions and no message until it is entered, and then one row of names", async () => {
  const page = await compute("space=so(3)");
  await page.fill("#space-input", "foo");
  await refusal(page);
  await page.fill("#space-input", "s");
  await page.waitForTimeout(1500);
  assert.equal(await text(page, ".refusal"), "");
  assert.equal(await stale(page), true);
  assert.ok(await page.locator(".matches .chip").count());
  await page.keyboard.press("Enter");
  await refusal(page);
  assert.ok(await page.locator(".matches").isHidden());
  const names = await page.locator(".refusal .chips:has-text('Did you mean') .chip").allTextContents();
  assert.equal(new Set(names).size, names.length);
  assert.ok((await text(page, ".refusal p")).length < 60);
});

test("a message that points to a list has the list, and notations to write, among them a metric in coordinates", async () => {
  for (const bad of ["foo", "ds^2 = dx^2 + dy^2"]) {
    const page = await compute("space=so(3)", { viewport: PHONE });
    await page.fill("#space-input", bad);
    await refusal(page);
    await page.click(".refusal summary");
    assert.ok(await page.locator(".refusal details .chip:text-is('kerr')").isVisible());
    await sound(page);
    await page.click(".refusal .chip:has-text('metric in coordinates')");
    await settled(page);
    assert.match(await text(page, "#read-as"), /dimension 2/);
    assert.match((await formulas(page, "scalar_curvature"))[0], /= 2$/);
    await page.context().close();
  }
  // the names come after the message of a link
  const link = await compute("space=foo");
  await link.waitForFunction(() => /all \d{3} names/.test(document.querySelector(".refusal summary")?.textContent));
  assert.equal(await link.locator(".chip:text-is('kerr')").count(), 1);
  assert.ok(await link.locator(".guide").isHidden());
  const page = await visit("#compute");
  await page.click(".guide .chip:has-text('metric in coordinates')");
  await settled(page);
  assert.match(await text(page, "#read-as"), /dimension 2/);
});

test("the box is as high as its text", async () => {
  for (const viewport of [PHONE, { width: 1920, height: 1080 }]) {
    const page = await compute("space=so(3)", { viewport });
    for (const words of ["so(3)", "[x1,x2]=x3; [x1,x3]=x4; [x1,x4]=x5; [x2,x3]=x5; [x1,x5]=x6; [x2,x4]=x6; [x1,x6]=x7; [x2,x5]=x7", "[x,y]=z\n[y,z]=x"]) {
      await page.fill("#space-input", words);
      const [content, inside] = await page.locator("#space-input").evaluate((field) => [field.scrollHeight, field.clientHeight]);
      assert.ok(content <= inside + 1, `${content} in ${inside}: ${words}`);
    }
    await page.context().close();
  }
});

test("Stop appears after a second, keeps its place as Resume, and gives the focus back to the box", async () => {
  const page = await compute("space=so(3)");
  // a quick computation shows no button that a Tab could reach
  await page.evaluate(() => {
    window.shown = 0;
    new MutationObserver(() => { window.shown += Number(!document.querySelector("#box .waiting").hidden); }).observe(document.querySelector("#box .waiting"), { attributes: true });
  });
  await type(page, "sl(2)");
  assert.equal(await page.evaluate(() => window.shown), 0);
  await type(page, "E8");
  await page.locator(".card.properties").scrollIntoViewIfNeeded();
  // it takes minutes
  await page.click(".card.properties .body button");
  const stop = page.locator("#box .stop");
  await stop.waitFor({ timeout: 60000 });
  await stop.focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#box .stop").textContent === "Resume");
  assert.ok(await stop.evaluate((button) => button === document.activeElement));
  const marked = () => page.locator(".card.stale").count();
  assert.equal(await marked(), 0, "results of this input are not marked");
  // a scroll does not begin it again
  await page.mouse.wheel(0, 900);
  await page.waitForTimeout(1500);
  assert.equal(await stop.textContent(), "Resume");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#box .stop").textContent === "Stop");
  await page.waitForTimeout(1500);
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#box .stop").textContent === "Resume");
  // another text ends it, and the button vanishes
  await page.evaluate(() => {
    const field = document.getElementById("space-input");
    field.value = "so(3)";
    field.dispatchEvent(new Event("input", { bubbles: true }));
  });
  await page.waitForFunction(() => document.querySelector("#box .waiting").hidden);
  assert.equal(await page.evaluate(() => document.activeElement?.id), "space-input");
  await sound(page);
});

test("buttons that vanish from a card leave the focus in it", async () => {
  const page = await compute("space=so(8)");
  const all = page.locator(".card .all").first();
  if (await all.count()) {
    await all.focus();
    await page.keyboard.press("Enter");
    await drawn(page);
    assert.equal(await tag(page), "ARTICLE");
  }
  await page.locator(".card.torsion .copies button, .card.connection .copies button").first().focus();
  await page.locator(".controls-of-space button:text-is('plus')").evaluate((button) => button.click());
  await settled(page);
  assert.equal(await tag(page), "BUTTON");
});
