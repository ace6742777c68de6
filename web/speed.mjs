// The engine in Chromium beside the program on one thread, in one run: AFFINOR_COMMAND=target/release/affinor node web/speed.mjs
import { execFileSync } from "node:child_process";
import { chromium } from "playwright-core";
import { serve } from "./tests/server.mjs";

const command = process.env.AFFINOR_COMMAND;
if (!command) throw new Error("AFFINOR_COMMAND names no program");
const RUNS = 5;
const CASES = [["so(6)", "identity", "curvature"], ["so(8)", "identity", "ricci"], ["su(4)", "identity", "curvature"], ["so(10)", "identity", "ricci"], ["E6", "", "killing"], ["so3", "diag(a,b,c)", "curvature"], ["se3", "[[a,0,0,0,0,0],[0,b,0,0,0,0],[0,0,c,0,0,0],[0,0,0,m,0,0],[0,0,0,0,m,0],[0,0,0,0,0,m]]", "curvature"]];

const server = await serve();
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage();
await page.goto(`${server.address}#report=conventions`);
console.log("| space | metric | tensor | browser, ms | program, ms | ratio |\n|---|---|---|---|---|---|");
for (const [space, metric, show] of CASES) {
  let inside = Infinity, outside = Infinity;
  for (let run = 0; run < RUNS; run++) {
    // alternately, so that both meet the same load
    inside = Math.min(inside, await page.evaluate(async (request) => {
      window.engine ??= new (await import("./engine-client.js")).Engine();
      return (await window.engine.ask(request)).ms;
    }, { report: "table", space, metric, show, format: "csv" }));
    const start = performance.now();
    execFileSync(command, ["table", space, ...(metric ? ["--metric", metric] : []), "--show", show, "--format", "csv", "--threads", "1"], { stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 });
    outside = Math.min(outside, performance.now() - start);
  }
  console.log(`| ${space} | ${metric.length > 14 ? "two blocks" : metric} | ${show} | ${inside.toFixed(1)} | ${outside.toFixed(1)} | ${(inside / outside).toFixed(2)} |`);
}
await browser.close();
server.close();
