// Parallel transport and motions, drawn, beside the numbers of the engine and of the program.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import { affinor, needsCommand, open, settled, text, violations } from "./browser.mjs";

const TRANSPORT = "#report=transport&path=0,0,0;1.5,0,0;0,1.5,0.6;0,0,0&vector=0,0,1";

/** The rows of the table of values. */
async function values(page) {
  if (!(await page.locator("#values").evaluate((box) => box.open))) await page.click("#values summary");
  await page.waitForSelector("#table tbody tr");
  return page.locator("#table tbody tr").evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
}

/** The vectors that arrive, by connection. */
async function ends(page) {
  const found = {};
  for (const [connection, , ...numbers] of await values(page)) found[connection] = numbers.map(Number).slice(3);
  return found;
}

test("a path carries a vector by three connections, as the program does", needsCommand, async () => {
  const page = await open(TRANSPORT);
  assert.equal(await page.locator("#view svg.ball").count(), 3);
  const found = await ends(page);
  // the arcs between the points, and the vector along them, by the program
  const numbers = (...words) => affinor(...words, "--format", "csv").trim().split("\n").at(-1).split(",").map(Number);
  const points = [[0, 0, 0], [1.5, 0, 0], [0, 1.5, 0.6], [0, 0, 0]];
  const arcs = points.slice(1).map((to, i) => numbers("compose", "so3", [...points[i].map((x) => -x), ...to].join(",")));
  for (const [connection, left] of Object.entries(found)) {
    const name = connection.split(" ").at(-1);
    const carried = numbers("transport", `so3@${name}`, "0,0,1", ...arcs.flatMap((arc) => ["--along", arc.join(",")]));
    carried.forEach((x, i) => assert.ok(Math.abs(x - left[i]) < 2e-6, `${connection}: ${carried} and ${left}`));
  }
  // minus keeps left components; the closed path returns to them
  assert.deepEqual(found["connection minus"], [0, 0, 1]);
  // plus has no curvature: around a closed path the vector returns
  found["M(3): connection plus"].forEach((x, i) => assert.ok(Math.abs(x - [0, 0, 1][i]) < 1e-6, `${x}`));
  // zero has curvature, and keeps the length
  const zero = found["SO(3): connection zero"];
  assert.ok(Math.abs(Math.hypot(...zero) - 1) < 1e-5 && Math.hypot(zero[0], zero[1]) > 0.1, `${zero}`);
  assert.deepEqual(page.problems, []);
});

test("the ball is turned, and the path drawn, by pointer and by keys", async () => {
  const page = await open(TRANSPORT);
  const picture = page.locator("#view svg.ball").first();
  const before = await picture.locator(".path").first().getAttribute("points");
  await picture.focus();
  await page.keyboard.press("ArrowRight");
  assert.notEqual(await picture.locator(".path").first().getAttribute("points"), before);
  // the end of the path, and another point
  await page.keyboard.press("Enter");
  await page.keyboard.press("Shift+ArrowUp");
  await settled(page);
  assert.equal((await page.inputValue("#path")).split(";").length, 5);
  assert.match(page.url(), /path=/);
  // a path by the pointer
  await page.click("text=Draw a path");
  const { x, y, width } = await picture.boundingBox();
  await page.mouse.move(x + 0.5 * width, y + 0.5 * width);
  await page.mouse.down();
  for (let k = 1; k <= 20; k++) await page.mouse.move(x + (0.5 + 0.25 * Math.sin(k / 4)) * width, y + (0.5 + 0.012 * k) * width);
  await page.mouse.up();
  await settled(page);
  assert.ok((await page.inputValue("#path")).split(";").length > 5);
  assert.match(await picture.getAttribute("aria-label"), /connection plus.*arrives at/);
  assert.equal(await text(page, "error"), "");
  assert.deepEqual(page.problems, []);
});

