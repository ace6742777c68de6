// @ts-check
// The page: a form, a report, and the address that holds the state of both.
import { FIELDS, REPORTS, read, used, write } from "./address.js";
import { Engine } from "./engine-client.js";
import { Grid } from "./grid.js";
import { Problem } from "./problem.js";

/** @param {string} id @returns {any} */
const by = (id) => document.getElementById(id);
const engine = new Engine();
const COPIES = ["latex", "markdown", "csv", "json", "text", "toml", "python", "rust"];
/** Reports that are drawn, each by a module that is loaded on demand. */
const DRAWN = {
  transport: async () => new (await import("./transport.js")).TransportView(by("view"), (path) => { by("path").value = path; compute("replace"); }),
  motion: async () => new (await import("./motion.js")).MotionView(by("view")),
};
/** The picture on the page. @type {{report: string, view: any} | null} */
let picture = null;
const problem = new Problem(by("example"), by("parameters"), by("problem"), (history) => compute(history));
const grid = new Grid(by("grid"), (metric) => { by("metric").value = metric; compute("replace"); });
/** The request whose report is shown. @type {Record<string, string>} */
let shown = {};

by("reports").append(...REPORTS.map((name) => {
  const label = document.createElement("label");
  const input = Object.assign(document.createElement("input"), { type: "radio", name: "report", value: name });
  label.append(input, " ", name);
  return label;
}));

by("copies").append("Copy as ", ...COPIES.map((format) => {
  const button = Object.assign(document.createElement("button"), { type: "button", textContent: format, disabled: true });
  button.addEventListener("click", () => copy(format));
  return button;
}));

/** The last copy, as a file. */
by("copies").append(Object.assign(document.createElement("a"), { id: "download", textContent: "Download", hidden: true }));

/** The state of the form. */
function state() {
  const data = new FormData(by("form"));
  /** @type {Record<string, string>} */
  const state = { report: String(data.get("report") ?? "compare") };
  for (const name of used(state.report)) state[name] = String(data.get(name) ?? "").trim();
  return Object.fromEntries(Object.entries(state).filter(([, value]) => value !== ""));
}

/** @param {Record<string, string>} state */
function fill(state) {
  for (const input of document.querySelectorAll("input[name=report]")) {
    const radio = /** @type {HTMLInputElement} */ (input);
    radio.checked = radio.value === state.report;
  }
  for (const name of FIELDS) by(name).value = state[name] ?? "";
  by("own").open = Boolean(state.definition);
  if (state.report === "motion") problem.fill();
  const moments = /^diag\(([^,]+),([^,]+),([^,]+)\)$/.exec(state.metric ?? "");
  document.querySelectorAll(".moment").forEach((slider, k) => { /** @type {any} */ (slider).value = moments?.[k + 1] ?? "1"; });
  const lambda = /^lambda\s*=\s*(\d+)(?:\/(\d+))?$/.exec(state.connection ?? "");
  if (lambda) by("lambda").value = String(24 * Number(lambda[1]) / Number(lambda[2] ?? 1));
  enable();
}

/** Only the fields that the report uses are there. */
function enable() {
  const names = used(state().report);
  /** Fields that write into others. @type {Record<string, string>} */
  const into = { lambda: "connection", example: "problem", parameters: "problem", "moments-field": "path", "grid-field": "metric" };
  for (const name of [...FIELDS, ...Object.keys(into)]) {
    const idle = !names.includes(into[name] ?? name);
    by(name).disabled = idle;
    by(name).closest(".field, details, .fields > *, #parameters").hidden = idle;
  }
  by("space").placeholder = names.includes("other") ? "M3" : "";
  by("lambda-value").textContent = fraction(Number(by("lambda").value));
}

/** The grid of the metric, in the basis of the space. */
async function square() {
  if (!by("grid-field").open || by("grid").contains(document.activeElement)) return;
  const { space = "", definition = "", metric = "", report } = state();
  if (report === "transport") return grid.show(["e1", "e2", "e3"], metric);
  try {
    // the empty metric: entries that are being written need not be a metric yet
    const { answer } = await engine.ask({ report: "table", space, definition, show: "structure", format: "json" });
    grid.show(JSON.parse(answer.text).algebra.basis, metric);
  } catch (problem) {
    if (/** @type {any} */ (problem).kind === "refused") by("grid").replaceChildren("A grid needs a space.");
  }
}

/** @param {number} parts twenty-fourths */
function fraction(parts) {
  const divisor = (/** @type {number} */ a, /** @type {number} */ b) => { while (b) [a, b] = [b, a % b]; return a; };
  const common = divisor(parts, 24) || 1;
  return 24 / common === 1 ? String(parts / common) : `${parts / common}/${24 / common}`;
}

/** The number of computations begun: only the newest ends the wait. */
let begun = 0;

