// What is sent: names by contents, compressed copies, sizes, and a page that opens without a network.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import zlib from "node:zlib";
import { test } from "node:test";
import { sound, visit, server } from "./visit.mjs";
import { dist, serve } from "./server.mjs";

const files = fs.readdirSync(dist, { recursive: true }).filter((name) => fs.statSync(path.join(dist, name)).isFile());
const plain = files.filter((name) => !/\.(br|gz)$/.test(name));
const read = (name) => fs.readFileSync(path.join(dist, name));

test("all but three files are in folders named by their contents", () => {
  assert.deepEqual(plain.filter((name) => !name.includes("/")).sort(), ["index.html", "paper.html", "sw.js"]);
  assert.ok(plain.filter((name) => name.includes("/")).every((name) => /^(page|engine)-[0-9a-f]{1,16}\//.test(name)));
  assert.equal(new Set(plain.filter((name) => name.includes("/")).map((name) => name.split("/")[0])).size, 2);
});

test("every file has compressed copies beside it, with the same contents", () => {
  for (const name of plain.filter((name) => !name.endsWith(".woff2") && read(name).length >= 500)) {
    assert.ok(zlib.brotliDecompressSync(read(`${name}.br`)).equals(read(name)), name);
    assert.ok(zlib.gunzipSync(read(`${name}.gz`)).equals(read(name)), name);
  }
});

test("scripts, styles and fonts stay within their budgets", () => {
  const size = (test) => plain.filter(test).reduce((sum, name) => sum + read(fs.existsSync(path.join(dist, `${name}.br`)) ? `${name}.br` : name).length, 0);
  const scripts = size((name) => /^page-.*\.(js|css)$/.test(name)), mathematics = size((name) => name.endsWith("/math.woff2")), text = size((name) => /\/text-.*\.woff2$/.test(name));
  console.log(`scripts and styles ${scripts} bytes, the font of mathematics ${mathematics}, of text ${text}`);
  assert.ok(scripts < 70_000, String(scripts));
  assert.ok(mathematics < 90_000, String(mathematics));
  assert.ok(text < 75_000, String(text));
});

test("mathematics is set in the font of the page, whatever the machine has", async () => {
  const page = await visit("#paper");
  await page.locator("#paper .entry:not([hidden])").first().waitFor();
  await page.evaluate(() => document.fonts.ready);
  const used = await page.context().newCDPSession(page).then(async (client) => {
    await client.send("DOM.enable");
    await client.send("CSS.enable");
    const { root } = await client.send("DOM.getDocument", { depth: -1 });
    const { nodeId } = await client.send("DOM.querySelector", { nodeId: root.nodeId, selector: "#paper article:not([hidden]) math mi" });
    return (await client.send("CSS.getPlatformFontsForNode", { nodeId })).fonts;
  });
  assert.ok(used.length > 0 && used.every(({ familyName, isCustomFont }) => isCustomFont && /STIX/.test(familyName)), JSON.stringify(used));
});

test("every character of the mathematics of the paper is in the font", async () => {
  const page = await visit("#paper/all");
  await page.locator("#paper .entry:not([hidden])").first().waitFor();
  const client = await page.context().newCDPSession(page);
  await client.send("DOM.enable");
  await client.send("CSS.enable");
  const { root } = await client.send("DOM.getDocument", { depth: -1 });
  const { nodeIds } = await client.send("DOM.querySelectorAll", { nodeId: root.nodeId, selector: "#paper article:nth-child(3n) math" });
  assert.ok(nodeIds.length > 50);
  const others = new Set();
  for (const nodeId of nodeIds) for (const { familyName, isCustomFont } of (await client.send("CSS.getPlatformFontsForNode", { nodeId })).fonts) if (!isCustomFont) others.add(familyName);
  assert.deepEqual([...others], []);
});

test("the page opens again without a network, in every view", async () => {
  const host = await serve(), page = await visit("", { serviceWorkers: "allow", at: host.address });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller);
  // no answer from anywhere: a service worker does not see the offline mode of a test
  host.close();
  await page.reload();
  await page.waitForFunction(() => document.querySelector("#contents li"));
  for (const [hash, part] of [["#explore/top", "#page .view svg"], ["#paper", "#paper .entry:not([hidden])"]]) {
    await page.goto(new URL(hash, host.address).href);
    await page.locator(part).first().waitFor();
  }
  await page.goto(new URL("paper.html#eq-1-4", host.address).href);
  assert.equal(await page.locator("article").count(), 83);
});

test("a visit asks for no file twice, and for none that is missing", async () => {
  const from = server.sent.length, page = await visit("#explore/torsion");
  await page.locator("#page .pictures").waitFor();
  await page.waitForTimeout(1200);
  const asked = server.sent.slice(from);
  assert.deepEqual(asked.filter(({ bytes }) => bytes === 0), []);
  assert.equal(new Set(asked.map(({ name }) => name)).size, asked.length);
  await sound(page);
});
