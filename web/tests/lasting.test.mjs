// The page lives on: random edits, a dead worker, back and forward, another window; and the values of random definitions.
import assert from "node:assert/strict";
import { test } from "node:test";
import { affinor, ask, needsCommand, open, settled, text } from "./browser.mjs";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

/** Numbers from 0 to 1, the same in every run: mulberry32. */
function random(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const EDITS = Number(process.env.EDITS ?? 1000);

test(`${EDITS} random edits: the page lives, the input is kept`, { timeout: 1800000 }, async () => {
  const page = await open("#report=table&space=so3&show=ricci");
  const result = await page.evaluate(async ([edits, seed]) => {
    let state = seed;
    const next = () => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return state / 2 ** 32; };
    const pick = (list) => list[Math.floor(next() * list.length)];
    const letters = [..."so(3)@zero;metric=diag[]{},.*/+-^1234567890abcxyz \n\"'=ßλ🙂"];
    const fields = ["space", "connection", "metric", "set", "show", "definition"];
    const whole = { space: ["so3", "sl(2)", "se(2)", "heisenberg(3)", "aff1"], connection: ["", "zero", "lambda=1/3", "levi-civita"], metric: ["", "identity", "diag(1,2,3)"], set: [""], show: ["ricci", "torsion", ""], definition: ["", 'basis = ["x", "y"]\nbrackets = "[x, y] = y"'] };
    let kept = 0;
    for (let k = 0; k < edits; k++) {
      const field = document.getElementById(pick(fields));
      const value = field.value, at = Math.floor(next() * (value.length + 1)), dice = next();
      let edited = dice < 0.5 ? value.slice(0, at) + pick(letters) + value.slice(at) : dice < 0.8 ? value.slice(0, at) + value.slice(at + 1) : pick(whole[field.id]);
      // long names would be large algebras
      if (edited.length > 60 && field.id !== "definition") edited = "";
      if (field.id === "space") edited = edited.replace(/\d{2,}|[4-9]/g, "3").slice(0, 16);
      field.value = edited;
      const shown = field.value;
      document.getElementById("form").requestSubmit();
      if (next() < 0.2) await new Promise((resolve) => setTimeout(resolve, 1));
      if (document.getElementById(field.id).value === shown) kept++;
    }
    return kept;
  }, [EDITS, 20130101]);
  assert.equal(result, EDITS);
  await settled(page);
  assert.deepEqual(page.problems, []);
  for (const [id, value] of [["definition", ""], ["metric", ""], ["set", ""], ["connection", "zero"], ["show", "ricci"], ["space", "so3"]]) {
    await page.evaluate(([id, value]) => { document.getElementById(id).value = value; }, [id, value]);
  }
  await page.click("button[type=submit]");
  await settled(page);
  assert.ok(await page.locator('#result math[alttext^="Ric_11 ="]').count());
});

test("back and forward through forty states, and a state in another window", async () => {
  const page = await open("#report=table&space=so3&show=ricci");
  const spaces = Array.from({ length: 40 }, (_, k) => ["so3", "sl(2)", "se(2)", "heisenberg(3)"][k % 4]);
  for (const space of spaces) {
    await page.fill("#space", space);
    await page.click("button[type=submit]");
    await settled(page);
  }
  const next = random(7);
  let at = spaces.length;
  // the first state was so3 already: it was replaced by the same address
  const states = ["so3", ...spaces.slice(1)];
  at = states.length - 1;
  for (let k = 0; k < 40; k++) {
    const back = at > 0 && (at === states.length - 1 || next() < 0.5);
    at += back ? -1 : 1;
    await (back ? page.goBack() : page.goForward());
    await settled(page);
    assert.equal(await page.inputValue("#space"), states[at]);
  }
  const [popup] = await Promise.all([page.context().waitForEvent("page"), page.evaluate(() => { window.open(location.href, "_blank", "noopener"); })]);
  await popup.waitForSelector("#result > *");
  assert.equal(await popup.inputValue("#space"), states[at]);
  assert.equal(await text(popup, "result"), await text(page, "result"));
});

/** The message that the engine was started anew, with the input in its field, and work that goes on. */
async function livesOn(page, space, reason) {
  await page.waitForFunction(() => document.getElementById("error").textContent.includes("started anew"), undefined, { timeout: 240000 });
  assert.equal(await page.inputValue("#space"), space);
  assert.match(await text(page, "error"), reason);
  assert.match(await text(page, "error"), /Your input is kept/);
  await page.fill("#space", "so3");
  await page.fill("#show", "ricci");
  await page.click("button[type=submit]");
  await settled(page);
  assert.match(await text(page, "result"), /so\(3\)/);
}

