// The page of a run in 3D.
import { readAddress, writeAddress } from "../page/address.js";
import { numberIn, placeBeside, Player, save } from "../page/common.js";
import { byId, connectLayers, connectSlider, connectZoom, doing, fit, introduce, layerNames, restoreLayers, Theme } from "../page/controls.js";
import { morph } from "../page/outline.js";
import { control } from "../page/view.js";
import { shortNumber, withUnits } from "../page/words.js";
import { drawLabels, labelsOf } from "./axes.js";
import { Camera } from "./camera.js";
import { chainOf } from "./chain.js";
import { Pace } from "./pace.js";
import { edgeNear, nearestArrow, pointOnCut, steps } from "./pick.js";
import { drawPicture } from "./picture.js";
import { Scene } from "./scene.js";
import { readSurface, readVolume, velocityAt } from "./volume.js";

const run = JSON.parse(byId("run").textContent);
const canvas = byId("picture");
const context = canvas.getContext("2d");
const slider = byId("scale");
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const theme = new Theme(run, { isEven: true }, () => update(), () => {
  if (scene?.ready) scene.setColors(theme.palette, theme.colors);
  redraw();
});
const axes = ["x", "y", "z"];
const names = axes.map((axis) => run[`${axis}Name`] || axis);

const state = {
  at: 0, // on the slider: index in the chain, with a part between two
  cut: { axis: -1, share: 0.5, shows: "both", hides: false }, // axis -1: none
  show: { arrows: true, clusters: false, outline: true, shadows: true, numbers: true },
};

let volume;
let camera;
let scene;
let hovered; // {arrow, at}
let shown = { at: -1, arrows: [] };
let wanted = 0; // animation frame
let fitted; // the stage's size, as the canvas has it
let numbers; // what is written at the box, as it was asked for
let chain; // of scales, of the run and between them

const last = () => chain.length - 1;
const link = () => chain[Math.round(state.at)];
const hasCut = () => state.cut.axis >= 0;

// ---- what is shown

function arrowsNow() {
  if (shown.at !== state.at) {
    const low = Math.floor(state.at);
    const [finer, coarser] = [chain[low], chain[Math.min(low + 1, last())]];
    shown = { at: state.at, arrows: morph(finer, coarser, state.at - low) };
    hovered = undefined;
    byId("reading").hidden = true;
  }
  return shown.arrows;
}

/** Where the slider is among the run's own scales. */
function placeInRun() {
  const [finer, coarser] = [chain[Math.floor(state.at)], chain[Math.ceil(state.at)]];
  return finer.at + (state.at - Math.floor(state.at)) * (coarser.at - finer.at);
}

/** Surfaces of the scales' clusters, read when they are first wanted. */
function clustersNow() {
  if (!state.show.clusters) return [];
  const low = Math.floor(placeInRun());
  const part = placeInRun() - low;
  return [[low, 1 - part], [low + 1, part]].flatMap(([index, share]) => {
    const scale = volume.scales[index];
    if (!scale?.packed || share <= 0) return [];
    scale.reading ??= readSurface(scale.packed, volume.half).then((mesh) => {
      scale.mesh = mesh;
      redraw();
    });
    return scale.mesh ? [{ mesh: scale.mesh, share }] : [];
  });
}

function pictureNow() {
  const arrows = arrowsNow();
  return {
    arrows: state.show.arrows ? arrows : [], clusters: clustersNow(), cut: hasCut() ? state.cut : undefined,
    outline: state.show.outline, shadows: state.show.shadows && state.show.arrows,
    picked: hovered?.arrow ? arrows.indexOf(hovered.arrow) + 1 : -1,
  };
}

const empty = [];

const MOST_PIXELS = 8e5; // of a coarse picture
const FEWER_PIXELS = 2e5; // where clusters are seen through one another, which takes most of its time

function draw() {
  cancelAnimationFrame(wanted);
  wanted = 0;
  if (!scene?.ready) return;
  const ratio = devicePixelRatio || 1;
  const what = pictureNow();
  const { isCoarse } = pace;
  if (!isCoarse) pace.measure();
  const fineness = setFineness(isCoarse ? coarseRatio(ratio, what.clusters.length > 0) : ratio);
  scene.draw(camera, { ...what, arrows: what.arrows.length ? what.arrows : empty }, fineness, isCoarse);
  drawNumbers(ratio);
  canvas.dataset.arrows = String(what.arrows.length);
  canvas.dataset.made = "yes";
  canvas.dataset.clusters = String(what.clusters.length);
}

