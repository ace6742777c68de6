// The engine in Chromium beside the program on one thread, in one run: AFFINOR_COMMAND=target/release/affinor node web/speed.mjs
// A time of the program is that of the whole process, less the start of one.
import { spawnSync } from "node:child_process";
import { chromium } from "playwright-core";
import { serve } from "./tests/server.mjs";

const command = process.env.AFFINOR_COMMAND;
if (!command) throw new Error("AFFINOR_COMMAND names no program");
const RUNS = 15;
const CASES = [["so(8)", "identity", "ricci"], ["so(10)", "identity", "ricci"], ["so(10)", "identity", "curvature"], ["su(6)", "identity", "curvature"], ["E6", "", "curvature"], ["E7", "", "killing"], ["se3", "[[a,0,0,0,0,0],[0,b,0,0,0,0],[0,0,c,0,0,0],[0,0,0,m,0,0],[0,0,0,0,m,0],[0,0,0,0,0,m]]", "curvature"], ["so(4)", "[[a,b,c,0,0,0],[b,d,e,0,0,0],[c,e,f,0,0,0],[0,0,0,1,0,0],[0,0,0,0,1,0],[0,0,0,0,0,1]]", "ricci"]];

function time(words) {
  const before = performance.now();
  const { status, stderr } = spawnSync(command, words, { stdio: ["ignore", "ignore", "pipe"], encoding: "utf8" });
  if (status !== 0) throw new Error(stderr);
  return performance.now() - before;
}

const server = await serve();
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage();
await page.goto(`${server.address}#compute`);
console.log("| space | metric | tensor | browser, ms | program, ms | ratio |\n|---|---|---|---|---|---|");
for (const [space, metric, show] of CASES) {
  let inside = Infinity, outside = Infinity, start = Infinity;
  for (let run = 0; run < RUNS; run++) {
    // alternately, so that both meet the same load
    inside = Math.min(inside, await page.evaluate(async (request) => {
      const script = document.querySelector('script[type="module"]').src;
      window.engine ??= new (await import(new URL("engine-client.js", script).href)).Engine();
      return (await window.engine.ask(request)).ms;
    }, { report: "table", space, metric, show, format: "csv" }));
    start = Math.min(start, time(["--version"]));
    outside = Math.min(outside, time(["table", space, ...(metric ? ["--metric", metric] : []), "--show", show, "--format", "csv", "--threads", "1"]));
  }
  console.log(`| ${space} | ${metric.length > 14 ? "two blocks" : metric} | ${show} | ${inside.toFixed(1)} | ${(outside - start).toFixed(1)} | ${(inside / (outside - start)).toFixed(2)} |`);
}
// the promises of the page: so(3) within one frame of the screen, the first table within one second
const ask = (request) => page.evaluate(async (request) => (await window.engine.ask(request)).ms, request);
const times = [];
for (let k = 0; k <= 40; k++) times.push(await ask({ report: "table", space: "so3", connection: `lambda=${k}/40` }));
const cold = await (await browser.newContext()).newPage();
await cold.goto(`${server.address}#compute?space=so3&connection=zero`);
await cold.waitForSelector(".card .body math");
console.log(`\nso(3) in the worker: median ${times.sort((a, b) => a - b)[20].toFixed(1)} ms; first table after ${Math.round(await cold.evaluate(() => performance.now()))} ms at most`);
await browser.close();
server.close();
