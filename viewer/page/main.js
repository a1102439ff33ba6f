// The page of a run.
import { readArrows } from "./arrows.js";
import { readAddress, writeAddress } from "./address.js";
import { captionText, numberIn, placeBeside, Player, save } from "./common.js";
import { byId, connectLayers, connectSlider, connectZoom, doing, fit, introduce, layerNames, restoreLayers, Theme } from "./controls.js";
import { arrowLayers, drawAsSvg, drawOnCanvas, frameLayer, hedgehog, mapLayers, missingLayer, tintLayer } from "./draw.js";
import { readField, velocityAt } from "./field.js";
import { Maker, numbersOf } from "./maker.js";
import { morph } from "./outline.js";
import { Particles } from "./particles.js";
import { Streaks } from "./streaks.js";
import { control, View } from "./view.js";
import { shortNumber, tellerOf } from "./words.js";

const run = JSON.parse(byId("run").textContent);
const field = readField(run);
const numbers = numbersOf(run.most, run.fewest);
const view = new View(field.box);
const canvas = byId("picture");
const context = canvas.getContext("2d");
const ground = byId("ground");
const under = ground.getContext("2d");
const particles = new Particles(byId("moving"), field, view, run.speeds[1]);
const streaks = new Streaks();
const slider = byId("scale");
const { speedWords, directionWords, placeWords } = tellerOf(run, field);
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const theme = new Theme(run, {}, () => update(), () => redraw());

const ownChoice = { kind: run.kind, seed: run.seed, anisotropy: run.anisotropy, coverage: run.coverage };

const state = {
  at: 0, // on the slider: index of a scale, with a part between two
  exactly: 0, // arrows, where a number was chosen that no scale has; else 0
  choice: ownChoice,
  show: { arrows: true, tint: false, particles: false, texture: false, hedgehog: false, coast: true, degrees: true },
};

let maker; // before the core is compiled it has the run's own arrows alone
let single; // {scale, key}: made at once, for the view or the number at hand
let fading; // {layers, since}: what was shown until a moment ago
let hovered; // {arrow, at} in the picture
let told; // of the arrow that keys came to
let drawn = []; // the arrows that are shown
let wanted = 0; // animation frame

const look = () => ({ palette: theme.palette, speeds: run.speeds });
const numberNow = () => state.exactly || numbers[Math.round(state.at)];
const keyNow = () => JSON.stringify([view.part ?? null, state.choice, numberNow()]);
const setNow = () => maker?.set(view.part, state.choice);

// ---- what is shown

/** Arrows and what they were made with, for the slider's place; undefined: not made yet. */
function shown() {
  const set = setNow();
  if (!state.exactly && set) {
    const low = Math.floor(state.at);
    const [finer, coarser] = [set.scales[low], set.scales[Math.ceil(state.at)]];
    if (finer && coarser) return { arrows: morph(finer, coarser, state.at - low), finer, coarser, share: state.at - low, key: "scales" };
  }
  const key = keyNow();
  if (single?.scale && single.key === key) return { arrows: single.scale.arrows, finer: single.scale, share: 0, key };
  const own = maker?.ownOf(view.part, state.choice, numberNow());
  return own && { arrows: own, finer: { arrows: own }, share: 0, key, waits: true }; // for their clusters
}

let last; // what was shown last: stays until there is something new

// What is to be shown from here on.
function advance() {
  const now = shown();
  if (now && last && now.key !== last.key && !calm.matches) fading = { arrows: drawn, since: performance.now() };
  if (now) last = now;
  drawn = last?.arrows ?? [];
}

/** What lies under the particles. */
function groundLayers() {
  const c = theme.colors;
  const { under, over } = mapLayers(field.map, c, state.show);
  const layers = [missingLayer(field, c), ...under];
  if (state.show.tint && last?.finer.density) {
    layers.push(tintLayer(last.finer.density, c, 1 - last.share));
    if (last.share > 0 && last.coarser?.density) layers.push(tintLayer(last.coarser.density, c, last.share));
  }
  if (state.show.texture && streaks.ready) layers.push(streaks.layer(field, view, devicePixelRatio || 1, c.flow));
  layers.push(...over);
  if (state.show.hedgehog) layers.push(hedgehog(field, view, run.speeds[1], c.hedgehog));
  return layers;
}

