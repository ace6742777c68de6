// What a reader does in Compute: names that are offered, messages at their place, wide and long results, copies, and ways back.
import assert from "node:assert/strict";
import { test } from "node:test";
import { equations } from "../page/compute/cards.js";
import { step } from "../page/compute/letters.js";
import { compute, formulas, settled, text, type } from "./computed.mjs";
import { PHONE, sound, violations, visit } from "./visit.mjs";

test("names are offered from their first letters", async () => {
  const page = await compute("space=so(3)");
  for (const [typed, name] of [["Heis", "Heisenberg"], ["Salam", "Salamon's list of de^i (0,0,12)"], ["schw", "Schwarzschild"]]) {
    await page.fill("#space-input", typed);
    await page.locator(".matches .chip", { hasText: name }).first().waitFor();
  }
  await page.fill("#space-input", "Heis");
  await page.locator('.matches .chip:text-is("Heisenberg")').click();
  await settled(page);
  assert.match(await text(page, "#read-as"), /heisenberg\(3\)/);
  await sound(page);
});

test("Enter on a list that is not closed says so, and marks the earlier cards", async () => {
  const page = await compute("space=so(3)");
  await page.fill("#space-input", "(0,0,0,12,13,23");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector(".refusal")?.textContent);
  assert.match(await text(page, ".refusal"), /A “\)” is missing/);
  assert.ok(await page.locator(".card.stale").count());
  assert.equal(await page.inputValue("#space-input"), "(0,0,0,12,13,23");
  await type(page, "(0,0,0,12,13,23)");
  assert.match(await text(page, "#read-as"), /read as Salamon's list/);
  assert.doesNotMatch(await text(page, "#read-as"), /\(0,0,12\)/);
});

for (const viewport of [PHONE, { width: 1366, height: 768 }, { width: 1920, height: 1080 }]) {
  test(`no formula of a metric of letters is cut at a width of ${viewport.width}`, async () => {
    const page = await compute("space=SU(2)&metric=diag(a,b,c)", { viewport });
    assert.match((await formulas(page, "ricci"))[0], /^Ric_11 = /);
    const cut = await page.locator(".card:not([hidden]) .body").evaluateAll((bodies) => bodies.filter((body) => body.scrollWidth > body.clientWidth + 1).length);
    assert.equal(cut, 0);
    await sound(page);
  });
}

test("on a phone an equation with several sides breaks between them, so that its value is in sight", async () => {
  const page = await compute("space=se(3)&connection=zero", { viewport: PHONE });
  const values = await page.locator(".card.curvature .components math").evaluateAll((all) => all.map((math) => ({ right: math.lastElementChild.getBoundingClientRect().right, edge: math.closest(".components").getBoundingClientRect().right, text: math.getAttribute("alttext") })));
  assert.match(values.at(-1).text, /= 1\/4$/);
  for (const { right, edge, text } of values) assert.ok(right <= edge + 1, `${text} ${right} ${edge}`);
  await sound(page);
});

test("all of the structure of so(8) fits a phone, and its diagrams are drawn in the colours of the page", { timeout: 120000 }, async () => {
  for (const colorScheme of ["light", "dark"]) {
    const page = await compute("space=so(8)", { viewport: PHONE, colorScheme });
    await page.locator(".card.structure").scrollIntoViewIfNeeded();
    await page.locator(".card.structure summary").first().click({ timeout: 60000 });
    await sound(page);
    assert.deepEqual(await violations(page), []);
    const { ground, ink, texts, filter } = await page.locator(".card.structure").evaluate((card) => ({
      ground: [...card.querySelectorAll(".drawn circle[fill='#ffffff']")].every((circle) => getComputedStyle(circle).fill === getComputedStyle(card).backgroundColor),
      ink: [...card.querySelectorAll(".drawn text")].every((text) => getComputedStyle(text).fill === getComputedStyle(card).color),
      texts: [...card.querySelectorAll(".drawn text")].filter((text) => text.getClientRects().length).map((text) => ({ name: text.textContent, size: parseFloat(getComputedStyle(text).fontSize) * text.ownerSVGElement.clientWidth / text.ownerSVGElement.viewBox.baseVal.width })),
      filter: getComputedStyle(card.querySelector(".drawn")).filter,
    }));
    assert.ok(ground && ink && filter === "none");
    assert.ok(texts.length > 4 && texts.every(({ size }) => size >= 12), JSON.stringify(texts));
    assert.ok(texts.filter(({ name }) => name === "D4").length <= 2, "once in each picture");
    await page.context().close();
  }
});

test("cards of an earlier input have no parts of another colour", async () => {
  const page = await compute("space=se(3)&connection=zero");
  await page.locator("#space-input").press("x");
  const grounds = await page.locator(".card.stale").evaluateAll((cards) => cards.map((card) => [getComputedStyle(card).backgroundColor, getComputedStyle(document.body).backgroundColor, ...[...card.querySelectorAll(".components, .matrix")].map((part) => /rgba?\([^)]*\)/.exec(getComputedStyle(part).backgroundImage)[0])]));
  assert.ok(grounds.length > 2);
  for (const colours of grounds) assert.equal(new Set(colours).size, 1, colours.join(" "));
});

