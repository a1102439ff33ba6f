// An arrow as sections from tail to tip, with frames that do not twist along the line (double
// reflection: Wang, Jüttler, Zheng and Liu 2008), as the program makes solids.
import { lengths } from "../page/outline.js";
import { cross, dot } from "./camera.js";

/** Numbers of a section: place 3, radius, tangent 3, speed, normal 3, arrow (from 1). */
export const SECTION = 12;

const HEAD_SECTIONS = 6;
const LONGEST_HEAD = 0.9; // of the line
const MOST_BODY = 72;
const TURN = 0.1; // radians between sections of the body

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const unit = (a) => {
  const size = Math.hypot(...a);
  return size > 0 ? a.map((x) => x / size) : undefined;
};

function reflect(a, mirror) {
  const square = dot(mirror, mirror);
  if (!(square > 0)) return a;
  const t = (2 * dot(mirror, a)) / square;
  return [a[0] - t * mirror[0], a[1] - t * mirror[1], a[2] - t * mirror[2]];
}

function bodySections(path) {
  let turn = 0;
  let before;
  for (let k = 3; k < path.length; k += 3) {
    const way = unit([path[k] - path[k - 3], path[k + 1] - path[k - 2], path[k + 2] - path[k - 1]]);
    if (way && before) turn += Math.acos(Math.min(1, dot(way, before)));
    before = way ?? before;
  }
  return Math.min(Math.ceil(turn / TURN) + 8, MOST_BODY);
}

// Places and speeds at lengths along a line.
function walker({ path, speeds }, along) {
  let at = 0;
  return (s) => {
    while (at < along.length - 2 && along[at + 1] < s) ++at;
    const t = Math.min(Math.max((s - along[at]) / (along[at + 1] - along[at] || 1), 0), 1);
    const place = [0, 1, 2].map((k) => path[3 * at + k] + t * (path[3 * at + 3 + k] - path[3 * at + k]));
    return { place, speed: speeds[at] + t * (speeds[at + 1] - speeds[at]) };
  };
}

function sectionsOf(arrow) {
  const along = lengths(arrow.path, 3);
  const length = along[along.length - 1];
  const head = Math.min(arrow.headLength, LONGEST_HEAD * length);
  const body = length - head;
  const walk = walker(arrow, along);
  const thin = arrow.share === undefined || arrow.share >= 1 ? 1 : arrow.share * (2 - arrow.share);
  const pieces = bodySections(arrow.path);
  const out = [{ ...walk(0), radius: 0 }];
  const add = (s, width) => out.push({ ...walk(s), radius: (thin * width) / 2 });
  for (let n = 0; n <= pieces; ++n)
    add((body * n) / pieces, arrow.tailWidth + ((arrow.width - arrow.tailWidth) * n) / pieces);
  for (let n = 0; n <= HEAD_SECTIONS; ++n)
    add(body + (head * n) / HEAD_SECTIONS, arrow.headWidth * (1 - n / HEAD_SECTIONS));
  return out;
}

function addFrames(sections) {
  let tangent;
  let normal;
  sections.forEach((section, n) => {
    const next = sections.slice(n + 1).find((s) => s.place.some((x, k) => x !== section.place[k]));
    const last = sections.slice(0, n).reverse().find((s) => s.place.some((x, k) => x !== section.place[k]));
    const way = unit(minus((next ?? section).place, (last ?? section).place)) ?? [0, 0, 1];
    if (!tangent) {
      const least = way.map(Math.abs).indexOf(Math.min(...way.map(Math.abs)));
      normal = unit(cross(way, [0, 1, 2].map((k) => Number(k === least))));
    } else {
      const step = minus(section.place, sections[n - 1].place);
      const turned = reflect(normal, step);
      const second = minus(way, reflect(tangent, step));
      const raw = reflect(turned, second);
      const t = dot(raw, way);
      normal = unit([raw[0] - t * way[0], raw[1] - t * way[1], raw[2] - t * way[2]]) ?? normal;
    }
    tangent = way;
    Object.assign(section, { tangent, normal });
  });
}

// An arrow that goes on past a periodic side is seen again from the other.
function copiesOf(sections, half, period) {
  let shifts = [[0, 0, 0]];
  for (let k = 0; k < 3; ++k) {
    if (!(period[k] > 0)) continue;
    const reach = sections.map((s) => s.place[k]);
    const [low, high] = [Math.min(...reach), Math.max(...reach)];
    const own = [];
    for (let n = Math.ceil((-half[k] - high) / period[k]); n * period[k] + low < half[k]; ++n) own.push(n * period[k]);
    shifts = shifts.flatMap((shift) => own.map((s) => shift.map((x, i) => (i === k ? s : x))));
  }
  return shifts;
}

const known = new WeakMap(); // of arrows that stay

/** The sections of all arrows. @returns {Float32Array} */
export function layOut(arrows, half, period) {
  const parts = arrows.map((arrow, index) => {
    let part = known.get(arrow);
    if (!part) {
      const sections = sectionsOf(arrow);
      addFrames(sections);
      const copies = copiesOf(sections, half, period);
      part = new Float32Array(copies.length * sections.length * SECTION);
      copies.forEach((shift, c) => sections.forEach((s, n) => part.set(
        [...s.place.map((x, k) => x + shift[k]), s.radius, ...s.tangent, s.speed, ...s.normal, 0], (c * sections.length + n) * SECTION)));
      part.count = sections.length;
      known.set(arrow, part);
    }
    // copies are told apart, so that no piece lies between two
    for (let n = 0; n * SECTION < part.length; ++n)
      part[n * SECTION + 11] = index + 1 + 1024 * Math.floor(n / part.count);
    return part;
  });
  const all = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