/** What lies above them. */
function arrowsNow() {
  if (!state.show.arrows) return [];
  const share = fading ? Math.min(1, (performance.now() - fading.since) / 250) : 1;
  const faded = (arrows, part) => arrowLayers(arrows, look()).map((l) => ({ ...l, opacity: l.opacity * part }));
  if (share < 1) return [...faded(fading.arrows, 1 - share), ...faded(drawn, share)];
  fading = undefined;
  return faded(drawn, share);
}

function ring(arrow) {
  return { name: "ring", paths: [arrow.outline ?? arrow.path], closed: Boolean(arrow.outline), stroke: theme.colors.ring, width: 2 };
}

function draw() {
  wanted = 0;
  advance();
  const layers = [frameLayer(field.border, theme.colors), ...arrowsNow()];
  if (hovered?.arrow && state.show.arrows && drawn.includes(hovered.arrow)) layers.push(ring(hovered.arrow));
  const ratio = devicePixelRatio || 1;
  drawOnCanvas(context, layers, view, ratio, field.border);
  drawGround(ratio);
  canvas.dataset.arrows = String(drawn.length);
  canvas.dataset.made = shown() ? "yes" : "no";
  canvas.dataset.scales = String(setNow()?.scales.length ?? 0);
  if (fading) redraw();
}

// Again only where it is another.
function drawGround(ratio) {
  const key = [...view.size, ...view.center, view.zoom, ratio, theme.isDark, JSON.stringify(state.show),
    state.show.tint && [last?.finer.arrows.length, last?.key, last?.share, Boolean(last?.finer.density)]].join();
  if (ground.dataset.key === key) return;
  ground.dataset.key = key;
  drawOnCanvas(under, groundLayers(), view, ratio, field.border, theme.colors.page);
}

function redraw() {
  wanted ||= requestAnimationFrame(draw);
}

function say() {
  const set = setNow();
  const n = numberNow();
  const there = state.choice.kind === "clusters" && shown() ? drawn.length : n; // clusters are as many as there are
  byId("count").textContent = String(there);
  slider.setAttribute("aria-valuetext", `${there} arrows`);
  if (document.activeElement !== byId("number")) byId("number").value = String(n);
  const failed = (single?.key === keyNow() && single.error) || set?.error;
  byId("status").textContent = failed ? failed.message.split("\n")[0]
    : !shown() ? "Placing arrows …" : told && told.arrow === hovered?.arrow ? told.words
      : set?.begun && !set.done && set.scales.length < numbers.length && !view.part ? `Placing scale ${set.scales.length + 1} of ${numbers.length} …` : "";
  canvas.setAttribute("aria-label", `${drawn.length} arrows of ${run.title}${view.part ? ", a part" : ""}`);
}

function keep() {
  const round = (x) => Number(x.toPrecision(6));
  writeAddress({
    n: numberNow(),
    at: view.zoom > 1 ? view.center.map(round).join(",") : undefined,
    zoom: view.zoom > 1 ? round(view.zoom) : undefined,
    ...Object.fromEntries(Object.entries(state.choice).filter(([name, value]) => value !== run[name])),
    show: layerNames(state.show),
    page: theme.choice || undefined,
  });
}

function update() {
  redraw();
  say();
  keep();
}

// ---- what is made

let asking = 0;

/** Makes what the view, the number and the seed at hand want, a moment after they rest. */
function want(delay = 120) {
  clearTimeout(asking);
  told = undefined;
  asking = setTimeout(make, delay);
  update();
}

async function make() {
  if (!maker.ready) return;
  const set = setNow();
  if (!view.part) maker.run(set);
  else if (maker.running !== set) maker.running = undefined;
  const now = shown();
  if (now && !now.waits) return update();
  if (!view.part && set.begun && !set.scales.length && numberNow() === numbers[0]) return; // on its way
  const key = keyNow();
  if (single?.key === key) return;
  single = { key };
  try {
    const scale = await maker.ask(view.part, { ...state.choice }, numberNow());
    if (scale && key === keyNow()) single = { key, scale };
  } catch (error) {
    if (key === keyNow()) single = { key, error };
  }
  update();
}

