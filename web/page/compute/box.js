// @ts-check
// The box: a text in any notation, what it was read as, suggestions, and messages under its letters.
import { button, element } from "./dom.js";

/** @typedef {{message: string, place?: any, help?: string | null, suggestions?: string[]}} Refusal */

/** Completions that are shown at once. */
const SHOWN = 7;
/** The largest number of lines of the field. */
const LINES = 12;

export class Box {
  /** Names for completion, and the text that each one means. @type {[string, string][]} */ #names = [];
  /** Names of notations, and an example of each one. @type {[string, string][]} */ #notations = [];
  /** The message that is shown. @type {Refusal | null} */ #refusal = null;
  /** Whether the computation was stopped. */
  #halted = false;

  /**
   * @param {HTMLFormElement} form @param {{typed: () => void, entered: () => void, chosen: (text: string) => void, stop: () => void, resume: () => void}} acts
   */
  constructor(form, acts) {
    const old = form.querySelector("#space-input"), value = /** @type {HTMLInputElement | null} */ (old)?.value ?? "";
    this.field = element("textarea", {
      id: "space-input", name: "space", rows: 1, autocomplete: "off", autocapitalize: "off", spellcheck: "false",
      placeholder: "a name, or brackets: [e1,e2]=e3", "aria-describedby": "read-as",
    });
    this.field.value = value;
    const focused = document.activeElement === old;
    old?.replaceWith(this.field);
    if (focused) this.field.focus();
    this.examples = /** @type {HTMLElement} */ (form.querySelector(".chips")) ?? element("p", { class: "chips" });
    this.matches = element("p", { class: "chips matches", hidden: true });
    this.line = element("p", { id: "read-as", class: "read-as", hidden: true });
    this.error = element("div", { class: "refusal", role: "alert" });
    this.progress = element("progress", { "aria-label": "computing" });
    this.words = element("span");
    this.halting = button("Stop", () => this.#halted ? acts.resume() : acts.stop(), { class: "stop" });
    this.waiting = element("p", { class: "waiting", hidden: true }, this.progress, " ", this.words, " ", this.halting);
    this.field.after(this.line, this.error, this.waiting);
    this.examples.after(this.matches);
    this.chosen = acts.chosen;
    // a text that is entered is not the beginning of another one
    const enter = () => { this.#offer([]); acts.entered(); };
    this.field.addEventListener("input", () => { this.#fit(); this.#complete(); acts.typed(); });
    this.field.addEventListener("keydown", (event) => {
      // a text of several lines has line ends
      if (event.key !== "Enter" || event.shiftKey || event.isComposing || this.field.value.includes("\n") && !event.ctrlKey) return;
      event.preventDefault();
      enter();
    });
    form.addEventListener("submit", (event) => { event.preventDefault(); enter(); });
    form.addEventListener("dragover", (event) => event.preventDefault());
    form.addEventListener("drop", async (event) => {
      const [file] = event.dataTransfer?.files ?? [];
      if (!file) return;
      event.preventDefault();
      if (file.size > 1 << 20) return this.refuse({ message: `${file.name} is larger than 1 MB` });
      acts.chosen(await file.text());
    });
    addEventListener("resize", () => this.#fit());
    this.#fit();
  }

  /** Whether names that complete the text are shown. */
  get completes() { return !this.matches.hidden; }

  get text() { return this.field.value.trim(); }

  /** @param {string} text */
  set text(text) {
    if (this.field.value !== text) this.field.value = text;
    this.#fit();
    this.#complete();
  }

  /** @param {string[]} names @param {[string, string][]} notations names of notations, and an example of each one */
  names(names, notations) {
    this.#names = [...new Set(names)].map((name) => /** @type {[string, string]} */ ([name, name])).concat(notations);
    this.#notations = notations;
    this.#complete();
    // a message that came before the names has no list
    if (this.#refusal) this.refuse(this.#refusal);
  }

  /** Buttons that write an example of each notation. */
  notations() {
    return element("p", { class: "chips" }, "Notations ", ...this.#chips(this.#notations));
  }

  /** Buttons of names. @param {[string, string][]} names */
  #chips(names) { return names.flatMap(([name, text]) => [button(name, () => this.chosen(text), { class: "chip" }), " "]); }

  /** The field is as high as its text, up to twelve lines. */
  #fit() {
    const { field } = this, { lineHeight, paddingTop, paddingBottom } = getComputedStyle(field);
    field.rows = 1;
    const lines = Math.round((field.scrollHeight - parseFloat(paddingTop) - parseFloat(paddingBottom)) / parseFloat(lineHeight));
    // a field that is hidden has no height
    field.rows = Math.min(LINES, Math.max(lines || 1, field.value.split("\n").length));
  }

  /** Names that contain what is typed. */
  #complete() {
    const typed = this.field.value.trim().toLowerCase(), plain = (/** @type {string} */ name) => name.toLowerCase().replace(/[^a-z0-9]/g, "");
    const found = typed && /^[\w\s(),*^-]{1,24}$/.test(typed) && document.activeElement === this.field
      ? this.#names.filter(([name]) => plain(name).startsWith(plain(typed)) && name.toLowerCase() !== typed).slice(0, SHOWN) : [];
    this.#offer(found);
  }

  /** Shows names that complete the text, or else the examples. @param {[string, string][]} found */
  #offer(found) {
    this.matches.replaceChildren(...this.#chips(found));
    this.matches.hidden = !found.length;
    this.examples.hidden = Boolean(found.length);
  }

  /** What was read. @param {(Node | string)[]} words @param {string[]} notes */
  read(words, notes) {
    this.line.replaceChildren(...words, ...(notes.length ? [element("span", { class: "notes", text: notes.join(" ") })] : []));
    this.line.hidden = !words.length;
    this.line.classList.remove("stale");
  }

  /** Marks the reading as that of an earlier input. */
  outdate() { this.line.classList.add("stale"); }

  /** No message. */
  clear() {
    this.#refusal = null;
    this.error.replaceChildren();
  }

  /** No message; what was read is what is in the field. */
  accept() {
    this.clear();
    this.line.classList.remove("stale");
  }

  /** A message under the letters it is about. @param {Refusal} refusal */
  refuse(refusal) {
    const { message, place, help, suggestions = [] } = this.#refusal = refusal;
    // the names that the message lists are buttons
    /** @type {HTMLElement[]} */
    const parts = [element("p", { text: capital(suggestions.length ? message.replace(/; the nearest is .*$/s, "") : message) })];
    if (place?.text) {
      const { text, from, to } = place, wide = text.length > 160;
      // of a long line only the neighbourhood is shown
      const start = wide ? Math.max(0, from - 60) : 0, end = wide ? from + 90 : text.length;
      const where = place.source === "input" ? "" : `${place.source}: `;
      const before = element("span", { text: where + text.slice(start, from) });
      const marked = element("mark", { text: text.slice(from, Math.max(from + 1, to)) || " " });
      parts.push(element("p", { class: "where" }, before, marked, text.slice(Math.max(from + 1, to), end)));
    }
    if (help) parts.push(element("p", { class: "help", text: `${capital(help)}.` }));
    if (suggestions.length) {
      parts.push(element("p", { class: "chips" }, "Did you mean ", ...this.#chips(suggestions.slice(0, SHOWN).map((name) => [name, name]))));
      // one row of names is enough
      this.matches.hidden = true;
      this.examples.hidden = false;
    }
    if (this.#names.length && help?.includes("list below")) {
      const names = this.#names.filter(([name, text]) => name === text);
      parts.push(this.notations(), element("details", {}, element("summary", { text: `all ${names.length} names` }), element("p", { class: "chips" }, ...this.#chips(names))));
    }
    this.error.replaceChildren(...parts);
  }

  /** Shows that a computation runs. @param {string} words or nothing to end */
  wait(words) { this.#work(words, false); }

  /** Shows that the computation was stopped, with a button to resume it. */
  halt() { this.#work("stopped", true); }

  /** @param {string} words @param {boolean} halted */
  #work(words, halted) {
    this.#halted = this.progress.hidden = halted;
    this.words.textContent = words;
    this.halting.textContent = halted ? "Resume" : "Stop";
    // the button vanishes
    if (!words && document.activeElement === this.halting) this.field.focus({ preventScroll: true });
    this.waiting.hidden = !words;
  }
}

/** @param {string} text */
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
