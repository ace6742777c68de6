// Presentations, pictures and films out of the page, links, and the page of the paper.
import assert from "node:assert/strict";
import fs from "node:fs";
import { test } from "node:test";
import { LAPTOP, PHONE, sound, violations, visit } from "./visit.mjs";

const open = async (page) => {
  await page.keyboard.press("p");
  await page.locator("dialog.presenting[open]").waitFor();
};
const file = async (page, name) => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator(`dialog [data-do=${name}]`).click()]);
  return { name: download.suggestedFilename(), bytes: fs.readFileSync(await download.path()) };
};

test("P shows the stage over the whole screen, on black and white, still alive, and Escape puts it back", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  await open(page);
  const { width, height } = await page.locator("dialog").boundingBox();
  assert.ok(width >= LAPTOP.width && height >= LAPTOP.height);
  const ground = () => page.locator("dialog").evaluate((dialog) => getComputedStyle(dialog).backgroundColor);
  assert.equal(await ground(), "rgb(255, 255, 255)");
  await page.locator("dialog [data-do=scheme]").click();
  assert.equal(await ground(), "rgb(0, 0, 0)");
  const range = page.locator("dialog .range input"), before = await page.locator("dialog .view").innerHTML();
  await range.focus();
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction((before) => document.querySelector("dialog .view").innerHTML !== before, before);
  assert.deepEqual(await violations(page), []);
  await page.keyboard.press("Escape");
  await page.locator("#page .stage .view").waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.scheme), undefined);
  await sound(page);
});

test("P is a letter where text is typed", async () => {
  const page = await visit();
  await page.locator("#box :is(input, textarea)").first().focus();
  await page.keyboard.press("p");
  await page.waitForTimeout(200);
  assert.equal(await page.locator("dialog[open]").count(), 0);
});

test("arrow keys go through the cards of the paper, with mathematics of 28 pixels", async () => {
  const page = await visit("#paper");
  await page.locator("#paper .entry:not([hidden])").first().waitFor();
  await page.locator("#paper h1").click();
  await open(page);
  assert.match(await page.locator("dialog .where").innerText(), /^1 of /);
  const first = await page.locator("dialog .entry").getAttribute("id");
  await page.keyboard.press("ArrowRight");
  assert.match(await page.locator("dialog .where").innerText(), /^2 of /);
  assert.notEqual(await page.locator("dialog .entry").getAttribute("id"), first);
  assert.equal(await page.locator("dialog math").first().evaluate((math) => getComputedStyle(math).fontSize), "28px");
  await page.keyboard.press("ArrowLeft");
  assert.equal(await page.locator("dialog .entry").getAttribute("id"), first);
  const order = await page.evaluate(() => document.querySelectorAll("#paper .entry").length);
  await page.keyboard.press("Escape");
  assert.equal(await page.evaluate(() => document.querySelectorAll("#paper .entry").length), order + 1);
  await sound(page);
});

test("a picture leaves the page as SVG with its colours, as PNG and as a film", async () => {
  const page = await visit();
  await open(page);
  const svg = await file(page, "svg");
  assert.match(svg.name, /\.svg$/);
  const text = svg.bytes.toString();
  assert.ok(!/var\(|class="(?!")|light-dark/.test(text));
  assert.ok((text.match(/<svg/g) ?? []).length === 4 && /rgb\(/.test(text));
  // a picture alone, outside of the page
  const drawn = await page.evaluate(async (text) => {
    const image = new Image();
    image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: 300, height: 100 }), context = canvas.getContext("2d");
    context.drawImage(image, 0, 0, 300, 100);
    return new Set(new Uint32Array(context.getImageData(0, 0, 300, 100).data.buffer)).size;
  }, text);
  assert.ok(drawn > 500, String(drawn));
  const png = await file(page, "png");
  assert.equal(png.bytes.subarray(1, 4).toString(), "PNG");
  assert.ok(png.bytes.length > 20_000);
  const film = await file(page, "film");
  assert.match(film.name, /\.webm$/);
  assert.equal(film.bytes.subarray(0, 4).toString("hex"), "1a45dfa3");
  assert.ok(film.bytes.length > 5000, String(film.bytes.length));
  await sound(page);
});

