// Checks the built site in Chromium, without a network:
//
//     node docs/site/check.mjs FOLDER [PICTURES]
//
// Every link leads to a page and an anchor; every page is at most two clicks from the index; no page is wider than its window; axe has no
// finding in light or dark; the search finds words. With PICTURES, a folder, it writes pictures of some pages at three widths. CHROMIUM is the
// browser; `npm ci` in web/ installs the packages.
import { existsSync, mkdirSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const packages = createRequire(process.env.WEB_PACKAGES ?? new URL("../../web/package.json", import.meta.url));
const { chromium } = packages("playwright-core");
const axe = readFileSync(packages.resolve("axe-core/axe.min.js"), "utf8");

const site = resolve(process.argv[2] ?? "target/site");
const pictures = process.argv[3];
const WIDTHS = [360, 1366, 1920];
const SCHEMES = ["light", "dark"];
/** Pages of the theme. */
const OTHERS = new Set(["search.html", "genindex.html", "py-modindex.html"]);
/** Folders that are not pages of the site. */
const SKIPPED = new Set(["_static", "_sources", "_images", "_downloads", "try", "static"]);
const PICTURED = ["index", "geometry", "mechanics", "connections", "python_tutorial", "motion", "gallery", "python", "paper", "translation",
  "how-to/choose-an-integrator", "catalogue", "formats", "notebooks/2_milnors_metrics"];

function pagesOf(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return SKIPPED.has(entry.name) ? [] : pagesOf(path);
    return entry.name.endsWith(".html") ? [relative(site, path)] : [];
  });
}

const found = [];
const report = (page, text) => found.push(`${page}: ${text}`);
const address = (page) => pathToFileURL(join(site, page)).href;

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const pages = pagesOf(site);
const links = new Map();
const anchors = new Map();

for (const scheme of SCHEMES) {
  const context = await browser.newContext({ colorScheme: scheme, reducedMotion: "reduce" });
  const tab = await context.newPage();
  let at = "";
  tab.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) report(at, `loads ${request.url()}`);
  });
  tab.on("pageerror", (error) => report(at, `script: ${error.message}`));
  for (const page of pages) {
    at = page;
    for (const width of WIDTHS) {
      await tab.setViewportSize({ width, height: 900 });
      if (width === WIDTHS[0]) await tab.goto(address(page));
      const wide = await tab.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      if (wide > 0) report(page, `${wide} pixels too wide at ${width}`);
      if (pictures && PICTURED.includes(page.replace(/\.html$/, ""))) {
        mkdirSync(pictures, { recursive: true });
        await tab.screenshot({ path: join(pictures, `${page.replace(/\.html$/, "").replaceAll("/", "-")}-${width}-${scheme}.png`) });
      }
    }
    await tab.evaluate(axe);
    const { violations } = await tab.evaluate(() => window.axe.run({ resultTypes: ["violations"] }));
    for (const { id, help, nodes } of violations) {
      report(page, `axe, ${scheme}: ${id}: ${help}: ${nodes.length} times, such as ${nodes[0].html.slice(0, 150)}`);
    }
    if (scheme === SCHEMES[0]) {
      links.set(page, await tab.$$eval("a[href], img[src]", (all) => [...new Set(all.map((link) => link.href || link.src))]));
      anchors.set(page, new Set(await tab.$$eval("[id]", (all) => all.map((element) => element.id))));
    }
  }
  await context.close();
}

// links, and the number of clicks from the index
const clicks = new Map([["index.html", 0]]);
for (const [page] of clicks) {
  for (const link of links.get(page) ?? []) {
    if (!link.startsWith("file:")) continue;
    const url = new URL(link);
    const target = relative(site, fileURLToPath(url));
    if (!clicks.has(target)) clicks.set(target, clicks.get(page) + 1);
  }
}
for (const [page, all] of links) {
  if (!OTHERS.has(page) && !(clicks.get(page) <= 2)) report(page, `${clicks.get(page) ?? "no number of"} clicks from the index`);
  for (const link of all) {
    if (!link.startsWith("file:")) continue;
    const url = new URL(link);
    const path = fileURLToPath(url);
    const target = relative(site, path);
    if (!existsSync(path)) report(page, `no file ${target}`);
    const anchor = decodeURIComponent(url.hash.slice(1));
    if (anchor && anchors.has(target) && !anchors.get(target).has(anchor)) report(page, `no anchor ${target}#${anchor}`);
  }
}

// the search
const tab = await browser.newPage();
for (const word of ["torsion", "quaternion", "Levi-Civita"]) {
  await tab.goto(`${address("search.html")}?q=${word}`);
  await tab.waitForSelector("#search-results li a", { timeout: 10000 }).catch(() => report("search.html", `finds nothing for ${word}`));
}
await browser.close();

if (found.length > 0) {
  console.error(found.join("\n"));
  process.exit(1);
}
console.log(`${pages.length} pages, ${[...links.values()].flat().length} links: no finding`);