test("the head and the foot of the page are as wide as the cards, and a slider is not wider than its use", async () => {
  for (const width of [1920, 3840]) {
    const page = await compute("space=Schwarzschild", { viewport: { width, height: 1080 } });
    const lefts = await page.evaluate(() => [".brand", ".cards", "footer p"].map((part) => Math.round(document.querySelector(part).getBoundingClientRect().left)));
    assert.equal(new Set(lefts).size, 1, lefts.join(" "));
    const slider = await page.locator(".controls-of-space .letter input[type=range]").boundingBox(), em = await page.evaluate(() => parseFloat(getComputedStyle(document.documentElement).fontSize));
    assert.ok(slider.width < 26 * em, String(slider.width));
    assert.match(await text(page, "#read-as"), /coordinates t, r, theta, phi/);
    await page.context().close();
  }
});

test("sliders are 44 pixels high on a phone", async () => {
  const page = await compute("space=so(3)&metric=diag(a,b,c)&connection=zero", { viewport: PHONE });
  for (const part of [".lambda input", ".controls-of-space .letter input[type=range]"]) assert.ok((await page.locator(part).first().boundingBox()).height >= 44, part);
});

test("a page that is opened by its link has no ring around its heading", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  assert.notEqual(await page.evaluate(() => document.activeElement.tagName), "H1");
});

test("a long list shows its first rows, and all of them by a button, without scrolling inside", async () => {
  const page = await compute("space=se(3)&metric=diag(a,b,c,d,e,f)");
  const rows = page.locator(".card.connection .components > li:visible");
  assert.equal(await rows.count(), 12);
  await page.locator(".card.connection .all").click();
  assert.ok(await rows.count() > 12);
  const scrolls = await page.locator(".card:not([hidden]) .body").evaluateAll((all) => all.filter((body) => body.scrollHeight > body.clientHeight + 1).length);
  assert.equal(scrolls, 0);
});

test("the link to Compute leads back to the last result, with the box in view", async () => {
  const page = await compute("space=su(2)");
  assert.match(await text(page, "#say"), /^su\(2\): \d+ cards/);
  await page.click('nav a[href="#explore"]');
  await page.waitForFunction(() => document.body.dataset.view === "explore");
  assert.equal(await text(page, "#say"), "");
  await page.click('nav a[href="#compute"]');
  await page.waitForFunction(() => document.body.dataset.view === "compute");
  await settled(page);
  assert.match(page.url(), /space=su\(2\)/);
  assert.ok(await page.locator(".guide").isHidden());
  const { y } = await page.locator("#space-input").boundingBox();
  assert.ok(y >= 0, String(y));
});

test("an emptied box leaves no result of an earlier input", async () => {
  const page = await compute("space=so(3)");
  await page.fill("#space-input", "");
  await page.waitForFunction(() => document.querySelector(".cards").hidden);
  assert.ok(await page.locator(".guide").isVisible());
  assert.equal(new URL(page.url()).hash, "#compute");
  await type(page, "so(3)");
  assert.ok(await page.locator(".cards").isVisible());
  await sound(page);
});

test("a message about the value of a letter is under its slider", async () => {
  const page = await compute("space=so(3)&metric=diag(a,b,c)");
  const row = page.locator(".controls-of-space .letter").first(), value = row.locator("input[type=text]");
  for (const [typed, words] of [["abc", /^Write a number/], ["1/0", /zero|divi/i], ["0", /degenerate|singular|invert/i]]) {
    await value.fill(typed);
    await value.press("Enter");
    await page.waitForFunction(() => document.querySelector(".controls-of-space .letter .help").textContent);
    assert.match(await row.locator(".help").innerText(), words);
    assert.equal(await text(page, ".refusal"), "");
    await value.fill("2");
    await value.press("Enter");
    await page.waitForFunction(() => !document.querySelector(".controls-of-space .letter .help").textContent);
  }
});

test("a link with a value that has no result has its message under the slider", async () => {
  const page = await visit("#compute?space=so(3)&metric=diag(a,b,c)&set=a=0");
  await page.waitForFunction(() => document.querySelector(".controls-of-space .letter .help")?.textContent);
  assert.equal(await text(page, ".refusal"), "");
});

test("sliders have steps of a power of ten, and short values", async () => {
  assert.deepEqual([3.9, 6, 40, 400, 0.5].map(step), [0.1, 0.1, 1, 10, 0.01]);
  const page = await compute("space=so(3)&metric=diag(a,b,c)");
  const slider = page.locator(".controls-of-space .letter input[type=range]").first();
  await slider.evaluate((range) => { range.value = "0.518"; range.dispatchEvent(new Event("input")); });
  await settled(page);
  assert.match(page.url(), /set=a=0\.5(&|$)/);
});

