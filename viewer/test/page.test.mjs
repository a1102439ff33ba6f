// The page that the program writes, opened from disk in Chromium.
//     FLOWGRAIN_PROGRAM=build/flowgrain node --test viewer/test
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { address, Opened, skip } from "./opened.mjs";

const winds = fileURLToPath(new URL("../../data/gfs_20140131.nc", import.meta.url));
const opened = new Opened();

before(async () => {
  if (skip) return;
  await opened.start();
  opened.run("vortex", "synth:vortex3", "--arrows", "30,8", "--nodes", "65", "--formats", "svg");
  opened.run("many", "synth:vortex3", "--arrows", "70,8", "--nodes", "65", "--formats", "svg");
  opened.run("clusters", "synth:vortex3", "--clusters", "40,8", "--nodes", "65", "--formats", "svg");
  opened.run("map", winds, "--arrows", "12", "--nodes", "65", "--region", "-25,25,35,65", "--formats", "svg");
});

after(() => opened.end());

async function open(...given) {
  const all = await opened.open(...given);
  await made(all.page);
  return all;
}

const data = (page) => page.locator("#picture").evaluate((canvas) => ({ ...canvas.dataset }));

/** Waits until what is wanted is shown. */
async function made(page) {
  await page.waitForTimeout(250); // a view is answered when it rests
  await page.waitForFunction(() => document.getElementById("picture").dataset.made === "yes");
}

/** Corners of the polygons of arrows in the SVG file that the page saves. */
async function savedArrows(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#svg")]);
  const text = readFileSync(await download.path(), "utf8");
  const shapes = [...text.matchAll(/<path d="([^"]+)" fill="rgb/g)].map(([, path]) =>
    [...path.matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(([, x, y]) => [Number(x), Number(y)]));
  return { text, shapes };
}

/** Before all of a page: what is said to a worker waits until release() is called there. */
function holdWorkers() {
  const Real = globalThis.Worker;
  const released = new Promise((resolve) => (globalThis.release = resolve));
  globalThis.Worker = class {
    constructor(...given) {
      this.real = new Real(...given);
    }
    addEventListener(...given) {
      this.real.addEventListener(...given);
    }
    postMessage(message) {
      released.then(() => this.real.postMessage(message));
    }
  };
}

/** Tails and tips of the arrows of a run's first scale, slow ones first, in a picture of the unit square. */
function firstArrows(name, [width, height]) {
  const { features } = JSON.parse(readFileSync(join(opened.folder, name, "scale-00.geojson"), "utf8"));
  const scale = Math.min(width, height);
  const place = ([x, y]) => [width / 2 + scale * (x - 0.5), height / 2 - scale * (y - 0.5)];
  return features.sort((a, b) => a.properties.speed - b.properties.speed)
    .map(({ geometry: { coordinates } }) => [place(coordinates[0]), place(coordinates.at(-1))]);
}

for (const [name, count] of [["many", 70], ["vortex", 30]])
  test(`the ${count} arrows of the run are there before a worker has answered, and stay`, { skip }, async () => {
    const { page, faults, close } = await open(name, "", { first: holdWorkers });
    assert.equal((await data(page)).arrows, String(count));
    assert.equal(await page.textContent("#count"), String(count));
    const size = await page.locator("#picture").evaluate((c) => [c.clientWidth, c.clientHeight]);
    const { shapes, text } = await savedArrows(page);
    const expected = firstArrows(name, size);
    assert.equal(shapes.length, count);
    shapes.forEach((shape, n) => {
      const [tail, tip] = expected[n];
      for (const end of [tail, tip])
        assert.ok(shape.some(([x, y]) => Math.hypot(x - end[0], y - end[1]) < 0.1), `arrow ${n} of ${count}`);
    });
    await page.focus("#picture");
    await page.keyboard.press("n");
    assert.match(await page.textContent("#status"), /^Arrow: [\d.]+, for [\d.]+ % of the field/);
    await page.keyboard.press("Escape");
    await page.evaluate(() => globalThis.release());
    await page.waitForFunction(() => Number(document.getElementById("picture").dataset.scales) > Number(document.getElementById("scale").max));
    assert.equal((await savedArrows(page)).text, text);
    await page.check("[data-layer=tint]"); // of the clusters, which the worker knows
    await page.waitForTimeout(300);
    assert.match((await savedArrows(page)).text, /<image /);
    assert.deepEqual(faults, []);
    await close();
  });

