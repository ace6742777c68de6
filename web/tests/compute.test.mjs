// The view Compute in a browser: the box, the chips, the letters and the cards.
import assert from "node:assert/strict";
import { test } from "node:test";
import { compute, formulas, settled, text, type } from "./computed.mjs";
import { PHONE, sound, violations, visit } from "./visit.mjs";

test("a name has its cards in their order, as mathematics", async () => {
  const page = await compute("space=so(3)&connection=zero");
  assert.match(await text(page, "#read-as"), /^so\(3\), dimension 3/);
  const titles = await page.locator(".card:not([hidden]) h2").allTextContents();
  // the order goes from column to column
  assert.deepEqual(titles.toSorted(), ["Brackets", "Connection", "Curvature", "Equations of motion", "Motions", "Properties", "Representations of A1", "Ricci tensor", "Structure", "Torsion"]);
  assert.deepEqual([titles[0], titles.at(-1)], ["Brackets", "Motions"]);
  assert.deepEqual((await formulas(page, "curvature"))[0], "R^1_212 = R^1_313 = R^2_323 = 1/4");
  assert.match(await text(page, ".card.curvature .rest"), /Antisymmetric/);
  assert.match(await page.title(), /so\(3\)/);
  await sound(page);
});

test("what is typed on the first screen opens Compute and keeps the cursor", async () => {
  const page = await visit();
  await page.click("#space-input");
  await page.waitForFunction(() => document.querySelector("textarea#space-input"));
  await page.locator("#space-input").pressSequentially("SU(2)");
  await page.waitForFunction(() => document.body.dataset.view === "compute");
  await settled(page);
  assert.equal(await page.inputValue("#space-input"), "SU(2)");
  assert.equal(await page.evaluate(() => document.activeElement?.id), "space-input");
  assert.match(await text(page, "#read-as"), /computed in its Lie algebra su\(2\)/);
  assert.match(page.url(), /#compute\?space=SU\(2\)/);
});

test("a text that is entered while Compute loads is computed, and one that is only typed as well", async () => {
  for (const enter of [true, false]) {
    const page = await visit();
    await page.route("**/compute/main.js", async (route) => {
      await new Promise((resolve) => setTimeout(resolve, 1500));
      await route.continue();
    });
    await page.reload();
    const loading = page.waitForRequest("**/compute/main.js");
    await page.waitForFunction(() => document.querySelector("#contents li"));
    await loading;
    await page.focus("#space-input");
    await page.keyboard.type("su(2)");
    if (enter) await page.keyboard.press("Enter");
    assert.equal(await page.locator("#space-input").evaluate((field) => field.localName), "input");
    await page.waitForFunction(() => document.querySelector("#read-as")?.textContent.startsWith("su(2)"));
    await settled(page);
    assert.match(page.url(), /#compute\?space=su\(2\)$/);
    assert.equal(await page.locator("#space-input").inputValue(), "su(2)");
    await sound(page);
    await page.context().close();
  }
});

test("names that complete a text go when it is entered", async () => {
  const page = await compute("space=so(3)");
  await page.fill("#space-input", "su(2");
  await page.locator(".matches .chip").first().waitFor();
  await page.keyboard.type(")");
  await page.keyboard.press("Enter");
  await settled(page);
  assert.ok(await page.locator(".matches").isHidden());
  assert.ok(await page.locator("#box .chips:has-text('Schwarzschild')").isVisible());
});

test("facts about a structure are whole on a phone, and letters of the metric are not taken for its letters", async () => {
  const page = await compute("space=[e1,e2]=e3, [e1,e3]=-e2&metric=diag(a,b,c)", { viewport: PHONE });
  await page.locator(".card.structure").scrollIntoViewIfNeeded();
  await page.waitForSelector(".card.structure .facts", { timeout: 60000 });
  const cut = await page.locator(".card.structure .facts.first dd").evaluateAll((all) => all.filter((fact) => fact.scrollWidth > fact.clientWidth + 1).map(({ textContent }) => textContent));
  assert.deepEqual(cut, []);
  assert.doesNotMatch(await text(page, ".card.structure .body"), /for generic values/);
});

test("the name of a matrix and the matrix are one formula, and A1 + A1 has no diagram", async () => {
  const page = await compute("space=so(4)&metric=identity");
  assert.equal((await formulas(page, "metric")).length, 1);
  assert.match((await formulas(page, "metric"))[0], /^g_ij = \[1, 0/);
  await page.locator(".card.structure").scrollIntoViewIfNeeded();
  await page.waitForSelector(".card.structure .facts", { timeout: 60000 });
  assert.equal(await page.locator(".card.structure .drawn").count(), 0);
});

test("a message stands under the letters, and goes when they are right", async () => {
  const page = await compute("space=so(3)");
  await page.fill("#space-input", "[x,y]=z; [y,z]=q^2");
  await page.waitForFunction(() => document.querySelector(".refusal mark"));
  assert.match(await text(page, ".refusal .where"), /\[y,z\]=q\^2/);
  assert.ok(await page.locator(".card.stale").count(), "earlier cards are marked");
  await type(page, "[x,y]=z");
  assert.equal(await text(page, ".refusal"), "");
  // cards of the second module wait until they are in view
  assert.equal(await page.locator(".card.stale:not(.structure, .properties, .equations, .motions)").count(), 0);
});

test("a suggestion is a button", async () => {
  const page = await compute("space=soo(3)");
  await page.locator(".refusal .chip").first().click();
  await settled(page);
  assert.equal(await text(page, ".refusal"), "");
  assert.match(await text(page, "#read-as"), /dimension/);
});

test("an earlier result is marked as soon as a letter is typed", async () => {
  const page = await compute("space=so(3)");
  await page.locator("#space-input").press("x");
  assert.ok(await page.locator(".card.stale").count());
});

test("every letter is a slider that makes one entry of the history, and a letter again", async () => {
  const page = await compute("space=so(3)&metric=diag(a,b,c)");
  assert.deepEqual(await page.locator(".controls-of-space .letter label math").evaluateAll((all) => all.map((math) => math.getAttribute("alttext"))), ["a", "b", "c"]);
  assert.match((await formulas(page, "scalar_curvature"))[0], /a/);
  const length = await page.evaluate(() => history.length);
  const slider = page.locator(".controls-of-space .letter input[type=range]").first();
  await slider.focus();
  for (let k = 0; k < 5; k++) await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.match(page.url(), /set=a=1\.\d+/);
  assert.doesNotMatch((await formulas(page, "scalar_curvature"))[0], /a/);
  assert.match(await slider.getAttribute("aria-valuetext"), /^a = 1\./);
  assert.equal(await page.evaluate(() => history.length), length);
  await page.click(".letter .free:visible");
  await settled(page);
  assert.match((await formulas(page, "scalar_curvature"))[0], /a/);
});

test("chips choose the connection and the metric, and lambda shows a value only where it holds", async () => {
  const page = await compute("space=so(3)");
  const chip = (name) => page.locator(`.controls-of-space button:text-is("${name}")`);
  assert.equal(await chip("zero").getAttribute("aria-pressed"), "true");
  assert.match(await chip("Levi-Civita").getAttribute("title"), /metric/);
  await chip("plus").click();
  await settled(page);
  assert.deepEqual((await formulas(page, "torsion"))[0], "tau^1_23 = 1");
  assert.equal(await text(page, ".lambda output"), "λ = 1");
  await chip("diagonal").click();
  await settled(page);
  await chip("Levi-Civita").click();
  await settled(page);
  assert.ok(await page.locator(".lambda").isHidden());
  assert.ok((await formulas(page, "torsion"))[0].endsWith("= 0"));
  await chip("full").click();
  await settled(page);
  const entry = page.locator(".grid input").nth(1);
  await entry.fill("1/2");
  await settled(page);
  assert.equal(await page.locator(".grid input").nth(3).inputValue(), "1/2");
  await page.goBack();
  await settled(page);
  assert.ok(await chip("Killing").isEnabled());
});

test("E8 is a summary with a filter, and no page of a mile", async () => {
  const page = await compute("space=E8&connection=zero");
  assert.match(await text(page, ".card.curvature .body"), /1\u2009031\u2009700 nonzero components/);
  assert.ok(await page.evaluate(() => document.documentElement.scrollHeight) < 6000);
  await page.locator(".card.curvature .filters input").nth(0).fill("1");
  await page.locator(".card.curvature .filters input").nth(1).fill("2");
  await page.locator(".card.curvature .filters input").nth(2).fill("1");
  await page.click(".card.curvature .filters button");
  await page.waitForFunction(() => !document.querySelector(".card.curvature .body strong"), undefined, { timeout: 60000 });
  assert.match(await text(page, ".card.curvature .body"), /zero/);
});

test("structure, properties and motions come when they are in view", async () => {
  const page = await compute("space=so(3)&metric=diag(1,2,3)");
  await page.locator(".card.properties").scrollIntoViewIfNeeded();
  await page.waitForSelector(".card.properties .badge", { timeout: 60000 });
  await page.locator(".card.properties .badge.no").first().click();
  assert.match(await text(page, ".card.properties .witness"), /^It fails/);
  assert.ok(await page.locator(".card.properties .witness math").count(), "the witness is mathematics");
  await page.locator(".card.motions").scrollIntoViewIfNeeded();
  await page.waitForSelector(".card.motions svg.ball polygon", { timeout: 60000 });
  await page.locator(".card.structure").scrollIntoViewIfNeeded();
  await page.waitForSelector(".card.structure .badge.yes", { timeout: 60000 });
  await sound(page);
});

test("copies of a card", async () => {
  const page = await compute("space=so(3)&connection=plus", { permissions: ["clipboard-read", "clipboard-write"] });
  for (const [name, part] of [["LaTeX", "\\tau"], ["CSV", "tensor,i,j,k,l,value"], ["JSON", "affinor.table/1"], ["Python", "import affinor"], ["TOML", "structure_constants"]]) {
    await page.click(`.card.torsion .copies button:text-is("${name}")`);
    // the end of the computation may be told just after the copy
    await page.waitForFunction(async (part) => (await navigator.clipboard.readText()).includes(part), part, { timeout: 60000 });
  }
  await page.click('.card.torsion .copies button:text-is("CSV")');
  await page.waitForFunction(() => document.getElementById("say").textContent.includes("copied as CSV"), undefined, { timeout: 60000 });
  await page.click('.card.torsion .copies button:text-is("Link")');
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /card=torsion/);
});

test("a link opens the same state, and back and forward lead through states", async () => {
  const page = await compute("space=so(3)&connection=zero");
  await type(page, "sl(2)");
  await page.keyboard.press("Enter");
  await page.goto(page.url().replace(/#.*/, "#compute?space=se(2)"));
  await settled(page);
  assert.match(await text(page, "#read-as"), /^se\(2\)/);
  await page.goBack();
  await settled(page);
  assert.match(await text(page, "#read-as"), /^sl\(2\)/);
  // the title names the card of a link, until the state changes
  const card = await compute("space=so(3)&card=torsion");
  assert.equal(await card.title(), "Torsion of so(3) - affinor");
  await card.click("[aria-label=Connection] button:text-is('plus')");
  await settled(card);
  assert.equal(await card.title(), "so(3), plus - affinor");
});

test("a spacetime, and its letter", async () => {
  const page = await compute("space=Schwarzschild");
  assert.deepEqual(await formulas(page, "ricci"), ["Ric_jl = 0"]);
  assert.equal(await page.locator(".controls-of-space .letter").count(), 1);
});

for (const [name, options] of [["a phone", { viewport: PHONE }], ["a dark laptop", { colorScheme: "dark" }]]) {
  test(`nothing is cut, and axe objects to nothing, on ${name}`, async () => {
    const page = await compute("space=so(3)&metric=diag(a,b,c)", options);
    await sound(page);
    assert.deepEqual(await violations(page), []);
    await page.fill("#space-input", "nonsense");
    await page.waitForSelector(".refusal p");
    await sound(page);
    assert.deepEqual(await violations(page), []);
  });
}

test("claims about the structure are those of the Levi subalgebra, and of generic letters, where this is so", async () => {
  const page = await compute("space=se(3)"), card = page.locator(".card.structure");
  const shown = async (/** @type {RegExp} */ wanted) => {
    await card.scrollIntoViewIfNeeded();
    await card.locator(".facts").filter({ hasText: wanted }).first().waitFor({ timeout: 60000 });
    return (await card.innerText()).replaceAll("\n", " ");
  };
  assert.match(await shown(/Levi/), /simple ideals of the Levi subalgebra/);
  await type(page, "[x,y]=a z, [y,z]=x, [z,x]=y");
  assert.match(await shown(/A1/), /for generic values of a/);
  await type(page, "sl(3)");
  assert.doesNotMatch(await shown(/A2/), /simple ideals of the Levi|generic/);
});

test("a homogeneous space is read by the second module", async () => {
  const page = await compute("space=so(3)");
  await type(page, "CP^2");
  assert.match(await text(page, "#read-as"), /^SU\(3\)\/S\(U\(2\)xU\(1\)\)/);
  await type(page, "S^7 = Sp(2)/Sp(1)");
  assert.match(await text(page, "#read-as"), /dimension 7/);
  // its canonical connections have names of their own, and a diagonal metric is invariant
  const pressed = () => page.locator("[aria-label=Connection] [aria-pressed=true]").allTextContents();
  assert.deepEqual(await pressed(), ["natural"]);
  await page.click("[aria-label=Connection] button:text-is('canonical')");
  await settled(page);
  assert.deepEqual(await pressed(), ["canonical"]);
  assert.equal(await text(page, ".lambda output"), "λ = 0");
  assert.ok(await page.locator("[aria-label=Connection] button:text-is('plus')").isHidden());
  await page.click("[aria-label=Metric] button:text-is('diagonal')");
  await settled(page);
  assert.equal(await text(page, ".refusal"), "");
  assert.equal(await page.locator(".letter").count(), 1);
  await type(page, "sl(2)");
  assert.ok(await page.locator("[aria-label=Connection] button:text-is('zero')").isVisible());
  assert.match(await text(page, "#read-as"), /^sl\(2/);
  await sound(page);
});
