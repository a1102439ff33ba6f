// An arrow as sections from tail to tip, with frames that do not twist along the line (double
// reflection: Wang, Jüttler, Zheng and Liu 2008), as the program makes solids.
import { lengths } from "../page/outline.js";
import { along, cross, dot } from "./camera.js";

/** Numbers of a section: place 3, radius, tangent 3, speed, normal 3, arrow (from 1). */
export const SECTION = 12;
const [RADIUS, TANGENT, SPEED, NORMAL, ARROW] = [3, 4, 7, 8, 11];

/** Sections of the body: radians from one to the next, the fewest and the most; of the head; whether they have normals. */
export const FINE = { turn: 0.1, fewest: 5, most: 72, head: 3, normals: true, known: new WeakMap() };
export const COARSE = { turn: 0.25, fewest: 4, most: 24, head: 2, normals: false, known: new WeakMap() };

const LONGEST_HEAD = 0.9; // of the line

function bodySections(path, far, { turn, fewest, most }) {
  let turned = 0;
  for (let k = 1; k + 1 < far.length; ++k) {
    const [before, after] = [far[k] - far[k - 1], far[k + 1] - far[k]];
    if (!(before > 0 && after > 0)) continue;
    let square = 0; // of the chord between two directions, which is as long as the small angle
    for (let i = 3 * k; i < 3 * k + 3; ++i) square += ((path[i + 3] - path[i]) / after - (path[i] - path[i - 3]) / before) ** 2;
    turned += Math.sqrt(square);
  }
  return Math.min(Math.ceil(turned / turn) + fewest, most);
}

/** Places, radii and speeds of an arrow's sections, the rest of their numbers 0. */
function sectionsOf(arrow, detail) {
  const { path, speeds, headWidth, tailWidth, width } = arrow;
  const far = lengths(path, 3);
  const length = far[far.length - 1];
  const head = Math.min(arrow.headLength, LONGEST_HEAD * length);
  const body = length - head;
  const thin = arrow.share === undefined || arrow.share >= 1 ? 1 : arrow.share * (2 - arrow.share);
  const pieces = bodySections(path, far, detail);
  const out = new Float32Array(SECTION * (pieces + detail.head + 3));
  let at = 0; // point of the line
  let row = 0;
  const add = (s, wide) => {
    while (at < far.length - 2 && far[at + 1] < s) ++at;
    const t = Math.min(Math.max((s - far[at]) / (far[at + 1] - far[at] || 1), 0), 1);
    for (let k = 0; k < 3; ++k) out[row + k] = path[3 * at + k] + t * (path[3 * at + 3 + k] - path[3 * at + k]);
    out[row + RADIUS] = (thin * wide) / 2;
    out[row + SPEED] = speeds[at] + t * (speeds[at + 1] - speeds[at]);
    row += SECTION;
  };
  add(0, 0);
  for (let n = 0; n <= pieces; ++n) add((body * n) / pieces, tailWidth + ((width - tailWidth) * n) / pieces);
  for (let n = 0; n <= detail.head; ++n) add(body + (head * n) / detail.head, headWidth * (1 - n / detail.head));
  return out;
}

const isApart = (rows, a, b) => rows[a] !== rows[b] || rows[a + 1] !== rows[b + 1] || rows[a + 2] !== rows[b + 2];

/** Tangents, from the next place before a section to the next one after it. */
function addTangents(rows) {
  let before = 0;
  let after = 0;
  for (let row = 0; row < rows.length; row += SECTION) {
    if (row > 0 && isApart(rows, row - SECTION, row)) before = row - SECTION;
    if (after <= row) after = row + SECTION;
    while (after < rows.length && !isApart(rows, after, row)) after += SECTION;
    const [from, to] = [isApart(rows, before, row) ? before : row, after < rows.length ? after : row];
    const [x, y, z] = [rows[to] - rows[from], rows[to + 1] - rows[from + 1], rows[to + 2] - rows[from + 2]];
    const size = Math.sqrt(x * x + y * y + z * z);
    rows[row + TANGENT] = size > 0 ? x / size : 0;
    rows[row + TANGENT + 1] = size > 0 ? y / size : 0;
    rows[row + TANGENT + 2] = size > 0 ? z / size : 1;
  }
}

/** A vector mirrored in the plane square to another. */
function reflect(vector, mirror) {
  const square = dot(mirror, mirror);
  const t = square > 0 ? (2 * dot(mirror, vector)) / square : 0;
  return along(vector, -t, mirror);
}

function addNormals(rows) {
  let [place, tangent, normal] = [];
  for (let row = 0; row < rows.length; row += SECTION) {
    const here = [rows[row], rows[row + 1], rows[row + 2]];
    const way = [rows[row + TANGENT], rows[row + TANGENT + 1], rows[row + TANGENT + 2]];
    if (!tangent) {
      const least = way.reduce((best, x, k) => (Math.abs(x) < Math.abs(way[best]) ? k : best), 0);
      normal = cross(way, [0, 1, 2].map((k) => Number(k === least)));
    } else {
      const step = along(here, -1, place);
      const second = along(way, -1, reflect(tangent, step));
      normal = reflect(reflect(normal, step), second);
    }
    const square = along(normal, -dot(normal, way), way);
    const size = Math.sqrt(dot(square, square));
    if (size > 0) normal = [square[0] / size, square[1] / size, square[2] / size];
    [place, tangent] = [here, way];
    rows.set(normal, row + NORMAL);
  }
}

// An arrow that goes on past a periodic side is seen again from the other.
function copiesOf(rows, half, period) {
  let shifts = [[0, 0, 0]];
  for (let k = 0; k < 3; ++k) {
    if (!(period[k] > 0)) continue;
    const reach = Array.from({ length: rows.length / SECTION }, (_, n) => rows[SECTION * n + k]);
    const [low, high] = [Math.min(...reach), Math.max(...reach)];
    const own = [];
    for (let n = Math.ceil((-half[k] - high) / period[k]); n * period[k] + low < half[k]; ++n) own.push(n * period[k]);
    shifts = shifts.flatMap((shift) => own.map((s) => shift.map((x, i) => (i === k ? s : x))));
  }
  return shifts;
}

function partOf(arrow, half, period, detail) {
  const rows = sectionsOf(arrow, detail);
  addTangents(rows);
  if (detail.normals) addNormals(rows);
  const copies = copiesOf(rows, half, period);
  const part = new Float32Array(copies.length * rows.length);
  copies.forEach((shift, c) => {
    part.set(rows, c * rows.length);
    for (let row = c * rows.length; row < (c + 1) * rows.length; row += SECTION)
      for (let k = 0; k < 3; ++k) part[row + k] += shift[k];
  });
  return { rows: part, length: rows.length };
}

/**
 * The sections of all arrows, FINE or COARSE: lists of them, arrow by arrow. The first and the last of
 * an arrow have no radius.
 * @returns {Float32Array[]}
 */
export function layOut(arrows, half, period, detail) {
  return arrows.map((arrow, index) => {
    let part = detail.known.get(arrow); // of arrows that stay
    if (!part) detail.known.set(arrow, part = partOf(arrow, half, period, detail));
    const { rows, length } = part;
    // copies are told apart, so that no piece lies between two
    for (let row = 0; row < rows.length; row += SECTION) rows[row + ARROW] = index + 1 + 1024 * Math.floor(row / length);
    return rows;
  });
}
