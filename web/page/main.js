// @ts-check
// The page: a form, a report, and the address that holds the state of both.
import { FIELDS, REPORTS, long, read, used, write } from "./address.js";
import { Engine } from "./engine-client.js";
import { Grid, entries, written } from "./grid.js";
import { Problem } from "./problem.js";

/** @param {string} id @returns {any} */
const by = (id) => document.getElementById(id);
const engine = new Engine();
const COPIES = ["latex", "markdown", "csv", "json", "text", "toml", "command", "python"];
/** Copies of reports of a space or a problem alone. */
const FILES = { formats: ["toml", "command", "python"], reports: ["table", "check", "info", "properties", "equations", "motion"] };
/** How often a module did not load. @type {Record<string, number>} */
const failures = {};
/** A module. Browsers remember an address that did not load, so the next attempt has another one. @param {string} name */
const load = async (name) => {
  try {
    return await import(failures[name] ? `./${name}?${failures[name]}` : `./${name}`);
  } catch (error) {
    failures[name] = (failures[name] ?? 0) + 1;
    throw error;
  }
};
/** Reports that are drawn, each by a module that is loaded on demand; it makes a view. */
const DRAWN = {
  transport: async () => {
    const { TransportView } = /** @type {typeof import("./transport.js")} */ (await load("transport.js"));
    return () => new TransportView(by("view"), (path) => { by("path").value = path; compute("replace"); });
  },
  motion: async () => {
    const { MotionView } = /** @type {typeof import("./motion.js")} */ (await load("motion.js"));
    return () => new MotionView(by("view"));
  },
};
/** The picture on the page. @type {{report: string, view: any} | null} */
let picture = null;
const problem = new Problem(by("example"), by("parameters"), by("problem"), {
  change: (history) => compute(history),
  keep: () => keep(write(state())),
});
const grid = new Grid(by("grid"), (metric) => { by("metric").value = metric; compute("replace"); });
/** The request whose report is shown. @type {Record<string, string>} */
let shown = {};
/** Where the message comes from: a computation, or the check of what is typed. */
let said = "";

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

/** What all fields say, those of other reports too. */
function whole() {
  return { ...Object.fromEntries(FIELDS.map((name) => [name, by(name).value])), report: state().report };
}

/** Keeps the form in the present entry of the history: an address has no room for long texts. @param {string} address */
function keep(address) {
  history.replaceState(whole(), "", address);
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
  enable();
}

/** The number of a fraction. @param {string} text */
function number(text) {
  const [above, below = "1"] = text.split("/");
  return Number(above) / Number(below);
}

/** The sliders show what the fields say. */
function slide() {
  const metric = entries(by("metric").value.trim(), 3);
  document.querySelectorAll(".moment").forEach((slider, k) => {
    const moment = number(metric?.[k][k] ?? "1");
    if (slider !== document.activeElement && Number.isFinite(moment)) /** @type {any} */ (slider).value = String(moment);
  });
  const connection = by("connection").value.trim();
  const lambda = /** @type {Record<string, string>} */ ({ plus: "1", zero: "1/2", minus: "0" })[connection] ?? /^lambda\s*=\s*(\S+)$/.exec(connection)?.[1];
  if (lambda && by("lambda") !== document.activeElement && Number.isFinite(number(lambda))) by("lambda").value = String(24 * number(lambda));
  by("lambda-value").textContent = lambda ?? "";
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
  // a definition stands for a space
  const defined = names.includes("definition") && by("definition").value.trim() !== "";
  if (defined) by("space").disabled = true;
  by("space-help").textContent = defined ? "The definition below is used." : SPACE;
  slide();
}
/** The help of the field. */
const SPACE = by("space-help").textContent;

/** The grid of the metric, in the basis of the space. */
async function square() {
  if (!by("grid-field").open || by("grid").contains(document.activeElement)) return;
  const { space = "", definition = "", metric = "", report } = state();
  if (report === "transport") return grid.show(["e1", "e2", "e3"], metric);
  try {
    // without the metric of the field: entries that are being written need not be a metric yet
    const { answer } = await engine.ask({ report: "table", space, definition, show: "structure, metric", format: "json" });
    const { algebra, tensors } = JSON.parse(answer.text), n = algebra.basis.length;
    grid.show(algebra.basis, metric || own(tensors.metric, n));
  } catch (problem) {
    if (/** @type {any} */ (problem).kind === "refused") by("grid").replaceChildren("A grid needs a space.");
  }
}