/** The numbers at the box, unless they are there. */
function drawNumbers(ratio) {
  const { azimuth, elevation, zoom, target, size } = camera;
  const wish = [azimuth, elevation, zoom, target, size, ratio, theme.isDark, state.show.numbers].join();
  if (numbers === wish) return;
  numbers = wish;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, ...size);
  if (state.show.numbers) drawLabels(context, labelsOf(run, volume, camera), theme.colors);
}

function redraw() {
  wanted ||= requestAnimationFrame(draw);
}

const pace = new Pace(redraw);

/** Pixels of a coarse picture for one of the window, along each side. */
function coarseRatio(ratio, hasClusters) {
  const [w, h] = camera.size;
  return Math.min(ratio, Math.sqrt((hasClusters ? FEWER_PIXELS : MOST_PIXELS) / (w * h)));
}

/** Gives the canvas so many pixels for one of the window. */
function setFineness(ratio) {
  const space = byId("space");
  const size = camera.size.map((length) => Math.round(length * ratio));
  if (space.width !== size[0] || space.height !== size[1]) [space.width, space.height] = size;
  return ratio;
}

/** "12 arrows · mean direction error 16° · …", as pictures have it. */
function captionWords() {
  const { at, count } = link();
  if (Number.isInteger(at)) return run.scales[at].caption;
  const [more, fewer] = [Math.floor(at), Math.ceil(at)].map((n) => run.scales[n].icons.length);
  return `${count} arrows · between the run's scales of ${more} and ${fewer}`;
}

const speedWords = (speed) => withUnits(speed, run.units);

function placeWords(place) {
  return volume.toField(place).map((x, k) => `${names[k]} ${withUnits(x, run[`${axes[k]}Units`], 4)}`).join(", ");
}

/** Where to: its parts along the axes. */
function directionWords(way) {
  const size = Math.hypot(...way) || 1;
  return `direction ${way.map((x, k) => `${names[k]} ${(x / size).toFixed(2).replace("-", "−")}`).join(", ")}`;
}

function say() {
  byId("subtitle").textContent = captionWords();
  byId("count").textContent = String(link().count);
  slider.setAttribute("aria-valuetext", `${link().count} arrows`);
  canvas.setAttribute("aria-label", `${link().count} arrows of ${run.title}, in 3D`);
  const { axis, share } = state.cut;
  for (const id of ["cut-at", "cut-shows", "cut-hides"]) byId(id).disabled = axis < 0;
  byId("cut-axis").value = axis < 0 ? "" : axes[axis];
  byId("cut-at").value = String(share);
  byId("cut-shows").value = state.cut.shows;
  byId("cut-hides").checked = state.cut.hides;
  const words = axis < 0 ? "" : `at ${names[axis]} ${withUnits(run.low[axis] + share * (run.high[axis] - run.low[axis]), run[`${axes[axis]}Units`], 4)}`;
  byId("cut-place").textContent = words;
  byId("cut-at").setAttribute("aria-valuetext", words);
}

function keep() {
  const round = (x, digits = 4) => Number(x.toFixed(digits));
  const { axis, share, shows, hides } = state.cut;
  const [azimuth, elevation] = camera.first;
  const turned = Math.abs(camera.azimuth - azimuth) + Math.abs(camera.elevation - elevation) > 0.05;
  writeAddress({
    n: link().count,
    view: turned ? `${round(camera.azimuth, 1)},${round(camera.elevation, 1)}` : undefined,
    zoom: Math.abs(camera.zoom - 1) > 1e-3 ? round(camera.zoom, 3) : undefined,
    at: camera.target.some((x) => Math.abs(x) > 1e-4) ? camera.target.map((x) => round(x)).join(",") : undefined,
    cut: axis < 0 ? undefined : `${axes[axis]},${round(share)}`,
    shows: axis < 0 || shows === "both" ? undefined : shows,
    before: axis >= 0 && hides ? "hidden" : undefined,
    show: layerNames(state.show),
    page: theme.choice || undefined,
  });
}

