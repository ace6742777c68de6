// The package of npm, installed in a folder of its own, beside the program.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const root = path.join(import.meta.dirname, "..", "..");

let folder;
before(() => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "affinor-npm-"));
  execFileSync("python3", [path.join(root, "release/npm")]);
  const tarball = execFileSync("npm", ["pack", "--silent", path.join(root, "target/npm")], { cwd: folder, encoding: "utf8" }).trim();
  fs.writeFileSync(path.join(folder, "package.json"), "{}");
  execFileSync("npm", ["install", "--offline", "--no-audit", "--no-fund", tarball], { cwd: folder, stdio: "ignore" });
});
after(() => fs.rmSync(folder, { recursive: true }));

const installed = () => path.join(folder, "node_modules/.bin/affinor");
const affinor = (...words) => spawnSync(installed(), words, { cwd: folder, encoding: "utf8" });

test("the command prints what the program prints", () => {
  const native = process.env.AFFINOR_COMMAND;
  for (const words of [["table", "so3", "--metric", "diag(a,b,c)", "--show", "ricci"], ["info", "sl(2)"], ["compare"], ["list", "heisenberg"]]) {
    const { status, stdout } = affinor(...words);
    assert.equal(status, 0);
    assert.equal(stdout, execFileSync(native, words, { encoding: "utf8" }));
  }
  const rows = affinor("simulate", path.join(root, "examples/motions/heavy_top.toml")).stdout.split("\n");
  assert.ok(rows[0].startsWith("t,g11,") && rows.length > 3, rows[0]);
});

test("errors have a place, help and a status", () => {
  const refused = affinor("table", "so33");
  assert.equal(refused.status, 2);
  assert.match(refused.stderr, /^error: “so33” can be read as so\(33\) or so\(3,3\).*\n {2}so33\n {2}\^{4}\n/);
  for (const words of [["tables"], ["table", "so3", "E8"], ["simulate"], ["simulate", "nothing.toml"], ["table", "--colour"], []]) {
    assert.equal(affinor(...words).status, 2, words.join(" "));
  }
});

test("the module computes in Node", async () => {
  const { report, AffinorError } = await import(pathToFileURL(path.join(folder, "node_modules/affinor/index.js")).href);
  const [one, other] = await Promise.all([
    report({ report: "table", space: "so3@zero", show: "ricci", format: "json" }),
    report({ report: "info", space: "E8", format: "json" }),
  ]);
  assert.deepEqual(JSON.parse(one.text).tensors.ricci.components.map((row) => row.at(-1)), ["1/2", "1/2", "1/2"]);
  assert.equal(JSON.parse(other.text).dimension, 248);
  await assert.rejects(report({ report: "table", space: "so33" }), (error) => error instanceof AffinorError && error.place.to === 4);
});