/** Computes what the form says. @param {"push" | "replace" | "keep"} history */
async function compute(history) {
  const request = state();
  if (history !== "keep" && write(request) !== location.hash) {
    window.history[history === "push" ? "pushState" : "replaceState"](null, "", write(request));
  }
  const turn = ++begun;
  by("error").replaceChildren();
  wait(true);
  by("status").textContent = "computing…";
  try {
    const drawn = request.report in DRAWN;
    const { answer, ms } = await engine.ask(drawn ? { ...request, format: "json" } : request, (name) => {
      if (turn === begun) by("status").textContent = `computing: ${name}`;
    });
    shown = request;
    if (drawn) await draw(request.report, JSON.parse(answer.text));
    else show(answer.text, answer.pictures);
    if (turn !== begun) return;
    by("status").textContent = [`${Math.max(1, Math.round(ms))} ms`, ...answer.notes].join("; ");
    for (const button of by("copies").querySelectorAll("button")) button.disabled = false;
  } catch (problem) {
    const { kind, message, refusal } = /** @type {any} */ (problem);
    if (kind === "replaced" || turn !== begun) return;
    by("status").textContent = kind === "stopped" ? "stopped" : "";
    if (kind === "refused") refuse(refusal);
    else if (kind === "crashed") refuse({ message: `The computation failed, and the engine was started anew: ${message}`, help: "Your input is kept. A smaller space or fewer tensors may succeed." });
    else if (kind === "failed") refuse({ message: `The engine did not load: ${message}`, help: "This page needs a browser with WebAssembly and modules in workers." });
    else if (kind !== "stopped") throw problem;
  }
  wait(false);
  if (!engine.busy) await square();
}

/** When the wait began. */
let since = 0;

/** A button to stop, and the seconds that have passed: not in the status, which is read aloud. @param {boolean} begins */
function wait(begins) {
  by("stop").disabled = !begins;
  since = begins ? since || performance.now() : 0;
  by("wait").hidden = true;
}
setInterval(() => {
  const seconds = Math.floor((performance.now() - since) / 1000);
  if (!since || seconds < 1) return;
  by("wait").hidden = false;
  by("seconds").textContent = `${seconds} s`;
}, 250);

/** A report as a picture, with its table on request. @param {string} report @param {any} data */
async function draw(report, data) {
  if (picture?.report !== report) {
    picture?.view.stop?.();
    picture = { report, view: await DRAWN[/** @type {keyof typeof DRAWN} */ (report)]() };
  }
  picture.view.show(data);
  by("result").replaceChildren();
  by("values").hidden = false;
  by("table").replaceChildren();
  if (by("values").open) await tabulate();
}

/** The values of a picture, in a table. */
async function tabulate() {
  if (engine.busy) return;
  try {
    const { answer } = await engine.ask({ ...shown, format: "html" });
    by("table").replaceChildren(...contents(answer.text));
  } catch (problem) {
    if (/** @type {any} */ (problem).kind !== "replaced") throw problem;
  }
}

/** A report as it is written, with pictures. @param {string} html @param {{title: string, svg: string}[]} pictures */
function show(html, pictures = []) {
  picture?.view.stop?.();
  picture = null;
  by("view").replaceChildren();
  by("values").hidden = true;
  by("result").replaceChildren(...contents(html), ...pictures.map(({ title, svg }) => {
    const details = document.createElement("details");
    const box = Object.assign(document.createElement("div"), { className: "picture" });
    box.tabIndex = 0;
    box.setAttribute("role", "group");
    box.setAttribute("aria-label", title);
    box.append(document.importNode(new DOMParser().parseFromString(svg, "image/svg+xml").documentElement, true));
    details.append(Object.assign(document.createElement("summary"), { textContent: title }), box);
    return details;
  }));
}

/** What a page of the engine has in its body. @param {string} html */
function contents(html) {
  const { body } = new DOMParser().parseFromString(html, "text/html");
  for (const heading of body.querySelectorAll("h1, h2, h3")) {
    // the page has its own first heading
    const lower = document.createElement(`h${Number(heading.tagName[1]) + 1}`);
    for (const { name, value } of heading.attributes) lower.setAttribute(name, value);
    lower.append(...heading.childNodes);
    heading.replaceWith(lower);
  }
  for (const link of body.querySelectorAll("nav a")) {
    const button = Object.assign(document.createElement("button"), { type: "button", className: "link", textContent: link.textContent });
    button.addEventListener("click", () => by(link.getAttribute("href")?.slice(1) ?? "").scrollIntoView());
    link.replaceWith(button);
  }
  // other links than states would replace the state in the address, or lead to files that are not here
  for (const link of body.querySelectorAll("a[href]:not([href^='#report='])")) link.replaceWith(...link.childNodes);
  // the page has a header and a main part of its own
  for (const part of body.querySelectorAll("header, main")) part.replaceWith(...part.childNodes);
  return body.childNodes;
}

