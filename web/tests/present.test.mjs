// Presentations, pictures and films out of the page, links, and the page of the paper.
import assert from "node:assert/strict";
import fs from "node:fs";
import { test } from "node:test";
import { compute } from "./computed.mjs";
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

test("slides grow with the screen, their heading centred over the picture", async () => {
  const sizes = {};
  for (const [width, height] of [[1366, 768], [1920, 1080], [3840, 2160]]) {
    const page = await visit("#explore/holonomy", { viewport: { width, height } });
    await page.locator("#page .pictures").waitFor();
    await open(page);
    sizes[width] = await page.locator("dialog").evaluate((dialog) => Object.fromEntries([".heading", ".words", ".formula math", ".readout", ".play", ".where"].map((part) => [part, parseFloat(getComputedStyle(dialog.querySelector(part)).fontSize)])));
    const middle = await page.locator("dialog .heading").evaluate((heading) => { const { left, right } = heading.getBoundingClientRect(); return (left + right) / 2; });
    assert.ok(Math.abs(middle - width / 2) < 2, `${middle} of ${width}`);
    await sound(page);
    await page.context().close();
  }
  assert.ok(sizes[1366][".formula math"] >= 28);
  for (const width of [1920, 3840]) for (const [part, size] of Object.entries(sizes[width])) assert.ok(size >= 0.99 * sizes[1366][part] * width / 1366, `${part} ${size} at ${width}`);
});

for (const [width, height] of [[1366, 768], [3840, 2160]]) {
  test(`every slide of se(3) is whole at ${width}, names its space, and offers the exports that it has`, { timeout: 300000 }, async () => {
    const page = await compute("space=se(3)&connection=zero", { viewport: { width, height } });
    await page.locator(".card.motions").scrollIntoViewIfNeeded();
    await page.waitForSelector(".card.motions .law math", { timeout: 60000 });
    await page.evaluate(() => scrollTo(0, 0));
    await open(page);
    const count = Number(/of (\d+)/.exec(await page.locator("dialog .where").innerText())[1]);
    for (let k = 0; k < count; k++) await page.keyboard.press("ArrowLeft");
    for (let k = 0; k < count; k++, await page.keyboard.press("ArrowRight")) {
      await page.waitForFunction(() => document.querySelector("dialog .card").dataset.key, undefined, { timeout: 60000 });
      const { title, cut, least, wide, exports } = await page.locator("dialog .slide").evaluate((slide) => ({
        title: slide.querySelector("h2").textContent, cut: slide.scrollHeight - slide.clientHeight,
        least: Math.min(...[...slide.querySelectorAll(".components > li > math")].filter((math) => math.checkVisibility()).map((math) => parseFloat(getComputedStyle(math).fontSize))),
        wide: [...slide.querySelectorAll(".components, .components > li, .matrix")].filter((part) => part.checkVisibility() && part.scrollWidth > part.clientWidth + 1).length,
        exports: [...document.querySelectorAll("dialog .bar button:not([hidden])")].map(({ textContent }) => textContent).filter((name) => /^(SVG|PNG|Film|LaTeX)$/.test(name)),
      }));
      assert.ok(cut <= 1 && wide === 0, `${title}: ${cut} px are cut, ${wide} parts are wider than their place`);
      assert.ok(least >= (title === "Motions" ? 25 : 27.9) * width / 1366, `${title} ${least}`);
      assert.match(await page.locator("dialog .of").innerText(), /^se\(3\), connection zero/);
      assert.deepEqual(exports, title === "Motions" ? ["SVG", "PNG", "Film"] : title === "Equations of motion" ? ["PNG"] : /^(Structure|Properties)$/.test(title) ? ["LaTeX"] : ["PNG", "LaTeX"], title);
    }
    // the last slide has a picture and formulas, and a film of its clock
    const [picture, law] = [await page.locator("dialog .ball").boundingBox(), await page.locator("dialog .law math").first().boundingBox()];
    assert.ok(picture.width > 0.2 * width && law.x >= picture.x + picture.width, `${JSON.stringify(picture)} ${JSON.stringify(law)}`);
    await sound(page);
    await page.context().close();
  });
}

