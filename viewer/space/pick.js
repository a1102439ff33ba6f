// What is under the pointer.
import { along, dot } from "./camera.js";
import { planeOf } from "./cut.js";

const NEAR = 8; // pixels beside an arrow
const NEAR_EDGE = 9; // beside the cut's frame

const wayAt = (path, k) => {
  const [a, b] = [Math.max(k - 3, 0), Math.min(k + 3, path.length - 3)];
  return [0, 1, 2].map((i) => path[b + i] - path[a + i]);
};

// Whether the cut hides a place.
function isHidden(place, cut, camera, half) {
  if (!cut?.hides) return false;
  const { at } = planeOf(cut, half);
  return camera.eye[cut.axis] > at ? place[cut.axis] > at : place[cut.axis] < at;
}

/** How far before the viewer the cut is at a pixel, and where; undefined: it is not there. */
function hitCut([px, py], cut, camera, half) {
  const ray = camera.ray(px, py);
  const { at } = planeOf(cut, half);
  const t = (at - camera.eye[cut.axis]) / ray[cut.axis];
  if (!(t > 0)) return undefined;
  const place = along(camera.eye, t, ray);
  place[cut.axis] = at;
  return place.every((x, k) => Math.abs(x) <= half[k] + 1e-9) ? { place, depth: t } : undefined;
}

export const pointOnCut = (at, cut, camera, volume) => hitCut(at, cut, camera, volume.half)?.place;

/** The foremost arrow near a pixel: with a place on its line, and the way there. */
export function nearestArrow([px, py], arrows, camera, cut, volume) {
  const plane = cut && cut.shows !== "arrows" ? hitCut([px, py], cut, camera, volume.half) : undefined;
  let best;
  for (const arrow of arrows) {
    const { path } = arrow;
    for (let k = 0; k < path.length; k += 3) {
      const place = [path[k], path[k + 1], path[k + 2]];
      const [x, y, depth] = camera.project(place);
      const thick = (0.5 * arrow.width * camera.scale * camera.distance) / depth;
      const far = Math.max(Math.hypot(x - px, y - py) - thick, 0);
      if (far > NEAR || (plane && depth > plane.depth) || isHidden(place, cut, camera, volume.half)) continue;
      const rank = depth + (far / NEAR) * camera.radius; // near the pixel, and to the viewer
      if (!(best?.rank <= rank)) best = { arrow, place, way: wayAt(path, k), rank };
    }
  }
  return best;
}

/**
 * Whether a pixel lies at the frame of the cut: then what says, of a pixel, the share of the
 * axis that the cut would have there.
 */
export function edgeNear([px, py], cut, camera, volume) {
  const { middle, sides } = planeOf(cut, volume.half);
  const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    .map(([a, b]) => camera.project(along(along(middle, a, sides[0]), b, sides[1])));
  const isNear = corners.some((p, n) => {
    const q = corners[(n + 1) % 4];
    const [dx, dy] = [q[0] - p[0], q[1] - p[1]];
    const t = Math.min(Math.max(((px - p[0]) * dx + (py - p[1]) * dy) / (dx * dx + dy * dy || 1), 0), 1);
    return Math.hypot(p[0] + t * dx - px, p[1] + t * dy - py) < NEAR_EDGE;
  });
  if (!isNear) return undefined;
  const first = cut.share;
  const unit = [0, 1, 2].map((k) => (k === cut.axis ? 2 * volume.half[k] : 0));
  const [from, to] = [along(middle, -0.5, unit), along(middle, 0.5, unit)].map((end) => camera.project(end));
  const step = [to[0] - from[0], to[1] - from[1]];
  const square = Math.max(step[0] ** 2 + step[1] ** 2, 60 ** 2); // an axis that is seen from its end
  return ([x, y]) => first + dot([x - px, y - py, 0], [...step, 0]) / square;
}

/** The arrow that follows one, from left to right, and where it is seen. */
export function steps(arrows, from, step, camera) {
  const seen = arrows.map((arrow) => {
    const middle = 3 * Math.floor(arrow.path.length / 6);
    const place = Array.from(arrow.path.slice(middle, middle + 3));
    return { arrow, place, way: wayAt(arrow.path, middle), at: camera.project(place).slice(0, 2) };
  }).filter(({ at }) => at.every((p, k) => p >= 0 && p <= camera.size[k])).sort((a, b) => a.at[0] - b.at[0]);
  if (!seen.length) return undefined;
  const index = seen.findIndex(({ arrow }) => arrow === from);
  const next = index < 0 ? (step > 0 ? 0 : seen.length - 1) : index + step;
  return seen[(next + seen.length) % seen.length];
}