/** The input of a source of a message. @type {Record<string, string>} */
const SOURCES = { "definition.toml": "definition", "definition.json": "definition", "problem.toml": "problem", path: "path", vector: "vector", "--metric": "metric", "--connection": "connection", "--set": "set" };

/** @param {{message: string, place?: any, help?: string | null}} refusal @param {boolean} [typing] whether the cursor stays where it is */
function refuse({ message, place, help }, typing = false) {
  const line = (/** @type {string} */ tag, /** @type {string | null | undefined | false} */ text) =>
    text ? [Object.assign(document.createElement(tag), { textContent: text })] : [];
  const under = place?.text && `${place.source}, line ${place.line}\n${place.text}\n${" ".repeat(place.from)}${"^".repeat(Math.max(1, place.to - place.from))}`;
  by("error").replaceChildren(...line("p", message), ...line("pre", under), ...line("p", help && `Help: ${help}`));
  const input = place?.selection && by(SOURCES[place.source]);
  if (!typing && input && /** @type {any} */ (document.activeElement)?.type !== "range") {
    const closed = input.closest("details");
    if (closed) closed.open = true;
    input.focus();
    input.setSelectionRange(...place.selection);
  }
}

/** The fields whose letters are checked while they are typed. */
const LIVE = ["definition", "metric", "connection", "set"];
/** @type {ReturnType<typeof setTimeout> | undefined} */
let pause;

/** Checks what is typed: the brackets, the Jacobi identity and the names, and no tensor. */
async function check() {
  const { report, other, ...fields } = state();
  // what is being computed has its own message
  if (!by("stop").disabled || !used(report).includes("definition")) return;
  try {
    await engine.ask({ ...fields, report: "table", show: "structure", format: "csv" });
    by("error").replaceChildren();
  } catch (problem) {
    const { kind, refusal } = /** @type {any} */ (problem);
    if (kind === "refused") refuse(refusal, true);
  }
}
for (const name of LIVE) {
  by(name).addEventListener("input", () => {
    clearTimeout(pause);
    pause = setTimeout(check, 250);
  });
}

/** @param {string} format */
async function copy(format) {
  try {
    const { answer } = await engine.ask({ ...shown, format });
    const endings = /** @type {Record<string, string>} */ ({ latex: "tex", markdown: "md", text: "txt", python: "py", rust: "rs" });
    URL.revokeObjectURL(by("download").href);
    const name = shown.report === "motion" && format === "toml" ? "problem" : shown.report;
    Object.assign(by("download"), { href: URL.createObjectURL(new Blob([answer.text])), download: `${name}.${endings[format] ?? format}`, hidden: false });
    await navigator.clipboard.writeText(answer.text);
    by("status").textContent = `copied as ${format}`;
  } catch (problem) {
    refuse({ message: `It could not be copied as ${format}: ${/** @type {any} */ (problem)?.refusal?.message ?? problem}` });
  }
}

by("form").addEventListener("submit", (/** @type {Event} */ event) => { event.preventDefault(); compute("push"); });
by("reports").addEventListener("change", () => {
  if (state().report === "motion") problem.fill();
  enable();
  compute("push");
});
by("grid-field").addEventListener("toggle", square);
by("values").addEventListener("toggle", () => { if (by("values").open) tabulate(); });
document.querySelectorAll(".moment").forEach((slider) => slider.addEventListener("input", () => {
  by("metric").value = `diag(${[...document.querySelectorAll(".moment")].map((slider) => /** @type {any} */ (slider).value).join(",")})`;
  compute("replace");
}));
by("stop").addEventListener("click", () => engine.stop());
by("lambda").addEventListener("input", () => {
  by("connection").value = `lambda=${fraction(Number(by("lambda").value))}`;
  enable();
  compute("replace");
});
by("own").addEventListener("dragover", (/** @type {DragEvent} */ event) => event.preventDefault());
by("own").addEventListener("drop", async (/** @type {DragEvent} */ event) => {
  event.preventDefault();
  const [file] = event.dataTransfer?.files ?? [];
  if (!file) return;
  if (file.size > 1 << 20) return refuse({ message: `${file.name} is larger than 1 MB` });
  by("definition").value = await file.text();
  compute("push");
});

/** The state of the address, into the form. */
function enter() {
  const { state, unknown } = read(location.hash);
  fill(state);
  return compute("keep").then(() => {
    if (unknown.length) refuse({ message: `The address has parts that are not understood: ${unknown.join(", ")}` });
  });
}
addEventListener("popstate", enter);

// names for the search, once the first report stands
enter().then(() => engine.ask({ report: "list", format: "json" })).then(({ answer }) => {
  const { spaces } = JSON.parse(answer.text);
  by("names").append(...spaces.map((/** @type {any} */ { example, summary }) =>
    Object.assign(document.createElement("option"), { value: example, label: summary })));
}).catch(() => {});
