// Asks a worker (worker.js) for scales.
import { FlowgrainError } from "./core.js";
import { setParents } from "./here.js";

function revive({ name, message, hint }) {
  if (name === "RangeError") return new RangeError(message);
  const error = new FlowgrainError(message);
  error.hint = hint ?? "";
  return error;
}

export class Client {
  #worker;
  #last = 0;
  /** @type {Map<number, (message: any) => void>} */
  #waiting = new Map();

  /** @param {Worker} worker @param {any} [source] the core, if not the file beside the worker */
  constructor(worker, source) {
    this.#worker = worker;
    worker.addEventListener("message", ({ data }) => this.#waiting.get(data.id)?.(data));
    worker.addEventListener("error", (event) => {
      const error = { message: event.message || "the worker cannot be started" };
      for (const tell of [...this.#waiting.values()]) tell({ error });
    });
    if (source) worker.postMessage({ load: source });
  }

  /** As evolve() of here.js. What is left early is not gone on with. */
  async *evolve(input) {
    const id = ++this.#last;
    const queue = [];
    let wake = () => {};
    this.#waiting.set(id, (message) => {
      queue.push(message);
      wake();
    });
    let before;
    let ended = false;
    try {
      this.#worker.postMessage({ id, input });
      for (;;) {
        if (!queue.length) await new Promise((resolve) => (wake = () => resolve(undefined)));
        const message = queue.shift();
        ended = Boolean(message.done || message.error);
        if (message.error) throw revive(message.error);
        if (message.done) return;
        if (before) setParents(before, message.scale);
        before = message.scale;
        yield message.scale;
      }
    } finally {
      this.#waiting.delete(id);
      if (!ended) this.#worker.postMessage({ leave: id });
    }
  }

  /** As arrows() of here.js. */
  async arrows(input) {
    for await (const scale of this.evolve({ ...input, numbers: [input?.n ?? 40] })) return scale;
    throw new Error("the field gives no arrows");
  }

  close() {
    this.#worker.terminate();
  }
}
