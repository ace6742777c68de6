// @ts-check
// Elements of the page, and parts of the reports of the engine as elements.

/**
 * An element with attributes; `text` is its text, and functions are listeners.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag @param {Record<string, any>} [attributes] @param {...(Node | string)} children @returns {HTMLElementTagNameMap[T]}
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "text") made.textContent = value;
    else if (typeof value === "function") made.addEventListener(name, value);
    else if (typeof value === "boolean") made.toggleAttribute(name, value);
    else made.setAttribute(name, String(value));
  }
  made.append(...children);
  return made;
}

/** @param {string} text @param {(event: Event) => void} act @param {Record<string, any>} [attributes] */
export const button = (text, act, attributes = {}) => element("button", { type: "button", text, click: act, ...attributes });

/** Elements of a fragment of HTML that the engine wrote. @param {string} html */
export function fragment(html) {
  return [...new DOMParser().parseFromString(html, "text/html").body.childNodes];
}

/** What a report of the engine, a page of HTML, has in its main part, without its title. @param {string} html @returns {HTMLElement} */
export function report(html) {
  const { body } = new DOMParser().parseFromString(html.replace(/<style>[^]*?<\/style>/, ""), "text/html");
  const main = /** @type {HTMLElement} */ (body.querySelector("main") ?? body);
  main.querySelector("h1")?.remove();
  for (const heading of main.querySelectorAll("h2")) {
    const lower = element("h3");
    lower.append(...heading.childNodes);
    heading.replaceWith(lower);
  }
  // links would replace the state in the address, or lead to files that are not here
  for (const link of main.querySelectorAll("a[href]")) link.replaceWith(...link.childNodes);
  const box = element("div", { class: "report" });
  box.append(...main.childNodes);
  return box;
}

/** A picture that the engine drew. @param {{title: string, svg: string}} picture */
export function drawn({ title, svg }) {
  const picture = element("figure", { class: "drawn", "aria-label": title });
  picture.append(document.importNode(new DOMParser().parseFromString(svg, "image/svg+xml").documentElement, true));
  return picture;
}

const NS = "http://www.w3.org/1998/Math/MathML";

/** A letter as mathematics: `J11` has the index 11. @param {string} name */
export function letter(name) {
  const [, stem, index] = /^(.*?)_?(\d+|(?<=_).+)?$/s.exec(name) ?? [];
  const greek = /** @type {Record<string, string>} */ ({ alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ϵ", theta: "θ", lambda: "λ", mu: "μ", nu: "ν", rho: "ρ", sigma: "σ", tau: "τ", phi: "ϕ", psi: "ψ", omega: "ω", Omega: "Ω", Lambda: "Λ" });
  const make = (/** @type {string} */ tag, /** @type {(Node | string)[]} */ ...children) => {
    const made = document.createElementNS(NS, tag);
    made.append(...children);
    return made;
  };
  const math = make("math"), base = make("mi", greek[stem] ?? stem);
  math.append(index ? make("msub", base, make(/^\d+$/.test(index) ? "mn" : "mi", index)) : base);
  math.setAttribute("alttext", name);
  return math;
}
