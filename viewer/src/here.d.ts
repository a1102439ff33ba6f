import type { Options, Scale } from "./index.js";

/** Loads the core, which the other calls do by themselves from the file beside this module. */
export function load(source?: URL | string | BufferSource | WebAssembly.Module): Promise<{
  readonly version: string;
  /** Bytes that the core's memory has grown to. */
  readonly bytes: number;
}>;
export function arrows(options: Options & { n?: number }): Promise<Scale>;
export function evolve(options: Options & { numbers?: ArrayLike<number> }): AsyncGenerator<Scale, void, void>;
export { FlowgrainError } from "./index.js";