// ids of 97 arrows in 100 stay from 70 to 65 (nine fields), tails of 76 where they are: lines become longer
test("the next scale, which a worker places, has most of the run's own arrows where they are", { skip }, async () => {
  const { page, close } = await open("many");
  await page.waitForFunction(() => Number(document.getElementById("picture").dataset.scales) > 1);
  const ends = async () => (await savedArrows(page)).shapes.map((shape) => shape[0]);
  const before = await ends();
  await page.locator("#scale").evaluate((slider) => {
    slider.value = "1";
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForTimeout(300);
  const after = await ends();
  const stay = after.filter(([x, y]) => before.some((end) => Math.hypot(end[0] - x, end[1] - y) < 20));
  assert.ok(after.length < 70 && stay.length > 0.7 * after.length, `${stay.length} of ${after.length}`);
  await close();
});

test("scales follow one another, and the slider glides between them", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=30");
  assert.equal((await data(page)).arrows, "30");
  const scales = await page.locator("#scale").evaluate((slider) => Number(slider.max) + 1);
  assert.ok(scales >= 24, `${scales} scales`);
  await page.waitForFunction((n) => document.getElementById("picture").dataset.scales === String(n), scales);
  const between = await page.locator("#scale").evaluate(async (slider) => {
    const canvas = document.getElementById("picture");
    const found = [];
    for (const at of [0, 9.5, Number(slider.max)]) {
      slider.value = String(at);
      slider.dispatchEvent(new Event("input"));
      await new Promise((r) => setTimeout(r, 400));
      found.push([Number(document.getElementById("count").textContent), Number(canvas.dataset.arrows)]);
    }
    return found;
  });
  assert.deepEqual(between[0], [60, 60]);
  assert.ok(between[1][1] >= between[1][0], `${between[1]}`); // those that go are still there
  assert.deepEqual(between[2], [8, 8]);
  assert.deepEqual(faults, []);
  await close();
});

test("a part that is zoomed into has as many arrows, all of them in view", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=30");
  await page.mouse.move(300, 300);
  for (let n = 0; n < 4; ++n) await page.mouse.wheel(0, -150);
  await page.waitForFunction(() => Number(new URLSearchParams(location.hash.slice(1)).get("zoom")) > 3);
  await made(page);
  const { shapes } = await savedArrows(page);
  const size = await page.locator("#picture").evaluate((c) => [c.clientWidth, c.clientHeight]);
  const seen = shapes.filter((shape) => shape.some(([x, y]) => x >= 0 && y >= 0 && x <= size[0] && y <= size[1]));
  assert.ok(Math.abs(seen.length - 30) <= 3, `${seen.length} arrows`);
  assert.equal(shapes.length, 30);
  await page.fill("#number", "17");
  await page.press("#number", "Enter");
  await made(page);
  assert.equal((await savedArrows(page)).shapes.length, 17);
  assert.deepEqual(faults, []);
  await close();
});

test("the address keeps the view; another seed gives other arrows", { skip }, async () => {
  const { page, close } = await open("vortex", "#n=21&at=0.3,0.6&zoom=2&seed=5&show=arrows,hedgehog&page=dark");
  const one = (await savedArrows(page)).shapes;
  assert.equal(one.length, 21);
  await page.waitForTimeout(200);
  const kept = await address(page);
  assert.deepEqual([kept.n, kept.seed, kept.zoom, kept.show, kept.page], ["21", "5", "2", "arrows,hedgehog", "dark"]);
  assert.ok(await page.evaluate(() => document.documentElement.classList.contains("dark")));
  await page.fill("#seed", "6");
  await page.press("#seed", "Enter");
  await made(page);
  assert.notDeepEqual((await savedArrows(page)).shapes, one);
  await close();
});

test("a run of clusters shows one arrow in each, and evolves anew by other options", { skip }, async () => {
  const { page, faults, close } = await open("clusters", "#show=arrows,tint");
  assert.equal(await page.inputValue("#kind"), "clusters");
  const first = (await savedArrows(page)).shapes;
  assert.ok(first.length > 8 && first.length <= 60, `${first.length} arrows`);
  await page.waitForFunction(() => Number(document.getElementById("picture").dataset.scales) > 5);
  await page.focus("#picture");
  for (let k = 0; k < 5; ++k) await page.keyboard.press(".");
  await made(page);
  const later = (await savedArrows(page)).shapes;
  assert.ok(later.length < first.length, `${later.length} arrows of ${first.length}`);
  assert.equal(await page.textContent("#count"), String(later.length));
  await page.fill("#coverage", "0.5");
  await page.press("#coverage", "Enter");
  await made(page);
  assert.notDeepEqual((await savedArrows(page)).shapes, later);
  await page.waitForFunction(() => location.hash.includes("coverage=0.5"));
  await page.fill("#anisotropy", "7"); // beyond what there is
  await page.press("#anisotropy", "Enter");
  assert.equal(await page.inputValue("#anisotropy"), "0.15");
  await page.selectOption("#kind", "arrows");
  await page.fill("#number", "25");
  await page.press("#number", "Enter");
  await made(page);
  assert.equal((await savedArrows(page)).shapes.length, 25);
  assert.deepEqual(faults, []);
  await close();
});