test("a slide that is longer than the screen scrolls by its keys, and its formulas do not overlap", async () => {
  for (const viewport of [PHONE, LAPTOP]) {
    const page = await compute("space=se(3)&metric=diag(a,b,c,d,e,f)", { viewport });
    await page.locator(".card.connection .copies button").first().focus();
    await open(page);
    await page.locator("dialog .all").click();
    const { boxes, wide } = await page.locator("dialog .slide").evaluate((slide) => ({
      boxes: [...slide.querySelectorAll(".components > li > math")].map((math) => math.getBoundingClientRect()).map(({ left, right, top, bottom }) => ({ left, right, top, bottom })),
      wide: slide.scrollWidth - slide.clientWidth,
    }));
    assert.ok(boxes.length > 12 && wide <= 1, String(wide));
    for (const a of boxes) for (const b of boxes) assert.ok(a === b || a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 2 || b.bottom <= a.top + 2, JSON.stringify([a, b]));
    const name = await page.locator("dialog .where").innerText(), lower = await page.locator("dialog .slide").evaluate((slide) => slide.scrollHeight > slide.clientHeight + 1);
    await page.keyboard.press("PageDown");
    assert.equal(await page.locator("dialog .where").innerText() === name, lower);
    assert.deepEqual(await violations(page), []);
    await page.context().close();
  }
});

test("a formula is copied as LaTeX from its slide", async () => {
  const page = await compute("space=so(3)&connection=plus", { permissions: ["clipboard-read", "clipboard-write"] });
  await page.locator(".card.torsion .copies button").first().focus();
  await open(page);
  await page.locator("dialog [data-do=latex]").click();
  await page.waitForFunction(() => document.querySelector("dialog .where").textContent.includes("copied as LaTeX"), undefined, { timeout: 60000 });
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /\\tau/);
  await sound(page);
});

test("formulas leave a slide as PNG in its colours, with the font of the page and nothing beside them", async () => {
  const page = await compute("space=so(3)&metric=diag(a,b,c)");
  await page.locator(".card.ricci .copies button").first().focus();
  await open(page);
  /** Size of the picture, the colour of its corner and the fractions of its pixels that differ from it. */
  const look = async () => {
    const { bytes } = await file(page, "png");
    return page.evaluate(async (address) => {
      const image = new Image();
      image.src = address;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }), context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height), pixels = new Uint32Array(data.buffer);
      const inked = (from, to) => pixels.slice(from * image.width, to * image.width).filter((pixel) => pixel !== pixels[0]).length / pixels.length;
      return { width: image.width, height: image.height, corner: [...data.slice(0, 3)], ink: inked(0, image.height), edge: inked(0, 6) + inked(image.height - 6, image.height) };
    }, `data:image/png;base64,${bytes.toString("base64")}`);
  };
  const white = await look();
  assert.deepEqual(white.corner, [255, 255, 255]);
  assert.ok(white.width > 1500 && white.ink > 0.01 && white.ink < 0.3, JSON.stringify(white));
  assert.equal(white.edge, 0);
  await page.locator("dialog [data-do=scheme]").click();
  const black = await look();
  assert.deepEqual(black.corner, [0, 0, 0]);
  assert.deepEqual([black.width, black.height], [white.width, white.height]);
  await sound(page);
});

test("a slide of Explore leaves the page as one PNG, with its picture, its sentence and its formula", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  await open(page);
  const { name, bytes } = await file(page, "whole"), { y, height } = await page.locator("dialog .slide").boundingBox();
  assert.equal(name, "holonomy-is-area-slide.png");
  assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [3 * LAPTOP.width, Math.round(3 * (y + height))]);
  /** Whether each part of the slide is drawn in the picture. */
  const parts = await page.evaluate(async (address) => {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height }), context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return [".heading", ".view", ".words", ".formula", ".controls"].map((part) => {
      const { x, y, width, height } = document.querySelector(`dialog ${part}`).getBoundingClientRect();
      const pixels = new Uint32Array(context.getImageData(3 * x, 3 * y, 3 * width, 3 * height).data.buffer);
      return [part, pixels.some((pixel) => pixel !== 0xffffffff)];
    });
  }, `data:image/png;base64,${bytes.toString("base64")}`);
  assert.deepEqual(parts, [[".heading", true], [".view", true], [".words", true], [".formula", true], [".controls", false]]);
  await sound(page);
});

