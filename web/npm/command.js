#!/usr/bin/env node
// @ts-check
// `affinor table so3 --show ricci`: the reports of the engine on the command line.
import { existsSync, readFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { AffinorError, report } from "./index.js";

const USAGE = `Usage: affinor REPORT [SPACE] [OPTIONS]

Reports: compare [SPACE SPACE], table, check, info, properties, equations SPACE,
         simulate FILE, list [TEXT], conventions
A SPACE is a name (so3, E8, "so3+R^3"), brackets "[x,y]=z", or a file: TOML, JSON, CSV, or a table of GAP, Sage or Maple.

  --connection C   levi-civita, plus, zero, minus, lambda=1/3
  --metric M       identity, killing, diag(a,b,c), or a matrix by rows
  --set LIST       values of parameters: a=1,b=2
  --show LIST      the tensors of a table: ricci,torsion
  --kind K         euler-poincare, autoparallel or transport, for equations
  --format F       text, markdown, latex, html, csv, json
  --version        the version

This is the engine compiled to WebAssembly. The full program is in the package affinor-cli of Rust and affinor of Python.`;
const REPORTS = ["compare", "table", "check", "info", "properties", "equations", "simulate", "list", "conventions"];

/** @typedef {import("./index.d.ts").Request} Request */

/** The words of a command line. @param {string[]} words */
function parsed(words) {
  const text = /** @type {const} */ ({ type: "string" }), flag = /** @type {const} */ ({ type: "boolean" });
  try {
    return parseArgs({
      args: words,
      allowPositionals: true,
      options: { connection: text, metric: text, set: text, show: text, kind: text, format: text, help: { ...flag, short: "h" }, version: flag },
    });
  } catch (error) {
    const option = /'(-[^' ]*)/.exec(/** @type {Error} */ (error).message)?.[1];
    if (option === "-o" || option === "--output") throw new TypeError("this package writes to standard output: redirect it, as in `> table.tex`");
    const fault = /** @type {any} */ (error).code === "ERR_PARSE_ARGS_UNKNOWN_OPTION" ? "unknown option" : "no value, or an unexpected one, for the option";
    throw new TypeError(option ? `${fault} \`${option}\`: see \`affinor --help\`` : "the options cannot be read: see `affinor --help`");
  }
}

/** @param {string[]} words @returns {Request | undefined} the request, or nothing for the help */
function read(words) {
  const { values: { kind, help, version: _, ...options }, positionals: [name, first, second, ...rest] } = parsed(words);
  if (help || name === undefined) return undefined;
  if (!REPORTS.includes(name)) throw new TypeError(`unknown report \`${name}\`: one of ${REPORTS.join(", ")}`);
  const extra = name === "compare" ? rest[0] : second;
  if (extra !== undefined) throw new TypeError(`unexpected argument \`${extra}\``);
  const given = Object.fromEntries(Object.entries({ ...options, motion: kind }).filter(([, value]) => value !== undefined));
  // the rows of a motion are too wide for a terminal
  const request = { format: name === "simulate" ? "csv" : "text", ...given };
  if (name === "simulate") {
    if (first === undefined) throw new TypeError("simulate needs the file of a problem");
    return /** @type {Request} */ ({ ...request, report: "motion", problem: readFileSync(first, "utf8") });
  }
  if (/\.(toml|json)$/.test(first ?? "")) {
    return /** @type {Request} */ ({ ...request, report: name, definition: readFileSync(first, "utf8") });
  }
  // a table in another notation
  if (name !== "list" && first !== undefined && /\.[A-Za-z]\w*$/.test(first) && existsSync(first)) {
    return /** @type {Request} */ ({ ...request, report: name, input: readFileSync(first, "utf8") });
  }
  return /** @type {Request} */ ({ ...request, report: name, space: first ?? "", other: second ?? "" });
}

/** @param {string[]} words @returns {Promise<number>} the exit status */
async function main(words) {
  try {
    if (words.includes("--version")) {
      console.log(`affinor ${JSON.parse(readFileSync(new URL("package.json", import.meta.url), "utf8")).version}`);
      return 0;
    }
    const request = read(words);
    if (!request) return console.log(USAGE), words.length ? 0 : 2;
    const { text, notes } = await report(request);
    notes.forEach((note) => console.error(`note: ${note}`));
    process.stdout.write(text);
    return 0;
  } catch (error) {
    if (!(error instanceof Error)) throw error;
    console.error(`error: ${error.message}`);
    if (error instanceof AffinorError) {
      const { place, help } = error;
      if (place) console.error(`  ${place.text}\n  ${" ".repeat(place.from)}${"^".repeat(Math.max(1, place.to - place.from))}`);
      if (help) console.error(`help: ${help}`);
    }
    return 2;
  }
}

process.exitCode = await main(process.argv.slice(2));
