// Writes the first screen into page/index.html, as it is drawn before any script has run: `node web/first.mjs`; a test compares it.
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { markup, start } from "./page/explore/stage.js";
import spec from "./page/explore/parallel.js";

const file = path.join(import.meta.dirname, "page/index.html");

/** The document with its first screen. */
export function drawn() {
  const screen = markup(spec, start(spec), "hero");
  return fs.readFileSync(file, "utf8").replace(/<!-- first screen -->.*<!-- \/first screen -->/s, () => `<!-- first screen -->${screen}<!-- /first screen -->`);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) fs.writeFileSync(file, drawn());
