// The field as the page holds it, and parts of it.

export function bytes(text) {
  const binary = atob(text);
  const out = new Uint8Array(binary.length);
  for (let n = 0; n < out.length; ++n) out[n] = binary.charCodeAt(n);
  return out;
}

/** What each IEEE 754 half is worth, in a unit. */
export function halfTable(unit) {
  const table = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const exponent = (h >> 10) & 31;
    const part = h & 1023;
    const size = exponent === 31 ? (part ? NaN : Infinity)
      : exponent ? 2 ** (exponent - 25) * (1024 + part) : 2 ** -24 * part;
    table[h] = (h & 0x8000 ? -size : size) * unit;
  }
  return table;
}

function halves(text, unit) {
  const table = halfTable(unit);
  return Float32Array.from(new Uint16Array(bytes(text).buffer), (h) => table[h]);
}

/** A line of 16-bit places between low and high: x, y, x, y, … */
function line(text, { low, high }) {
  const places = new Uint16Array(bytes(text).buffer);
  return Float64Array.from(places, (p, n) => low[n & 1] + (p / 65535) * (high[n & 1] - low[n & 1]));
}

/** @param {any} run the JSON in the page */
export function readField(run) {
  const field = {
    width: run.width,
    height: run.height,
    x: new Float64Array(bytes(run.x).buffer),
    y: new Float64Array(bytes(run.y).buffer),
    u: halves(run.u, run.unit),
    v: halves(run.v, run.unit),
    period: run.period,
    axes: run.axes,
  };
  const map = run.map && Object.fromEntries(["land", "shore", "lakes", "banks", "degrees", "outline"]
    .map((name) => [name, run.map[name].map((text) => line(text, run.map))]));
  const end = (axis, period) => (period ? axis[0] + period : axis[axis.length - 1]);
  const box = [field.x[0], field.y[0], end(field.x, field.period[0]), end(field.y, field.period[1])];
  const table = run.map?.places;
  const places = table && { ...table, directions: new Float32Array(bytes(table.directions).buffer) };
  return { ...field, map, box, places, border: border(map, box) };
}

// What the picture is framed by: the outline of the world, or the box of the field.
function border(map, [west, south, east, north]) {
  const paths = map?.outline.length ? map.outline : [[west, south, east, south, east, north, west, north]];
  return { name: "border", paths, closed: true };
}

// The interval of an axis that holds a place, and how far in it that lies; beyond: undefined.
function find(axis, place, period) {
  const last = axis.length - 1;
  if (period) place -= period * Math.floor((place - axis[0]) / period);
  if (place > axis[last]) {
    if (!period || place > axis[0] + period) return undefined;
    return [last, 0, (place - axis[last]) / (axis[0] + period - axis[last])];
  }
  if (!(place >= axis[0])) return undefined;
  let [low, high] = [0, last];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (axis[middle] <= place) low = middle;
    else high = middle;
  }
  return [low, high, (place - axis[low]) / (axis[high] - axis[low])];
}

function mix(values, width, [i, i1, a], [j, j1, b]) {
  // a missing corner without weight does not count
  const row = (n) => (a > 0 ? values[n * width + i] * (1 - a) + values[n * width + i1] * a : values[n * width + i]);
  return b > 0 ? row(j) * (1 - b) + row(j1) * b : row(j);
}

/** The velocity at a place; undefined where there is none. */
export function velocityAt(field, x, y) {
  const [i, j] = [find(field.x, x, field.period[0]), find(field.y, y, field.period[1])];
  if (!i || !j) return undefined;
  const velocity = [mix(field.u, field.width, i, j), mix(field.v, field.width, i, j)];
  return Number.isNaN(velocity[0]) ? undefined : velocity;
}

const FEWEST = 97; // samples along the longest side of a part: enough for smooth lines
const MOST = 257;

/** What makers of arrows get: the whole field, or the part in a box, sampled anew. */
export function part(field, box) {
  if (!box) {
    const { width, height, x, y, u, v, period, axes } = field;
    return { width, height, x, y, u, v, period, axes };
  }
  const size = [box[2] - box[0], box[3] - box[1]];
  const spacing = Math.min((field.x[field.width - 1] - field.x[0]) / (field.width - 1),
    (field.y[field.height - 1] - field.y[0]) / (field.height - 1));
  const longest = Math.max(...size);
  const nodes = Math.min(Math.max(Math.round(longest / spacing) + 1, FEWEST), MOST);
  const [width, height] = size.map((s) => Math.max(9, Math.round((nodes - 1) * (s / longest)) + 1));
  const axis = (low, length, count) => Float64Array.from({ length: count }, (_, k) => low + (length * k) / (count - 1));
  const [x, y] = [axis(box[0], size[0], width), axis(box[1], size[1], height)];
  // ends may lie beyond the last sample by rounding
  const clamp = (places, k) => Array.from(places, (p) =>
    find(field[k ? "y" : "x"], field.period[k] ? p : Math.min(Math.max(p, field.box[k]), field.box[k + 2]), field.period[k]));
  const [columns, rows] = [clamp(x, 0), clamp(y, 1)];
  const [u, v] = [new Float32Array(width * height), new Float32Array(width * height)];
  for (let n = 0; n < u.length; ++n) {
    const [i, j] = [columns[n % width], rows[Math.floor(n / width)]];
    u[n] = mix(field.u, field.width, i, j);
    v[n] = mix(field.v, field.width, i, j);
  }
  return { width, height, x, y, u, v, period: [0, 0], axes: field.axes };
}
