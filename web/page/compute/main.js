// @ts-check
// Compute: one box, chips, a slider for each letter, and the results as cards.
import { Box } from "./box.js";
import { Card, KINDS, named } from "./cards.js";
import { Chips } from "./chips.js";
import { button, element } from "./dom.js";
import { Letters } from "./letters.js";
import { MotionCard } from "./motions.js";
import { RepresentationCard } from "./representations.js";
import { LONGEST, empty, read, write } from "./state.js";

/** @typedef {import("./state.js").State} State @typedef {import("./chips.js").Reading} Reading */

/** @typedef {Card | MotionCard | RepresentationCard} AnyCard */

/** Milliseconds after the last key until a text is read. */
const PAUSE = 250;
/** The least width of a column of cards, in letters of the root. */
const COLUMN = 28;
/** Messages while a text is being typed wait longer. */
const PATIENCE = 900;
/** A metric in coordinates, as it is written into the box. */
const CHART = 'chart.coordinates = ["theta", "phi"]\nmetric = "diag(1, sin(theta)^2)"';

/** @param {HTMLElement} section @param {import("../main.js").Services} services */
export function mount(section, services) {
  return new Compute(section, services).view();
}

class Compute {
  /** @type {State} */ #state = empty();
  /** @type {Reading | null} */ #reading = null;
  /** The part of the state that the reading holds for. */
  #read = "";
  /** The number of runs begun: only the newest writes. */
  #turn = 0;
  /** The space that the reading is of, as it is written. */
  #taken = "";
  /** Whether the reader has stopped the computation. */
  #halted = false;
  /** Whether a run is on its way, and whether the state has changed since. */
  #busy = false;
  #again = false;
  /** An assumption of the page for the next reading. */
  #note = "";
  /** The cards of each column that is laid. */
  #laid = "";
  /** The card of the link that was opened, which the title names. */
  #opened = "";
  /** The letter whose value changed last, while nothing else has. */
  #letter = "";
  /** Whether the space was read, so that a message is about the values of its letters. */
  #valued = false;
  /** @type {AnyCard[]} */ #cards = [];
  #representations = new RepresentationCard((part) => {
    this.#state = { ...this.#state, ...part };
    // the address leads to the card
    this.services.address.set(write({ ...this.#state, card: "representations" }), "push");
    this.#run();
  });
  /** @type {ReturnType<typeof setTimeout> | undefined} */ #pause;
  /** Cards of the second module that are in view. @type {Set<Element>} */ #seen = new Set();

  /** @param {HTMLElement} section @param {import("../main.js").Services} services */
  constructor(section, services) {
    this.services = services;
    this.box = new Box(services.box, {
      typed: () => this.#typed(),
      entered: () => this.#enter(this.box.text, "push"),
      chosen: (text) => { this.box.text = text; this.#enter(text, "push"); this.box.field.focus(); },
      stop: () => services.engine.stop(),
      resume: () => { this.box.wait("computing"); this.#run(); },
    });
    const controls = element("div", { class: "controls-of-space", hidden: true }), letters = element("div", { class: "letters", hidden: true, role: "group", "aria-label": "Letters" });
    this.controls = controls;
    this.chips = new Chips(controls, {
      connection: (connection, moving) => {
        // Levi-Civita is the connection of a metric
        const lacks = connection === "levi-civita" && !this.#reading?.has_metric;
        this.#note = lacks ? "Levi-Civita needs a metric: the identity is taken." : "";
        this.#change({ connection, ...(lacks ? { metric: "identity" } : {}) }, moving);
      },
      metric: (metric, moving) => this.#change({ metric, ...this.#following(metric) }, moving),
    });
    controls.append(letters);
    this.letters = new Letters(letters, (name, value, moving) => this.#assign(name, value, moving));
    this.list = element("div", { class: "cards" });
    this.guide = element("div", { class: "quiet guide" }, element("p", { text: "Write a name or brackets in the box above, or choose an example." }));
    section.append(element("h1", { class: "hidden", text: "Compute" }), controls, this.guide, this.list);
    this.watcher = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        if (isIntersecting) this.#seen.add(target);
        else this.#seen.delete(target);
      }
      if (!this.#halted && entries.some(({ isIntersecting }) => isIntersecting)) this.#run();
    }, { rootMargin: "200px" });
    this.#names();
    // a text that was typed before the field was replaced
    if (this.box.text) this.#typed();
  }

  view() {
    return {
      /** @param {string} text */
      open: async (text) => {
        const state = read(text);
        this.#opened = state.card;
        if (!state.space && this.#state.space && this.#reading) {
          // the link to the view leads back to its last state
          this.services.address.set(write(this.#state), "replace");
          return this.#run();
        }
        if (write(state) === write(this.#state) && this.#reading) return this.#run();
        [this.#state, this.#letter] = [state, ""];
        this.box.text = state.space;
        await this.#run();
      },
      state: () => write(this.#state),
      title: () => this.#title(),
      clock: () => this.#cards.find((card) => card instanceof MotionCard)?.clock() ?? null,
      about: () => ({ of: this.#of() }),
      // in an order that does not depend on the number of columns
      cards: () => {
        // the card of representations appears with the structure, which a small window computes later
        const shown = this.list.hidden ? [] : this.#cards.filter((card) => !card.element.hidden && card !== this.#representations);
        const begins = (/** @type {AnyCard} */ { kind }) => kind.name === "motions" && Boolean(this.#state.motion);
        return [...shown.filter(begins), ...shown.filter((card) => !begins(card))].map(({ element }) => element);
      },
    };
  }

  /** Names for completion, once the engine is there. */
  async #names() {
    try {
      const { answer } = await this.services.engine.ask({ report: "names" });
      /** @type {{spaces: string[], charts: string[], notations: [string, string][]}} */
      const { spaces, charts, notations } = JSON.parse(answer.text);
      this.box.names(["M(3)", "SO(3)", ...spaces, ...charts],
        [...notations.map(([name, example]) => /** @type {[string, string]} */ ([`${name} ${example}`, example])), ["ds^2, a metric in coordinates", CHART]]);
      this.guide.append(this.box.notations());
    } catch {
      // completion is no necessity
    }
  }

  /** Without a metric the connection cannot be that of the metric. @param {string} metric */
  #following(metric) {
    if (!metric && this.#state.connection === "levi-civita") return { connection: "" };
    return {};
  }

  #typed() {
    clearTimeout(this.#pause);
    this.#outdate();
    this.#pause = setTimeout(() => this.#enter(this.box.text, document.body.dataset.view === "compute" ? "replace" : "push", true), PAUSE);
  }

  /** @param {string} space @param {"push" | "replace"} history @param {boolean} [typing] */
  #enter(space, history, typing = false) {
    clearTimeout(this.#pause);
    if (!space) {
      this.#again = this.#busy;
      return this.#empty(history);
    }
    // a new space has its own connection, metric and letters
    if (space !== this.#state.space) [this.#letter, this.#opened, this.#state] = ["", "", stated(space)];
    this.#tell(history);
    this.#run(typing);
  }

  /** The box is empty: no results of an earlier input stay. @param {"push" | "replace"} history */
  #empty(history) {
    this.box.accept();
    this.box.read([], []);
    this.box.wait("");
    [this.#state, this.#reading, this.#read, this.#letter] = [empty(), null, "", ""];
    this.list.hidden = this.controls.hidden = true;
    this.guide.hidden = false;
    this.services.say("");
    if (document.body.dataset.view !== "compute") return;
    this.#tell(history);
    this.services.title(this.#title());
  }

  /** @param {Partial<State>} part @param {boolean} moving a slider that moves makes no entry of the history */
  #change(part, moving) {
    this.#state = { ...this.#state, card: "", ...part };
    [this.#letter, this.#opened] = ["", ""];
    this.#tell(moving ? "replace" : "push");
    this.#run(true);
  }

  /** Gives a letter a value, or none. @param {string} name @param {string | null} value @param {boolean} moving */
  #assign(name, value, moving) {
    const set = { ...this.#state.set };
    if (value === null) delete set[name];
    else set[name] = value;
    this.#change({ set }, moving);
    this.#letter = name;
  }

  /** @param {"push" | "replace"} history */
  #tell(history) { this.services.address.set(write(this.#state), history); }

  /** Marks what is shown as the result of an earlier input. */
  #outdate() {
    for (const card of this.#cards) card.outdate();
    if (stated(this.box.text).space !== this.#taken.trim()) this.box.outdate();
  }

  #title() {
    if (!this.#reading) return "Compute";
    const { metric, connection } = this.#state, kind = [...KINDS, this.#representations.kind].find(({ name }) => name === this.#opened);
    const space = [this.#reading.name, metric, connection === "levi-civita" ? "Levi-Civita" : connection].filter(Boolean).join(", ");
    return kind ? `${kind.title} of ${space}` : space;
  }

  /** The space with its connection and its metric, in words. */
  #of() {
    const { name, connection } = /** @type {Reading} */ (this.#reading), { metric } = this.#state;
    return [name, connection && `connection ${connection === "levi-civita" ? "Levi-Civita" : connection}`, metric && `metric ${metric}`].filter(Boolean).join(", ");
  }

  /** Computes the state. While one runs, only the newest state waits. @param {boolean} [typing] */
  async #run(typing = false) {
    this.#halted = false;
    if (this.#busy) {
      this.#again = true;
      return;
    }
    this.#busy = true;
    try {
      do {
        this.#again = false;
        await this.#once(typing);
      } while (this.#again);
    } finally {
      this.#busy = false;
    }
  }

  /** @param {boolean} typing */
  async #once(typing) {
    if (!this.#state.space) return this.#empty("replace");
    const state = this.#state, turn = ++this.#turn, started = performance.now();
    let words = "computing";
    const stage = (/** @type {string} */ name) => { words = name; };
    const waiting = setInterval(() => {
      const seconds = Math.floor((performance.now() - started) / 1000);
      if (seconds) this.box.wait(`${words}, ${seconds} s`);
    }, 250);
    this.#valued = false;
    try {
      const key = JSON.stringify([state.space, state.connection, state.metric]);
      if (key !== this.#read) {
        this.#outdate();
        const { answer } = await this.services.engine.ask({ report: "reading", ...named({ ...state, set: {} }) }, stage);
        if (this.#again) return;
        this.#take(JSON.parse(answer.text), state);
        this.#read = key;
      } else {
        this.letters.show(this.#reading?.parameters ?? [], state.set);
      }
      this.box.accept();
      this.letters.accept();
      this.#valued = true;
      const computed = await this.#fill(state, stage);
      if (this.#again) return;
      const count = this.#cards.filter(({ element: { hidden } }) => !hidden).length;
      if (computed && document.body.dataset.view === "compute") this.services.say(`${this.#title()}: ${count} cards, ${Math.max(1, Math.round(performance.now() - started))} ms`);
      if (state.card) this.#scroll(state.card);
    } catch (problem) {
      if (!this.#again) this.#fail(problem, typing, turn);
    } finally {
      clearInterval(waiting);
      if (!this.#halted) this.box.wait("");
    }
  }

  /** @param {Reading & {notes: string[], introduced: string[]}} reading @param {State} state */
  #take(reading, state) {
    [this.#reading, this.#taken] = [reading, state.space];
    const known = Object.fromEntries(Object.entries(state.set).filter(([name]) => reading.parameters.includes(name)));
    if (Object.keys(known).length < Object.keys(state.set).length) this.#state = { ...this.#state, set: known };
    const letters = reading.parameters.length ? `, letter${reading.parameters.length > 1 ? "s" : ""} ${reading.parameters.join(", ")}` : "";
    const notation = /** @type {any} */ (reading).notation;
    const notes = reading.notes.map((note) => `${note.charAt(0).toUpperCase()}${note.slice(1).replace(/\.$/, "")}.`);
    if (this.#note) notes.push(this.#note);
    this.#note = "";
    const long = state.space.length > LONGEST ? ["The text is too long for a link."] : [];
    const coordinates = reading.kind === "chart" ? `, coordinates ${reading.coordinates.join(", ")}` : "";
    this.box.read([element("b", { text: reading.name }), `, dimension ${reading.dimension}${coordinates}${letters}${notation ? `, read as ${notation}` : ""}. `], [...notes, ...long]);
    this.chips.show(reading, state.connection, state.metric);
    const positive = state.metric.match(/[A-Za-z]\w*/g) ?? [];
    this.letters.show(reading.parameters, this.#state.set, positive);
    this.controls.hidden = false;
    this.guide.hidden = true;
    this.list.hidden = false;
    this.#lay(reading);
    this.services.title(this.#title());
  }

  /** The cards of a reading: those that stay are kept. @param {Reading} reading */
  #lay(reading) {
    if (!this.#cards.length) {
      this.#cards = [...KINDS.map((kind) => new Card(kind)), this.#representations];
      // a letter that the space and its motion share has one value
      this.#cards.push(new MotionCard(this.services.engine, (name, value, moving) => {
        if (this.#reading?.parameters.includes(name)) this.#assign(name, value, moving);
      }));
      for (const card of this.#cards) if (card.kind.second) this.watcher.observe(card.element);
      new ResizeObserver(() => this.#columnize()).observe(this.list);
    }
    this.#representations.space = this.#taken;
    for (const card of this.#cards) card.element.hidden = !card.kind.when(reading);
    this.#columnize();
  }

  /** Lays the cards in columns of about equal height. The heights are those of usual cards, so that no card changes its column
   * when its result grows. */
  #columnize() {
    const count = Math.max(1, Math.min(3, Math.floor(this.list.clientWidth / (COLUMN * parseFloat(getComputedStyle(document.documentElement).fontSize)))));
    const columns = Array.from({ length: count }, () => ({ size: 0, cards: /** @type {AnyCard[]} */ ([]) }));
    const wide = this.#cards.filter(({ kind }) => kind.name === "motions");
    for (const card of this.#cards) {
      if (wide.includes(card)) continue;
      const lowest = columns.reduce((least, column) => column.size < least.size ? column : least);
      lowest.cards.push(card);
      if (!card.element.hidden) lowest.size += /** @type {any} */ (card.kind).size;
    }
    // an example of a motion begins with it
    const [before, after] = this.#state.motion ? [wide, []] : [[], wide];
    const layout = [before, ...columns.map(({ cards }) => cards), after], laid = JSON.stringify(layout.map((cards) => cards.map(({ kind }) => kind.name)));
    // elements that are moved, even to their own place, lose the focus
    if (laid === this.#laid) return;
    this.#laid = laid;
    const elements = (/** @type {AnyCard[]} */ cards) => cards.map(({ element }) => element);
    this.list.replaceChildren(...elements(before), ...columns.map(({ cards }) => element("div", { class: "column" }, ...elements(cards))), ...elements(after));
  }

  /** Fills the cards, those of the first module before the others. Returns how many were computed.
   * @param {State} state @param {(name: string) => void} told called with the name of each stage */
  async #fill(state, told) {
    const reading = /** @type {Reading} */ (this.#reading);
    const shown = this.#cards.filter(({ element: { hidden } }) => !hidden);
    const key = JSON.stringify(state.set) + this.#read;
    const link = (/** @type {string} */ card) => location.href.replace(/#.*$/, `#compute?${write({ ...state, card })}`);
    const context = { state, reading, engine: this.services.engine, link, say: this.services.say };
    let computed = 0;
    const first = shown.filter(({ kind }) => !kind.second), second = shown.filter(({ kind }) => kind.second);
    for (const { element: box } of second) if (this.#seen.has(box)) box.querySelector(".body > .later")?.replaceChildren("…");
    const cards = first.concat(second), representations = this.#representations;
    for (const card of cards) {
      const { element: box, kind } = card;
      const own = card === representations ? key + representations.key(state) : key;
      if (box.dataset.key === own) {
        box.classList.remove("stale");
        continue;
      }
      card.outdate();
      // the factors of the algebra are known by its structure
      const asked = state.card === kind.name || state.card === "representations" && kind.name === "structure";
      if (kind.second && !this.#seen.has(box) && !asked) continue;
      const most = "most" in kind ? kind.most : undefined;
      if (card instanceof Card && most && reading.dimension > most && !card.asked) {
        card.tell(`Above dimension ${most} this takes minutes.`, button("Compute", () => { card.asked = true; this.#run(); }));
        continue;
      }
      try {
        told(kind.title);
        await card.compute(context, (name) => told(`${kind.title}: ${name}`));
        box.dataset.key = own;
        computed++;
        if (card instanceof Card && kind.name === "structure") {
          representations.offer(card.factors);
          representations.element.hidden = !representations.kind.when();
          this.#columnize();
          if (!representations.element.hidden && !cards.includes(representations)) cards.push(representations);
        }
      } catch (problem) {
        const { kind: what, refusal, message } = /** @type {any} */ (problem);
        if (what === "refused" && !first.includes(card)) card.tell(refusal.message);
        else if (what === "failed") card.tell(`The part of the engine for this card did not load: ${message}`);
        else throw problem;
      }
      if (this.#again) break;
    }
    return computed;
  }

  /** @param {any} problem @param {boolean} typing @param {number} turn */
  #fail(problem, typing, turn) {
    const { kind, message, refusal } = problem;
    if (kind === "replaced") return;
    if (kind === "stopped") {
      this.#halted = true;
      this.box.halt();
      return this.services.say("stopped");
    }
    this.#outdate();
    // the space is read without the values of its letters
    const letter = this.#valued ? this.#letter || Object.keys(this.#state.set).at(-1) : "";
    const tell = () => {
      if (turn !== this.#turn) return;
      this.letters.accept();
      // a text that is the beginning of names is not a fault before it is entered
      if (kind === "refused" && typing && refusal.place?.source === "input" && this.box.completes) this.box.clear();
      else if (kind === "refused" && letter && this.letters.tell(letter, sentence(refusal))) this.box.accept();
      else if (kind === "refused") this.box.refuse(refusal);
      else if (kind === "crashed") this.box.refuse({ message: `The computation failed: ${message}.`, help: "Your input is kept. A smaller space or fewer letters may succeed" });
      else if (kind === "failed") this.box.refuse({ message: `The engine did not load: ${message}`, help: "This page needs a browser with WebAssembly. Press Enter to try again" });
      else this.box.refuse({ message: `The page failed: ${message ?? problem}` });
      this.services.say("");
    };
    this.#read = "";
    if (typing) setTimeout(tell, PATIENCE - PAUSE);
    else tell();
  }

  /** @param {string} card */
  #scroll(card) {
    const box = this.#cards.find(({ kind }) => kind.name === card)?.element;
    const { motion } = this.#state;
    this.#state = { ...this.#state, card: "" };
    if (motion) return scrollTo(0, 0);
    box?.scrollIntoView({ block: "start" });
    // a presentation begins with it
    box?.focus({ preventScroll: true });
  }
}

/** The state of a text of the box. @param {string} space */
const stated = (space) => read(new URLSearchParams({ space }).toString().replaceAll("+", "%20"));

/** A message and its advice as sentences. @param {import("./box.js").Refusal} refusal */
function sentence({ message, help }) {
  const parts = [message, help ?? ""].filter(Boolean).map((part) => `${part.charAt(0).toUpperCase()}${part.slice(1).replace(/\.$/, "")}.`);
  return parts.join(" ");
}