/** The metric that a space has of its own, as text. @param {any} tensor @param {number} n */
function own(tensor, n) {
  if (!tensor) return "";
  const rows = Array.from({ length: n }, () => Array.from({ length: n }, () => "0"));
  for (const [[i, j], value] of tensor.components) rows[i - 1][j - 1] = String(value);
  return written(rows);
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
  clearTimeout(pause);
  enable();
  const request = state(), address = write(request);
  if (history === "push" && address !== location.hash) window.history.pushState(whole(), "", address);
  else if (history !== "keep") keep(address);
  const turn = ++begun;
  complain();
  wait(true);
  by("status").textContent = "computing…";
  try {
    const drawn = request.report in DRAWN;
    const { answer, ms } = await engine.ask(drawn ? { ...request, format: "json" } : request, (name) => {
      if (turn === begun) by("status").textContent = `computing: ${name}`;
    });
    if (drawn) {
      const view = await viewed(request.report);
      if (turn !== begun) return;
      shown = request;
      await draw(request.report, view, JSON.parse(answer.text));
    } else {
      shown = request;
      show(answer.text, answer.pictures);
    }
    stale(false);
    if (turn !== begun) return;
    const over = long(request).map((name) => `the ${name} is too long for a link`);
    by("status").textContent = [`${Math.max(1, Math.round(ms))} ms`, ...answer.notes, ...over].join("; ");
  } catch (problem) {
    const { kind, message, refusal } = /** @type {any} */ (problem);
    if (kind === "replaced" || turn !== begun) return;
    stale(true);
    by("status").textContent = kind === "stopped" ? "stopped" : "";
    if (kind === "refused") refuse(refusal);
    else if (kind === "crashed") refuse({ message: `The computation failed, and the engine was started anew: ${message}`, help: "Your input is kept. A smaller space or fewer tensors may succeed." });
    else if (kind === "failed") refuse({ message: `The engine did not load: ${message}`, help: "This page needs a browser with WebAssembly and modules in workers. Compute tries again." });
    else if (kind !== "stopped") refuse({ message: `The picture did not load: ${message ?? problem}`, help: "Compute tries again." });
  }
  wait(false);
  if (!engine.busy) await square();
}

/** Marks what stands on the page as a report of an input before, which is not copied. @param {boolean} is */
function stale(is) {
  const marked = is && (Boolean(shown.report) || !by("before").hidden);
  for (const id of ["result", "view", "values"]) by(id).classList.toggle("stale", marked);
  by("before").hidden = !marked;
  if (is) shown = {};
}

/** A message, or none. @param {...(Node | string)} message */
function complain(...message) {
  said = message.length ? "computation" : "";
  by("error").replaceChildren(...message);
}

/** When the wait began. */
let since = 0;

/** A button to stop, and the seconds that have passed: not in the status, which is read aloud. @param {boolean} begins */
function wait(begins) {
  by("stop").disabled = !begins;
  for (const button of by("copies").querySelectorAll("button")) {
    button.disabled = begins || !shown.report || FILES.formats.includes(button.textContent) && !FILES.reports.includes(shown.report);
  }
  since = begins ? since || performance.now() : 0;
  by("wait").hidden = true;
}
setInterval(() => {
  const seconds = Math.floor((performance.now() - since) / 1000);
  if (!since || seconds < 1) return;
  by("wait").hidden = false;
  by("seconds").textContent = `${seconds} s`;
}, 250);

/** What makes the view of a report. @param {string} report @returns {Promise<() => any>} */
async function viewed(report) {
  return picture?.report === report ? () => picture?.view : DRAWN[/** @type {keyof typeof DRAWN} */ (report)]();
}

