// @ts-check
// Explore: the first screen, and seven pages of one idea each.
import { Stage } from "./stage.js";
import { PAGES } from "./pages.js";
import hero from "./parallel.js";

/** @param {string} id @returns {HTMLElement} */
const by = (id) => /** @type {HTMLElement} */ (document.getElementById(id));

/** The view of Explore. @param {import("../main.js").Services} services @returns {import("../main.js").View & {clock(): Stage}} */
export function mount(services) {
  let id = "", title = "", opened = false;
  /** @type {Stage} */ let stage;
  /** What the control says, once it has been moved. */
  const named = () => {
    const { spec, state } = stage, { control } = spec;
    if (state.v === control.value) return title;
    const words = "choices" in control ? control.choices[state.v] : control.words(state.v);
    return title ? `${title}, ${words}` : `Parallel transport, ${words}`;
  };
  let writing = 0;
  const changed = () => {
    services.title(named());
    // browsers limit how often the address may change
    clearTimeout(writing);
    const address = `#explore${id && `/${id}`}?${stage.save()}`;
    writing = setTimeout(() => { if (location.hash.startsWith("#explore") || !location.hash) history.replaceState(history.state, "", address); }, 120);
  };
  const first = stage = new Stage(by("hero"), hero, "hero", () => changed());
  const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
  /** Whether the first screen has shown once what it is about. */
  let shown = still;
  by("contents").innerHTML = `<h2>Seven pages, one idea each</h2><ol>${PAGES.map(({ id, title, idea }) => `<li><a href="#explore/${id}"><b>${title}</b><span>${idea}</span></a></li>`).join("")}</ol>`;
  return {
    async open(rest) {
      const [, name = "", state] = /^(?:([a-z]+)(?![^?]))?\??(.*)$/s.exec(rest) ?? ["", "", ""];
      const at = PAGES.findIndex((page) => page.id === name);
      if (stage !== first) stage.pause();
      const again = opened;
      opened = true;
      by("page").hidden = at < 0;
      for (const part of ["explore", "box", "contents"]) by(part).hidden = at >= 0;
      if (at < 0) {
        [id, title, stage] = ["", "", first];
        if (state) stage.load(state);
        else stage.now();
        if (!state && !shown && !stage.playing) stage.toggle();
        shown = true;
        if (name) services.say(`There is no page "${name}"; these are the pages.`);
        return;
      }
      const { default: spec } = await PAGES[at].load();
      if (id !== name || !by("page").firstChild) {
        [id, title] = [name, spec.title];
        const near = (/** @type {number} */ k, /** @type {string} */ sign) => PAGES[k] ? `<a href="#explore/${PAGES[k].id}">${sign === "next" ? `${PAGES[k].title} →` : `← ${PAGES[k].title}`}</a>` : '<a href="#explore">All pages</a>';
        by("page").innerHTML = `<h1 tabindex="-1">${spec.title}</h1><div class="spread"><div class="stage"></div><div class="text"><p>${spec.text}</p><p>${spec.more}</p>`
          + `<p class="readout"></p><p><a class="tensors" href="#compute?${spec.tensors}">See the tensors →</a></p></div></div><nav class="steps" aria-label="Pages">${near(at - 1, "before")}${near(at + 1, "next")}</nav>`;
        stage = new Stage(/** @type {HTMLElement} */ (by("page").querySelector(".stage")), spec, "page", () => changed());
        scrollTo(0, 0);
        // who comes from another page reads on from the heading; a first visit begins at the top
        if (again) /** @type {HTMLElement} */ (by("page").querySelector("h1")).focus({ preventScroll: true });
        if (state) stage.load(state);
        else if (!still) stage.toggle();
      } else if (state) stage.load(state);
    },
    state: () => stage.save(),
    title: named,
    cards: () => [stage.box],
    clock: () => stage,
    about: () => ({ ...(stage === first ? { title: by("question").innerHTML, words: document.querySelector("#explore .lead")?.innerHTML ?? "" } : { title: stage.spec.title, words: stage.spec.text }),
      formula: stage.spec.formula, readout: stage.spec.readout(stage.state) }),
  };
}
