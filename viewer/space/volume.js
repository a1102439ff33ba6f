// A run in 3D as the page holds it. All places are in the view box: the middle of the field's
// box is 0, its longest side 1.
import { halfTable } from "../page/field.js";
import { unpack, unpackAxes } from "../page/unpack.js";

const PLACE_STEPS = 65535;
const SPEED_STEPS = 4095;
const SURFACE_STEPS = 4095;

// of sampleVelocity: where in a cell, and the weighted sum of its corners
const part = new Float64Array(3);
const sum = new Float64Array(4);

function boxOf({ low, high }) {
  const scale = 1 / Math.max(...low.map((l, k) => high[k] - l));
  const middle = low.map((l, k) => (l + high[k]) / 2);
  return {
    scale,
    half: low.map((l, k) => ((high[k] - l) * scale) / 2),
    /** From the view box to the field's coordinates, and back. */
    toField: (p) => Array.from(p, (x, k) => x / scale + middle[k]),
    fromField: (p) => Array.from(p, (x, k) => (x - middle[k]) * scale),
  };
}

async function readArrows(scale, box) {
  const [axes, speeds] = await Promise.all([unpackAxes(scale), unpack(scale.speeds)]);
  let first = 0;
  return scale.icons.map((icon) => {
    const path = new Float64Array(3 * icon.points);
    for (let n = 0; n < icon.points; ++n) {
      const place = axes.map((values, k) =>
        scale.low[k] + (values[first + n] / PLACE_STEPS) * (scale.high[k] - scale.low[k]));
      path.set(box.fromField(place), 3 * n);
    }
    const along = Float64Array.from(speeds.subarray(first, first + icon.points), (s) => (s / SPEED_STEPS) * scale.fastest);
    first += icon.points;
    const sizes = Object.fromEntries(["width", "tailWidth", "headLength", "headWidth"].map((name) => [name, icon[name] * box.scale]));
    return { ...icon, ...sizes, area: icon.volume, path, speeds: along };
  });
}

/** Vertices with normals, the means of the triangles' about them; undefined: there is none. */
export async function readSurface(packed, half) {
  if (!packed) return undefined;
  const [axes, corners] = await Promise.all([unpackAxes(packed), unpack(packed.triangles)]);
  const count = packed.vertices;
  const place = new Float32Array(3 * count);
  for (let n = 0; n < count; ++n)
    for (let k = 0; k < 3; ++k) place[3 * n + k] = (axes[k][n] / SURFACE_STEPS - 0.5) * 2 * half[k];
  const normal = new Float32Array(3 * count);
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
    const [u, v] = [b, c].map((to) => [0, 1, 2].map((k) => place[to + k] - place[a + k]));
    for (let k = 0; k < 3; ++k) {
      const n = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
      for (const corner of [a, b, c]) normal[corner + k] += n;
    }
  }
  return { place, normal, corners: Uint32Array.from(corners) };
}

async function readVelocity({ nodes, unit, ...packed }, half) {
  const table = halfTable(unit);
  const halves = await unpackAxes(packed);
  const count = nodes[0] * nodes[1] * nodes[2];
  const samples = new Float32Array(4 * count); // velocity, and 1 where it is known
  for (let n = 0; n < count; ++n) {
    const v = halves.map((h) => table[h[n] & 0xffff]);
    if (!v.some(Number.isNaN)) samples.set([...v, 1], 4 * n);
  }
  return { nodes, samples, half };
}

/**
 * The velocity at a place in the view box, into the first three of `out`. Returns whether there is
 * one. Lines are traced by it, and so it makes nothing.
 */
export function sampleVelocity(out, { nodes, samples, half }, place) {
  let node = 0; // of the cell's first corner
  for (let k = 2; k >= 0; --k) {
    const at = (place[k] / half[k] / 2 + 0.5) * (nodes[k] - 1);
    if (!(at > -1e-6 && at < nodes[k] - 1 + 1e-6)) return false;
    const low = Math.min(Math.max(Math.floor(at), 0), nodes[k] - 2);
    part[k] = at - low;
    node = node * nodes[k] + low;
  }
  sum.fill(0);
  for (let c = 0; c < 8; ++c) {
    const [x, y, z] = [c & 1, (c >> 1) & 1, c >> 2];
    const weight = (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]);
    const at = 4 * (node + x + nodes[0] * (y + nodes[1] * z));
    for (let i = 0; i < 4; ++i) sum[i] += weight * samples[at + i];
  }
  for (let i = 0; i < 3; ++i) out[i] = sum[i] / sum[3];
  return sum[3] > 0.5;
}

/** The velocity at a place in the view box; undefined where there is none. */
export function velocityAt(velocity, place) {
  const out = [0, 0, 0];
  return sampleVelocity(out, velocity, place) ? out : undefined;
}

/** @param {any} run the JSON in the page */
export async function readVolume(run) {
  const box = boxOf(run);
  const [velocity, outline, ...scales] = await Promise.all([
    readVelocity(run.field, box.half),
    readSurface(run.outline, box.half),
    ...run.scales.map(async (scale) => ({ arrows: await readArrows(scale, box), packed: scale.clusters })),
  ]);
  const period = run.period.map((p) => p * box.scale);
  return { ...box, period, velocity, outline, scales };
}
