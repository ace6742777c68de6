// @ts-check
// A stage: pictures under one camera, points to drag, one control, and a clock. What it shows is a spec, so that each page says only its idea.
import { Camera } from "./scene.js";
import { add } from "./rotations.js";
import { within } from "./ball.js";

/** @typedef {import("./rotations.js").Point} Point */
/** @typedef {{v: number, t: number, points: Record<string, Point>, memo?: any}} State value of the control, time, points that a hand moves */
/** @typedef {{svg: string, caption: string, about: string, kind?: string}} Picture */
/** @typedef {{label: string, min: number, max: number, step: number, value: number, ticks?: [number, string][], words(v: number): string}} Range */
/** @typedef {{label: string, value: number, choices: string[]}} Choice */
/**
 * @typedef {Object} Spec
 * @property {string} id
 * @property {string} title
 * @property {string} text the idea in one sentence, as HTML
 * @property {string} more what to look for, as HTML
 * @property {string} formula the law that the picture shows, as MathML
 * @property {string} tensors the state of Compute that shows the tensors
 * @property {Range | Choice} control
 * @property {[number, number]} camera azimuth and elevation in degrees
 * @property {(state: State, camera: Camera, prefix: string) => Picture[]} draw
 * @property {(state: State) => string} readout numbers, as HTML
 * @property {string} play the name of the button that starts the clock
 * @property {number} duration seconds until the clock stops at `t = duration`; endless if infinite
 * @property {number} [rest] the time that is shown before the clock starts
 * @property {Record<string, Point>} [points]
 * @property {(name: string, x: Point, state: State) => Point} [move] restricts a point that is moved
 * @property {{unit: number, box: [number, number, number, number], size?: (state: State) => number}} [hands] scale and box of the pictures with points; `size` scales the points
 */

/** @param {Spec} spec @returns {State} */
export const start = (spec) => ({ v: spec.control.value, t: spec.rest ?? 0, points: structuredClone(spec.points ?? {}) });

const brief = (/** @type {Point} */ x) => x.map((part) => part.toFixed(1).replace("-", "−")).join(", ");

/** Where a point stands in its picture, in percent. @param {Spec} spec @param {Camera} camera @param {Point} x @param {State} state */
function place(spec, camera, x, state) {
  const [right, up] = camera.axes(), { unit, box, size } = spec.hands ?? { unit: 1, box: [0, 0, 1, 1] };
  const along = (/** @type {Point} */ axis) => unit * (size?.(state) ?? 1) * (x[0] * axis[0] + x[1] * axis[1] + x[2] * axis[2]);
  return [100 * (along(right) - box[0]) / box[2], 100 * (-along(up) - box[1]) / box[3]];
}

/** The HTML of a stage. @param {Spec} spec @param {State} state @param {string} prefix of ids */
export function markup(spec, state, prefix) {
  const camera = new Camera(...spec.camera), { control } = spec;
  const figures = spec.draw(state, camera, prefix).map(({ svg, caption, about, kind = "" }, k) =>
    `<figure class="picture ${kind}"><div class="view" role="img" aria-label="${about}">${svg}</div>`
    + Object.keys(state.points).map((name) => `<button type="button" class="handle" data-name="${name}" role="slider" aria-label="point ${name}" aria-valuenow="0" aria-valuetext="${brief(state.points[name])}"${k ? ' tabindex="-1"' : ""}></button>`).join("")
    + `<figcaption>${caption}</figcaption></figure>`).join("");
  const input = "choices" in control
    ? `<fieldset class="choice"><legend>${control.label}</legend>${control.choices.map((name, k) => `<label><input type="radio" name="${prefix}choice" value="${k}"${k === control.value ? " checked" : ""}><span>${name}</span></label>`).join("")}</fieldset>`
    : `<div class="range${control.ticks ? " blend" : ""}"><label for="${prefix}range">${control.label}</label><input id="${prefix}range" type="range" min="${control.min}" max="${control.max}" step="${control.step}" value="${state.v}" aria-valuetext="${control.words(state.v)}"${control.ticks ? ` list="${prefix}ticks"` : ""}><output for="${prefix}range">${control.words(state.v)}</output>`
      + (control.ticks ? `<datalist id="${prefix}ticks">${control.ticks.map(([v, name]) => `<option value="${v}" label="${name}"></option>`).join("")}</datalist>` : "") + "</div>";
  return `<div class="pictures n${(figures.match(/<figure/g) ?? []).length}">${figures}</div><div class="controls"><button type="button" class="play">${spec.play}</button>`
    + `<button type="button" class="turn" title="Arrow keys turn the view">Turn<span class="hidden"> the view; arrow keys turn it</span></button>${input}</div>`;
}

