/** A request, in the words of the command line. */
export interface Request {
  /** The report. */
  report: "compare" | "table" | "check" | "info" | "properties" | "equations" | "transport" | "motion" | "simulate" | "list" | "conventions";
  /** A name such as `so3`, `E8`, `so3+R^3`, a geometry such as `so3@zero;metric=diag(1,2,3)`, or brackets `[x,y]=z`. */
  space?: string;
  /** The second space of a comparison. */
  other?: string;
  /** The text of a definition file in TOML or JSON, instead of a space. */
  definition?: string;
  /** A name, or a definition in any notation: brackets, `(0,0,12)`, matrices, a table of GAP, TOML; instead of a space. */
  input?: string;
  /** A connection: `levi-civita`, `plus`, `zero`, `minus`, `lambda=1/3`, ... */
  connection?: string;
  /** A metric: `identity`, `killing`, `diag(a,b,c)`, or a matrix. */
  metric?: string;
  /** Values of parameters: `a=1,b=2`. */
  set?: string;
  /** Tensors of a table, as `ricci,torsion`. */
  show?: string;
  /** The kind of equations. */
  motion?: "euler-poincare" | "autoparallel" | "transport";
  /** Points of the ball of rotation vectors, separated by semicolons, for `transport`. */
  path?: string;
  /** The vector that is transported, in the left-invariant frame. */
  vector?: string;
  /** The text of a problem of mechanics in TOML, for `motion`, which is also called `simulate`. */
  problem?: string;
  /** Methods of integration to compare with the method of the problem. */
  methods?: string;
  /** The format of the report; `html` if it is left out. */
  format?: "text" | "markdown" | "latex" | "html" | "csv" | "json" | "toml" | "command" | "python";
}

/** A report. */
export interface Answer {
  /** The report in the format of the request. */
  text: string;
  /** Notes about the input, such as symbols taken as parameters. */
  notes: string[];
  /** Pictures that belong to a report in HTML. */
  pictures: { title: string; svg: string }[];
}

/** A place in an input. */
export interface Place {
  /** The name of the input: `space`, `metric`, a file. */
  source: string;
  /** The line, from 1, and its text. */
  line: number;
  text: string;
  /** The characters of the line, from 0. */
  from: number;
  to: number;
}

/** An input that was refused. */
export class AffinorError extends Error {
  place: Place | null;
  help: string | null;
}

/**
 * Computes a report. The engine is loaded by the first call; a computation keeps the thread until it ends.
 *
 * @throws {AffinorError} if the input is refused
 */
export function report(request: Request): Promise<Answer>;
