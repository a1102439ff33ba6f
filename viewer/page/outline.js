// Arrows between two scales: lines that become one another, and their outlines.

const STATIONS = 28; // points of a line that changes
const SWEEP = 0.12; // barbs lie behind the head's base by this share of its length
const TAIL = 4; // vertices that round a tail's end, on each side

/** How long a line of points of `stride` coordinates is up to each of them. */
export function lengths(path, stride = 2) {
  const along = new Float64Array(path.length / stride);
  for (let k = 1; k < along.length; ++k) {
    let sum = 0;
    for (let i = 0; i < stride; ++i) sum += (path[stride * k + i] - path[stride * (k - 1) + i]) ** 2;
    along[k] = along[k - 1] + Math.sqrt(sum);
  }
  return along;
}

/** A line as so many points at even distances along it. */
export function stations(path, count = STATIONS, stride = 2) {
  const along = lengths(path, stride);
  const n = along.length;
  const out = new Float64Array(stride * count);
  for (let k = 0, at = 0; k < count; ++k) {
    const s = (along[n - 1] * k) / (count - 1);
    while (at < n - 2 && along[at + 1] < s) ++at;
    const share = Math.min(1, (s - along[at]) / (along[at + 1] - along[at] || 1));
    for (let i = 0; i < stride; ++i)
      out[stride * k + i] = path[stride * at + i] + share * (path[stride * (at + 1) + i] - path[stride * at + i]);
  }
  return out;
}

/** The closed polygon of an arrow, as the library draws it but for sharp bends. */
export function outline({ path, width, tailWidth, headLength, headWidth }) {
  const count = path.length / 2;
  const along = lengths(path);
  const length = along[count - 1];
  const head = Math.min(headLength, 0.8 * length);
  const body = length - head;
  const [left, right] = [[], []];
  let at = 0;
  const place = (s) => {
    while (at < count - 2 && along[at + 1] < s) ++at;
    while (at > 0 && along[at] > s) --at;
    const share = (s - along[at]) / (along[at + 1] - along[at] || 1);
    return [0, 1].map((i) => path[2 * at + i] + share * (path[2 * at + 2 + i] - path[2 * at + i]));
  };
  const reach = 0.75 * width;
  const add = (s, half) => {
    const middle = place(s);
    const [a, b] = [place(Math.max(0, s - reach)), place(Math.min(length, s + reach))];
    const size = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const normal = [-(b[1] - a[1]) / size, (b[0] - a[0]) / size];
    left.push(middle[0] + half * normal[0], middle[1] + half * normal[1]);
    right.push([middle[0] - half * normal[0], middle[1] - half * normal[1]]);
  };
  const half = (s) => 0.5 * (tailWidth + (width - tailWidth) * (body > 0 ? s / body : 1));
  const cap = Math.min(tailWidth / 2, body / 2);
  for (let k = 1; k <= TAIL; ++k) {
    const angle = (Math.PI * k) / (2 * TAIL);
    const s = cap * (1 - Math.cos(angle));
    add(s, half(s) * Math.sin(angle));
  }
  for (let k = 1; k < count - 1; ++k) if (along[k] > cap && along[k] < body) add(along[k], half(along[k]));
  add(body, width / 2);
  const base = place(body);
  const tip = [path[2 * count - 2], path[2 * count - 1]];
  const [dx, dy] = [tip[0] - base[0], tip[1] - base[1]];
  const size = Math.hypot(dx, dy) || 1;
  for (const side of [1, -1]) {
    const barb = [base[0] - SWEEP * dx - (side * 0.5 * headWidth * dy) / size,
      base[1] - SWEEP * dy + (side * 0.5 * headWidth * dx) / size];
    if (side > 0) left.push(...barb);
    else right.push(barb);
  }
  return Float64Array.from([path[0], path[1], ...left, ...tip, ...right.reverse().flat()]);
}

const blend = (a, b, t) => a + t * (b - a);
const WIDTHS = ["width", "tailWidth", "headLength", "headWidth"];
const SIZES = [...WIDTHS, "speed", "area"];
const SOLID_STATIONS = 72; // of a line in 3D

