/** A field in the plane, sampled on a grid, x fastest. */
export interface Field {
  /** Components of the velocity, width × height numbers each; NaN: missing. */
  u: ArrayLike<number>;
  v: ArrayLike<number>;
  /** Samples along x and y, 2 at least. */
  width: number;
  height: number;
  /** Not 0 where the field is missing. */
  mask?: ArrayLike<number>;
  /** Ascending coordinates of the samples; default: 0, 1, 2, … */
  x?: ArrayLike<number>;
  y?: ArrayLike<number>;
  /** After which length x and y repeat; 0: never. The last sample lies before the first's repetition. */
  period?: [number, number];
  /** "degrees": x and y are longitude and latitude, u and v along east and north. */
  axes?: "plain" | "degrees";
}

export interface Options extends Field {
  /** Of the noise that clusters grow from; default 1. */
  seed?: number;
  /** "arrows": placed so that readers can reconstruct the field; "clusters": one in each cluster. */
  kind?: "arrows" | "clusters";
  /** From where the first arrows start; "even" needs no clusters, and is faster. */
  start?: "clusters" | "even";
  effort?: "normal" | "quick" | "thorough";
  lengths?: "free" | "fair";
  /** Nodes of the mesh along its longest side. */
  nodes?: number;
  /** In (0, 1], default 0.15. */
  anisotropy?: number;
  /** In (0, 1), default 0.3. */
  coverage?: number;
  /** With start "even": whether `density` shall be that of the parts that arrows stand for. */
  regions?: boolean;
  /**
   * The first scale's arrows, as many as there are to be, that were placed before on this field or one that differs
   * little: the scales go on from them.
   */
  first?: Arrow[];
  /** false: in this thread. */
  worker?: boolean;
}

export interface Arrow {
  /** x, y, x, y, … from the tail to the tip of the head. */
  path: Float64Array;
  /** The closed polygon of body and head, its first vertex not repeated. */
  outline: Float64Array;
  kind: "arrow" | "ring" | "spiral";
  /** Number of the cluster in `density.labels` that it is in or nearest to; 0: none. */
  cluster: number;
  /** Of placed arrows: the same in all scales, from 1; else 0. */
  id: number;
  /** The id of the arrow that it goes into in the next scale, known from then on; 0: none. */
  parent: number;
  /** Of the part of the field that it stands for, and the mean speed there. */
  area: number;
  speed: number;
  /** Full width of the body at the head and at the tail, and the head's size. */
  width: number;
  tailWidth: number;
  headLength: number;
  headWidth: number;
  center: [number, number];
  /** Of placed arrows: a point of its line, and how far that may go against the flow and along it. */
  seed: [number, number];
  way: [number, number];
}

/** The clusters, or the parts that arrows stand for, at the nodes of an even raster. */
export interface Density {
  nodes: [number, number];
  origin: [number, number];
  spacing: [number, number];
  /** Positive inside. */
  u: Float32Array;
  /** The number of each node's cluster, from 1; 0 outside, -1 in those too small to count. */
  labels: Int32Array;
}

export interface Scale {
  arrows: Arrow[];
  /** `dropped`: clusters too small for an arrow. */
  counts: { arrows: number; clusters: number; dropped: number };
  /** Ends of a colour key: least and largest speed, but for outliers. */
  speedRange: [number, number];
  /** Of the evolution. */
  time: number;
  step: number;
  density?: Density;
  /** Of each arrow of the scale before, the id of the one here that it goes into. */
  parents: number[];
}

/** What was refused or could not be done, in the library's words. */
export class FlowgrainError extends Error {
  hint: string;
}

/**
 * Exactly n arrows, 40 by default; of kind "clusters" as many as there are of at most n clusters.
 * RangeError: an option is out of range; FlowgrainError: the library refuses the field.
 */
export function arrows(options: Options & { n?: number }): Promise<Scale>;

/** A scale for each of `numbers`, descending; default 200, 100, 50, 25, 12. */
export function evolve(options: Options & { numbers?: ArrayLike<number> }): AsyncGenerator<Scale, void, void>;

/** Asks a worker of one's own, started from flowgrain/worker. */
export class Client {
  /** source: the core, where it is not the file flowgrain.wasm beside the worker's. */
  constructor(worker: Worker, source?: URL | string | BufferSource | WebAssembly.Module);
  arrows(options: Options & { n?: number }): Promise<Scale>;
  evolve(options: Options & { numbers?: ArrayLike<number> }): AsyncGenerator<Scale, void, void>;
  /** Ends the worker. */
  close(): void;
}
