// The page lives on: random edits, a dead worker, back and forward, another window; and the values of random definitions.
import assert from "node:assert/strict";
import { test } from "node:test";
import { affinor, ask, compute, formulas, needsCommand, settled, text, type } from "./computed.mjs";
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
  const page = await compute("space=so(3)");
  const kept = await page.evaluate(async ([edits, seed]) => {
    let state = seed;
    const next = () => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return state / 2 ** 32; };
    const pick = (list) => list[Math.floor(next() * list.length)];
    const letters = [..."so(3)@zero;metric=diag[]{},.*/+-^1234567890abcxyz \n\"'=ßλ🙂"];
    const whole = ["so(3)", "sl(2)", "SE(2)", "Heisenberg", "aff1", "[x,y]=z", "(0,0,12)", "[[0,1],[0,0]]", "basis = [\"x\"]", "so3@plus"];
    const field = document.getElementById("space-input");
    let kept = 0;
    for (let k = 0; k < edits; k++) {
      const value = field.value, at = Math.floor(next() * (value.length + 1)), dice = next();
      let edited = dice < 0.5 ? value.slice(0, at) + pick(letters) + value.slice(at) : dice < 0.8 ? value.slice(0, at) + value.slice(at + 1) : pick(whole);
      // long names would be large algebras
      if (edited.length > 60) edited = "";
      edited = edited.replace(/\d{2,}|[4-9]/g, "3");
      field.value = edited;
      field.dispatchEvent(new Event("input", { bubbles: true }));
      if (next() < 0.1) document.getElementById("box").requestSubmit();
      if (next() < 0.05) for (const chip of [...document.querySelectorAll(".controls-of-space .chip:not(:disabled)")].slice(0, 3)) chip.click();
      if (next() < 0.2) await new Promise((resolve) => setTimeout(resolve, 5));
      if (field.value === edited) kept++;
    }
    return kept;
  }, [EDITS, 20130101]);
  assert.equal(kept, EDITS);
  await type(page, "sl(2)");
  assert.deepEqual(page.problems, []);
  assert.match(await text(page, "#read-as"), /^sl\(2\)/);
  assert.equal(await text(page, ".refusal"), "");
});

test("back and forward through states, and a state in another window", async () => {
  const page = await compute("space=so(3)");
  const names = ["sl(2)", "se(2)", "heisenberg(3)", "su(2)", "aff(1)", "R^3"];
  for (const name of names) {
    await page.evaluate((name) => { location.hash = `#compute?space=${name}`; }, name);
    await settled(page);
  }
  const states = ["so(3)", ...names], next = random(7);
  let at = states.length - 1;
  for (let k = 0; k < 20; k++) {
    const back = at > 0 && (at === states.length - 1 || next() < 0.5);
    at += back ? -1 : 1;
    await (back ? page.goBack() : page.goForward());
    await settled(page);
    assert.equal(await page.inputValue("#space-input"), states[at]);
  }
  const [other] = await Promise.all([page.context().waitForEvent("page"), page.evaluate(() => { window.open(location.href, "_blank", "noopener"); })]);
  await settled(other);
  assert.equal(await other.inputValue("#space-input"), states[at]);
  assert.deepEqual(await formulas(other, "brackets"), await formulas(page, "brackets"));
});

/** The message that the computation failed, with the input in its field, and work that goes on. */
async function livesOn(page, space, reason) {
  await page.waitForFunction(() => document.querySelector(".refusal")?.textContent.includes("The computation failed"), undefined, { timeout: 240000 });
  assert.equal(await page.inputValue("#space-input"), space);
  assert.match(await text(page, ".refusal"), reason);
  assert.match(await text(page, ".refusal"), /Your input is kept/);
  await type(page, "so(3)");
  assert.match(await text(page, "#read-as"), /^so\(3\)/);
}

test("a worker that panics is started anew, and the input is kept", async () => {
  const page = await compute("space=so(3)");
  // the engine dies at its first request for sl(2)
  await page.route("**/worker.js", async (route) => {
    const answer = await route.fetch();
    const died = 'console.error("panicked at src/lib.rs: a test"); throw new WebAssembly.RuntimeError("unreachable");';
    await route.fulfill({ response: answer, body: (await answer.text()).replace("      answer();", `      if (request.input === "sl(2)") { ${died} }\n      answer();`) });
  });
  await page.goto(page.url().replace(/#.*/, "?again#compute?space=sl(2)"));
  await livesOn(page, "sl(2)", /panicked at/);
});

test("work that needs more memory than a page has is told as that, and the input is kept", { timeout: 600000 }, async () => {
  // a full symbolic metric of dimension 8: one block of more than 200 MB fails when 800 MB are in use
  const letters = "abcdfghijkmnopqrtuvwxyzABCDEFGHIJKLM";
  let at = 0;
  const rows = Array.from({ length: 8 }, () => Array.from({ length: 8 }, () => ""));
  for (let i = 0; i < 8; i++) for (let j = i; j < 8; j++) rows[i][j] = rows[j][i] = `q${letters[at++]}`;
  const metric = `[${rows.map((row) => `[${row.join(",")}]`).join(",")}]`;
  const page = await compute("space=so(3)");
  await page.evaluate((metric) => { location.hash = `#compute?space=su(3)&metric=${metric}`; }, metric);
  await livesOn(page, "su(3)", /memory/);
});

test("a report too long for a page ends in a message, and work goes on", async () => {
  const page = await compute("space=so(3)");
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
  const page = await compute("space=so(3)");
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