export class Stage {
  #frame = 0;
  #last = 0;
  #asked = false;

  /** @param {HTMLElement} box @param {Spec} spec @param {string} prefix @param {(() => void)} [changed] called when the state changes by hand */
  constructor(box, spec, prefix, changed = () => {}) {
    this.box = box;
    this.spec = spec;
    this.prefix = prefix;
    this.changed = changed;
    this.state = start(spec);
    this.camera = new Camera(...spec.camera);
    // the first screen is in the document already
    if (!box.querySelector(".pictures")) box.innerHTML = markup(spec, this.state, prefix);
    /** @type {HTMLElement[]} */ this.views = [...box.querySelectorAll(".view")].map((x) => /** @type {HTMLElement} */ (x));
    this.captions = [...box.querySelectorAll("figcaption")];
    this.play = /** @type {HTMLButtonElement} */ (box.querySelector(".play"));
    this.play.addEventListener("click", () => this.toggle());
    for (const view of this.views) this.#drag(view, (right, down) => this.camera.turn(0.5 * right, 0.5 * down));
    for (const handle of box.querySelectorAll(".handle")) this.#hand(/** @type {HTMLElement} */ (handle));
    const turn = /** @type {HTMLElement} */ (box.querySelector(".turn"));
    turn.addEventListener("click", () => { this.camera.turn(-15, 0); this.draw(); });
    turn.addEventListener("keydown", (event) => this.#arrows(event, (x, y) => this.camera.turn(6 * x, 6 * y)));
    const range = /** @type {HTMLInputElement | null} */ (box.querySelector(".range input"));
    range?.addEventListener("input", () => this.set(Number(range.value)));
    for (const radio of box.querySelectorAll(".choice input")) radio.addEventListener("change", () => this.set(Number(/** @type {HTMLInputElement} */ (radio).value)));
    new ResizeObserver(() => this.draw()).observe(box);
    this.now();
  }

  /** @param {HTMLElement} element @param {(right: number, down: number, event: PointerEvent) => void} move */
  #drag(element, move) {
    let [x, y] = [0, 0];
    element.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      element.setPointerCapture(event.pointerId);
      [x, y] = [event.clientX, event.clientY];
    });
    element.addEventListener("pointermove", (event) => {
      if (!element.hasPointerCapture(event.pointerId)) return;
      move(event.clientX - x, event.clientY - y, event);
      [x, y] = [event.clientX, event.clientY];
      this.draw();
    });
  }

  /** @param {HTMLElement} handle */
  #hand(handle) {
    const name = handle.dataset.name ?? "", { unit, box, size } = this.spec.hands ?? { unit: 1, box: [0, 0, 1, 1] };
    const move = (/** @type {number} */ right, /** @type {number} */ up) => {
      const scale = 1 / (size?.(this.state) ?? 1), axes = this.camera.axes(), moved = add(add(this.state.points[name], axes[0], right * scale), axes[1], up * scale);
      this.state.points[name] = (this.spec.move ?? ((_, x) => within(x)))(name, moved, this.state);
      this.state.memo = undefined;
      this.changed();
      this.draw();
    };
    this.#drag(handle, (right, down) => {
      const width = /** @type {HTMLElement} */ (handle.parentElement?.firstElementChild).clientWidth;
      move(right * box[2] / (width * unit), -down * box[2] / (width * unit));
    });
    handle.addEventListener("keydown", (event) => this.#arrows(event, (x, y) => move(0.1 * x, 0.1 * y)));
  }

  /** @param {KeyboardEvent} event @param {(right: number, up: number) => void} move */
  #arrows(event, move) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    move(way[0], way[1]);
    this.draw();
  }

  /** Sets the control. @param {number} v */
  set(v) {
    this.state.v = v;
    this.state.memo = undefined;
    if (this.spec.duration === Infinity) this.state.t = this.spec.rest ?? 0;
    this.changed();
    this.draw();
  }

  /** The state as a part of an address. */
  save() {
    const kept = new URLSearchParams({ v: String(this.state.v) });
    for (const [name, x] of Object.entries(this.state.points)) kept.set(name, x.map((part) => part.toFixed(2)).join(","));
    return kept.toString().replaceAll("%2C", ",");
  }

  /** Takes a saved state; what cannot be read stays as it is. @param {string} text */
  load(text) {
    const { control } = this.spec;
    for (const [name, value] of new URLSearchParams(text)) {
      if (name === "v") {
        const [least, most] = "choices" in control ? [0, control.choices.length - 1] : [control.min, control.max];
        const v = Number(value);
        if (value !== "" && Number.isFinite(v)) this.state.v = Math.max(least, Math.min(most, "choices" in control ? Math.round(v) : v));
      } else if (Object.hasOwn(this.state.points, name)) {
        const x = value.split(",").map(Number);
        if (x.length === 3 && x.every(Number.isFinite)) this.state.points[name] = (this.spec.move ?? ((_, x) => within(x)))(name, /** @type {Point} */ (x), this.state);
      }
    }
    this.state.memo = undefined;
    this.now();
  }

  /** Starts or stops the clock. */
  toggle() {
    if (this.playing) return this.pause();
    if (this.state.t >= this.spec.duration) this.state.t = 0;
    this.#last = 0;
    this.play.textContent = "Pause";
    this.#frame = requestAnimationFrame((time) => this.#tick(time));
  }

  pause() {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.play.textContent = this.spec.play;
  }

  /** Seconds until the clock stops. */
  get length() { return this.spec.duration; }

  get time() { return this.state.t; }

  /** Draws a time. @param {number} time */
  go(time) {
    this.state.t = time;
    this.now();
  }

  get playing() { return this.#frame !== 0; }

  /** @param {number} time */
  #tick(time) {
    if (!this.box.isConnected || this.box.closest("[hidden]")) return this.pause();
    // a hidden tab does not jump
    const passed = this.#last ? Math.min(0.1, (time - this.#last) / 1000) : 0;
    this.#last = time;
    this.state.t = Math.min(this.spec.duration, this.state.t + passed);
    this.now();
    if (this.state.t >= this.spec.duration) return this.pause();
    this.#frame = requestAnimationFrame((time) => this.#tick(time));
  }

  /** Draws with the next frame. */
  draw() {
    if (this.#asked || this.playing) return;
    this.#asked = true;
    requestAnimationFrame(() => { this.#asked = false; this.now(); });
  }

  /** Draws. */
  now() {
    const { spec, state, camera } = this, { control } = spec;
    spec.draw(state, camera, this.prefix).forEach(({ svg, caption, about }, k) => {
      this.views[k].innerHTML = svg;
      this.views[k].setAttribute("aria-label", about);
      if (this.captions[k].innerHTML !== caption) this.captions[k].innerHTML = caption;
    });
    for (const element of this.box.querySelectorAll(".handle")) {
      const handle = /** @type {HTMLElement} */ (element), x = state.points[handle.dataset.name ?? ""];
      const [left, top] = place(spec, camera, x, state), view = /** @type {HTMLElement} */ (handle.parentElement?.firstElementChild);
      handle.style.left = `${view.offsetLeft + left / 100 * view.offsetWidth}px`;
      handle.style.top = `${view.offsetTop + top / 100 * view.offsetHeight}px`;
      handle.setAttribute("aria-valuenow", Math.hypot(...x).toFixed(2));
      handle.setAttribute("aria-valuetext", brief(x));
    }
    if ("choices" in control) {
      const radio = /** @type {HTMLInputElement} */ (this.box.querySelectorAll(".choice input")[state.v]);
      if (radio) radio.checked = true;
    } else {
      const range = /** @type {HTMLInputElement} */ (this.box.querySelector(".range input")), words = control.words(state.v);
      if (Number(range.value) !== state.v) range.value = String(state.v);
      range.setAttribute("aria-valuetext", words);
      /** @type {HTMLElement} */ (this.box.querySelector(".range output")).textContent = words;
    }
    const readout = this.box.parentElement?.querySelector(".readout"), text = spec.readout(state);
    if (readout && readout.innerHTML !== text) readout.innerHTML = text;
  }
}
