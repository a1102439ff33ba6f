// The page of a run in 3D, opened from disk in Chromium.
//     FLOWGRAIN_PROGRAM=build/flowgrain node --test viewer/test
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { address, Opened, skip } from "./opened.mjs";

const opened = new Opened();

before(async () => {
  if (skip) return;
  await opened.start();
  opened.run("vortex", "synth:vortex3d", "--arrows", "12,5", "--nodes", "33", "--width", "40");
});

after(() => opened.end());

// without a graphics processor each frame is drawn pixel by pixel, and that of a file four times as large
async function open(name, address, options) {
  const all = await opened.open(name, address, { viewport: { width: 760, height: 560 }, ...options });
  await all.page.waitForFunction(() => document.getElementById("picture").dataset.made === "yes");
  return all;
}

/** The picture that the page saves: bytes of the file, and of its pixels. */
async function saved(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#png")]);
  const file = readFileSync(await download.path());
  assert.equal(file.subarray(1, 4).toString(), "PNG");
  return decoded(page, file, 4);
}

/** A picture of a PNG file's pixels, one for `step` times `step` of them. */
async function decoded(page, file, step) {
  // as a text: the driver takes seconds for an array of as many numbers
  const { width, height, bytes } = await page.evaluate(async ({ text, step }) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const paper = document.createElement("canvas");
    [paper.width, paper.height] = [image.width / step, image.height / step];
    const context = paper.getContext("2d");
    context.drawImage(image, 0, 0, paper.width, paper.height);
    const { data } = context.getImageData(0, 0, paper.width, paper.height);
    let bytes = "";
    for (let n = 0; n < data.length; n += 4096) bytes += String.fromCharCode(...data.subarray(n, n + 4096));
    return { width: image.width, height: image.height, bytes };
  }, { text: file.toString("base64"), step });
  return { width, height, pixels: Buffer.from(bytes, "latin1") };
}

/** Share of the pixels that differ. */
function apart(one, other) {
  assert.equal(one.pixels.length, other.pixels.length);
  let count = 0;
  for (let n = 0; n < one.pixels.length; n += 4)
    if ([0, 1, 2].some((k) => Math.abs(one.pixels[n + k] - other.pixels[n + k]) > 12)) ++count;
  return count / (one.pixels.length / 4);
}

/** Share of the pixels that have a colour, as arrows and the cut have. */
function colourful({ pixels }) {
  let count = 0;
  for (let n = 0; n < pixels.length; n += 4) {
    const rgb = pixels.slice(n, n + 3);
    if (Math.max(...rgb) - Math.min(...rgb) > 50) ++count;
  }
  return count / (pixels.length / 4);
}

test("the slider glides through every number of arrows", { skip }, async () => {
  const { page, faults, close } = await open("vortex");
  assert.equal(await page.textContent("#count"), "12");
  assert.match(await page.textContent("#subtitle"), /^12 arrows · mean direction error [\d.]+°/);
  const first = await saved(page);
  assert.ok(colourful(first) > 0.01, `${colourful(first)}`);
  await page.focus("#scale");
  for (let n = 11; n >= 5; --n) {
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.textContent("#count"), String(n));
    await page.waitForFunction((n) => document.getElementById("picture").dataset.arrows === String(n), n);
    const words = n > 5 ? `${n} arrows · between the run's scales of 12 and 5` : "5 arrows · mean direction error";
    assert.ok((await page.textContent("#subtitle")).startsWith(words));
  }
  const second = await saved(page);
  assert.ok(apart(first, second) > 0.02);
  await page.focus("#scale");
  await page.keyboard.press("PageDown");
  assert.equal(await page.textContent("#count"), "12");
  const between = await page.locator("#scale").evaluate(async (slider) => {
    slider.value = "0.5";
    slider.dispatchEvent(new Event("input"));
    await new Promise((resolve) => setTimeout(resolve, 200));
    return Number(document.getElementById("picture").dataset.arrows);
  });
  assert.ok(between >= 12, `${between}`); // those that go are still there
  await page.waitForFunction(() => location.hash.includes("n="));
  await page.click("#play");
  await page.waitForFunction(() => document.getElementById("play").textContent === "Play");
  assert.equal(await page.textContent("#count"), "5");
  assert.deepEqual(faults, []);
  await close();
});

