// flowgrain: curved arrows of a vector field, made in a worker.
import { Client } from "./client.js";
import * as here from "./here.js";

/** @type {Client | undefined} */
let client;

// Where there are no workers, as in Node.js, the work is done at once.
function maker(input) {
  if (input?.worker === false || typeof Worker === "undefined") return here;
  client ??= new Client(new Worker(new URL("./worker.js", import.meta.url), { type: "module" }));
  return client;
}

/** Exactly n arrows. */
export function arrows({ worker, ...input } = {}) {
  return maker({ worker }).arrows(input);
}

/** Scales, from many arrows to few. */
export function evolve({ worker, ...input } = {}) {
  return maker({ worker }).evolve(input);
}

export { FlowgrainError } from "./core.js";
export { Client } from "./client.js";
