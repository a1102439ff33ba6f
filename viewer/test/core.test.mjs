// The package under Node.js: arrows as the program's, errors, memory, iteration.
//     FLOWGRAIN_PROGRAM=build/flowgrain node --test viewer/test
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { arrows, evolve, FlowgrainError, load } from "../../build-viewer/package/dist/here.js";
import { holed, jet, toNpz, vortices } from "./fields.mjs";

const program = process.env.FLOWGRAIN_PROGRAM;
const wasm = new URL("../../build-viewer/package/dist/flowgrain.wasm", import.meta.url);

/** The program's arrows of each scale. */
function run(field, numbers, options) {
  const folder = mkdtempSync(join(tmpdir(), "flowgrain-"));
  try {
    writeFileSync(join(folder, "field.npz"), toNpz(field));
    execFileSync(program, ["run", join(folder, "field.npz"), "-o", join(folder, "out"), "--quiet",
      "--formats", "svg", "--arrows", numbers.join(), ...options]);
    return numbers.map((_, n) =>
      JSON.parse(readFileSync(join(folder, "out", `scale-0${n}.geojson`), "utf8")).features);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const pairs = (path) => Array.from({ length: path.length / 2 }, (_, k) => [...path.subarray(2 * k, 2 * k + 2)]);

// Placed arrows that start evenly take no function from libm but the square root.
for (const [name, field] of [["holed", holed()], ["jet", jet()], ["vortices", vortices(65)]])
  test(`${name}: the same bits as the program's arrows`, { skip: !program }, async () => {
    const numbers = [24, 10];
    const expected = run(field, numbers, ["--start", "even"]);
    let scales = 0;
    const kept = [];
    for await (const scale of evolve({ ...field, numbers, start: "even" })) {
      const theirs = expected[scales++];
      kept.push(scale);
      assert.deepEqual(scale.arrows.map((a) => pairs(a.path)), theirs.map((f) => f.geometry.coordinates));
      for (const key of ["speed", "area", "width", "id"])
        assert.deepEqual(scale.arrows.map((a) => a[key]), theirs.map((f) => f.properties[key]));
    }
    assert.equal(scales, numbers.length);
    assert.deepEqual(kept[0].arrows.map((a) => a.parent), expected[0].map((f) => f.properties.parent));
  });

test("arrows that start from clusters are the program's", { skip: !program }, async () => {
  const field = vortices(65);
  const [expected] = run(field, [20], ["--seed", "7"]);
  const scale = await arrows({ ...field, n: 20, seed: 7 });
  const far = (a, f) => Math.max(...pairs(a.path).map(([x, y], k) =>
    Math.hypot(x - f.geometry.coordinates[k][0], y - f.geometry.coordinates[k][1])));
  assert.ok(Math.max(...scale.arrows.map((a, n) => far(a, expected[n]))) < 1e-9);
  assert.equal(scale.density.labels.length, scale.density.nodes[0] * scale.density.nodes[1]);
});

test("clusters become fewer, and each has an arrow in itself", async () => {
  const numbers = [20, 10, 5];
  let scales = 0;
  for await (const { arrows: all, counts, density } of evolve({ ...vortices(65), kind: "clusters", nodes: 129, numbers })) {
    assert.ok(counts.clusters <= numbers[scales++]);
    assert.equal(all.length, counts.clusters - counts.dropped);
    for (const { center, cluster } of all) {
      const [i, j] = center.map((c, k) => Math.round((c - density.origin[k]) / density.spacing[k]));
      assert.equal(density.labels[j * density.nodes[0] + i], cluster);
    }
  }
  assert.equal(scales, numbers.length);
});

test("scales go on from arrows that are given, as from their own", async () => {
  const field = { ...vortices(65), effort: "quick" };
  const [own, later] = [[], []];
  for await (const scale of evolve({ ...field, numbers: [24, 20, 9] })) own.push(scale);
  const { arrows: first } = own[0];
  for await (const scale of evolve({ ...field, numbers: [24, 20, 9], first, seed: 5, start: "even" })) later.push(scale);
  assert.deepEqual(later[0].arrows.map(({ cluster, ...rest }) => rest), first.map(({ cluster, ...rest }) => rest));
  assert.deepEqual(later[0].speedRange, own[0].speedRange);
  for (const k of [1, 2]) {
    assert.deepEqual(later[k].arrows.map((a) => [a.id, a.path]), own[k].arrows.map((a) => [a.id, a.path]));
    assert.deepEqual(later[k].parents, own[k].parents);
  }
  assert.deepEqual((await arrows({ ...field, n: 24, first })).arrows.map((a) => a.id), first.map((a) => a.id));
  await assert.rejects(arrows({ ...field, n: 23, first }), /first has 24 arrows/);
  await assert.rejects(arrows({ ...field, kind: "clusters", n: 24, first }), RangeError);
  await assert.rejects(arrows({ ...field, n: 24, first: first.map((a) => ({ ...a, id: 0 })) }), FlowgrainError);
  await assert.rejects(arrows({ ...field, n: 24, first: first.map((a) => ({ ...a, id: NaN })) }), RangeError);
});

test("a mask and missing values are the same", async () => {
  const { u, v, ...rest } = holed();
  const mask = Array.from(u, Number.isNaN);
  const filled = { u: u.map((a) => a || 0), v: v.map((a) => a || 0), mask };
  const [one, other] = [await arrows({ u, v, ...rest, n: 9 }), await arrows({ ...filled, ...rest, n: 9 })];
  assert.deepEqual(one.arrows, other.arrows);
  assert.equal(one.arrows.length, 9);
});

test("what is wrong is said with its numbers, and can be tried again", async () => {
  const field = jet();
  const zero = new Float32Array(field.u.length);
  await assert.rejects(arrows({ ...field, u: zero, v: zero }),
    (e) => e instanceof FlowgrainError && /velocity is zero everywhere \(4096 cells\)/.test(e.message));
  await assert.rejects(arrows({ ...field, x: field.x.slice().reverse() }), FlowgrainError);
  await assert.rejects(arrows({ ...field, u: [1, 2] }), /u has 2 numbers; width × height are 4225/);
  await assert.rejects(arrows({ ...field, n: 0 }), /n is 0; a whole number from 1/);
  await assert.rejects(arrows({ ...field, start: "odd" }), /start is odd; one of clusters, even/);
  await assert.rejects(arrows(), /input is undefined/);
  assert.equal((await arrows({ ...field, n: 5, start: "even" })).arrows.length, 5);
});

test("memory is given back, also by what is left or fails", async () => {
  const field = jet();
  const zero = new Float32Array(field.u.length);
  const core = await load();
  const once = async () => {
    await arrows({ ...field, n: 8, kind: "clusters", nodes: 65 });
    for await (const scale of evolve({ ...field, start: "even", regions: true, numbers: [6, 5, 4] }))
      if (scale.arrows.length === 5) break;
    await arrows({ ...field, u: zero, v: zero }).catch(() => {});
  };
  await once();
  await once();
  const before = core.bytes;
  for (let n = 0; n < 8; ++n) await once(); // a hundred kilobytes each time would show
  assert.equal(core.bytes, before);
});

test("the core asks its surroundings for a clock alone, and is small", () => {
  const bytes = readFileSync(wasm);
  const imports = WebAssembly.Module.imports(new WebAssembly.Module(bytes)).map((i) => i.name).sort();
  assert.deepEqual(imports, ["clock_time_get", "fd_close", "fd_seek", "fd_write"]);
  assert.ok(gzipSync(bytes, { level: 9 }).length < 300_000, `${statSync(wasm).size} bytes`);
});
