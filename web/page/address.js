// @ts-check
// The state of the page in its address: `#report=table&space=so3&connection=zero`, in the words of the command line.

/** @typedef {Record<string, string>} State */

export const REPORTS = ["compare", "table", "check", "info", "properties", "equations", "transport", "motion", "list", "conventions"];
export const FIELDS = ["space", "other", "connection", "metric", "set", "show", "motion", "path", "vector", "problem", "methods", "definition"];
/** What the page begins with: the two geometries of the paper. */
export const START = { report: "compare" };
/** Longer texts are not put into the address. */
const LONGEST = 30000;

/** @param {string} hash @returns {{state: State, unknown: string[]}} */
export function read(hash) {
  const state = /** @type {State} */ ({ ...START });
  const unknown = [];
  // in a space a plus is one, as in so3+R^3, and not a blank
  const sums = hash.replace(/^#/, "").replace(/(?<=^|&)(space|other)=[^&]*/g, (part) => part.replaceAll("+", "%2B"));
  for (const [key, value] of new URLSearchParams(sums)) {
    if (key === "report" ? REPORTS.includes(value) : FIELDS.includes(key)) state[key] = value;
    else unknown.push(key === "report" ? `report=${value}` : key);
  }
  return { state, unknown };
}

/** @param {State} state @returns {string} */
export function write(state) {
  const kept = Object.entries(state).filter(([key, value]) => value !== "" && value.length <= LONGEST && (key === "report" || FIELDS.includes(key)));
  return "#" + new URLSearchParams(kept).toString().replaceAll("+", "%20");
}

/** The fields that are too long for an address. @param {State} state @returns {string[]} */
export function long(state) {
  return Object.keys(state).filter((key) => state[key].length > LONGEST);
}

/** The fields that a report uses. @param {string} report @returns {string[]} */
export function used(report) {
  const all = {
    compare: ["space", "other"], list: ["space"], conventions: [],
    table: ["space", "connection", "metric", "set", "show", "definition"],
    equations: ["space", "connection", "metric", "set", "motion", "definition"],
    transport: ["path", "vector", "metric"], motion: ["problem", "methods"],
    info: ["space", "set", "definition"],
  };
  return all[/** @type {keyof typeof all} */ (report)] ?? ["space", "connection", "metric", "set", "definition"];
}