test("a drag goes round, the wheel and two fingers zoom, and the address keeps it", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "", { hasTouch: true });
  const before = await saved(page);
  await page.mouse.move(300, 300);
  await page.mouse.down();
  await page.mouse.move(420, 340, { steps: 4 });
  await page.mouse.up();
  await page.mouse.wheel(0, -150);
  await page.waitForFunction(() => /view=[\d.]+,-?[\d.]+/.test(location.hash) && /zoom=1\.4/.test(location.hash));
  const turned = await saved(page);
  assert.ok(apart(before, turned) > 0.05);
  const kept = await page.evaluate(() => location.hash);
  const again = await open("vortex", kept);
  assert.ok(apart(turned, await saved(again.page)) < 0.005);
  await again.close();
  const fingers = (type, ...places) => page.evaluate(({ type, places }) => {
    for (const [id, x, y] of places)
      document.getElementById("picture").dispatchEvent(new PointerEvent(type, { pointerId: id, pointerType: "touch", clientX: x, clientY: y, bubbles: true }));
  }, { type, places });
  await page.locator("#picture").evaluate((canvas) => canvas.setPointerCapture = () => {}); // no real pointers
  await fingers("pointerdown", [11, 300, 300], [12, 400, 300]);
  await fingers("pointermove", [12, 500, 300]);
  await fingers("pointerup", [11, 300, 300], [12, 500, 300]);
  await page.waitForFunction(() => /zoom=2\.[89]/.test(location.hash));
  await page.click("#whole");
  await page.waitForFunction(() => !/view=|zoom=|at=/.test(location.hash));
  assert.ok(apart(before, await saved(page)) < 0.005);
  assert.deepEqual(faults, []);
  await close();
});

test("a plane cuts the volume, is dragged by its frame, and tells the flow", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=5&show=outline,numbers&view=30,25");
  const bare = await saved(page);
  await page.selectOption("#cut-axis", "z");
  await page.waitForFunction(() => location.hash.includes("cut=z,0.5"));
  assert.equal(await page.textContent("#cut-place"), "at z 0.5");
  const cut = await saved(page);
  assert.ok(colourful(cut) > colourful(bare) + 0.05, `${colourful(bare)} ${colourful(cut)}`);
  await page.selectOption("#cut-shows", "arrows");
  const glyphs = await saved(page);
  assert.ok(apart(bare, glyphs) > 0.01 && colourful(glyphs) < 0.02);
  const box = await page.locator("#picture").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y); // the middle of the box
  const reading = await page.textContent("#reading");
  assert.match(reading, /x 0\.\d+, y 0\.\d+, z 0\.5\n?[\d.]+\n?direction x −?[\d.]+, y −?[\d.]+, z −?[\d.]+/);
  // the frame's front corner is below the middle: found by where the pointer says so
  let found;
  for (let dy = 5; dy < box.height / 2 && !found; dy += 5) {
    await page.mouse.move(x, y + dy);
    if (await page.locator("#picture").evaluate((canvas) => canvas.style.cursor === "move")) found = y + dy;
  }
  assert.ok(found, "no frame");
  await page.mouse.down();
  await page.mouse.move(x, found - 60, { steps: 3 });
  await page.mouse.up();
  await page.waitForFunction(() => Number(/cut=z,([\d.]+)/.exec(location.hash)?.[1]) > 0.55);
  await page.check("#cut-hides");
  await page.check("[data-layer=arrows]");
  const hidden = await saved(page);
  await page.uncheck("#cut-hides");
  assert.ok(apart(hidden, await saved(page)) > 0.002);
  assert.deepEqual(faults, []);
  await close();
});

test("keys turn, zoom, cut and go from arrow to arrow", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=12&view=30,20");
  await page.focus("#picture");
  await page.keyboard.press("n");
  assert.match(await page.textContent("#status"), /^Arrow: [\d.]+, volume: [\d.]+ % of what all arrows stand for, direction x −?[\d.]+, y/);
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("+");
  await page.keyboard.press("y");
  await page.keyboard.press("]");
  await page.keyboard.press(".");
  await page.waitForFunction(() => /n=5&.*cut=y,0\.52/.test(location.hash)); // what keys do is written after them
  const { view, zoom, n, cut } = await address(page);
  assert.deepEqual([view, zoom, n, cut], ["30,41", "1.5", "5", "y,0.52"]);
  await page.keyboard.press("y");
  await page.keyboard.press("0");
  await page.waitForFunction(() => !/cut=|view=|zoom=/.test(location.hash));
  assert.deepEqual(faults, []);
  await close();
});

