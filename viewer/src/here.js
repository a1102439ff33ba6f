// flowgrain/here: the same calls without a worker, for code that is in one already.
import { Core } from "./core.js";
import { makePlan } from "./options.js";

/** @type {Promise<Core> | undefined} */
let loaded;

async function compile(source) {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source);
  const url = source ?? new URL("./flowgrain.wasm", import.meta.url);
  if (new URL(url, import.meta.url).protocol === "file:" && globalThis.process?.versions?.node) {
    const { readFile } = await import("node:fs/promises");
    return WebAssembly.compile(await readFile(url));
  }
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  return WebAssembly.compile(await answer.arrayBuffer());
}

/**
 * Loads the core, which the other calls do by themselves.
 * @param {URL | string | BufferSource | WebAssembly.Module} [source] the file flowgrain.wasm
 */
export function load(source) {
  loaded ??= compile(source).then((module) => Core.create(module));
  loaded.catch(() => (loaded = undefined)); // may be tried again
  return loaded;
}

/** Exactly n arrows. */
export async function arrows(input) {
  const plan = makePlan(input, [input?.n ?? 40]);
  const core = await load();
  for (const scale of core.scales(plan)) return scale;
  throw new Error("the field gives no arrows");
}

/** A scale for each of `numbers`, descending; with kind "clusters" at most so many clusters. */
export async function* evolve(input) {
  const plan = makePlan(input, Array.from(input?.numbers ?? []));
  const core = await load();
  /** @type {any} */
  let before;
  for (const scale of core.scales(plan)) {
    if (before) setParents(before, scale);
    else if (plan.first) scale.arrows = input.first.map((arrow, n) => ({ ...arrow, cluster: scale.arrows[n].cluster }));
    before = scale;
    yield scale;
  }
}

/** Lets each arrow of a scale name the one of the next scale that it goes into. */
export function setParents(scale, next) {
  if (next.parents.length === scale.arrows.length)
    scale.arrows.forEach((arrow, n) => (arrow.parent = next.parents[n]));
}

export { FlowgrainError } from "./core.js";
