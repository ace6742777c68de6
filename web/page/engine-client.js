// @ts-check
// One worker, one request at a time; of those that wait only the newest is kept.

export class Engine {
  /** @type {Worker | undefined} */ #worker;
  /** @type {{request: object, resolve: Function, reject: Function, id: number, stage?: (name: string) => void} | undefined} */ #running;
  /** @type {{request: object, resolve: Function, reject: Function, id: number, stage?: (name: string) => void} | undefined} */ #waiting;
  #ready = false;
  #failed = false;
  #next = 0;

  constructor() { this.#start(); }

  #start() {
    this.#worker?.terminate();
    this.#ready = this.#failed = false;
    this.#worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    this.#worker.onmessage = ({ data }) => this.#receive(data);
    this.#worker.onerror = (event) => this.#receive({ kind: "failed", message: event.message || "the engine did not load" });
  }

  /**
   * Asks for a report. Rejects with {kind, ..} of the worker, or {kind: "stopped"}.
   * @param {object} request @param {(name: string) => void} [stage] called with the name of each stage that begins @returns {Promise<any>}
   */
  ask(request, stage) {
    // an engine that did not load is asked for again
    if (this.#failed) this.#start();
    return new Promise((resolve, reject) => {
      this.#waiting?.reject({ kind: "replaced" });
      this.#waiting = { request, resolve, reject, id: ++this.#next, stage };
      this.#send();
    });
  }

  /** Whether a request waits. */
  get busy() { return Boolean(this.#waiting); }

  /** Ends what is running by starting another worker. */
  stop() {
    for (const job of [this.#running, this.#waiting]) job?.reject({ kind: "stopped" });
    this.#running = this.#waiting = undefined;
    this.#start();
  }

  #send() {
    if (!this.#ready || this.#running || !this.#waiting) return;
    this.#running = this.#waiting;
    this.#waiting = undefined;
    this.#worker?.postMessage({ id: this.#running.id, request: this.#running.request });
  }

  /** @param {any} data */
  #receive(data) {
    if (data.kind === "ready") this.#ready = true;
    else if (data.kind === "failed") {
      this.#failed = true;
      for (const job of [this.#running, this.#waiting]) job?.reject(data);
      this.#running = this.#waiting = undefined;
      return;
    } else if (data.kind === "stage") {
      if (this.#running?.id === data.id) this.#running?.stage?.(data.name);
      return;
    } else if (this.#running?.id === data.id) {
      const job = this.#running;
      this.#running = undefined;
      if (data.kind === "answer") job?.resolve(data);
      else job?.reject(data);
      if (data.kind === "crashed") this.#start();
    }
    this.#send();
  }
}
