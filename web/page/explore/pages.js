// @ts-check
// The seven pages of Explore, in order; each is a module that is loaded when it is opened.

/** @type {{id: string, title: string, idea: string, load: () => Promise<{default: import("./stage.js").Spec}>}[]} */
export const PAGES = [
  { id: "parallel", title: "Three parallelisms", idea: "One vector, one path, three answers", load: () => import("./parallel.js") },
  { id: "holonomy", title: "Holonomy is area", idea: "A loop turns a vector by a quarter of its area", load: () => import("./holonomy.js") },
  { id: "torsion", title: "Torsion", idea: "The parallelogram that does not close", load: () => import("./torsion.js") },
  { id: "geodesics", title: "Geodesics of a metric", idea: "Inertia bends the shortest paths", load: () => import("./geodesics.js") },
  { id: "book", title: "The tumbling book", idea: "Why the middle axis flips", load: () => import("./book.js") },
  { id: "top", title: "The heavy top", idea: "Spin, and it falls sideways", load: () => import("./top.js") },
  { id: "screw", title: "Screw motions", idea: "Every motion of space turns about a line and slides along it", load: () => import("./screw.js") },
];