/** Where the slider is, for a number of arrows; beside the scales' own: exactly so many. Fewer arrows of a run are no scale. */
function choose(n) {
  const index = n === maker.own?.arrows.length && n < numbers[0] ? -1 : numbers.indexOf(n);
  state.exactly = index < 0 ? n : 0;
  const nearest = numbers.reduce((best, m, k) => (Math.abs(m - n) < Math.abs(numbers[best] - n) ? k : best), 0);
  state.at = index < 0 ? nearest : index;
  slider.value = String(state.at);
}

// ---- controls

function slide(at) {
  state.at = Math.min(Math.max(at, 0), numbers.length - 1);
  state.exactly = 0;
  slider.value = String(state.at);
  const set = setNow();
  if (view.part && set) maker.run(set); // scales of the part, once they are wanted
  want();
}

const player = new Player(byId("play"), {
  at: () => state.at,
  last: () => numbers.length - 1,
  made: () => setNow()?.scales.length ?? 0,
  slide,
  pace: () => (calm.matches ? 1500 : 600),
});

function nearestArrow([px, py]) {
  let best;
  let least = 14;
  for (const arrow of drawn) {
    for (let k = 0; k < arrow.path.length; k += 2) {
      const [x, y] = view.toScreen(arrow.path[k], arrow.path[k + 1]);
      const far = Math.hypot(x - px, y - py);
      if (far < least) [least, best] = [far, arrow];
    }
  }
  return best;
}

/** Of what all arrows stand for: of the field, or of its part in view. */
function areaWords(area) {
  const all = drawn.reduce((sum, arrow) => sum + arrow.area, 0);
  return `for ${shortNumber((100 * area) / all, 2)} % of the ${view.part ? "view" : "field"}`;
}

function read(at, arrow) {
  const box = byId("reading");
  const [x, y] = view.toPlane(...at);
  const velocity = velocityAt(field, x, y);
  hovered = { at, arrow: arrow ?? nearestArrow(at) };
  box.hidden = !velocity && !hovered.arrow;
  if (box.hidden) return redraw();
  const lines = [placeWords(x, y)];
  if (velocity) lines.push(`${speedWords(Math.hypot(...velocity))}, ${directionWords(x, y, velocity)}`);
  box.replaceChildren();
  if (hovered.arrow) {
    const title = document.createElement("b");
    title.textContent = `Arrow: ${speedWords(hovered.arrow.speed)}, ${areaWords(hovered.arrow.area)}`;
    box.append(title);
  }
  box.append(lines.join("\n"));
  box.style.whiteSpace = "pre-line";
  placeBeside(box, at, view.size);
  redraw();
  return [box.firstChild.textContent, ...lines].join("; ");
}

function leave() {
  hovered = undefined;
  byId("reading").hidden = true;
  redraw();
}

// The next arrow for keys, from left to right.
function walk(step) {
  const seen = drawn.filter((a) => view.toScreen(...a.center).every((p, k) => p >= 0 && p <= view.size[k]))
    .sort((a, b) => a.center[0] - b.center[0]);
  if (!seen.length) return;
  const index = hovered?.arrow ? seen.indexOf(hovered.arrow) + step : step > 0 ? 0 : seen.length - 1;
  const arrow = seen[(index + seen.length) % seen.length];
  told = { arrow, words: read(view.toScreen(...arrow.center), arrow) };
  say();
}

const keys = {
  ",": () => slide(Math.ceil(state.at) - 1),
  ".": () => slide(Math.floor(state.at) + 1),
  " ": () => player.play(!player.playing),
  n: () => walk(1),
  p: () => walk(-1),
  Escape: leave,
};

// ---- files

function svg() {
  advance();
  fading = undefined; // what goes is no part of it
  const [w, h] = view.size;
  const extra = captionText(h + 26, 15, run.title, theme.colors.text, "bold") +
    captionText(h + 46, 12, `${drawn.length} arrows. ${run.subtitle}`, theme.colors.text) +
    `<g transform="translate(${w - 252} ${h + 2})">${theme.legend}</g>`;
  return drawAsSvg([...groundLayers(), ...arrowsNow()], view, theme.colors, field.border, run.title, extra, 76);
}

function saveSvg() {
  save("flowgrain.svg", new Blob([svg()], { type: "image/svg+xml" }));
}

