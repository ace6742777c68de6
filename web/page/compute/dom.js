// @ts-check
// Elements of the page, and parts of the reports of the engine as elements.

const NS = "http://www.w3.org/1998/Math/MathML";

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
  const { body } = new DOMParser().parseFromString(html, "text/html");
  labelled(body);
  chained(body);
  return [...body.childNodes];
}

/** Joins the name of a matrix and the matrix into one formula, so that they have one axis. @param {Element} box */
function labelled(box) {
  for (const matrix of box.querySelectorAll(".matrix")) {
    const [name, value, ...more] = matrix.children, row = value?.firstElementChild;
    if (name?.localName !== "math" || value?.localName !== "math" || row?.firstElementChild?.textContent !== "=" || more.length) continue;
    row.prepend(...name.childNodes);
    value.setAttribute("alttext", `${name.getAttribute("alttext")} = ${value.getAttribute("alttext")}`);
    name.remove();
  }
}

/** Groups the sides of equations with several sides, so that lines can break between them. @param {Element} box */
function chained(box) {
  for (const math of box.querySelectorAll('math[display="block"]')) {
    const [row, ...more] = math.children;
    if (row?.localName !== "mrow" || more.length) continue;
    /** @type {Element[][]} */ const sides = [[]];
    for (const part of row.children) {
      if (part.localName === "mo" && part.textContent === "=") sides.push([]);
      sides[sides.length - 1].push(part);
    }
    if (sides.length < 3) continue;
    math.replaceChildren(...sides.filter((side) => side.length).map((side) => {
      const group = document.createElementNS(NS, "mrow");
      group.append(...side);
      return group;
    }));
    math.classList.add("chain");
  }
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

/** The height of the title of a picture. */
const TITLE = 40;

/** A picture that the engine drew. @param {{title: string, svg: string}} picture */
export function drawn({ title, svg }) {
  const picture = element("figure", { class: "drawn", "aria-label": title });
  const { documentElement } = new DOMParser().parseFromString(svg, "image/svg+xml"), made = /** @type {any} */ (document.importNode(documentElement, true));
  // without the band of the title, which the card has
  const [, , width, height] = (made.getAttribute("viewBox") ?? "").split(" ").map(Number);
  if (height > TITLE) made.setAttribute("viewBox", `0 ${TITLE} ${width} ${height - TITLE}`);
  made.removeAttribute("height");
  made.setAttribute("width", `${width / 16}rem`);
  picture.append(made);
  return picture;
}

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