function update() {
  redraw();
  say();
  keep();
}

function move() {
  pace.move();
  update();
}

// ---- controls

function slide(at) {
  state.at = Math.min(Math.max(at, 0), last());
  slider.value = String(state.at);
  move();
}

/** To the run's next scale of fewer arrows, or of more. */
function leap(way) {
  let at = way > 0 ? Math.floor(state.at) + 1 : Math.ceil(state.at) - 1;
  while (chain[at] && !Number.isInteger(chain[at].at)) at += way;
  slide(at);
}

// Two seconds from one of the run's scales to the next, more where many arrows change one by one.
function pause() {
  const low = Math.min(Math.floor(state.at), last() - 1);
  return Math.max(2000 * (chain[low + 1].at - chain[low].at), 150) * (calm.matches ? 2 : 1);
}

const player = new Player(byId("play"), { at: () => state.at, last, made: () => chain.length, slide, pace: pause });

function cutAcross(axis) {
  state.cut.axis = state.cut.axis === axis ? -1 : axis;
  update();
}

function moveCut(share) {
  if (!hasCut()) return;
  state.cut.share = Math.min(Math.max(share, 0), 1);
  move();
}

function read(at, given) {
  const note = byId("reading");
  const cut = hasCut() ? state.cut : undefined;
  const found = given ?? (state.show.arrows ? nearestArrow(at, arrowsNow(), camera, cut, volume) : undefined);
  const place = found ? undefined : cut && pointOnCut(at, cut, camera, volume);
  const velocity = place && velocityAt(volume.velocity, place);
  if (hovered?.arrow !== found?.arrow) redraw();
  hovered = found && { ...found, at };
  canvas.style.cursor = cut && edgeNear(at, cut, camera, volume) ? "move" : "";
  note.hidden = !found && !velocity;
  if (note.hidden) return "";
  const lines = [];
  note.replaceChildren();
  if (found) {
    const title = document.createElement("b");
    title.textContent = `Arrow: ${speedWords(found.arrow.speed)}`;
    note.append(title);
    const all = arrowsNow().reduce((sum, arrow) => sum + arrow.area, 0);
    lines.push(`volume: ${shortNumber((100 * found.arrow.area) / all, 2)} % of what all arrows stand for`, directionWords(found.way),
      `at ${placeWords(found.place)}`);
  } else lines.push(placeWords(place), speedWords(Math.hypot(...velocity)), directionWords(velocity));
  note.append(lines.join("\n"));
  note.style.whiteSpace = "pre-line";
  placeBeside(note, at, camera.size);
  return [...note.childNodes].map((node) => node.textContent).join(", ").replaceAll("\n", ", ");
}

function leave() {
  if (hovered) redraw();
  hovered = undefined;
  byId("reading").hidden = true;
}

// The next arrow for keys, from left to right.
function walk(step) {
  const next = steps(arrowsNow(), hovered?.arrow, step, camera);
  if (next) byId("status").textContent = read(next.at, next);
}

const keys = {
  ",": () => leap(-1),
  ".": () => leap(1),
  " ": () => player.play(!player.playing),
  n: () => walk(1),
  p: () => walk(-1),
  x: () => cutAcross(0),
  y: () => cutAcross(1),
  z: () => cutAcross(2),
  "[": () => moveCut(state.cut.share - 0.02),
  "]": () => moveCut(state.cut.share + 0.02),
  Escape: leave,
};

/** Moves the cut by its frame. */
function grab(at) {
  const held = hasCut() && edgeNear(at, state.cut, camera, volume);
  return held ? (now) => moveCut(held(now)) : undefined;
}

async function savePng() {
  const blob = await drawPicture(camera, 2, {
    scene: (ratio) => scene.draw(camera, pictureNow(), ratio),
    canvas: byId("space"),
    labels: (paper) => state.show.numbers && drawLabels(paper, labelsOf(run, volume, camera), theme.colors),
    title: run.title, words: captionWords(), colors: theme.colors, legend: theme.legend,
  });
  draw(); // on the canvas of the window again
  if (blob) save("flowgrain.png", blob);
}

