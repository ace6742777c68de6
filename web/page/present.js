// @ts-check
// Present: one card over the whole screen, on white or black, with arrow keys from card to card; and pictures and films out of it.
import { download, drawing, film, photo, png } from "./export.js";

/** @typedef {{box: Element, time: number, length: number, pause(): void, go(time: number): void}} Clock the clock of a picture, in seconds */
/** @typedef {{title?: string, words?: string, formula?: string, readout?: string, of?: string}} About title, sentence, formula and numbers of a picture, as HTML; or the space of all cards, as text */

const dialog = document.createElement("dialog");
dialog.className = "presenting";
dialog.setAttribute("aria-label", "Presentation");
dialog.tabIndex = -1;
dialog.innerHTML = '<div class="slide"></div><p class="bar"><button type="button" data-do="before" aria-label="previous card">←</button><span class="where" role="status"></span><button type="button" data-do="next" aria-label="next card">→</button>'
  + '<button type="button" data-do="scheme">Black</button><button type="button" data-do="svg">SVG</button><button type="button" data-do="png">PNG</button><button type="button" data-do="whole" title="The slide with its words and formulas, as PNG">Slide</button><button type="button" data-do="film">Film</button><button type="button" data-do="latex">LaTeX</button><button type="button" data-do="close">Close</button></p>';
const slide = /** @type {HTMLElement} */ (dialog.querySelector(".slide")), where = /** @type {HTMLElement} */ (dialog.querySelector(".where"));
const button = (/** @type {string} */ name) => /** @type {HTMLButtonElement} */ (dialog.querySelector(`[data-do="${name}"]`));

/** @type {Element[]} */ let cards = [];
let at = 0, name = "affinor";
/** @type {About} */ let about = {};
/** Where the card belongs. */
const place = document.createComment("card");
/** @type {() => (Clock | null)} */ let clock = () => null;

/** The longest film, in seconds. */
const LONGEST = 15;

function back() {
  for (const name of ["--formula", "--columns"]) /** @type {HTMLElement | undefined} */ (cards[at])?.style.removeProperty(name);
  if (place.parentNode) place.replaceWith(cards[at]);
}

/** @param {number} k */
function turn(k) {
  back();
  at = Math.max(0, Math.min(cards.length - 1, k));
  cards[at].before(place);
  slide.replaceChildren(cards[at]);
  const { title, words, formula, readout, of } = about;
  if (title) slide.prepend(Object.assign(document.createElement("h2"), { className: "heading", innerHTML: title }));
  if (words) {
    const aside = Object.assign(document.createElement("div"), { className: "aside", innerHTML: `<p class="words">${words}</p>` });
    if (formula) aside.append(Object.assign(document.createElement("p"), { className: "formula", innerHTML: formula }));
    slide.append(aside);
    // a stage writes its numbers beside itself
    if (readout) slide.append(Object.assign(document.createElement("p"), { className: "readout", innerHTML: readout }));
  }
  if (of) slide.prepend(Object.assign(document.createElement("p"), { className: "of", textContent: of }));
  slide.scrollTop = 0;
  grown.disconnect();
  // a card may be computed while it is shown
  for (const part of cards[at].querySelectorAll(".body, .motion")) grown.observe(part, { childList: true });
  settle();
  where.textContent = cards.length > 1 ? `${at + 1} of ${cards.length}` : "";
  for (const part of ["before", "next"]) button(part).hidden = cards.length < 2;
}

const grown = new MutationObserver(() => settle());

/** Fits the card, and offers the exports that it has. */
function settle() {
  fit();
  const drawn = Boolean(cards[at].querySelector("svg"));
  button("svg").hidden = !drawn;
  button("png").hidden = !drawn && !printed();
  button("whole").hidden = !drawn || !about.words;
  button("film").hidden = clock()?.box !== cards[at];
  button("latex").hidden = !latex();
}

/** White space around formulas in a picture, in pixels of the screen. */
const MARGIN = 8;

/** The part of the screen with the formulas of a card that has no drawing. */
function printed() {
  const parts = [cards[at], ...cards[at].querySelectorAll(".body")].flatMap(({ children }) => [...children])
    .filter((part) => part.matches(".components, .matrix, .findings, .report, p")).filter((part) => part.checkVisibility() && part.textContent?.trim());
  if (!parts.some((part) => part.querySelector("math"))) return null;
  const all = parts.flatMap((part) => [part, ...part.querySelectorAll("math")]).map((part) => part.getBoundingClientRect()), shown = slide.getBoundingClientRect();
  const x = Math.max(0, Math.min(...all.map(({ left }) => left)) - MARGIN), right = Math.min(innerWidth, Math.max(...all.map(({ right }) => right)) + MARGIN);
  const y = Math.max(shown.top, Math.min(...all.map(({ top }) => top)) - MARGIN), bottom = Math.min(shown.bottom, Math.max(...all.map(({ bottom }) => bottom)) + MARGIN);
  return { x, y, width: right - x, height: bottom - y };
}

/** The button of a card that copies it as LaTeX. */
const latex = () => /** @type {HTMLButtonElement | undefined} */ ([...cards[at].querySelectorAll(".copies button")].find(({ textContent }) => textContent === "LaTeX"));

/** Sizes of formulas in units of the screen; a card of formulas has the largest that fits, in as many columns as that needs. */
const SIZES = [128, 96, 80, 68, 56, 48, 40, 34, 28];
/** The largest size of formulas in a list. */
const MANY = 68;
const COLUMNS = [1, 2, 3, 4, 5, 6];

/** Shows by its lower edge that a slide goes on. */
function edge() {
  const long = slide.scrollHeight > slide.clientHeight + 1;
  slide.classList.toggle("more", slide.scrollTop + slide.clientHeight < slide.scrollHeight - 1);
  if (long) slide.tabIndex = 0;
  else slide.removeAttribute("tabindex");
}

