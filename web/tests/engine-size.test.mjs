// The sizes of the modules of the engine, as they are sent, compressed by the build.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { dist } from "./server.mjs";

test("the modules of the engine stay within their budgets", () => {
  const folder = fs.readdirSync(dist).find((name) => name.startsWith("engine-"));
  const size = (name) => fs.statSync(path.join(dist, folder, `${name}.br`)).size;
  const [tables, engine, representations] = ["tables_bg.wasm", "engine_bg.wasm", "representations_bg.wasm"].map(size);
  console.log(`with brotli: tables ${tables} bytes, the whole engine ${engine}, representations ${representations}`);
  assert.ok(tables < 700_000, String(tables));
  assert.ok(engine < 1_500_000, String(engine));
  assert.ok(representations < 560_000, String(representations));
});