// Lines in 3D have `speeds`, at their points, which go with them.
const strideOf = (arrow) => (arrow.speeds ? 3 : 2);

function stationsOf(arrow) {
  if (!arrow.stations) {
    const count = arrow.speeds ? SOLID_STATIONS : STATIONS;
    arrow.stations = stations(arrow.path, count, strideOf(arrow));
    if (arrow.speeds) arrow.stationSpeeds = stationValues(arrow.speeds, lengths(arrow.path, 3), count);
  }
  return arrow.stations;
}

/** What values at a line's points are at its stations. */
function stationValues(values, along, count) {
  const out = new Float64Array(count);
  for (let k = 0, at = 0; k < count; ++k) {
    const s = (along[along.length - 1] * k) / (count - 1);
    while (at < along.length - 2 && along[at + 1] < s) ++at;
    const part = Math.min(1, (s - along[at]) / (along[at + 1] - along[at] || 1));
    out[k] = values[at] + part * (values[at + 1] - values[at]);
  }
  return out;
}

function blendAll(from, to, t) {
  const out = new Float64Array(from.length);
  for (let k = 0; k < out.length; ++k) out[k] = from[k] + t * (to[k] - from[k]);
  return out;
}

/** From an arrow of one scale to the same in the next. */
export function between(a, b, t) {
  const [from, to] = [stationsOf(a), stationsOf(b)];
  const out = { id: a.id, share: 1, path: blendAll(from, to, t) };
  if (a.speeds) out.speeds = blendAll(a.stationSpeeds, b.stationSpeeds, t);
  for (const name of SIZES) out[name] = blend(a[name], b[name], t);
  return out;
}

// The part of a line about a point of it, `share` as long.
function shrunk(arrow, share) {
  const path = stationsOf(arrow);
  const stride = strideOf(arrow);
  const middle = stride * Math.floor(path.length / stride / 2);
  const out = { ...arrow, share, path: new Float64Array(path.length) };
  for (let k = 0; k < path.length; ++k) out.path[k] = blend(path[middle + (k % stride)], path[k], 0.4 + 0.6 * share);
  if (arrow.speeds) out.speeds = arrow.stationSpeeds;
  for (const name of WIDTHS) out[name] *= 0.4 + 0.6 * share;
  return out;
}

/**
 * The arrows a share t of the way from a scale to the next coarser one: those in both glide, of the
 * others the finer scale's go to their `parent`, and the coarser scale's grow.
 */
export function morph(finer, coarser, t) {
  if (t <= 0 || !coarser) return finer.arrows;
  if (t >= 1) return coarser.arrows;
  const next = new Map(coarser.arrows.map((a) => [a.id, a]));
  const before = new Set(finer.arrows.map((a) => a.id));
  const out = [];
  for (const arrow of finer.arrows) {
    const same = next.get(arrow.id);
    if (same) out.push(between(arrow, same, t));
    else out.push(goTo(shrunk(arrow, 1 - t), next.get(arrow.parent), t));
  }
  for (const arrow of coarser.arrows) if (!before.has(arrow.id)) out.push(shrunk(arrow, t));
  return out;
}

// Some of the way to the arrow that it goes into, from the middle of its line.
function goTo(arrow, parent, t) {
  if (!parent) return arrow;
  const stride = strideOf(arrow);
  const middle = stride * Math.floor(arrow.path.length / stride / 2);
  const center = arrow.center ?? arrow.path.slice(middle, middle + stride);
  let nearest = Infinity;
  let at = 0; // of the parent's points the nearest
  for (let k = 0; k < parent.path.length; k += stride) {
    let far = 0;
    for (let i = 0; i < stride; ++i) far += (parent.path[k + i] - center[i]) ** 2;
    if (far < nearest) [nearest, at] = [far, k];
  }
  const path = new Float64Array(arrow.path.length);
  for (let k = 0; k < path.length; ++k) path[k] = arrow.path[k] + 0.35 * t * (parent.path[at + (k % stride)] - center[k % stride]);
  return { ...arrow, path };
}