test("a worker that panics is started anew, and the input is kept", async () => {
  const context = await open().then((page) => page.context());
  const page = await context.newPage();
  // the engine dies at its first request for sl(2)
  await page.route("**/worker.js", async (route) => {
    const answer = await route.fetch();
    const died = 'console.error("panicked at src/lib.rs: a test"); throw new WebAssembly.RuntimeError("unreachable");';
    await route.fulfill({ response: answer, body: (await answer.text()).replace("const answer = call(", `if (request.space === "sl(2)") { ${died} }\n    const answer = call(`) });
  });
  await page.goto(new URL("#report=table&space=sl(2)&show=ricci", context.pages()[0].url()).href);
  await livesOn(page, "sl(2)", /panicked at/);
  await context.close();
});

test("work that needs more memory than a page has ends in a message, and the input is kept", { timeout: 300000 }, async () => {
  const page = await open("#report=table&space=so3&show=ricci");
  await page.evaluate(() => { location.hash = "#report=table&space=E8&connection=levi-civita&metric=identity&show=nabla_curvature"; });
  await livesOn(page, "E8", /more than 1 GiB of memory/);
});

test("a report too long for a page ends in a message, and work goes on", async () => {
  const page = await open("#report=table&space=so3&show=ricci");
  const [large, after] = await ask(page, [
    { report: "table", space: "E8", metric: "identity", show: "curvature", format: "json" },
    { report: "table", space: "so3@zero", show: "ricci", format: "text" },
  ]);
  assert.ok(large.problem, "a report of a million components is too long for a page");
  assert.match(after.text, /Ric_11/);
});

/** Brackets of a semidirect product of a line with R^(n-1): Jacobi holds for every matrix. */
function definition(next) {
  const n = 2 + Math.floor(next() * 4), labels = Array.from({ length: n }, (_, i) => `e${i + 1}`);
  const value = () => { const p = Math.floor(next() * 9) - 4; return next() < 0.5 ? `${p}` : `${p}/${1 + Math.floor(next() * 5)}`; };
  const brackets = labels.slice(1).map((label) => `[e1, ${label}] = ${labels.slice(1).map((other) => `(${value()})*${other}`).join(" + ")}`);
  const metric = next() < 0.6 ? `metric = "diag(${labels.map(() => 1 + Math.floor(next() * 5)).join(", ")})"\n` : "";
  const connection = metric && next() < 0.5 ? "" : `connection = "${["plus", "zero", "minus", `lambda = ${1 + Math.floor(next() * 5)}/7`][Math.floor(next() * 4)]}"\n`;
  return `name = "random"\nbasis = [${labels.map((label) => `"${label}"`).join(", ")}]\nbrackets = """\n${brackets.join("\n")}\n"""\n${metric}${connection}`;
}

test("the values of the program for the catalogue up to dimension 30 and 200 random definitions", { ...needsCommand, timeout: 1800000 }, async () => {
  const page = await open();
  const show = "structure,affinities,torsion,curvature,ricci,killing";
  const next = random(20130102), folder = fs.mkdtempSync(path.join(os.tmpdir(), "affinor-"));
  const files = Array.from({ length: 200 }, () => definition(next));
  const found = await ask(page, files.map((definition) => ({ report: "table", definition, show, format: "csv" })));
  files.forEach((text, at) => {
    const file = path.join(folder, `${at}.toml`);
    fs.writeFileSync(file, text);
    assert.equal(found[at].text, affinor("table", file, "--show", show, "--format", "csv"), text);
  });
  const examples = JSON.parse(affinor("list", "--format", "json")).spaces.map(({ example }) => example);
  const more = ["so(4)", "so(5)", "so(6)", "so(7)", "so(8)", "su(2)", "su(4)", "su(5)", "sl(3)", "sl(4)", "sl(5)", "sp(4)", "sp(6)", "gl(3)", "gl(4)", "gl(5)", "se(2)", "se(4)", "se(6)", "R^9", "heisenberg(7)", "heisenberg(29)", "A2", "A4", "B2", "B3", "C3", "D4", "G2", "filiform(30)", "t(5)", "so3+R^3"];
  const small = [...new Set([...examples, ...more])].filter((name) => {
    try { return JSON.parse(affinor("info", name, "--format", "json")).dimension <= 30; } catch { return false; }
  });
  const answers = await ask(page, small.map((space) => ({ report: "table", space, show, format: "csv" })));
  small.forEach((space, at) => assert.equal(answers[at].text, affinor("table", space, "--show", show, "--format", "csv"), space));
  fs.rmSync(folder, { recursive: true });
  console.log(`${small.length} names of the catalogue and ${files.length} definitions`);
  assert.ok(small.length > 40);
});
