// @ts-check
// Present: one card over the whole screen, on white or black, with arrow keys from card to card; and pictures and films out of it.
import { download, drawing, film, png } from "./export.js";

/** @typedef {{box: Element, state: {t: number}, spec: {duration: number, id: string}, pause(): void, now(): void}} Clock a stage with a clock */

const dialog = document.createElement("dialog");
dialog.className = "presenting";
dialog.setAttribute("aria-label", "Presentation");
dialog.tabIndex = -1;
dialog.innerHTML = '<div class="slide"></div><p class="bar"><button type="button" data-do="before" aria-label="previous card">←</button><span class="where" role="status"></span><button type="button" data-do="next" aria-label="next card">→</button>'
  + '<button type="button" data-do="scheme">Black</button><button type="button" data-do="svg">SVG</button><button type="button" data-do="png">PNG</button><button type="button" data-do="film">Film</button><button type="button" data-do="close">Close</button></p>';
const slide = /** @type {HTMLElement} */ (dialog.querySelector(".slide")), where = /** @type {HTMLElement} */ (dialog.querySelector(".where"));
const button = (/** @type {string} */ name) => /** @type {HTMLButtonElement} */ (dialog.querySelector(`[data-do="${name}"]`));

/** @type {Element[]} */ let cards = [];
let at = 0, name = "affinor";
/** The title and the words of a slide that is a picture. @type {{title: string, words: string} | undefined} */ let about;
/** Where the card belongs. */
const place = document.createComment("card");
/** @type {() => (Clock | null)} */ let clock = () => null;

function back() {
  /** @type {HTMLElement | undefined} */ (cards[at])?.style.removeProperty("--formula");
  if (place.parentNode) place.replaceWith(cards[at]);
}

/** @param {number} k */
function turn(k) {
  back();
  at = Math.max(0, Math.min(cards.length - 1, k));
  cards[at].before(place);
  slide.replaceChildren(cards[at]);
  if (about) {
    const heading = Object.assign(document.createElement("h2"), { className: "heading", innerHTML: about.title });
    const words = Object.assign(document.createElement("p"), { className: "words", innerHTML: about.words });
    slide.prepend(heading);
    slide.append(words);
  }
  fit();
  where.textContent = cards.length > 1 ? `${at + 1} of ${cards.length}` : "";
  for (const part of ["before", "next"]) button(part).hidden = cards.length < 2;
  const drawn = Boolean(cards[at].querySelector("svg"));
  const moving = clock()?.box === cards[at];
  for (const part of ["svg", "png", "film"]) {
    const [can, reason] = part === "film" ? [moving, "only pictures with a clock can be filmed"] : [drawn, "only pictures can be exported"];
    button(part).disabled = !can;
    button(part).title = can ? "" : reason;
  }
}

/** Sizes of formulas in pixels; a card of formulas has the largest that fits. */
const SIZES = [96, 80, 68, 56, 48, 40, 34, 28];

function fit() {
  const card = /** @type {HTMLElement} */ (cards[at]);
  if (!card.matches(".card")) return;
  const wide = () => [...card.querySelectorAll(".components, .matrix, .report, .body > p")].some((part) => part.scrollWidth > part.clientWidth + 1);
  for (const size of SIZES) {
    card.style.setProperty("--formula", `${size}px`);
    if (slide.scrollHeight <= slide.clientHeight && !wide()) return;
  }
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
    if (picture) download(await png(picture), `${name}.png`);
  },
  async film() {
    const stage = clock();
    if (!stage) return;
    stage.pause();
    where.textContent = "recording…";
    const length = Math.min(stage.spec.duration, 12);
    const made = await film((time) => {
      stage.state.t = Math.min(time, length);
      stage.now();
      return drawing(cards[at], ground());
    }, length);
    download(made, `${name}.webm`);
    where.textContent = "recorded";
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
  ACTIONS[action]();
});
dialog.addEventListener("close", () => {
  back();
  delete document.documentElement.dataset.scheme;
  if (document.fullscreenElement) document.exitFullscreen();
});

addEventListener("resize", () => { if (dialog.open) fit(); });

/**
 * Presents cards, first the one that has the focus.
 * @param {Element[]} shown @param {string} title of files @param {() => (Clock | null)} stage the stage that has a clock
 * @param {{title: string, words: string}} [words] what is written around a picture, as HTML
 */
export function present(shown, title, stage, words) {
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
