// @ts-check
// The shell: reads the address, shows a view, and gives the views what they share.

import { copy, confirm } from "./export.js";

/** @typedef {{open(state: string): void | Promise<void>, state(): string, title(): string, cards(): Element[], clock?(): import("./present.js").Clock | null, about?(): import("./present.js").About}} View */
/**
 * @typedef {Object} Services what every view gets
 * @property {{ask(request: object, stage?: (name: string) => void): Promise<any>, stop(): void}} engine
 * @property {{get(): string, set(state: string, history: "push" | "replace"): void}} address the state behind `#compute?`
 * @property {(text: string) => void} say writes the status line
 * @property {(text: string) => void} title names the state in the title of the document
 * @property {HTMLFormElement} box the box of the first screen
 */

/** @param {string} id @returns {any} */
const by = (id) => document.getElementById(id);

/** The engine; it is loaded with the first request, or when the page is idle. */
const engine = new class {
  /** @type {any} */ #client = null;
  async client() {
    const { Engine } = await import("./engine-client.js");
    return this.#client ??= new Engine();
  }
  /** @param {object} request @param {(name: string) => void} [stage] */
  async ask(request, stage) { return (await this.client()).ask(request, stage); }
  stop() { this.#client?.stop(); }
}();

/** @type {Services} */
const services = {
  engine,
  address: {
    get: () => /^#compute\?(.*)$/s.exec(location.hash)?.[1] ?? "",
    set: (state, mode) => {
      const address = state ? `#compute?${state}` : "#compute";
      if (address === location.hash) return;
      if (mode === "push") history.pushState(null, "", address);
      else history.replaceState(history.state, "", address);
      show("compute");
    },
  },
  say: (text) => { by("say").textContent = text; },
  title: (text) => { document.title = text ? `${text} - affinor` : "affinor: what does parallel mean on a group?"; },
  box: by("box"),
};

/** Views by name, once they are mounted. @type {Record<string, Promise<View>>} */
const mounted = {};
/** How a view is loaded and mounted. @type {Record<string, () => Promise<View>>} */
const MOUNT = {
  paper: async () => (await import("./paper/main.js")).mount(by("paper"), services),
  explore: async () => (await import("./explore/main.js")).mount(services),
  // @ts-ignore the view of a package of its own
  compute: async () => (await import("./compute/main.js")).mount(by("compute"), services),
};

/** Splits an address `#view/rest` or `#view?rest`. @param {string} hash */
export function route(hash) {
  const [, view = "", rest = ""] = /^#?([a-z]*)[/?]?(.*)$/s.exec(hash) ?? [];
  return ["explore", "compute", "paper"].includes(view) ? { view, rest } : { view: "explore", rest: "" };
}

/** Shows the sections of a view. @param {string} view */
function show(view) {
  document.body.dataset.view = view;
  for (const name of ["explore", "compute", "paper", "contents", "page"]) by(name).hidden = name !== view && !(name === "contents" && view === "explore");
  by("box").hidden = view !== "explore" && view !== "compute";
  for (const link of document.querySelectorAll("nav a")) {
    if (link.getAttribute("href") === `#${view === "page" ? "explore" : view}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
}

/** Opens what the address names. */
async function open() {
  const { view, rest } = route(location.hash);
  show(view);
  services.title("");
  services.say("");
  try {
    const shown = await (mounted[view] ??= MOUNT[view]());
    // a later address has been opened meanwhile
    if (route(location.hash).view !== view) return;
    await shown.open(rest);
    if (route(location.hash).view === view) services.title(shown.title());
  } catch (error) {
    delete mounted[view];
    services.say(`This view did not load: ${/** @type {Error} */ (error).message}. Reload the page to try again.`);
  }
}

/** The view that is shown. */
const current = () => mounted[document.body.dataset.view ?? ""];

addEventListener("popstate", open);
// an address without a state is the name of a section, to which the browser would scroll
for (const link of document.querySelectorAll(".brand, nav a")) {
  link.addEventListener("click", (event) => {
    const { ctrlKey, metaKey, shiftKey } = /** @type {MouseEvent} */ (event);
    if (ctrlKey || metaKey || shiftKey) return;
    event.preventDefault();
    const address = link.getAttribute("href") ?? "";
    if (location.hash !== address) history.pushState(null, "", address);
    scrollTo(0, 0);
    open();
  });
}
document.querySelector(".skip")?.addEventListener("click", (event) => {
  // the address keeps the view
  event.preventDefault();
  by("main").focus();
  by("main").scrollIntoView();
});
by("box").addEventListener("submit", (/** @type {Event} */ event) => {
  event.preventDefault();
  const space = by("space-input")?.value.trim();
  // the field of Compute, which replaces this one when it is mounted, computes by itself
  if (space && by("space-input").localName === "input") location.hash = `#compute?space=${encodeURIComponent(space)}`;
});
by("share").addEventListener("click", async () => {
  try {
    await copy(location.href);
    confirm(by("share"), "link copied");
    services.say("The link is copied. It opens this page in this state.");
  } catch (error) {
    services.say(`The link could not be copied: ${/** @type {Error} */ (error).message}. It is in the address bar.`);
  }
});

async function presented() {
  const [view, { present }] = await Promise.all([current(), import("./present.js")]);
  const cards = view?.cards() ?? [];
  if (cards.length) present(cards, document.title.replace(/ - affinor$|^affinor: /, ""), () => view.clock?.() ?? null, view.about?.());
  else services.say("There is no card to present yet.");
}
by("present").addEventListener("click", presented);
addEventListener("keydown", (event) => {
  const typing = /** @type {HTMLElement} */ (event.target).closest?.("input:not([type=range], [type=radio], [type=checkbox]), textarea, select, dialog");
  if (event.key.toLowerCase() !== "p" || typing || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  presented();
});

// what may be needed next is loaded when nothing else is to do
addEventListener("load", () => setTimeout(async () => {
  const saving = /** @type {any} */ (navigator).connection?.saveData;
  if (!saving) {
    await (mounted.compute ??= MOUNT.compute()).catch(() => { delete mounted.compute; });
    await engine.client().catch(() => {});
  }
  // the files that it stores are in the cache of the browser by then
  if ("serviceWorker" in navigator) setTimeout(() => navigator.serviceWorker.register(new URL("../sw.js", import.meta.url)).catch(() => {}), 2500);
}, 600));
open();