function fit() {
  const card = /** @type {HTMLElement} */ (cards[at]);
  const wide = () => [...card.querySelectorAll(".components, .matrix, .report, .body > p")].some((part) => part.checkVisibility() && part.scrollWidth > part.clientWidth + 1)
    || [...card.querySelectorAll(".components > li > math")].some((math) => math.checkVisibility() && math.getBoundingClientRect().width > /** @type {Element} */ (math.parentElement).clientWidth + 1);
  const rows = Math.max(1, ...[...card.querySelectorAll(".components")].map(({ children }) => [...children].filter((row) => row.checkVisibility()).length));
  const tries = card.matches(".card:not(.motions)") ? SIZES.filter((size) => rows < 2 || size <= MANY).flatMap((size) => COLUMNS.filter((count) => count <= rows).map((count) => [size, count])) : [];
  const set = (/** @type {number[]} */ [size, count]) => {
    card.style.setProperty("--formula", String(size));
    card.style.setProperty("--columns", String(count));
  };
  const fitted = tries.some((one) => {
    set(one);
    return slide.scrollHeight <= slide.clientHeight + 1 && !wide();
  });
  // a longer list scrolls, in as many columns as there is room for
  if (!fitted) tries.filter(([size]) => size === SIZES.at(-1)).reverse().some((one) => {
    set(one);
    return !wide();
  });
  edge();
}

const ground = () => getComputedStyle(dialog).backgroundColor;

/** @type {Record<string, () => void | Promise<void>>} */
const ACTIONS = {
  before: () => turn(at - 1),
  next: () => turn(at + 1),
  close: () => dialog.close(),
  scheme() {
    const dark = document.documentElement.dataset.scheme !== "dark";
    document.documentElement.dataset.scheme = dark ? "dark" : "light";
    button("scheme").textContent = dark ? "White" : "Black";
  },
  svg() {
    const picture = drawing(cards[at], ground());
    if (picture) download(new Blob([picture.text], { type: "image/svg+xml" }), `${name}.svg`);
  },
  async png() {
    const picture = drawing(cards[at], ground());
    download(await (picture ? png(picture) : photo(dialog, printed() ?? slide.getBoundingClientRect())), `${name}.png`);
  },
  // without its controls, which do nothing in a picture
  async whole() { download(await photo(dialog, { x: 0, y: 0, width: innerWidth, height: slide.getBoundingClientRect().bottom }), `${name}-slide.png`); },
  async film() {
    const stage = clock();
    if (!stage) return;
    stage.pause();
    where.textContent = "recording…";
    const before = stage.time, length = Math.min(stage.length, LONGEST);
    try {
      const made = await film((time) => {
        stage.go(Math.min(time, length));
        return drawing(stage.box, ground());
      }, length);
      download(made, `${name}.webm`);
      where.textContent = "recorded";
    } finally {
      stage.go(before);
    }
  },
  latex() {
    const said = /** @type {HTMLElement} */ (document.getElementById("say"));
    new MutationObserver((_, once) => {
      // the cards may tell something else meanwhile
      if (!said.textContent?.includes("copied")) return;
      where.textContent = said.textContent;
      once.disconnect();
    }).observe(said, { childList: true });
    latex()?.click();
  },
};

dialog.addEventListener("click", async (event) => {
  const action = /** @type {HTMLElement} */ (event.target).closest("[data-do]")?.getAttribute("data-do");
  if (!action) return;
  try {
    await ACTIONS[action]();
  } catch (error) {
    where.textContent = `That failed: ${/** @type {Error} */ (error).message}`;
  }
});
dialog.addEventListener("keydown", (event) => {
  // sliders and points have arrow keys of their own
  if (/** @type {HTMLElement} */ (event.target).matches("input, .handle, .turn") || event.ctrlKey || event.metaKey || event.altKey) return;
  const action = { ArrowRight: "next", PageDown: "next", ArrowLeft: "before", PageUp: "before", b: "scheme", w: "scheme" }[event.key];
  if (!action) return;
  event.preventDefault();
  // a page of a slide that is longer than the screen comes before the next slide
  const way = { PageDown: 1, PageUp: -1 }[event.key] ?? 0, from = slide.scrollTop;
  slide.scrollTop += 0.85 * way * slide.clientHeight;
  if (slide.scrollTop === from) ACTIONS[action]();
});
dialog.addEventListener("close", () => {
  grown.disconnect();
  back();
  delete document.documentElement.dataset.scheme;
  if (document.fullscreenElement) document.exitFullscreen();
});

slide.addEventListener("scroll", edge);
// rows that are unfolded
slide.addEventListener("click", (event) => { if (/** @type {HTMLElement} */ (event.target).matches(".all")) fit(); });
slide.addEventListener("toggle", edge, true);
addEventListener("resize", () => { if (dialog.open) fit(); });

/**
 * Presents cards, first the one that has the focus.
 * @param {Element[]} shown @param {string} title of files @param {() => (Clock | null)} stage the stage that has a clock
 * @param {About} [words] what is written around the cards
 */
export function present(shown, title, stage, words = {}) {
  if (!shown.length || dialog.open) return;
  if (!dialog.isConnected) document.body.append(dialog);
  const first = Math.max(0, shown.findIndex((card) => card.contains(document.activeElement)));
  [cards, about, clock] = [shown, words, stage];
  name = title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") || "affinor";
  document.documentElement.dataset.scheme = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  button("scheme").textContent = document.documentElement.dataset.scheme === "dark" ? "White" : "Black";
  dialog.showModal();
  turn(first);
  dialog.focus();
  dialog.requestFullscreen?.().catch(() => {});
}