async function savePng() {
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(svg())}`;
  await image.decode();
  const paper = document.createElement("canvas");
  [paper.width, paper.height] = [2 * image.width, 2 * image.height];
  paper.getContext("2d").drawImage(image, 0, 0, paper.width, paper.height);
  paper.toBlob((blob) => blob && save("flowgrain.png", blob));
}

// ---- the page

/** Lets particles move, where they are wanted and may. */
function move() {
  const moves = state.show.particles && !calm.matches;
  if (!moves) particles.stop();
  const able = (!moves || particles.start(() => theme.colors.flow)) && (!state.show.texture || streaks.ready);
  const note = byId("layers-note");
  note.textContent = !able ? "Particles and texture need WebGL2, which this browser does not offer."
    : state.show.particles && !moves ? "Particles rest, for the system asks for less motion." : "";
  note.hidden = !note.textContent;
}

function resize() {
  view.size = fit(ground, byId("moving"), canvas);
  ground.dataset.key = ""; // it is empty now
  view.settle();
  draw();
  want();
}

function restore() {
  const address = readAddress();
  choose(Math.round(numberIn(address.n, 1, 400) ?? maker.own?.arrows.length ?? numbers[0]));
  state.choice = {
    kind: ["arrows", "clusters"].includes(address.kind) ? address.kind : run.kind,
    seed: Math.round(numberIn(address.seed, 1, 999999999) ?? run.seed),
    anisotropy: numberIn(address.anisotropy, 0.01, 1) ?? run.anisotropy,
    coverage: numberIn(address.coverage, 0.01, 0.9) ?? run.coverage,
  };
  view.zoom = numberIn(address.zoom, 1, 400) ?? 1;
  const at = address.at?.split(",").map(Number);
  if (at?.length === 2 && at.every(Number.isFinite)) view.center = at;
  theme.restore(address.page);
  for (const name of Object.keys(state.choice)) byId(name).value = String(state.choice[name]);
  restoreLayers(state.show, address.show);
}

function connect() {
  slider.max = String(numbers.length - 1);
  const step = (by) => () => slide(Math.round(state.at) + by);
  connectSlider(slider, player, slide, { ArrowLeft: step(-1), ArrowDown: step(-1), ArrowRight: step(1), ArrowUp: step(1),
    PageDown: step(-4), PageUp: step(4) });
  byId("number").addEventListener("change", () => {
    const n = Math.round(Number(byId("number").value));
    if (!(n >= 1 && n <= 400)) return say();
    choose(n);
    want();
  });
  byId("kind").addEventListener("change", () => {
    state.choice.kind = byId("kind").value;
    want();
  });
  for (const name of ["seed", "anisotropy", "coverage"]) {
    const input = byId(name);
    input.addEventListener("change", () => {
      if (input.value && input.validity.valid) state.choice[name] = Number(input.value);
      input.value = String(state.choice[name]);
      want();
    });
  }
  connectLayers(state.show, (name) => field.map || !["coast", "degrees"].includes(name), () => {
    move();
    update();
  });
  calm.addEventListener("change", move);
  move();
  connectZoom(view, 1.5, () => want());
  byId("svg").addEventListener("click", saveSvg);
  byId("png").addEventListener("click", savePng);
  control(canvas, view, {
    changed: () => want(200),
    hovered: (at) => (at ? read(at) : leave()),
    key: doing(keys),
  });
  new ResizeObserver(resize).observe(byId("stage"));
  addEventListener("hashchange", () => {
    restore();
    move();
    theme.apply();
    want();
  });
}

async function compile() {
  const packed = Uint8Array.from(atob(byId("core").textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
}

async function start() {
  const arrows = run.arrows && await readArrows(run.arrows);
  maker = new Maker(field, { numbers, lengths: run.lengths, told: update, own: arrows && { arrows, choice: { ...ownChoice } } });
  introduce(run);
  byId("subtitle").textContent = run.subtitle;
  restore();
  connect();
  theme.apply();
  const source = URL.createObjectURL(new Blob([JSON.parse(byId("worker").textContent)], { type: "text/javascript" }));
  maker.start(() => new Worker(source), await compile());
  want(0);
}

start().catch((error) => {
  byId("status").textContent = `This browser cannot show the page: ${error.message}`;
});