/** Frames take so many milliseconds by the page's clock; timers eight times as long, for a slow machine to keep up. */
function keepTime(milliseconds) {
  const [animate, wait] = [globalThis.requestAnimationFrame, globalThis.setTimeout];
  let now = 0;
  let last;
  performance.now = () => now;
  globalThis.requestAnimationFrame = (call) => animate((time) => {
    if (time !== last) now += milliseconds; // once for all that is done in a frame
    last = time;
    call(now);
  });
  globalThis.setTimeout = (call, time, ...given) => wait(call, 8 * time, ...given);
}

/** Opens it on a screen of small pixels, where a frame takes so long. */
async function openAt(milliseconds) {
  const all = await open("vortex", "", { viewport: { width: 560, height: 420 }, deviceScaleFactor: 3, first: keepTime, given: milliseconds });
  const rests = () => all.page.waitForFunction(() => document.getElementById("space").width === 3 * document.getElementById("space").clientWidth);
  await rests(); // the first frame is coarse
  /** Moves the slider again and again. @returns {Promise<number[]>} pixels of the canvas in one of the window, after each time */
  const drag = () => all.page.evaluate(async () => {
    const [slider, canvas] = ["scale", "space"].map((id) => document.getElementById(id));
    const seen = [];
    for (let n = 1; n <= 12; ++n) {
      slider.value = String(0.1 * n);
      slider.dispatchEvent(new Event("input"));
      await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      seen.push(canvas.width / canvas.clientWidth);
    }
    return seen;
  });
  return { ...all, rests, drag };
}

test("where frames take long what moves is drawn coarsely, and finely when it rests", { skip }, async () => {
  const { page, faults, close, rests, drag } = await openAt(100);
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  const seen = await drag();
  const stage = page.locator("#stage");
  const moving = await decoded(page, await stage.screenshot(), 1);
  assert.ok(seen.slice(2).every((ratio) => ratio < 2.9 && ratio >= 1), seen.join());
  await rests();
  const resting = await decoded(page, await stage.screenshot(), 1);
  const [first, second] = [colourful(moving), colourful(resting)];
  assert.ok(first > 0.005 && first > 0.6 * second && first < 1.4 * second, `${first} ${second}`); // the same arrows
  const apartBy = apart(moving, resting);
  assert.ok(apartBy > 0.001 && apartBy < 0.1, `${apartBy}`);
  assert.deepEqual(faults, []);
  await close();
});

test("where frames are fast all are drawn finely", { skip }, async () => {
  const { faults, close, drag } = await openAt(10);
  assert.ok((await drag()).every((ratio) => ratio === 3));
  assert.deepEqual(faults, []);
  await close();
});

test("an arrow under the pointer tells its speed, volume and direction", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=5");
  const box = await page.locator("#picture").boundingBox();
  let text = "";
  for (let k = 1; k < 40 && !text.startsWith("Arrow"); ++k) {
    await page.mouse.move(box.x + (box.width * k) / 40, box.y + box.height * 0.5);
    text = await page.locator("#reading").evaluate((note) => (note.hidden ? "" : note.textContent));
  }
  assert.match(text, /^Arrow: [\d.]+volume: [\d.]+ % .*\ndirection x .*\nat x [\d.]+, y [\d.]+, z [\d.]+/);
  assert.deepEqual(faults, []);
  await close();
});

test("clusters are transparent surfaces round the arrows", { skip }, async () => {
  const { page, faults, close } = await open("vortex", "#n=12&show=arrows");
  const without = await saved(page);
  await page.check("[data-layer=clusters]");
  await page.waitForFunction(() => document.getElementById("picture").dataset.clusters === "1");
  const surfaces = await saved(page);
  assert.ok(apart(without, surfaces) > 0.03, `${apart(without, surfaces)}`);
  assert.ok(Math.abs(colourful(without) - colourful(surfaces)) < 0.03); // arrows are still seen
  assert.deepEqual(faults, []);
  await close();
});

for (const colorScheme of ["light", "dark"])
  test(`WCAG AA holds by axe-core on a ${colorScheme} page`, { skip }, async () => {
    const { page, close } = await open("vortex", "#n=12&cut=x,0.4", { colorScheme });
    await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"));
    const { violations } = await page.evaluate(() => globalThis.axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"] }));
    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`), []);
    const { width, pixels } = await saved(page);
    assert.equal(width, 2 * (await page.locator("#picture").evaluate((canvas) => canvas.clientWidth)));
    assert.equal(pixels[0] > 128, colorScheme === "light");
    await close();
  });
