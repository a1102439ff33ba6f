// Between two scales of a run every number of arrows: those that stay glide, the others go or
// come one by one. At each number arrows lie on streamlines of the page's velocity.
import { between, lengths } from "../page/outline.js";
import { sampleVelocity } from "./volume.js";

const HALF_STEPS = 24; // of a streamline, to either side of its middle
const KEPT = 8; // links whose arrows are there

const apart = (a, b) => Math.sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2);

function middleOf({ path }) {
  const half = (path.length / 3 - 1) / 2;
  const [before, after] = [3 * Math.floor(half), 3 * Math.ceil(half)];
  return [0, 1, 2].map((k) => (path[before + k] + path[after + k]) / 2);
}

/** The one of `left` that is nearest to one of them. */
function findNearest(one, left) {
  [one.far, one.nearest] = [Infinity, undefined];
  for (const other of left) {
    const far = other === one ? Infinity : apart(one.at, other.at);
    if (far < one.far) [one.far, one.nearest] = [far, other];
  }
}

/** Again and again the arrow that is nearest to one that stays, so that those left lie evenly. */
function leavingOrder(arrows, leaves) {
  const left = new Set(arrows.map((arrow) => ({ arrow, at: middleOf(arrow) })));
  const going = new Set([...left].filter(({ arrow }) => leaves(arrow)));
  for (const one of going) findNearest(one, left);
  const order = [];
  while (going.size) {
    let next;
    for (const one of going) if (!(next?.far <= one.far)) next = one;
    order.push(next.arrow);
    going.delete(next);
    left.delete(next);
    for (const one of going) if (one.nearest === next) findNearest(one, left);
  }
  return order;
}

const wrapped = new Float64Array(3);

/** The direction at a place, in a volume that may be periodic, into `way`. Returns the speed; 0: it leaves the flow. */
function flowAt(way, { velocity, half, period }, place) {
  for (let k = 0; k < 3; ++k)
    wrapped[k] = period[k] > 0 ? place[k] - period[k] * Math.floor((place[k] + half[k]) / period[k]) : place[k];
  if (!sampleVelocity(way, velocity, wrapped)) return 0;
  const speed = Math.sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
  for (let k = 0; k < 3; ++k) way[k] /= speed;
  return speed;
}

const way = new Float64Array(3);
const at = new Float64Array(3);
const middle = new Float64Array(3);

/**
 * Half of a streamline by the midpoint rule, from the middle of `path` to its end where `size`, the
 * length of a step, is positive, else to its beginning. Returns whether it gets there.
 */
function traceHalf(path, speeds, volume, size) {
  const on = Math.sign(size);
  let n = HALF_STEPS;
  for (let k = 0; k < 3; ++k) at[k] = path[3 * n + k];
  speeds[n] = flowAt(way, volume, at);
  while (speeds[n] > 0 && n > 0 && n < 2 * HALF_STEPS) {
    for (let k = 0; k < 3; ++k) middle[k] = at[k] + (size / 2) * way[k];
    if (!(flowAt(way, volume, middle) > 0)) return false;
    n += on;
    for (let k = 0; k < 3; ++k) path[3 * n + k] = at[k] += size * way[k];
    speeds[n] = flowAt(way, volume, at);
  }
  return speeds[n] > 0;
}

/** An arrow laid on the streamline through its middle; as it is, where that ends early. */
function laid(arrow, volume) {
  const along = lengths(arrow.path, 3);
  const size = along[along.length - 1] / (2 * HALF_STEPS);
  const path = new Float64Array(3 * (2 * HALF_STEPS + 1));
  const speeds = new Float64Array(2 * HALF_STEPS + 1);
  path.set(middleOf(arrow), 3 * HALF_STEPS);
  const ends = [-size, size].every((step) => traceHalf(path, speeds, volume, step));
  return ends ? { ...arrow, path, speeds } : arrow;
}

/** Arrows of the links that were last wanted; those of all of a run of many arrows take too much memory. */
class Made {
  constructor() {
    this.links = new Map();
  }

  get(link, make) {
    const arrows = this.links.get(link) ?? make();
    this.links.delete(link); // and so is the last of them
    this.links.set(link, arrows);
    if (this.links.size > KEPT) this.links.delete(this.links.keys().next().value);
    return arrows;
  }
}

/** The numbers of arrows between two scales, of which arrows keep their ids. */
function linksBetween(volume, low, made) {
  const [finer, coarser] = [volume.scales[low], volume.scales[low + 1]];
  const later = new Map(coarser.arrows.map((arrow) => [arrow.id, arrow]));
  const earlier = new Set(finer.arrows.map((arrow) => arrow.id));
  const steps = finer.arrows.length - coarser.arrows.length;
  if (!finer.arrows.some(({ id }) => later.has(id))) return [];
  const going = leavingOrder(finer.arrows, ({ id }) => !later.has(id));
  const coming = coarser.arrows.filter(({ id }) => !earlier.has(id));
  return Array.from({ length: Math.max(0, steps - 1) }, (_, n) => {
    const share = (n + 1) / steps;
    const come = Math.floor(share * coming.length);
    const gone = new Set(going.slice(0, n + 1 + come));
    const make = () => [
      ...finer.arrows.filter((arrow) => !gone.has(arrow)).map((arrow) => {
        const same = later.get(arrow.id);
        return same ? { ...laid(between(arrow, same, share), volume), parent: arrow.id } : arrow;
      }),
      ...coming.slice(0, come),
    ];
    return {
      count: finer.arrows.length - n - 1,
      at: low + share,
      get arrows() {
        return made.get(this, make);
      },
    };
  });
}

/**
 * What the slider goes through: `count` arrows, `at` a place among the run's scales. Runs of
 * clusters have their own scales alone, for their arrows do not stay from one to the next.
 */
export function chainOf(volume) {
  const made = new Made();
  return volume.scales.flatMap((scale, n) => [
    { count: scale.arrows.length, at: n, arrows: scale.arrows },
    ...(n + 1 < volume.scales.length ? linksBetween(volume, n, made) : []),
  ]);
}
