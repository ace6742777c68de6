// @ts-check
// The metric as a grid of numbers and letters, which writes its text.

import { element, letter } from "./dom.js";

/** The largest grid. */
export const LARGEST = 8;

/** The entries of a metric that is written as `identity`, `diag(..)` or `[[..], ..]`; else nothing. @param {string} text @param {number} n @returns {string[][] | undefined} */
export function entries(text, n) {
  const unit = (/** @type {number} */ i, /** @type {number} */ j) => (i === j ? "1" : "0");
  const made = (/** @type {(i: number, j: number) => string} */ at) => Array.from({ length: n }, (_, i) => Array.from({ length: n }, (_, j) => at(i, j)));
  if (/^(identity)?$/.test(text)) return made(unit);
  const diagonal = /^diag\((.*)\)$/s.exec(text);
  if (diagonal) {
    const found = diagonal[1].split(",").map((entry) => entry.trim());
    return found.length === n ? made((i, j) => (i === j ? found[i] : "0")) : undefined;
  }
  const rows = /^\[\s*\[(.*)\]\s*\]$/s.exec(text)?.[1].split(/\]\s*,\s*\[/).map((row) => row.split(",").map((entry) => entry.trim()));
  return rows?.length === n && rows.every((row) => row.length === n) ? rows : undefined;
}

/** The text of entries: `diag(..)` where it can be. @param {string[][]} rows */
export function written(rows) {
  const isDiagonal = rows.every((row, i) => row.every((entry, j) => i === j || entry === "0"));
  return isDiagonal ? `diag(${rows.map((row, i) => row[i]).join(", ")})` : `[${rows.map((row) => `[${row.join(", ")}]`).join(", ")}]`;
}

export class Grid {
  #box;
  #changed;

  /** @param {HTMLElement} box @param {(metric: string) => void} changed */
  constructor(box, changed) {
    this.#box = box;
    this.#changed = changed;
  }

  /** The grid of a metric in a basis. @param {string[]} basis @param {string[][]} rows */
  show(basis, rows) {
    const table = element("table", {}, element("caption", { class: "hidden", text: "entries of the metric" }));
    const head = element("tr", {}, element("td"), ...basis.map((name) => element("th", { scope: "col" }, letter(name))));
    /** @type {HTMLInputElement[][]} */
    const inputs = rows.map((row, i) => row.map((value, j) => {
      const input = element("input", { value, spellcheck: false, autocomplete: "off", size: 4, "aria-label": `g ${basis[i]} ${basis[j]}` });
      input.addEventListener("input", () => {
        // a metric is symmetric
        if (i !== j) inputs[j][i].value = input.value;
        this.#changed(written(inputs.map((row) => row.map(({ value }) => value.trim() || "0"))));
      });
      return input;
    }));
    table.append(head, ...inputs.map((row, i) => element("tr", {}, element("th", { scope: "row" }, letter(basis[i])), ...row.map((input) => element("td", {}, input)))));
    this.#box.replaceChildren(table);
  }
}
