// @ts-check
// One worker, one request at a time, in the order in which they are asked. Views that change quickly ask only for their newest state.

/** @typedef {{request: object, resolve: Function, reject: Function, id: number, stage?: (name: string) => void}} Job */

export class Engine {
  /** @type {Worker | undefined} */ #worker;
  /** @type {Job | undefined} */ #running;
  /** @type {Job[]} */ #waiting = [];
  #ready = false;
  #failed = false;
  #next = 0;

  constructor() { this.#start(); }

  #start() {
    this.#worker?.terminate();
    this.#ready = this.#failed = false;
    const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }) => { if (worker === this.#worker) this.#receive(data); };
    worker.onerror = (event) => { if (worker === this.#worker) this.#receive({ kind: "failed", message: event.message || "the engine did not load" }); };
    this.#worker = worker;
  }

  /**
   * Asks for a report. Rejects with {kind, ..} of the worker, or {kind: "stopped"}.
   * @param {object} request @param {(name: string) => void} [stage] called with the name of each stage that begins @returns {Promise<any>}
   */
  ask(request, stage) {
    // an engine that did not load is asked for again
    if (this.#failed) this.#start();
    return new Promise((resolve, reject) => {
      this.#waiting.push({ request, resolve, reject, id: ++this.#next, stage });
      this.#send();
    });
  }

  /** Whether a request waits. */
  get busy() { return this.#waiting.length > 0; }

  /** Ends all requests by starting another worker. */
  stop() {
    this.#reject({ kind: "stopped" });
    this.#start();
  }

  /** @param {any} problem */
  #reject(problem) {
    const jobs = this.#running ? [this.#running, ...this.#waiting] : this.#waiting;
    this.#running = undefined;
    this.#waiting = [];
    for (const job of jobs) job.reject(problem);
  }

  #send() {
    if (!this.#ready || this.#running) return;
    this.#running = this.#waiting.shift();
    if (this.#running) this.#worker?.postMessage({ id: this.#running.id, request: this.#running.request });
  }

  /** @param {any} data */
  #receive(data) {
    if (data.kind === "loading") return (this.#running ?? this.#waiting[0])?.stage?.(`loading the engine, ${data.megabytes} MB`);
    if (data.kind === "ready") this.#ready = true;
    else if (data.kind === "failed") {
      this.#failed = true;
      return this.#reject(data);
    } else if (this.#running?.id === data.id) {
      const job = /** @type {Job} */ (this.#running);
      if (data.kind === "stage") return job.stage?.(data.name);
      this.#running = undefined;
      if (data.kind === "answer") job.resolve(data);
      // the part that did not load is asked for again by the next request
      else job.reject(data.kind === "unloaded" ? { ...data, kind: "failed" } : data);
      if (data.kind === "crashed") this.#start();
    }
    this.#send();
  }
}
