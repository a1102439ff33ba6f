// What callers ask for, checked, in the form that the core takes.

/**
 * @typedef {object} Plan
 * @property {number} width @property {number} height
 * @property {Float64Array} x @property {Float64Array} y
 * @property {Float32Array} u @property {Float32Array} v
 * @property {Uint8Array | undefined} valid
 * @property {number[]} period @property {boolean} degrees
 * @property {number[]} numbers @property {boolean} clusters @property {boolean} even
 * @property {number} effort @property {boolean} fair @property {number} nodes
 * @property {number} seed @property {number} anisotropy @property {number} coverage
 * @property {boolean} regions @property {Float64Array | undefined} first
 */

const MOST_SCALES = 64;

function refuse(name, value, wanted) {
  const shown = Array.isArray(value) || ArrayBuffer.isView(value) ? `an array` : String(value);
  throw new RangeError(`${name} is ${shown}; ${wanted} is needed`);
}

function whole(name, value, least, most = 2 ** 31 - 1) {
  if (!Number.isInteger(value) || value < least || value > most)
    refuse(name, value, `a whole number from ${least} to ${most}`);
  return value;
}

function choice(name, value, words) {
  const index = words.indexOf(value);
  if (index < 0) refuse(name, value, `one of ${words.join(", ")}`);
  return index;
}

function share(name, value) {
  if (value === undefined) return 0; // the library's own
  if (!(value > 0)) refuse(name, value, "a number between 0 and 1");
  return value;
}

function samples(name, value, count, Kind) {
  if (!value || typeof value.length !== "number") refuse(name, value, `an array of ${count} numbers`);
  if (value.length !== count)
    throw new RangeError(`${name} has ${value.length} numbers; width × height are ${count}`);
  return value instanceof Kind ? value : Kind.from(value);
}

// Coordinates: given, or the samples' own numbers.
function axis(name, value, count) {
  if (value === undefined) return Float64Array.from({ length: count }, (_, n) => n);
  if (typeof value.length !== "number" || value.length !== count)
    throw new RangeError(`${name} has ${value.length} numbers; there are ${count} samples along it`);
  return Float64Array.from(value);
}

// Arrows that the first scale has: a row for each, as core/shim.c reads it.
function given(arrows, { kind }, numbers) {
  if (arrows === undefined) return undefined;
  if (kind === "clusters" || arrows.length !== numbers[0])
    throw new RangeError(`first has ${arrows.length} arrows; as many are needed as the first scale has placed ones`);
  const rows = Array.from(arrows, ({ id, speed, center, seed, way }) => [id, speed, ...center, ...seed, ...way]).flat();
  if (!rows.every(Number.isFinite)) throw new RangeError("first has arrows that were not placed");
  return Float64Array.from(rows);
}

/**
 * @param {any} input what callers give: index.d.ts
 * @param {number[]} numbers of the scales, none: the library's own
 * @returns {Plan}
 */
export function makePlan(input, numbers) {
  if (!input || typeof input !== "object") refuse("input", input, "an object with u, v, width, height");
  const width = whole("width", input.width, 2);
  const height = whole("height", input.height, 2);
  const count = width * height;
  if (numbers.length > MOST_SCALES)
    throw new RangeError(`${numbers.length} scales are wanted; ${MOST_SCALES} at most are possible`);
  numbers.forEach((n) => whole("n", n, 1));
  const { mask } = input;
  const valid = mask === undefined || mask === null ? undefined
    : Uint8Array.from(samples("mask", mask, count, Uint8Array), (m) => (m ? 0 : 1));
  const period = input.period ?? [0, 0];
  return {
    width,
    height,
    x: axis("x", input.x, width),
    y: axis("y", input.y, height),
    u: samples("u", input.u, count, Float32Array),
    v: samples("v", input.v, count, Float32Array),
    valid,
    period: [period[0] || 0, period[1] || 0],
    degrees: choice("axes", input.axes ?? "plain", ["plain", "degrees"]) === 1,
    numbers,
    clusters: choice("kind", input.kind ?? "arrows", ["arrows", "clusters"]) === 1,
    even: choice("start", input.start ?? "clusters", ["clusters", "even"]) === 1,
    effort: choice("effort", input.effort ?? "normal", ["normal", "quick", "thorough"]),
    fair: choice("lengths", input.lengths ?? "free", ["free", "fair"]) === 1,
    nodes: input.nodes === undefined ? 0 : whole("nodes", input.nodes, 2, 8193),
    seed: whole("seed", input.seed ?? 1, 1, Number.MAX_SAFE_INTEGER),
    anisotropy: share("anisotropy", input.anisotropy),
    coverage: share("coverage", input.coverage),
    regions: Boolean(input.regions),
    first: given(input.first, input, numbers),
  };
}
