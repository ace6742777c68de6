// @ts-check
// The page: a form, a report, and the address that holds the state of both.
import { FIELDS, REPORTS, read, used, write } from "./address.js";
import { Engine } from "./engine-client.js";

/** @param {string} id @returns {any} */
const by = (id) => document.getElementById(id);
const engine = new Engine();
const COPIES = ["latex", "markdown", "csv", "json", "text"];
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
  const lambda = /^lambda\s*=\s*(\d+)(?:\/(\d+))?$/.exec(state.connection ?? "");
  if (lambda) by("lambda").value = String(24 * Number(lambda[1]) / Number(lambda[2] ?? 1));
  enable();
}

/** Only the fields that the report uses are there. */
function enable() {
  const names = used(state().report);
  for (const name of [...FIELDS, "lambda"]) {
    const idle = !names.includes(name === "lambda" ? "connection" : name);
    by(name).disabled = idle;
    by(name).closest(".field, details").hidden = idle;
  }
  by("space").placeholder = names.includes("other") ? "M3" : "";
  by("lambda-value").textContent = fraction(Number(by("lambda").value));
}

/** @param {number} parts twenty-fourths */
function fraction(parts) {
  const divisor = (/** @type {number} */ a, /** @type {number} */ b) => { while (b) [a, b] = [b, a % b]; return a; };
  const common = divisor(parts, 24) || 1;
  return 24 / common === 1 ? String(parts / common) : `${parts / common}/${24 / common}`;
}

/** Computes what the form says. @param {"push" | "replace" | "keep"} history */
async function compute(history) {
  const request = state();
  if (history !== "keep" && write(request) !== location.hash) {
    window.history[history === "push" ? "pushState" : "replaceState"](null, "", write(request));
  }
  by("error").replaceChildren();
  by("stop").disabled = false;
  by("status").textContent = "computing…";
  try {
    const { answer, ms } = await engine.ask(request);
    show(answer.text);
    shown = request;
    by("status").textContent = [`${Math.max(1, Math.round(ms))} ms`, ...answer.notes].join("; ");
    for (const button of by("copies").querySelectorAll("button")) button.disabled = false;
  } catch (problem) {
    const { kind, message, refusal } = /** @type {any} */ (problem);
    if (kind === "replaced") return;
    by("status").textContent = kind === "stopped" ? "stopped" : "";
    if (kind === "refused") refuse(refusal);
    else if (kind === "crashed") refuse({ message: `The computation failed, and the engine was started anew: ${message}`, help: "Your input is kept. A smaller space or fewer tensors may succeed." });
    else if (kind === "failed") refuse({ message: `The engine did not load: ${message}`, help: "This page needs a browser with WebAssembly and modules in workers." });
    else if (kind !== "stopped") throw problem;
  }
  by("stop").disabled = true;
}

/** The main part of a page of the engine. @param {string} html */
function show(html) {
  const page = new DOMParser().parseFromString(html, "text/html");
  const main = page.querySelector("main");
  for (const heading of main?.querySelectorAll("h1, h2, h3") ?? []) {
    // the page has its own first heading
    const lower = document.createElement(`h${Number(heading.tagName[1]) + 1}`);
    for (const { name, value } of heading.attributes) lower.setAttribute(name, value);
    lower.append(...heading.childNodes);
    heading.replaceWith(lower);
  }
  // links of the report would replace the state in the address
  for (const link of main?.querySelectorAll("a[href^='#']") ?? []) link.replaceWith(...link.childNodes);
  by("result").replaceChildren(...(main?.childNodes ?? []));
}

/** The input of a source of a message. @type {Record<string, string>} */
const SOURCES = { "definition.toml": "definition", "definition.json": "definition", "--metric": "metric", "--connection": "connection", "--set": "set" };

/** @param {{message: string, place?: any, help?: string | null}} refusal */
function refuse({ message, place, help }) {
  const line = (/** @type {string} */ tag, /** @type {string | null | undefined | false} */ text) =>
    text ? [Object.assign(document.createElement(tag), { textContent: text })] : [];
  const under = place?.text && `${place.source}, line ${place.line}\n${place.text}\n${" ".repeat(place.from)}${"^".repeat(Math.max(1, place.to - place.from))}`;
  by("error").replaceChildren(...line("p", message), ...line("pre", under), ...line("p", help && `Help: ${help}`));
  const input = place?.selection && by(SOURCES[place.source]);
  if (input && document.activeElement !== by("lambda")) {
    input.focus();
    input.setSelectionRange(...place.selection);
  }
}

/** @param {string} format */
async function copy(format) {
  try {
    const { answer } = await engine.ask({ ...shown, format });
    await navigator.clipboard.writeText(answer.text);
    by("status").textContent = `copied as ${format}`;
  } catch (problem) {
    refuse({ message: `It could not be copied as ${format}: ${/** @type {any} */ (problem)?.refusal?.message ?? problem}` });
  }
}

by("form").addEventListener("submit", (/** @type {Event} */ event) => { event.preventDefault(); compute("push"); });
by("reports").addEventListener("change", () => { enable(); compute("push"); });
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