test("a diagonal metric of dimension 6 has the letters a to f", async () => {
  const page = await compute("space=(0,0,0,12,13,23)");
  await page.locator('.controls-of-space button:text-is("diagonal")').click();
  await settled(page);
  assert.match(decodeURIComponent(page.url()), /diag\(a, ?b, ?c, ?d, ?e, ?f\)/);
});

test("a copy as LaTeX is the formulas alone, and its button says that it is done", async () => {
  assert.equal(equations("\\section*{x}\n\\begin{align*}\na &= 1\n\\end{align*}\ntext"), "\\begin{align*}\na &= 1\n\\end{align*}");
  assert.equal(equations("text"), "text");
  const page = await compute("space=so(3)&connection=plus", { permissions: ["clipboard-read", "clipboard-write"] });
  const copy = page.locator('.card.torsion .copies button:text-is("LaTeX")');
  await copy.click();
  await page.locator('.card.torsion .copies [data-told="copied"]').waitFor({ timeout: 60000 });
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(copied, /^\\begin\{align\*\}\n\\tau/);
  assert.match(copied, /\\end\{align\*\}$/);
});

test("the tumbling book begins with its motion, which moves, below the box", async () => {
  const page = await compute("space=tumbling%20book", { moving: true });
  await page.waitForSelector(".card.motions svg.ball polygon", { timeout: 60000 });
  await page.locator('.card.motions button:text-is("Pause")').waitFor();
  const [box, card] = [await page.locator("#space-input").boundingBox(), await page.locator(".card.motions").boundingBox()];
  assert.ok(box.y >= 0 && card.y > box.y && card.y < 600, `${box.y} ${card.y}`);
  await page.locator('.card.motions button:text-is("Pause")').click();
  const still = await compute("space=tumbling%20book");
  await still.waitForSelector(".card.motions svg.ball polygon", { timeout: 60000 });
  assert.equal(await still.locator('.card.motions button:text-is("Play")').count(), 1);
});

test("Present begins with the card that has the focus, with large formulas and without its copies", async () => {
  const page = await compute("space=so(3)&connection=zero");
  await page.locator(".card.curvature").evaluate((card) => card.scrollIntoView({ block: "start" }));
  await page.locator(".card.curvature .copies button").last().focus();
  await page.keyboard.press("p");
  await page.locator("dialog.presenting[open]").waitFor();
  assert.ok(await page.locator("dialog .card.curvature").isVisible());
  assert.ok(await page.locator("dialog math").first().evaluate((math) => parseFloat(getComputedStyle(math).fontSize)) >= 40);
  assert.ok(await page.locator("dialog .foot").isHidden());
  assert.equal(await page.evaluate(() => document.activeElement.tagName), "DIALOG");
  assert.ok(await page.locator("dialog [data-do=svg]").isHidden());
  await page.keyboard.press("Escape");
  // the dialog tells of its end a moment later
  await page.locator(".cards .card.curvature").waitFor();
  await sound(page);
});

test("a slide of Explore has its title and its sentence", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  await page.locator("#present").click();
  await page.locator("dialog.presenting[open]").waitFor();
  assert.equal(await page.locator("dialog .heading").innerText(), "Holonomy is area");
  assert.match(await page.locator("dialog .words").innerText(), /quarter of the area/);
  const { y, height } = await page.locator("dialog .words").boundingBox();
  assert.ok(y + height < 768, String(y + height));
});

test("the hand on a point of the loop moves with the size of the loop", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  const centre = async () => { const { x, y, width, height } = await page.locator("#page .handle").boundingBox(); return [x + width / 2, y + height / 2]; };
  const dot = async () => page.locator("#page .view").evaluate((view) => {
    const hand = document.querySelector("#page .handle").getBoundingClientRect(), [x, y] = [hand.x + hand.width / 2, hand.y + hand.height / 2];
    const dots = [...view.querySelectorAll("circle.point")].map((point) => { const box = point.getBoundingClientRect(); return Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y); });
    return Math.min(...dots);
  });
  const before = await centre();
  assert.ok(await dot() < 3);
  const range = page.locator("#page .range input");
  await range.fill("0.5");
  await page.waitForTimeout(200);
  const after = await centre();
  assert.ok(Math.hypot(after[0] - before[0], after[1] - before[1]) > 20);
  assert.ok(await dot() < 3, String(await dot()));
});

test("the focus follows: to the heading of a page, and to the content without losing the address", async () => {
  const page = await visit("#explore/torsion");
  await page.locator("#page .pictures").waitFor();
  await page.locator("#page .steps a").last().click();
  await page.waitForFunction(() => document.activeElement?.tagName === "H1");
  const { hash } = new URL(page.url());
  await page.locator(".skip").focus();
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.id), "main");
  assert.equal(new URL(page.url()).hash.split("?")[0], hash.split("?")[0]);
  await page.locator("#share").click();
  await page.locator("#share[data-told]").waitFor();
});
