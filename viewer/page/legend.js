// The colour key: slow to fast, with arrows of those widths and colours.
import { colorOf } from "./colors.js";
import { outline } from "./outline.js";
import { shortNumber, unitsOf } from "./words.js";

/** The key as SVG in a box of `width` by 80; texts take `color`. Arrows of one width where that tells no speed. */
export function legendMarks(run, palette, color, { width = 240, isEven = false } = {}) {
  const [low, high] = run.speeds;
  const parts = [];
  for (let k = 0; k < 4; ++k) {
    const share = k / 3;
    const x = 8 + (k * (width - 16)) / 4;
    const size = isEven ? 5.5 : 3 + 5.5 * share;
    const path = Float64Array.from({ length: 18 }, (_, n) =>
      n & 1 ? 24 - 6 * Math.sin((Math.PI * (n >> 1)) / 8) : x + ((width / 4 - 14) * (n >> 1)) / 8);
    const shape = outline({ path, width: size, tailWidth: 0.5 * size, headLength: 2 * size, headWidth: 2.3 * size });
    let points = "";
    for (let n = 0; n < shape.length; n += 2) points += `${shape[n].toFixed(1)},${shape[n + 1].toFixed(1)} `;
    parts.push(`<polygon points="${points}" fill="${colorOf(palette, run.speeds, low + share * (high - low))}"/>`);
  }
  const steps = 32;
  for (let k = 0; k < steps; ++k)
    parts.push(`<rect x="${8 + (k * (width - 16)) / steps}" y="40" width="${(width - 16) / steps + 0.5}" height="10" ` +
      `shape-rendering="crispEdges" fill="${colorOf(palette, run.speeds, low + ((k + 0.5) / steps) * (high - low))}"/>`);
  const text = (x, anchor, words) =>
    `<text x="${x}" y="66" text-anchor="${anchor}" fill="${color}" font-family="DejaVu Sans, sans-serif" font-size="12">${words}</text>`;
  const units = unitsOf(run.units).replace(/[&<>]/g, "");
  parts.push(text(8, "start", shortNumber(low)), text(width / 2, "middle", units ? `speed, ${units}` : "speed"),
    text(width - 8, "end", shortNumber(high)));
  return parts.join("");
}
