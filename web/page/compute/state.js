// @ts-check
// The state of the view: the text of the box, the connection, the metric, the values of letters, and a card.

/** @typedef {{space: string, connection: string, metric: string, set: Record<string, string>, card: string, motion: string, weight: string, factors: string, subalgebra: string}} State */

/** Longer texts are not put into the address. */
export const LONGEST = 30000;
/** Texts of the examples that are not names of spaces. @type {Record<string, Partial<State>>} */
const EXAMPLES = {
  "tumbling book": { space: "so(3)", metric: "diag(J1, J2, J3)", connection: "levi-civita", set: { J1: "0.6", J2: "1", J3: "1.5" }, card: "motions", motion: "free body" },
  "heavy top": { space: "so(3)", card: "motions", motion: "heavy top" },
};

/** @returns {State} */
export const empty = () => ({ space: "", connection: "", metric: "", set: {}, card: "", motion: "", weight: "", factors: "", subalgebra: "" });

/** The state of an address. @param {string} text @returns {State} */
export function read(text) {
  // in a space a plus is one, as in so3+R^3, and not a blank
  const fields = new URLSearchParams(text.replaceAll("+", "%2B"));
  const state = { ...empty(), ...EXAMPLES[fields.get("space")?.trim().toLowerCase() ?? ""] };
  for (const name of /** @type {const} */ (["space", "connection", "metric", "card", "weight", "factors", "subalgebra"])) {
    const value = fields.get(name);
    if (value && !(name === "space" && state.space)) state[name] = value;
  }
  // links name a card by its tensor
  state.card ||= fields.get("show") ?? "";
  state.motion ||= fields.get("motion") ?? "";
  for (const part of (fields.get("set") ?? "").split(",")) {
    const [name, value] = part.split("=").map((word) => word.trim());
    if (name && value) state.set[name] = value;
  }
  return state;
}

/** The values of letters, as the engine reads them. @param {Record<string, string>} set */
export const settings = (set) => Object.entries(set).map(([name, value]) => `${name}=${value}`).join(",");

/** The address of a state. @param {State} state */
export function write(state) {
  const fields = { ...state, set: settings(state.set) };
  const kept = Object.entries(fields).filter(([, value]) => value !== "" && value.length <= LONGEST);
  return new URLSearchParams(kept).toString().replaceAll("+", "%20").replaceAll("%28", "(").replaceAll("%29", ")").replaceAll("%2C", ",").replaceAll("%3D", "=");
}
