// Arrows between two scales: lines that become one another, and their outlines.

const STATIONS = 28; // points of a line that changes
const SWEEP = 0.12; // barbs lie behind the head's base by this share of its length
const TAIL = 4; // vertices that round a tail's end, on each side

/** A line as so many points at even distances along it. */
export function stations(path, count = STATIONS) {
  const n = path.length / 2;
  const along = new Float64Array(n);
  for (let k = 1; k < n; ++k)
    along[k] = along[k - 1] + Math.hypot(path[2 * k] - path[2 * k - 2], path[2 * k + 1] - path[2 * k - 1]);
  const out = new Float64Array(2 * count);
  for (let k = 0, at = 0; k < count; ++k) {
    const s = (along[n - 1] * k) / (count - 1);
    while (at < n - 2 && along[at + 1] < s) ++at;
    const share = Math.min(1, (s - along[at]) / (along[at + 1] - along[at] || 1));
    for (let i = 0; i < 2; ++i) out[2 * k + i] = path[2 * at + i] + share * (path[2 * at + 2 + i] - path[2 * at + i]);
  }
  return out;
}

/** The closed polygon of an arrow, as the library draws it but for sharp bends. */
export function outline({ path, width, tailWidth, headLength, headWidth }) {
  const count = path.length / 2;
  const along = new Float64Array(count);
  for (let k = 1; k < count; ++k)
    along[k] = along[k - 1] + Math.hypot(path[2 * k] - path[2 * k - 2], path[2 * k + 1] - path[2 * k - 1]);
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
const SIZES = ["width", "tailWidth", "headLength", "headWidth", "speed", "area"];

/** From an arrow of one scale to the same in the next. */
function between(a, b, t) {
  a.stations ??= stations(a.path);
  b.stations ??= stations(b.path);
  const out = { id: a.id, share: 1, path: a.stations.map((p, k) => blend(p, b.stations[k], t)) };
  for (const name of SIZES) out[name] = blend(a[name], b[name], t);
  return out;
}

// The part of a line about a point of it, `share` as long.
function shrunk(arrow, share) {
  const path = arrow.stations ??= stations(arrow.path);
  const middle = path.length / 2 - (path.length / 2) % 2;
  const [x, y] = [path[middle], path[middle + 1]];
  const out = { ...arrow, share, path: path.map((p, k) => blend(k & 1 ? y : x, p, 0.4 + 0.6 * share)) };
  for (const name of ["width", "tailWidth", "headLength", "headWidth"]) out[name] *= 0.4 + 0.6 * share;
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

// Some of the way to the arrow that it goes into.
function goTo(arrow, parent, t) {
  if (!parent) return arrow;
  const [x, y] = arrow.center;
  let [nearest, dx, dy] = [Infinity, 0, 0];
  for (let k = 0; k < parent.path.length; k += 2) {
    const [px, py] = [parent.path[k] - x, parent.path[k + 1] - y];
    if (px * px + py * py < nearest) [nearest, dx, dy] = [px * px + py * py, px, py];
  }
  return { ...arrow, path: arrow.path.map((p, k) => p + 0.35 * t * (k & 1 ? dy : dx)) };
}
