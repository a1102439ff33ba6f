// The run's own arrows, as the program writes them: src/write/view/arrows.c.
import { bytes } from "./field.js";
import { outline } from "./outline.js";
import { unpack } from "./unpack.js";

const COLUMNS = 14;
const PLACE_STEPS = 65535;

/** @param {{rows: string, low: number[], high: number[], x: string, y: string}} packed */
export async function readArrows({ rows, low, high, x, y }) {
  const table = new Float64Array(bytes(rows).buffer);
  const steps = await Promise.all([unpack(x), unpack(y)]);
  const place = (n, k) => low[k] + (steps[k][n] / PLACE_STEPS) * (high[k] - low[k]);
  let first = 0;
  return Array.from({ length: table.length / COLUMNS }, (_, n) => {
    const [id, area, speed, width, tailWidth, headLength, headWidth, centerX, centerY, seedX, seedY, back, on, points] =
      table.subarray(n * COLUMNS, (n + 1) * COLUMNS);
    const start = first;
    first += points;
    const path = Float64Array.from({ length: 2 * points }, (_, k) => place(start + (k >> 1), k & 1));
    const arrow = { id, parent: 0, cluster: 0, kind: "arrow", path, area, speed, width, tailWidth, headLength, headWidth,
      center: [centerX, centerY], seed: [seedX, seedY], way: [back, on] };
    return { ...arrow, outline: outline(arrow) };
  });
}