test("Share copies the link, over plain http as well", async () => {
  const page = await visit("#explore/torsion?v=20", { permissions: ["clipboard-read", "clipboard-write"] });
  await page.locator("#page .pictures").waitFor();
  await page.locator("#share").click();
  await page.waitForFunction(() => document.getElementById("say").textContent.includes("copied"));
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), page.url());
  // where the clipboard is missing, as over plain http from another host
  await page.evaluate(() => {
    Object.defineProperty(navigator, "clipboard", { value: undefined });
    document.getElementById("say").textContent = "";
    document.addEventListener("copy", () => { window.copied = document.activeElement.value ?? String(getSelection()); }, { once: true });
  });
  await page.locator("#share").click();
  await page.waitForFunction(() => document.getElementById("say").textContent.includes("copied"));
  assert.equal(await page.evaluate(() => window.copied), page.url());
  await sound(page);
});

test("the paper lists the 24 refuted statements, names its entries, and finds words", async () => {
  for (const viewport of [PHONE, LAPTOP]) {
    const page = await visit("#paper", { viewport });
    await page.locator("#paper .entry:not([hidden])").first().waitFor();
    assert.match(await page.locator("#paper .claim").innerText(), /no connection and no metric of its own/);
    const count = (selector) => page.locator(selector).evaluateAll((all) => all.filter((x) => x.checkVisibility()).length);
    assert.match(await page.locator("#paper .found").innerText(), /^24 refuted statements/);
    assert.equal(await count("#paper .entry > .findings .fails"), 24);
    await page.locator("#paper [value=all]").check({ force: true });
    assert.equal(await count("#paper .entry"), 83);
    const names = await page.locator("#paper h2 .name").allInnerTexts();
    assert.equal(new Set(names).size, 83);
    await page.locator("#paper [name=find]").fill("rodrigues");
    assert.equal(await count("#paper .entry"), 1);
    await page.locator("#paper [name=find]").fill("");
    assert.deepEqual(await violations(page), []);
    await sound(page);
    await page.context().close();
  }
});

test("words that are only in entries of another choice are told, with a button to them", async () => {
  const page = await visit("#paper"), found = page.locator("#paper .found");
  await page.locator("#paper .entry:not([hidden])").first().waitFor();
  await page.locator("#paper [name=find]").fill("Rodrigues");
  assert.match(await found.innerText(), /^0 refuted statements in 0 entries; the words are in 1 more entry\./);
  await found.locator("button").focus();
  await page.keyboard.press("Enter");
  assert.equal(await found.innerText(), "1 entry");
  assert.equal(await page.evaluate(() => document.activeElement.value), "all");
  assert.equal(await page.locator("#paper .entry:not([hidden])").count(), 1);
  await page.locator("#paper [name=find]").fill("no such words");
  assert.equal(await found.innerText(), "0 entries");
  await sound(page);
});

test("a presentation begins with the entry of the link", async () => {
  const page = await visit("#paper/eq-4-10");
  await page.locator("#eq-4-10 details[open]").waitFor();
  await open(page);
  assert.equal(await page.locator("dialog .entry").getAttribute("id"), "eq-4-10");
  await page.keyboard.press("Escape");
  await sound(page);
});

test("an entry has a link of its own, and the whole document is beside the page", async () => {
  const page = await visit("#paper/eq-4-10");
  await page.locator("#eq-4-10 details[open]").waitFor();
  assert.ok(await page.locator("#eq-4-10").isVisible());
  await page.locator("#paper .whole").click();
  await page.waitForURL(/paper\.html$/);
  assert.equal(await page.locator("article").count(), 83);
  // no link leads into a repository that a reader does not have
  const links = await page.locator("a").evaluateAll((all) => all.map((a) => a.getAttribute("href")));
  assert.ok(links.every((link) => /^(#|https:)/.test(link)), links.find((link) => !/^(#|https:)/.test(link)));
});

test("a document that does not load is told, with what to do", async () => {
  const page = await visit();
  await page.route("**/paper.html", (route) => route.fulfill({ status: 503, body: "" }));
  await page.evaluate(() => { location.hash = "#paper"; });
  await page.waitForFunction(() => document.querySelector("#paper .found")?.textContent.includes("did not load"));
  assert.match(await page.locator("#paper .found").innerText(), /503/);
});
