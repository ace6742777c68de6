// @ts-check
// Pictures out of the page: SVG with its colours written out, PNG, and a film.

/** Properties of style that a picture needs outside of the page. */
const KEPT = ["fill", "stroke", "stroke-width", "stroke-opacity", "fill-opacity", "opacity", "stroke-dasharray", "stroke-linecap", "stroke-linejoin",
  "stop-color", "stop-opacity", "font-family", "font-size", "font-style", "font-weight", "text-anchor", "paint-order", "display"];

/** The pictures of a card side by side, as one SVG document, and its size. @param {Element} card @param {string} ground colour behind it */
export function drawing(card, ground) {
  const pictures = /** @type {SVGSVGElement[]} */ ([...card.querySelectorAll("svg")].filter((svg) => svg.getClientRects().length));
  if (!pictures.length) return null;
  let width = 0, height = 0;
  const parts = pictures.map((picture, k) => {
    const copy = /** @type {SVGSVGElement} */ (picture.cloneNode(true)), from = picture.querySelectorAll("*"), to = copy.querySelectorAll("*");
    from.forEach((element, i) => {
      const style = getComputedStyle(element);
      for (const name of KEPT) {
        const value = style.getPropertyValue(name);
        if (value && value !== "none" || name === "fill" || name === "stroke") to[i].setAttribute(name, value);
      }
      to[i].removeAttribute("class");
      // names of gradients belong to one picture
      if (to[i].id) to[i].id = `p${k}-${to[i].id}`;
      const fill = element.getAttribute("fill")?.match(/^url\(#(.*)\)$/);
      if (fill) to[i].setAttribute("fill", `url(#p${k}-${fill[1]})`);
    });
    const { width: w, height: h } = picture.viewBox.baseVal.width ? picture.viewBox.baseVal : picture.getBoundingClientRect();
    const scale = 400 / h;
    copy.removeAttribute("class");
    for (const [name, value] of Object.entries({ x: width, y: 0, width: w * scale, height: 400, color: getComputedStyle(picture).color })) copy.setAttribute(name, String(value));
    width += w * scale;
    height = 400;
    return new XMLSerializer().serializeToString(copy);
  });
  const text = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}"><rect width="100%" height="100%" fill="${ground}"/>${parts.join("")}</svg>`;
  return { text, width, height };
}

/** Draws a picture on a canvas. @param {{text: string, width: number, height: number}} picture @param {HTMLCanvasElement} canvas */
async function paint(picture, canvas) {
  const address = URL.createObjectURL(new Blob([picture.text], { type: "image/svg+xml" }));
  const image = new Image();
  image.src = address;
  await image.decode();
  URL.revokeObjectURL(address);
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
}

/** A canvas for a picture. @param {{width: number, height: number}} picture @param {number} scale */
const canvasOf = (picture, scale) => Object.assign(document.createElement("canvas"), { width: Math.round(picture.width * scale), height: Math.round(picture.height * scale) });

/** @param {HTMLCanvasElement} canvas @returns {Promise<Blob>} */
const blobOf = (canvas) => new Promise((resolve, reject) => canvas.toBlob((blob) => blob ? resolve(blob) : reject(new Error("the browser made no image"))));

/** @param {{text: string, width: number, height: number}} picture @returns {Promise<Blob>} */
export async function png(picture) {
  const canvas = canvasOf(picture, 3);
  await paint(picture, canvas);
  return blobOf(canvas);
}

/** A file as an address of data. @param {string} address */
const inlined = async (address) => {
  const reader = new FileReader(), blob = await (await fetch(address)).blob();
  return new Promise((resolve) => {
    reader.onload = () => resolve(String(reader.result));
    reader.readAsDataURL(blob);
  });
};

/** The styles of the page with their fonts, as a picture needs them. */
async function styles() {
  const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules].map((rule) => ({ text: rule.cssText, base: sheet.href ?? location.href })));
  const written = await Promise.all(rules.map(async ({ text, base }) => {
    const [whole, name] = text.startsWith("@font-face") && /url\("([^"]+)"\)/.exec(text) || [];
    return name ? text.replace(String(whole), `url("${await inlined(new URL(name, base).href)}")`) : text;
  }));
  return written.join("\n").replace(/&/g, "&amp;").replace(/</g, "&lt;");
}

/** A part of a box as a PNG of three times its size, with formulas and text. A canvas takes HTML only from an address of data.
 * @param {HTMLElement} box as large as the window @param {{x: number, y: number, width: number, height: number}} part @returns {Promise<Blob>} */
export async function photo(box, part) {
  const root = document.documentElement, whole = /** @type {HTMLElement} */ (root.cloneNode(false)), body = document.body.cloneNode(false);
  const { fontSize, colorScheme } = getComputedStyle(root);
  Object.assign(whole.style, { fontSize, colorScheme });
  body.appendChild(box.cloneNode(true));
  whole.append(body);
  // units of the screen are those of the window
  const size = `width="${innerWidth}" height="${innerHeight}"`;
  const text = `<svg xmlns="http://www.w3.org/2000/svg" ${size}><style>${await styles()} .components, .matrix { background: none !important } .controls, .buttons { visibility: hidden }</style><foreignObject ${size}>${new XMLSerializer().serializeToString(whole)}</foreignObject></svg>`;
  const image = new Image(), canvas = canvasOf(part, 3);
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  canvas.getContext("2d")?.drawImage(image, -3 * part.x, -3 * part.y, 3 * innerWidth, 3 * innerHeight);
  return blobOf(canvas);
}

/** A film of a clock: calls `frame` with seconds and records what it draws. @param {(time: number) => ({text: string, width: number, height: number} | null)} frame @param {number} seconds @returns {Promise<Blob>} */
export async function film(frame, seconds) {
  const first = frame(0);
  if (!first || typeof MediaRecorder === "undefined") throw new Error("this browser records no film");
  const canvas = canvasOf(first, 2), recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: "video/webm", videoBitsPerSecond: 6e6 });
  /** @type {Blob[]} */ const parts = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  await paint(first, canvas);
  recorder.start();
  const begin = performance.now();
  for (let time = 0; time < seconds; time = (performance.now() - begin) / 1000) {
    const picture = frame(time);
    if (picture) await paint(picture, canvas);
    await new Promise((resolve) => setTimeout(resolve, 33));
  }
  const ended = new Promise((resolve) => { recorder.onstop = resolve; });
  recorder.stop();
  await ended;
  return new Blob(parts, { type: "video/webm" });
}

/** Offers a file. @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Copies a text, over plain http as well. @param {string} text */
export async function copy(text) {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const area = Object.assign(document.createElement("textarea"), { value: text, className: "hidden" });
  (document.querySelector("dialog[open]") ?? document.body).append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  if (!done) throw new Error("the browser does not allow it");
}

/** Shows for two seconds at a button that its action is done. @param {HTMLElement} button @param {string} words */
export function confirm(button, words) {
  button.dataset.told = words;
  setTimeout(() => { delete button.dataset.told; }, 2000);
}