test("the values of a summary are in the order of their size, apart on a slide", async () => {
  const page = await compute("space=so(8)&connection=zero&card=curvature");
  const values = () => page.locator(".card.curvature .body > p.prose math").evaluateAll((all) => all.map((math) => math.getAttribute("alttext")));
  const sizes = (await values()).map((value) => value.split("/").map(Number)).map(([above, below = 1]) => above / below);
  assert.deepEqual(sizes, [...sizes].sort((a, b) => a - b));
  await page.locator(".card.curvature .copies button").first().focus();
  await open(page);
  const { math, words } = await page.locator("dialog .prose").first().evaluate((prose) => ({ math: parseFloat(getComputedStyle(prose.querySelector("math") ?? prose).fontSize), words: parseFloat(getComputedStyle(prose).fontSize) }));
  assert.ok(words >= 27 && math < 1.2 * words, `${math} in ${words}`);
});

test("the buttons of a slide are readable before they are used", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const page = await visit("#explore/holonomy", { colorScheme });
    await page.locator("#page .pictures").waitFor();
    await open(page);
    await page.waitForTimeout(300);
    assert.equal(await page.locator("dialog .bar").evaluate((bar) => getComputedStyle(bar).opacity), "1");
    assert.deepEqual(await violations(page), []);
    await page.context().close();
  }
});

test("a film leaves the picture as it was", async () => {
  const page = await visit("#explore/holonomy");
  await page.locator("#page .pictures").waitFor();
  await open(page);
  const picture = () => page.locator("dialog .view").innerHTML(), before = await picture();
  await file(page, "film");
  await page.waitForFunction(() => document.querySelector("dialog .where").textContent === "recorded");
  assert.equal(await picture(), before);
  await page.locator("dialog [data-do=scheme]").click();
  assert.equal(await picture(), before);
});

test("the motion of a body is filmed, and stays where it was", { timeout: 120000 }, async () => {
  const page = await compute("space=so(3)");
  await page.locator(".card.motions").scrollIntoViewIfNeeded();
  await page.waitForSelector(".card.motions .law math", { timeout: 60000 });
  await page.locator(".card.motions button:text-is('Step')").click();
  await open(page);
  const time = () => page.locator("dialog .buttons output").innerText(), before = await time();
  const film = await file(page, "film");
  assert.equal(film.bytes.subarray(0, 4).toString("hex"), "1a45dfa3");
  await page.waitForFunction(() => document.querySelector("dialog .where").textContent === "recorded");
  assert.equal(await time(), before);
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
    // a right formula with a refuted statement says which of them is right
    const marks = await page.locator("#paper .entry:has(> .findings .fails) h2").evaluateAll((all) => all.map((heading) => [...heading.querySelectorAll(".standing")].map(({ textContent }) => textContent)));
    assert.ok(marks.length === 24 && marks.every(([first]) => first !== "right"), JSON.stringify(marks));
    assert.ok(marks.filter(([first]) => first === "formula right").every(([, other]) => /^\d statements? refuted$/.test(other)));
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
  assert.ok(links.every((link) => /^(#|https:|\.\/#paper$)/.test(link)), links.find((link) => !/^(#|https:)/.test(link)));
  await page.locator("a[href='./#paper']").click();
  await page.locator("#paper .entry:not([hidden])").first().waitFor();
  await sound(page);
});

test("the whole document has the font and the sizes of the page", async () => {
  for (const [width, least] of [[1366, 16], [3840, 32]]) {
    const page = await visit("", { viewport: { width, height: 800 } });
    const missing = [];
    page.on("response", (response) => { if (response.status() >= 400) missing.push(response.url()); });
    await page.goto(new URL("paper.html", page.url()).href);
    await page.evaluate(() => document.fonts.ready);
    const { size, family, loaded } = await page.evaluate(() => ({ size: parseFloat(getComputedStyle(document.body).fontSize), family: getComputedStyle(document.body).fontFamily, loaded: document.fonts.check("16px 'Affinor Text'") }));
    assert.ok(size >= least, `${size} at ${width}`);
    assert.ok(loaded && /^"Affinor Text"/.test(family), family);
    assert.deepEqual(missing, []);
    await page.context().close();
  }
});

test("a document that does not load is told, with what to do", async () => {
  const page = await visit();
  await page.route("**/paper.html", (route) => route.fulfill({ status: 503, body: "" }));
  await page.evaluate(() => { location.hash = "#paper"; });
  await page.waitForFunction(() => document.querySelector("#paper .found")?.textContent.includes("did not load"));
  assert.match(await page.locator("#paper .found").innerText(), /503/);
});