test("geodesics follow the entries of the metric", async () => {
  const page = await open(`${TRANSPORT}&metric=diag(1,1,1)`);
  const rays = () => page.locator("#view figure").nth(3).locator(".own, .ray").evaluateAll((lines) => lines.map((line) => line.getAttribute("points")));
  assert.equal(await page.locator("#view svg.ball").count(), 4);
  const round = await rays();
  // Levi-Civita of the round metric is zero: the same curves
  const zero = await page.locator("#view figure").nth(1).locator(".own, .ray").evaluateAll((lines) => lines.map((line) => line.getAttribute("points")));
  const far = (a, b) => Math.max(...a.flatMap((line, i) => line.split(/[ ,]/).map((x, k) => Math.abs(x - b[i].split(/[ ,]/)[k]))));
  assert.ok(far(round, zero) <= 0.2, String(far(round, zero)));
  await page.locator(".moment").nth(2).focus();
  for (let k = 0; k < 20; k++) await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.equal(await page.inputValue("#metric"), "diag(1, 1, 3)");
  // a moment of 3 about the third axis: the rays from e along the axes stay one-parameter groups
  assert.deepEqual(page.problems, []);
  await page.fill("#vector", "0.5, 0, 1");
  await page.click("button[type=submit]");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  // another direction: the geodesic leaves the one-parameter group
  const own = (at) => page.locator("#view figure").nth(at).locator(".own").evaluateAll((lines) => lines.map((line) => line.getAttribute("points")));
  assert.notDeepEqual(await own(3), await own(1));
});

test("a motion is the run of the program on the copied file", needsCommand, async () => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "affinor-"));
  const page = await open("#report=motion", { permissions: ["clipboard-read", "clipboard-write"] });
  for (const example of ["free body", "heavy top", "body in a fluid"]) {
    await page.selectOption("#example", example);
    await settled(page);
    // another velocity, by its slider
    await page.focus("#parameter-w2");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    await settled(page);
    assert.equal(await text(page, "error"), "", example);
    await page.click('#copies button:text-is("toml")');
    await page.waitForFunction(() => document.getElementById("status").textContent === "copied as toml");
    const file = path.join(folder, "problem.toml");
    fs.writeFileSync(file, await page.evaluate(() => navigator.clipboard.readText()));
    const rows = affinor("simulate", file, "--format", "csv").trim().split("\n");
    const shown = await values(page);
    assert.equal(shown.length, rows.length - 1, example);
    // the same to rounding: sin and cos of the machine and of the browser differ in the last bit
    const [last, own] = [rows.at(-1).split(",").map(Number), shown.at(-1).map(Number)];
    last.forEach((x, i) => assert.ok(Math.abs(x - own[i]) <= 1e-9 * (1 + Math.abs(x)), `${example}: ${last} and ${own}`));
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("text=Download")]);
    assert.equal(fs.readFileSync(await download.path(), "utf8"), fs.readFileSync(file, "utf8"));
  }
  fs.rmSync(folder, { recursive: true });
  assert.deepEqual(page.problems, []);
});

test("a motion is played, stepped through, and compared by methods", async () => {
  const page = await open("#report=motion");
  const clock = () => page.locator("#view output").innerText();
  await page.click("text=Step");
  assert.equal(await clock(), "t = 0.1");
  await page.click("text=Back");
  assert.equal(await clock(), "t = 0");
  await page.click("text=Play");
  await page.waitForFunction(() => document.querySelector("#view output").textContent !== "t = 0");
  await page.click("text=Pause");
  const there = await clock();
  await page.waitForTimeout(200);
  assert.equal(await clock(), there);
  // Moser-Veselov keeps the energy of the free body up to bounded oscillations; Runge-Kutta drifts, and keeps more digits
  const cells = await page.locator("#view tbody tr").evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  assert.deepEqual(cells.map(([method]) => method), ["dmv10", "rkmk4", "projected4", "cf4"]);
  const heads = await page.locator("#view thead th").allInnerTexts();
  const energy = Object.fromEntries(cells.map((row) => [row[0], Number(row[heads.indexOf("energy")])]));
  assert.ok(energy.dmv10 < 1e-12 && energy.cf4 > 1e-9 && energy.rkmk4 > 1e-9, JSON.stringify(energy));
});

test("with reduced motion nothing runs smoothly", async () => {
  const page = await open("#report=motion", { reducedMotion: "reduce" });
  await page.click("text=Play");
  const seen = new Set();
  for (let k = 0; k < 22; k++) {
    seen.add(await page.locator("#view output").innerText());
    await page.waitForTimeout(50);
  }
  // a step a second
  assert.ok(seen.size <= 3, [...seen].join());
});