test("keys move, zoom, step and go from arrow to arrow; the pointer reads the field", { skip }, async () => {
  const { page, faults, close } = await open("map", "#n=12");
  await made(page);
  await page.focus("#picture");
  await page.keyboard.press("n");
  assert.match(await page.textContent("#status"), /^Arrow: [\d.]+ m\/s, for [\d.]+ % of the field/);
  await page.keyboard.press(",");
  assert.equal(await page.textContent("#count"), "13"); // the scale before
  await page.keyboard.press("+");
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => /[#&]zoom=1\.5(&|$)/.test(location.hash)); // the address follows when keys rest
  await page.keyboard.press("0");
  await page.waitForFunction(() => !location.hash.includes("zoom="));
  await made(page);
  await page.mouse.move(400, 350);
  // the region is 25 W to 25 E, 35 to 65 N
  const [, latitude, ns, longitude] = /([\d.]+)° ([NS]), ([\d.]+)° [EW]/.exec(await page.textContent("#reading"));
  assert.ok(ns === "N" && latitude > 35 && latitude < 66 && longitude < 30, `${latitude} ${longitude}`);
  assert.match(await page.textContent("#reading"), /[\d.]+ m\/s, to \d+° \((north|south|east|west)/);
  assert.deepEqual(faults, []);
  await close();
});

const frames = (page) => page.locator("#moving").evaluate((canvas) => Number(canvas.dataset.frames ?? 0));

test("particles move with the flow while they are wanted", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=12");
  assert.equal(await frames(page), 0);
  await page.check("[data-layer=particles]");
  await page.waitForFunction(() => Number(document.getElementById("moving").dataset.frames) > 12);
  assert.ok(await page.evaluate(() => new Promise((resolve) => {
    // within a frame, after the page's own part of it
    const look = (left) => requestAnimationFrame(() => {
      const canvas = document.getElementById("moving");
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext("2d");
      context.drawImage(canvas, 0, 0);
      const { data } = context.getImageData(0, 0, copy.width, copy.height);
      const drawn = data.filter((_, n) => n % 4 === 3).filter((a) => a > 20).length;
      if (drawn > 1000 || !left) resolve(drawn > 1000);
      else look(left - 1);
    });
    look(300);
  })));
  await page.waitForFunction(() => location.hash.includes("particles"));
  await page.uncheck("[data-layer=particles]");
  const ended = await frames(page);
  await page.waitForTimeout(300);
  assert.ok(await frames(page) <= ended + 1);
  assert.deepEqual(faults, []);
  await close();
});

test("particles rest where less motion is asked for", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=12&show=arrows,particles", { reducedMotion: "reduce" });
  assert.match(await page.textContent("#layers-note"), /less motion/);
  await page.waitForTimeout(200);
  assert.equal(await frames(page), 0);
  assert.deepEqual(faults, []);
  await close();
});

test("the texture is of the part in view, and in the file", { skip }, async () => {
  const { page, faults, close } = await open("map", "#n=12&show=arrows,texture");
  const { text } = await savedArrows(page);
  const [image] = /<image [^>]*>/.exec(text);
  const area = (image) => / width="([\d.]+)" height="([\d.]+)"/.exec(image).slice(1).reduce((product, side) => product * Number(side), 1);
  const found = await page.evaluate(async (source) => {
    const picture = new Image();
    picture.src = source;
    await picture.decode();
    const paper = document.createElement("canvas");
    [paper.width, paper.height] = [picture.width, picture.height];
    const context = paper.getContext("2d");
    context.drawImage(picture, 0, 0);
    const { data, width, height } = context.getImageData(0, 0, picture.width, picture.height);
    let [sum, inside] = [0, 0];
    for (let n = 3; n < data.length; n += 4) {
      sum += data[n];
      inside += data[n] > 0;
    }
    return { width, height, share: inside / (width * height), mean: sum / Math.max(inside, 1) };
  }, /href="([^"]+)"/.exec(image)[1]);
  assert.ok(found.share > 0.5 && found.mean > 20 && found.mean < 90, JSON.stringify(found));
  await page.click("#closer");
  await made(page);
  const closer = (await savedArrows(page)).text;
  assert.ok(area(/<image [^>]*>/.exec(closer)[0]) > area(image)); // it fills the window
  assert.deepEqual(faults, []);
  await close();
});

for (const colorScheme of ["light", "dark"])
  test(`WCAG AA holds by axe-core on a ${colorScheme} page`, { skip }, async () => {
    const { page, close } = await open("map", "#n=12", { colorScheme });
    await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"));
    const { violations } = await page.evaluate(() => globalThis.axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"] }));
    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`), []);
    const png = await Promise.all([page.waitForEvent("download"), page.click("#png")]);
    assert.equal(readFileSync(await png[0].path()).subarray(1, 4).toString(), "PNG");
    await close();
  });
