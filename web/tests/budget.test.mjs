// The size of the built page, without a browser.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import zlib from "node:zlib";
import { test } from "node:test";
import { dist } from "./server.mjs";

test("what is sent stays within the budget", () => {
  const size = (name) => zlib.brotliCompressSync(fs.readFileSync(path.join(dist, name))).length;
  const module = size("engine_bg.wasm");
  const rest = fs.readdirSync(dist).filter((name) => !name.endsWith(".wasm")).reduce((sum, name) => sum + size(name), 0);
  console.log(`engine ${module} bytes with brotli, everything else ${rest}`);
  assert.ok(module < 1_500_000, String(module));
  assert.ok(rest < 40_000, String(rest));
});
