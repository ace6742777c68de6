// @ts-check
// The problem of a motion: examples, and sliders for the parameters of its text.
import { html } from "./picture.js";
import { PROBLEMS } from "./problems.js";

/** Methods of interest beside that of an example. @type {Record<string, string>} */
export const COMPARED = { "free body": "rkmk4, projected4, cf4", "heavy top": "rkmk4, projected4, kick4", "body in a fluid": "projected4, cf4, rkmk853" };
/** A parameter with a number. */
const PARAMETER = /^(\s*\w+)(\s*=\s*)([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)(\s*(?:#.*)?)$/;
/** The head of the table of parameters. */
const HEAD = /^\s*\[\s*parameters\s*\]\s*(?:#.*)?$/;

export class Problem {
  /**
   * @param {HTMLSelectElement} examples @param {HTMLElement} sliders @param {HTMLTextAreaElement} text
   * @param {{change: (history: "push" | "replace") => void, keep: () => void}} page what follows a change, and what comes before the text
   * is replaced
   */
  constructor(examples, sliders, text, { change, keep }) {
    this.examples = examples;
    this.sliders = sliders;
    this.text = text;
    this.change = change;
    examples.append(...Object.keys(PROBLEMS).map((name) => html("option", {}, name)));
    examples.addEventListener("change", () => {
      keep();
      this.#choose(examples.value);
      change("push");
    });
    text.addEventListener("change", () => this.fill());
  }

  /** @param {string} name @param {string} [methods] */
  #choose(name, methods = COMPARED[name]) {
    this.text.value = PROBLEMS[/** @type {keyof typeof PROBLEMS} */ (name)];
    /** @type {HTMLInputElement} */ (document.getElementById("methods")).value = methods;
    this.fill();
  }

  /** Sliders for the parameters of the text; an empty text becomes the first example. */
  fill() {
    const methods = /** @type {HTMLInputElement} */ (document.getElementById("methods")).value;
    if (!this.text.value.trim()) return this.#choose(Object.keys(PROBLEMS)[0], methods || undefined);
    const sliders = this.#parameters().map(({ name, value }) => {
      const positive = /^[A-Zml]/.test(name);
      const most = Math.max(positive ? 4 : 3, 2 * Math.abs(value));
      const id = `parameter-${name}`;
      const slider = /** @type {HTMLInputElement} */ (html("input", { id, type: "range", min: String(positive ? most / 40 : -most), max: String(most), step: "any" }));
      slider.value = String(value);
      const shown = html("output", { for: id }, String(value));
      slider.addEventListener("input", () => {
        const number = String(Number(Number(slider.value).toPrecision(3)));
        shown.textContent = number;
        this.#set(name, number);
        this.change("replace");
      });
      slider.addEventListener("keydown", (event) => {
        // a slider without steps moves by a hundredth
        const sign = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
        if (!sign) return;
        event.preventDefault();
        slider.value = String(Number(slider.value) + sign * most / 40);
        slider.dispatchEvent(new Event("input"));
      });
      return html("div", { class: "field" }, html("label", { for: id }, `${name} `, shown), slider);
    });
    this.sliders.replaceChildren(...sliders);
    const same = Object.entries(PROBLEMS).find(([name]) => this.text.value.includes(`"${name}"`));
    this.examples.value = same?.[0] ?? "";
  }

  /** The parameters that are numbers. */
  #parameters() {
    let inside = false;
    /** @type {{name: string, value: number}[]} */
    const found = [];
    for (const line of this.text.value.split("\n")) {
      if (/^\s*\[/.test(line)) inside = HEAD.test(line);
      const parameter = inside && PARAMETER.exec(line);
      if (parameter) found.push({ name: parameter[1].trim(), value: Number(parameter[3]) });
    }
    return found;
  }

  /** @param {string} name @param {string} value */
  #set(name, value) {
    let inside = false;
    this.text.value = this.text.value.split("\n").map((line) => {
      if (/^\s*\[/.test(line)) inside = HEAD.test(line);
      const parameter = inside && PARAMETER.exec(line);
      return parameter && parameter[1].trim() === name ? `${parameter[1]}${parameter[2]}${value}${parameter[4]}` : line;
    }).join("\n");
  }
}