test("pictures have words, and no violation of accessibility", async () => {
  for (const [width, colorScheme] of [[360, "light"], [800, "dark"], [1600, "light"], [1600, "dark"]]) {
    for (const hash of [`${TRANSPORT}&metric=diag(1,2,3)`, "#report=motion"]) {
      const page = await open(hash, { viewport: { width, height: 900 }, colorScheme });
      if (process.env.SCREENSHOTS) await page.screenshot({ path: path.join(process.env.SCREENSHOTS, `${hash.slice(8, 14)}-${width}-${colorScheme}.png`), fullPage: true });
      await values(page);
      assert.deepEqual(await violations(page), [], `${width} ${colorScheme} ${hash}`);
      const silent = await page.locator("#view svg:not([aria-label])").count();
      assert.equal(silent, 0);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${width} ${hash}`);
      await page.context().close();
    }
  }
});

test("moments move one entry of the metric, and show what it is", async () => {
  const page = await open("#report=transport&metric=diag(10,1/2,1)");
  const slider = page.locator(".moment").nth(1);
  assert.equal(await slider.inputValue(), "0.5");
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await settled(page);
  assert.equal(await page.inputValue("#metric"), "diag(10, 0.6, 1)");
  await page.fill("#metric", "[[2,1,0],[1,3,0],[0,0,4]]");
  await page.press("#metric", "Enter");
  await settled(page);
  assert.equal(await slider.inputValue(), "3");
  await slider.focus();
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  assert.equal(await page.inputValue("#metric"), "[[2, 1, 0], [1, 2.9, 0], [0, 0, 4]]");
});

test("points of a path that are not moved keep their digits, at the rim of the ball too", async () => {
  const page = await open("#report=transport&path=0,0,0; 0,0,3.14159265; 0.33333333,0,0");
  await page.locator("#view svg.ball").first().focus();
  await page.keyboard.press("Shift+ArrowRight");
  await settled(page);
  assert.equal(await text(page, "error"), "");
  assert.match(await page.inputValue("#path"), /^0, 0, 0; 0, 0, 3\.14159265; /);
  // the place of a mistake is that in the whole path
  await page.fill("#path", "0,0,0; 1.5,q,0; 0,0,1");
  await page.press("#path", "Enter");
  await settled(page);
  assert.equal(await page.locator("#path").evaluate((input) => input.value.slice(input.selectionStart, input.selectionEnd)), "q");
});

test("methods of a link, reasons of methods, and problems of one's own", async () => {
  const page = await open("#report=motion&methods=rkmk4");
  assert.equal(await page.inputValue("#methods"), "rkmk4");
  assert.match(await page.locator("#view .table").innerText(), /rkmk4/);
  const mine = 'space = "so3"\nmetric = "diag(1, 2, 3)"\n[parameters] # two\n w = 6e-1\n[initial]\nvelocity = ["w", 0.1, 0.2]\n[output]\nend = 1\nevery = 0.5\n';
  await page.click("#problem-field summary");
  await page.fill("#problem", mine);
  await page.press("#methods", "Enter");
  await settled(page);
  assert.equal(await page.inputValue("#example"), "");
  assert.equal(await page.inputValue("#parameter-w"), "0.6");
  assert.match(await page.locator("#view .table").innerText(), /rkmk4 .*step/i);
  await page.selectOption("#example", "heavy top");
  await settled(page);
  await page.goBack();
  await settled(page);
  assert.equal(await page.inputValue("#problem"), mine);
  assert.deepEqual(page.problems, []);
});

test("a long table shows its beginning", async () => {
  const page = await open("#report=motion");
  const problem = (await page.inputValue("#problem")).replace(/end\s*=\s*\S+/, "end = 300").replace(/every\s*=\s*\S+/, "every = 0.1");
  await page.fill("#methods", "");
  await page.click("#problem-field summary");
  await page.fill("#problem", problem);
  await page.press("#methods", "Enter");
  await settled(page);
  await page.click("#values summary");
  await page.waitForFunction(() => document.querySelectorAll("#table tr").length > 1000);
  assert.match(await text(page, "table"), /The first 2000 of 3001 rows/);
});
