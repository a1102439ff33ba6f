// Numbers of arrows between two scales of a run in 3D.
import assert from "node:assert/strict";
import { test } from "node:test";
import { chainOf } from "../space/chain.js";

const nodes = 33;
const half = [0.5, 0.5, 0.5];

/** Rotation about an axis beside the middle, with some drift along it. */
function flow([x, y]) {
  return [0.2 - y, x + 0.1, 0.3];
}

function velocity() {
  const samples = new Float32Array(4 * nodes ** 3);
  for (let n = 0; n < nodes ** 3; ++n) {
    const place = [n % nodes, Math.floor(n / nodes) % nodes, Math.floor(n / nodes ** 2)].map((k) => k / (nodes - 1) - 0.5);
    samples.set([...flow(place), 1], 4 * n);
  }
  return { nodes: [nodes, nodes, nodes], samples, half };
}

/** A straight line along the flow at its middle. */
function arrow(id, parent, middle, length) {
  const way = flow(middle);
  const size = Math.hypot(...way);
  const at = (s) => middle.map((x, k) => x + (s * length * way[k]) / size);
  return { id, parent, path: Float64Array.from([-0.5, -0.25, 0, 0.25, 0.5].flatMap(at)), speeds: new Float64Array(5).fill(size),
    width: 0.02, tailWidth: 0.01, headLength: 0.05, headWidth: 0.04, speed: size, area: 0.1 };
}

const places = [[-0.3, -0.2, -0.2], [0.25, -0.3, 0.1], [0.3, 0.3, -0.25], [-0.2, 0.28, 0.2], [0.05, -0.05, 0], [0.1, 0, 0.05]];
const shifted = ([x, y, z]) => [x + 0.04, y - 0.03, z + 0.02];

function volume(period = [0, 0, 0]) {
  const finer = places.map((place, n) => arrow(n + 1, n < 3 ? n + 1 : 2, place, 0.2));
  const coarser = [...places.slice(0, 2).map((place, n) => arrow(n + 1, 0, shifted(place), 0.3)), arrow(9, 0, [-0.1, 0.1, 0.3], 0.3)];
  return { half, period, velocity: velocity(), scales: [{ arrows: finer }, { arrows: coarser }] };
}

test("there are exactly so many arrows at every number, and each of an id once", () => {
  const chain = chainOf(volume());
  assert.deepEqual(chain.map(({ count }) => count), [6, 5, 4, 3]);
  assert.deepEqual(chain.map(({ at }) => at), [0, 1 / 3, 2 / 3, 1]);
  for (const { count, arrows } of chain) {
    assert.equal(arrows.length, count);
    assert.equal(new Set(arrows.map(({ id }) => id)).size, count);
  }
  for (const { arrows } of chain) assert.ok([1, 2].every((id) => arrows.some((a) => a.id === id))); // those that stay
});

test("of two arrows beside each other one goes first", () => {
  const [, next] = chainOf(volume());
  assert.equal([5, 6].filter((id) => next.arrows.some((a) => a.id === id)).length, 1);
});

test("arrows on the way lie on streamlines, and have their speed", () => {
  for (const { at, arrows } of chainOf(volume()))
    for (const { id, path, speeds } of arrows.filter(({ id }) => id < 3 && at % 1)) {
      assert.ok(path.length > 60, `${id}`);
      for (let k = 0; k + 3 < path.length; k += 3) {
        const chord = [0, 1, 2].map((i) => path[k + 3 + i] - path[k + i]);
        const way = flow([0, 1, 2].map((i) => (path[k + 3 + i] + path[k + i]) / 2));
        const cosine = chord.reduce((sum, c, i) => sum + c * way[i], 0) / Math.hypot(...chord) / Math.hypot(...way);
        assert.ok(cosine > 1 - 1e-5, `${id}: ${cosine}`);
        assert.ok(Math.abs(speeds[k / 3] - Math.hypot(...flow(path.slice(k, k + 3)))) < 1e-5);
      }
    }
});

test("a streamline that leaves the volume goes on where it is periodic, else the arrow stays a blend", () => {
  const of = (period) => {
    const given = volume(period);
    for (const [scale, z] of [[0, 0.42], [1, 0.46]]) given.scales[scale].arrows[0] = arrow(1, 1, [-0.1, 0.2, z], 0.4); // on the axis
    return chainOf(given)[1].arrows.find(({ id }) => id === 1);
  };
  const [walled, periodic] = [of([0, 0, 0]), of([0, 0, 1])];
  assert.notEqual(walled.path.length, periodic.path.length);
  const tip = (a) => a.path[a.path.length - 1];
  assert.ok(tip(periodic) > 0.5 && Math.abs(tip(periodic) - tip(walled)) < 1e-6);
});

test("scales without common arrows have nothing between them", () => {
  const given = volume();
  given.scales[1].arrows = given.scales[1].arrows.map((a, n) => ({ ...a, id: 20 + n }));
  assert.equal(chainOf(given).length, 2);
});
