// @ts-check
// Letters: each one is a slider with a number, or stays a letter.
import { button, element, letter } from "./dom.js";

/** The number of sliders made so far. */
let made = 0;
/** The least number of steps of a slider. */
const STEPS = 30;
/** Values that are not a number: names other than those of constants and functions. */
const NAMES = /[A-Za-z_]\w*/g, NUMBERS = /^(e|E\d*|e\d+|pi|sqrt)$/;

export class Letters {
  /** @type {Map<string, {row: HTMLElement, range: HTMLInputElement, number: HTMLInputElement, free: HTMLButtonElement}>} */ #rows = new Map();

  /** @param {HTMLElement} box @param {(name: string, value: string | null, moving: boolean) => void} changed */
  constructor(box, changed) {
    this.box = box;
    this.changed = changed;
  }

  /** @param {string[]} names @param {Record<string, string>} set @param {string[]} positive letters that a metric needs positive */
  show(names, set, positive = []) {
    for (const [name, { row }] of this.#rows) if (!names.includes(name)) { row.remove(); this.#rows.delete(name); }
    names.forEach((name, at) => {
      const { row } = this.#rows.get(name) ?? this.#row(name, positive.includes(name));
      // an element that is inserted anew, even in its own place, loses the focus and the mouse that drags it
      if (this.box.children[at] !== row) this.box.insertBefore(row, this.box.children[at] ?? null);
      this.#value(name, set[name] ?? null);
    });
    this.box.hidden = !names.length;
  }

  /** @param {string} name @param {boolean} positive */
  #row(name, positive) {
    // the same letter may have another slider in the card of motions
    const id = `letter-${name}-${made++}`;
    const range = element("input", { id, type: "range", "aria-label": name, min: positive ? "0.1" : "-3", max: positive ? "4" : "3", step: "0.1", "aria-valuetext": `${name}, a letter` });
    range.value = "1";
    const number = element("input", { type: "text", inputmode: "decimal", size: 6, placeholder: "letter", "aria-label": `value of ${name}`, autocomplete: "off", spellcheck: "false" });
    const free = button("letter", () => {
      this.#set(name, null, false);
      // the button vanishes
      if (free.hidden) range.focus();
    }, { class: "free", title: `compute with ${name} as a letter`, "aria-label": `${name} as a letter` });
    range.addEventListener("input", () => this.#set(name, short(Number(range.value)), true));
    range.addEventListener("change", () => this.#set(name, short(Number(range.value)), false));
    number.addEventListener("change", () => {
      const text = number.value.trim();
      if (text.match(NAMES)?.some((word) => !NUMBERS.test(word))) return this.tell(name, "Write a number, or leave the field empty for the letter.");
      this.#set(name, text || null, false);
    });
    const row = element("div", { class: "letter" }, element("label", { for: id }, letter(name)), range, number, free, element("p", { class: "help", role: "alert" }));
    const parts = { row, range, number, free };
    this.#rows.set(name, parts);
    return parts;
  }

  /** @param {string} name @param {string | null} value @param {boolean} moving */
  #set(name, value, moving) {
    this.#value(name, value);
    this.tell(name, "");
    this.changed(name, value, moving);
  }

  /** A message about the value of a letter, under its slider. Returns whether the letter has a slider. @param {string} name @param {string} text */
  tell(name, text) {
    const place = this.#rows.get(name)?.row.querySelector(".help");
    if (place) place.textContent = text;
    return Boolean(place);
  }

  /** Removes the messages. */
  accept() { for (const name of this.#rows.keys()) this.tell(name, ""); }

  /** @param {string} name @param {string | null} value */
  #value(name, value) {
    const { row, range, number, free } = /** @type {any} */ (this.#rows.get(name));
    const size = fraction(value);
    row.classList.toggle("free", value === null);
    free.hidden = value === null;
    if (document.activeElement !== number) number.value = value ?? "";
    if (size !== null && document.activeElement !== range) {
      // a number beyond the slider makes it longer
      if (size > Number(range.max)) range.max = String(2 * size);
      if (size < Number(range.min)) range.min = String(size < 0 ? 2 * size : 0);
      range.step = String(step(Number(range.max) - Number(range.min)));
      range.value = String(size);
    }
    range.setAttribute("aria-valuetext", value === null ? `${name}, a letter` : `${name} = ${value}`);
  }
}

/** The number of a fraction or a decimal. @param {string | null} text */
export function fraction(text) {
  if (text === null) return null;
  const [above, below = "1"] = text.split("/");
  const value = Number(above) / Number(below);
  return Number.isFinite(value) && above.trim() ? value : null;
}

/** A power of ten that divides a length into at least 30 steps. @param {number} length */
export const step = (length) => Number((10 ** Math.floor(Math.log10(length / STEPS))).toPrecision(1));

/** @param {number} value */
export const short = (value) => String(Number(value.toPrecision(3)));
