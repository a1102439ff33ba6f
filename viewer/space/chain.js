// Between two scales of a run every number of arrows: those that stay glide, the others go or
// come one by one. At each number arrows lie on streamlines of the page's velocity.
import { between, lengths } from "../page/outline.js";
import { velocityAt } from "./volume.js";

const HALF_STEPS = 24; // of a streamline, to either side of its middle

const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

function middleOf({ path }) {
  const half = (path.length / 3 - 1) / 2;
  const [before, after] = [3 * Math.floor(half), 3 * Math.ceil(half)];
  return [0, 1, 2].map((k) => (path[before + k] + path[after + k]) / 2);
}

/** Again and again the arrow that is nearest to one that stays, so that those left lie evenly. */
function leavingOrder(arrows, leaves) {
  const left = arrows.map((arrow) => ({ arrow, at: middleOf(arrow), goes: leaves(arrow) }));
  const order = [];
  while (left.some(({ goes }) => goes)) {
    let [least, next] = [Infinity, -1];
    left.forEach((one, n) => {
      if (!one.goes) return;
      const far = Math.min(...left.map((other) => (other === one ? Infinity : apart(one.at, other.at))));
      if (next < 0 || far < least) [least, next] = [far, n];
    });
    order.push(left.splice(next, 1)[0].arrow);
  }
  return order;
}

/** The direction and the speed at a place, in a volume that may be periodic. */
function flowAt({ velocity, half, period }, place) {
  const at = place.map((x, k) => (period[k] > 0 ? x - period[k] * Math.floor((x + half[k]) / period[k]) : x));
  const v = velocityAt(velocity, at);
  const speed = v && Math.hypot(...v);
  return speed > 0 ? { way: v.map((x) => x / speed), speed } : undefined;
}

/** A step along the flow by the midpoint rule; undefined: it leaves the flow. */
function step(volume, place, size) {
  const first = flowAt(volume, place);
  const half = first && flowAt(volume, place.map((x, k) => x + (size / 2) * first.way[k]));
  return half && place.map((x, k) => x + size * half.way[k]);
}

/** An arrow laid on the streamline through its middle; as it is, where that ends early. */
function laid(arrow, volume) {
  const along = lengths(arrow.path, 3);
  const size = along[along.length - 1] / (2 * HALF_STEPS);
  const places = [middleOf(arrow)];
  for (let n = 0; n < HALF_STEPS; ++n) {
    const [before, after] = [step(volume, places[0], -size), step(volume, places[places.length - 1], size)];
    if (!before || !after) return arrow;
    places.unshift(before);
    places.push(after);
  }
  const flows = places.map((place) => flowAt(volume, place));
  if (flows.some((flow) => !flow)) return arrow;
  return { ...arrow, path: Float64Array.from(places.flat()), speeds: Float64Array.from(flows, (flow) => flow.speed) };
}

/** The numbers of arrows between two scales, of which arrows keep their ids. */
function linksBetween(volume, low) {
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
    let made;
    return {
      count: finer.arrows.length - n - 1,
      at: low + share,
      /** Made when they are first wanted. */
      get arrows() {
        made ??= [
          ...finer.arrows.filter((arrow) => !gone.has(arrow)).map((arrow) => {
            const same = later.get(arrow.id);
            return same ? { ...laid(between(arrow, same, share), volume), parent: arrow.id } : arrow;
          }),
          ...coming.slice(0, come),
        ];
        return made;
      },
    };
  });
}

/**
 * What the slider goes through: `count` arrows, `at` a place among the run's scales. Runs of
 * clusters have their own scales alone, for their arrows do not stay from one to the next.
 */
export function chainOf(volume) {
  return volume.scales.flatMap((scale, n) => [
    { count: scale.arrows.length, at: n, arrows: scale.arrows },
    ...(n + 1 < volume.scales.length ? linksBetween(volume, n) : []),
  ]);
}
