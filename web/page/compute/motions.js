// @ts-check
// Motions: a body that turns, or moves, on the group of the space; a problem of motion with a slider for each number.
import { button, element, report } from "./dom.js";
import { Letters } from "./letters.js";
import { PROBLEMS } from "./problems.js";

/** @typedef {import("./chips.js").Reading} Reading */

/** Problems of each group. @type {Record<string, (keyof typeof PROBLEMS)[]>} */
const OF = { "so(3)": ["free body", "heavy top"], "su(2)": ["free body", "heavy top"], "M(3)": ["free body", "heavy top"], "SO(3)": ["free body", "heavy top"], "se(3)": ["body in a fluid"] };
/** Methods of interest beside that of a problem. @type {Record<string, string>} */
const COMPARED = { "free body": "rkmk4, projected4, cf4", "heavy top": "rkmk4, projected4, kick4", "body in a fluid": "projected4, cf4, rkmk853" };
/** The space and the metric of a problem. */
const SPACE = /^\s*space\s*=\s*"(.*)"/m, METRIC = /^\s*metric\s*=\s*"(.*)"/m, POTENTIAL = /^\s*potential\s*=\s*"(.*)"/m;
/** A parameter with a number, or with a text in quotes such as "5/4". */
const NUMBER = /^[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?$/, PARAMETER = /^(\s*\w+)(\s*=\s*)([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|"[^"]*")(\s*(?:#.*)?)$/;

/** The parameters of a problem that are numbers. @param {string} text */
export function parameters(text) {
  let inside = false;
  /** @type {Record<string, string>} */
  const found = {};
  for (const line of text.split("\n")) {
    if (/^\s*\[/.test(line)) inside = /^\s*\[\s*parameters\s*\]/.test(line);
    const parameter = inside && PARAMETER.exec(line);
    if (parameter) found[parameter[1].trim()] = parameter[3].replaceAll('"', "");
  }
  return found;
}

/** The problem with other numbers. @param {string} text @param {Record<string, string>} values */
export function assigned(text, values) {
  let inside = false;
  return text.split("\n").map((line) => {
    if (/^\s*\[/.test(line)) inside = /^\s*\[\s*parameters\s*\]/.test(line);
    const parameter = inside ? PARAMETER.exec(line) : null, value = parameter ? values[parameter[1].trim()] : undefined;
    return parameter && value !== undefined ? `${parameter[1]}${parameter[2]}${NUMBER.test(value) ? value : `"${value}"`}${parameter[4]}` : line;
  }).join("\n");
}

export class MotionCard {
  kind = { name: "motions", title: "Motions", second: true, report: "motion", when: (/** @type {Reading} */ { name }) => name in OF };
  /** @type {any} */ #view = null;
  #problem = "";
  /** Whether an example of a motion was played. */
  #shown = false;
  #text = "";
  /** The text whose motion is shown. */
  #drawn = "";
  #busy = false;
  #again = false;
  /** The space, the metric and the potential whose equations are shown. */
  #law = "";

  /**
   * @param {{ask(request: object, stage?: (name: string) => void): Promise<any>}} engine
   * @param {(name: string, value: string, moving: boolean) => void} changed called for each number that changes here
   */
  constructor(engine, changed) {
    this.engine = engine;
    this.picture = element("div", { class: "motion" }, element("p", { class: "quiet", text: "Computed when it is in view." }));
    this.choice = element("div", { class: "pick", role: "group", "aria-label": "Problem" });
    const box = element("div", { class: "letters", role: "group", "aria-label": "Numbers of the motion" });
    this.letters = new Letters(box, (name, value, moving) => {
      if (value === null) return this.letters.show(Object.keys(parameters(this.#text)), parameters(this.#text));
      this.#text = assigned(this.#text, { [name]: value });
      this.#draw();
      changed(name, value, moving);
    });
    this.field = element("textarea", { rows: 14, spellcheck: false, "aria-label": "The problem, as TOML" });
    this.field.addEventListener("change", () => {
      const before = parameters(this.#text);
      this.#text = this.field.value;
      this.#sliders();
      this.#draw();
      for (const [name, value] of Object.entries(parameters(this.#text))) if (value !== before[name]) changed(name, value, false);
    });
    this.message = element("p", { class: "help", role: "alert" });
    this.element = element("article", { class: "card motions", tabindex: "-1", "aria-labelledby": "card-motions" },
      element("h2", { id: "card-motions", text: "Motions" }), this.choice, this.picture, box, this.message,
      element("details", {}, element("summary", { text: "the problem as a file" }), this.field));
  }

  outdate() {}

  /** The clock of the motion, once it is computed. @returns {import("../present.js").Clock | null} */
  clock() {
    const { element: box } = this, view = this.#view;
    return view && { box, get time() { return view.passed; }, length: view.length, pause: () => view.stop(), go: (/** @type {number} */ time) => view.go(time) };
  }

  /** @param {string} text */
  tell(text) { this.message.textContent = text; }

  /** @param {{state: import("./state.js").State, reading: Reading}} context */
  async compute({ state, reading }) {
    const names = OF[reading.name] ?? [];
    const wanted = names.find((name) => name === state.motion);
    if (wanted && wanted !== this.#problem) this.#choose(wanted, names);
    else if (!names.includes(/** @type {any} */ (this.#problem))) this.#choose(names[0], names);
    // letters of the metric are moments of the body
    this.#text = assigned(this.#text, state.set);
    this.#sliders();
    if (this.#text !== this.#drawn) await this.#draw();
    // an example of a motion moves at once
    if (wanted && !this.#shown && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.#view?.start();
    this.#shown ||= Boolean(wanted);
  }

  /** @param {string} name @param {string[]} names */
  #choose(name, names) {
    this.#problem = name;
    this.#text = PROBLEMS[/** @type {keyof typeof PROBLEMS} */ (name)] ?? "";
    // the buttons of the same problems stay, and with them the focus
    if ([...this.choice.children].map(({ textContent }) => textContent).join() !== names.join()) this.choice.replaceChildren(...names.map((other) => button(other, () => { this.#choose(other, names); this.#sliders(); this.#draw(); }, { class: "chip" })));
    for (const chip of this.choice.children) chip.setAttribute("aria-pressed", String(chip.textContent === name));
  }

  #sliders() {
    this.field.value = this.#text;
    const found = parameters(this.#text);
    this.letters.show(Object.keys(found), found, Object.keys(found).filter((name) => /^[A-Zml]/.test(name)));
  }

  /** Computes the motion; of those that wait, only the newest. */
  async #draw() {
    this.field.value = this.#text;
    this.#again = true;
    if (this.#busy) return;
    this.#busy = true;
    try {
      while (this.#again) {
        this.#again = false;
        const { MotionView } = await import("./motion.js");
        const text = this.#text;
        const { answer } = await this.engine.ask({ report: "motion", problem: text, methods: COMPARED[this.#problem] ?? "", format: "json" });
        this.#view ??= new MotionView(this.picture);
        this.#view.show(JSON.parse(answer.text));
        this.#drawn = text;
        this.message.textContent = "";
        await this.#equations();
      }
    } catch (problem) {
      const { kind, refusal, message } = /** @type {any} */ (problem);
      if (kind === "refused") this.message.textContent = refusal.message;
      else if (kind !== "replaced" && kind !== "stopped") this.message.textContent = `The motion was not computed: ${message}`;
    } finally {
      this.#busy = false;
    }
  }

  /** Writes the equations of the problem beside its picture. */
  async #equations() {
    const [space = "", metric = "", potential = ""] = [SPACE, METRIC, POTENTIAL].map((key) => key.exec(this.#text)?.[1]);
    const law = JSON.stringify([space, metric, potential]);
    if (law === this.#law) return;
    const { answer } = await this.engine.ask({ report: "equations", input: space, metric });
    const list = report(answer.text).querySelector(".components");
    this.#view.law.replaceChildren(...(list ? [element("h3", { text: "Equations of motion" }), list] : []),
      element("p", { class: "rest", text: potential ? `M: the moment of the potential ${potential}` : "M = 0" }));
    this.#law = law;
  }
}