// ---- the page

/** Gives the view the stage's size; whether that is another. */
function refit() {
  const { clientWidth, clientHeight } = byId("stage");
  const size = [clientWidth, clientHeight, devicePixelRatio].join();
  if (size === fitted) return false;
  fitted = size;
  camera.size = fit(canvas);
  numbers = undefined; // a canvas of another size is empty
  return true;
}

function resize() {
  if (refit()) draw();
}

function restore() {
  const address = readAddress();
  const n = numberIn(address.n, 0, 1e9);
  state.at = n === undefined ? 0
    : chain.reduce((best, { count }, k) => (Math.abs(count - n) < Math.abs(chain[best].count - n) ? k : best), 0);
  slider.value = String(state.at);
  camera.reset();
  const list = (text, count) => {
    const values = (text ?? "").split(",").map(Number);
    return text && values.length === count && values.every(Number.isFinite) ? values : undefined;
  };
  [camera.azimuth, camera.elevation] = list(address.view, 2) ?? camera.first;
  camera.zoom = numberIn(address.zoom, 0.4, 60) ?? 1;
  camera.target = list(address.at, 3) ?? [0, 0, 0];
  camera.slide(0, 0); // within the box
  camera.pan(0, 0);
  const [axis, share] = (address.cut ?? "").split(",");
  state.cut = { axis: axes.indexOf(axis), share: numberIn(share, 0, 1) ?? 0.5,
    shows: ["speed", "arrows"].includes(address.shows) ? address.shows : "both", hides: address.before === "hidden" };
  theme.restore(address.page);
  restoreLayers(state.show, address.show);
}

function connectCut() {
  names.forEach((name, k) => byId("cut-axis").append(new Option(name, axes[k])));
  byId("cut-axis").addEventListener("change", () => {
    state.cut.axis = axes.indexOf(byId("cut-axis").value);
    update();
  });
  byId("cut-at").addEventListener("input", () => moveCut(Number(byId("cut-at").value)));
  byId("cut-shows").addEventListener("change", () => {
    state.cut.shows = byId("cut-shows").value;
    update();
  });
  byId("cut-hides").addEventListener("change", () => {
    state.cut.hides = byId("cut-hides").checked;
    update();
  });
}

function connectView() {
  connectZoom(camera, 1.25, move);
  for (const button of document.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => {
      camera.reset();
      [camera.azimuth, camera.elevation] = (/** @type {HTMLElement} */ (button).dataset.view ?? "").split(",").map(Number);
      camera.settle();
      update();
    });
  control(canvas, camera, {
    changed: () => {
      leave();
      move();
    },
    hovered: (at) => (at ? read(at) : leave()),
    key: doing(keys),
    grab,
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault()); // that button moves the view
}

function connect() {
  slider.max = String(last());
  slider.disabled = last() === 0;
  byId("play").disabled = last() === 0;
  const step = (by) => () => slide(Math.round(state.at) + by);
  connectSlider(slider, player, slide, { ArrowLeft: step(-1), ArrowDown: step(-1), ArrowRight: step(1), ArrowUp: step(1),
    PageDown: () => leap(-1), PageUp: () => leap(1) });
  const has = { clusters: run.scales.some((scale) => scale.clusters), outline: Boolean(run.outline) };
  connectLayers(state.show, (name) => has[name] !== false, update);
  connectCut();
  connectView();
  byId("png").addEventListener("click", savePng);
  byId("space").addEventListener("webglcontextrestored", () => {
    scene.prepare();
    theme.apply();
  });
  new ResizeObserver(resize).observe(byId("stage"));
  addEventListener("hashchange", () => {
    restore();
    theme.apply();
    update();
  });
}

async function start() {
  introduce(run);
  volume = await readVolume(run);
  chain = chainOf(volume);
  camera = new Camera(volume.half, run.view);
  scene = new Scene(byId("space"), volume, run);
  restore();
  connect();
  theme.apply();
  refit();
  pace.start();
  update();
  if (!scene.ready) throw new Error("it offers no WebGL2");
}

start().catch((error) => {
  byId("status").textContent = `This browser cannot show the page: ${error.message}`;
});