/** A report as a picture, with its table on request. @param {string} report @param {() => any} view @param {any} data */
async function draw(report, view, data) {
  if (picture?.report !== report) {
    picture?.view.stop?.();
    picture = { report, view: view() };
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
    const { kind, refusal } = /** @type {any} */ (problem);
    if (kind === "refused") refuse(refusal);
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

/** Longer tables would hold the page up. */
const ROWS = 2000;

/** What a page of the engine has in its body. @param {string} html */
function contents(html) {
  // the page has the style of reports
  const { body } = new DOMParser().parseFromString(html.replace(/<style>[^]*?<\/style>/, ""), "text/html");
  for (const rows of body.querySelectorAll("tbody, table")) {
    const all = [...rows.children].filter(({ tagName }) => tagName === "TR");
    if (all.length <= ROWS) continue;
    all.slice(ROWS).forEach((row) => row.remove());
    body.append(Object.assign(document.createElement("p"), { textContent: `The first ${ROWS} of ${all.length} rows; the copies have all.` }));
  }
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
function refuse({ message, place, help }, typing = by("grid").contains(document.activeElement)) {
  const line = (/** @type {string} */ tag, /** @type {string | null | undefined | false} */ text) =>
    text ? [Object.assign(document.createElement(tag), { textContent: text })] : [];
  const under = place?.text && `${place.source}, line ${place.line}\n${place.text}\n${" ".repeat(place.from)}${"^".repeat(Math.max(1, place.to - place.from))}`;
  complain(...line("p", message), ...line("pre", under), ...line("p", help && `Help: ${help}`));
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
    // clears only the message of a check; the message of a computation stays
    if (said === "check") complain();
  } catch (problem) {
    const { kind, refusal } = /** @type {any} */ (problem);
    if (kind !== "refused") return;
    refuse(refusal, true);
    said = "check";
  }
}
for (const name of LIVE) {
  by(name).addEventListener("input", () => {
    clearTimeout(pause);
    pause = setTimeout(check, 250);
    enable();
  });
}

/** @param {string} format */
async function copy(format) {
  const turn = begun;
  wait(true);
  by("status").textContent = `copying as ${format}…`;
  try {
    const { answer } = await engine.ask({ ...shown, format });
    const endings = /** @type {Record<string, string>} */ ({ latex: "tex", markdown: "md", text: "txt", command: "sh", python: "py" });
    URL.revokeObjectURL(by("download").href);
    const name = shown.report === "motion" && format === "toml" ? "problem" : shown.report;
    Object.assign(by("download"), { href: URL.createObjectURL(new Blob([answer.text])), download: `${name}.${endings[format] ?? format}`, hidden: false });
    await navigator.clipboard.writeText(answer.text);
    by("status").textContent = `copied as ${format}`;
  } catch (problem) {
    const { kind, refusal, message } = /** @type {any} */ (problem);
    // what is computed now has its own words
    if (turn !== begun) return;
    by("status").textContent = kind === "stopped" ? "stopped" : "";
    if (kind !== "stopped") refuse({ message: `It could not be copied as ${format}: ${refusal?.message ?? message ?? problem}` });
  }
  if (turn === begun) wait(false);
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
  // the other entries stay as they are
  const rows = entries(by("metric").value.trim(), 3) ?? /** @type {string[][]} */ (entries("", 3));
  const at = [...document.querySelectorAll(".moment")].indexOf(slider);
  rows[at][at] = /** @type {any} */ (slider).value;
  by("metric").value = written(rows);
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

/** The state of the history or of the address, into the form. */
function enter() {
  const { state: asked, unknown } = read(location.hash);
  const kept = history.state && write(fitting(history.state)) === write(asked) ? history.state : asked;
  fill(kept);
  // a choice that is none of the list
  for (const name of FIELDS) if (by(name).tagName === "SELECT" && kept[name] && by(name).value !== kept[name]) unknown.push(`${name}=${kept[name]}`);
  return compute("keep").then(() => {
    keep(location.hash || write(state()));
    if (!unknown.length) return;
    const textContent = `The address has parts that are not understood: ${unknown.join(", ")}`;
    by("error").append(Object.assign(document.createElement("p"), { textContent }));
  });
}

/** What an address has of a state of the form. @param {Record<string, string>} all */
function fitting(all) {
  const kept = ["report", ...used(all.report)].map((name) => [name, (all[name] ?? "").trim()]);
  const state = Object.fromEntries(kept.filter(([, value]) => value !== ""));
  if (state.definition) delete state.space;
  return state;
}
addEventListener("popstate", enter);

// names for the search, once the first report stands
enter().then(() => engine.ask({ report: "list", format: "json" })).then(({ answer }) => {
  const { spaces } = JSON.parse(answer.text);
  by("names").append(...spaces.map((/** @type {any} */ { example, summary }) =>
    Object.assign(document.createElement("option"), { value: example, label: summary })));
}).catch(() => {});
