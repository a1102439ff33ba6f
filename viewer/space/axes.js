// The box of the field, and numbers along three of its edges.
import { shortNumber, unitsOf } from "../page/words.js";

const AXES = [0, 1, 2];
const APART = 46; // pixels between numbers
const FONT = '12px system-ui, "DejaVu Sans", sans-serif';

/** Ends of the edges whose inside is seen: pairs of corners, in the view box. */
export function edgesOf(camera) {
  const out = [];
  for (const k of AXES) {
    const [i, j] = [(k + 1) % 3, (k + 2) % 3];
    for (const a of [-1, 1])
      for (const b of [-1, 1]) {
        if (!camera.seesInside(i, a) && !camera.seesInside(j, b)) continue;
        const ends = [-1, 1].map((end) => {
          const corner = [0, 0, 0];
          [corner[i], corner[j], corner[k]] = [a * camera.half[i], b * camera.half[j], end * camera.half[k]];
          return corner;
        });
        out.push({ axis: k, sides: { [i]: a, [j]: b }, ends, isOutline: camera.seesInside(i, a) !== camera.seesInside(j, b) });
      }
  }
  return out;
}

/** The edge with the numbers of an axis: below for x and y, at the left for z. */
function numberedEdge(axis, edges, camera) {
  let best;
  for (const edge of edges) {
    if (edge.axis !== axis || !edge.isOutline) continue;
    const [p, q] = edge.ends.map((end) => camera.project(end));
    const rank = axis === 2 ? -(p[0] + q[0]) : p[1] + q[1];
    const long = Math.hypot(p[0] - q[0], p[1] - q[1]);
    if (long > 30 && !(best?.rank >= rank)) best = { ...edge, rank, long };
  }
  return best;
}

/** Multiples of 1, 2 or 5 times a power of ten, at most so many. */
function ticksOf(low, high, most) {
  const least = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= least * (1 - 1e-9));
  const out = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) out.push(n * step);
  return { places: out, step };
}

function numberText(x, step) {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return digits > 4 || Math.abs(x) >= 1e6 ? shortNumber(x) : x.toFixed(digits).replace("-", "−");
}

/**
 * What is written at the box: texts with their place in the window, and marks.
 * @param {any} run @param {any} volume @param {import("./camera.js").Camera} camera
 */
export function labelsOf(run, volume, camera) {
  const [middleX, middleY] = camera.project([0, 0, 0]);
  const texts = [];
  const marks = [];
  const edges = edgesOf(camera);
  for (const k of AXES) {
    const edge = numberedEdge(k, edges, camera);
    if (!edge) continue;
    const [p, q] = edge.ends.map((end) => camera.project(end));
    // away from the box, square to the edge
    let out = [-(q[1] - p[1]) / edge.long, (q[0] - p[0]) / edge.long];
    if (out[0] * ((p[0] + q[0]) / 2 - middleX) + out[1] * ((p[1] + q[1]) / 2 - middleY) < 0) out = out.map((x) => -x);
    const { places, step } = ticksOf(run.low[k], run.high[k], edge.long / APART);
    for (const x of places) {
      const place = [...edge.ends[0]];
      place[k] = (x - (run.low[k] + run.high[k]) / 2) * volume.scale;
      const [px, py] = camera.project(place);
      marks.push([px, py, px + 5 * out[0], py + 5 * out[1]]);
      texts.push({ text: numberText(x, step), x: px + 9 * out[0], y: py + 9 * out[1], out });
    }
    const name = [run.xName, run.yName, run.zName][k] || "xyz"[k];
    const units = [run.xUnits, run.yUnits, run.zUnits][k];
    const wide = 9 + 16 * Math.abs(out[1]) + 34 * Math.abs(out[0]);
    texts.push({ text: units ? `${name} (${unitsOf(units)})` : name, out, x: (p[0] + q[0]) / 2 + wide * out[0], y: (p[1] + q[1]) / 2 + wide * out[1], isName: true });
  }
  return { texts, marks };
}

/** @param {CanvasRenderingContext2D} context in pixels of the window */
export function drawLabels(context, { texts, marks }, colors) {
  context.strokeStyle = colors.frame;
  context.lineWidth = 1;
  context.beginPath();
  for (const [x0, y0, x1, y1] of marks) {
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
  }
  context.stroke();
  context.font = FONT;
  context.fillStyle = colors.text;
  context.textBaseline = "middle";
  const taken = [];
  for (const { text, x, y, out } of texts) {
    const wide = context.measureText(text).width;
    // beside a steep edge, centred below a level one
    const left = x + (out[0] / 2 - 0.5) * wide;
    const top = y + 6 * out[1] - 7;
    const box = [left - 3, top, left + wide + 3, top + 14];
    if (taken.some((b) => b[0] < box[2] && box[0] < b[2] && b[1] < box[3] && box[1] < b[3])) continue;
    taken.push(box);
    context.fillText(text, left, top + 7);
  }
}
