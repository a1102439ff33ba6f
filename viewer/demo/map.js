// A map of the world's winds with a chosen number of arrows in view, by the package alone.
import { arrows } from "flowgrain";
import { readLand, readNetcdf } from "./data.js";

const canvas = document.getElementById("map"), picture = canvas.getContext("2d");
const number = document.getElementById("number"), told = document.getElementById("told");
const [wind, land] = await Promise.all([readNetcdf("../../data/gfs_20140131.nc"), readLand("../../data/coast-110m.bin")]);
const columns = 360, highest = 84; // samples a degree apart from 0 east and 90 north; the poles are no place for a flat map
const tall = 2 * highest / 360; // the view's height beside its width
const view = { west: -180, north: highest, span: 360 };
let shown = { arrows: [], speedRange: [0, 1] }, asked = 0;

const scale = () => canvas.width / view.span;
const sample = (name, longitude, latitude) => wind[name][(90 - latitude) * columns + ((longitude % columns) + columns) % columns];

/** The samples in view, a degree beyond it on each side, south to north. */
function cut() {
  const west = Math.floor(view.west), width = Math.min(Math.ceil(view.span) + 2, columns + 1);
  const south = Math.max(Math.floor(view.north - tall * view.span), -highest), height = Math.min(Math.ceil(view.north), highest) - south + 1;
  const x = Float64Array.from({ length: width }, (_, i) => west + i), y = Float64Array.from({ length: height }, (_, j) => south + j);
  const of = (name) => Float32Array.from({ length: width * height }, (_, n) => sample(name, x[n % width], y[Math.floor(n / width)]));
  return { u: of("u10"), v: of("v10"), width, height, x, y, axes: "degrees" };
}

/** Asks for the arrows in view; of several answers the last one counts. */
async function place() {
  const request = ++asked, begin = performance.now();
  try {
    const scale = await arrows({ ...cut(), n: Number(number.value), effort: "quick" });
    if (request !== asked) return;
    shown = scale;
    told.textContent = `${scale.arrows.length} arrows in ${Math.round(performance.now() - begin)} ms`;
  } catch (error) {
    if (request !== asked) return;
    told.textContent = error.message;
  }
  canvas.dataset.made = request;
  draw();
}

let waiting;
const placeSoon = () => { draw(); clearTimeout(waiting); waiting = setTimeout(place, 120); };

/** Slow is light blue, fast is dark red. */
function color(speed) {
  const [least, most] = shown.speedRange, t = Math.min(Math.max((speed - least) / (most - least || 1), 0), 1);
  return `hsl(${200 + 150 * t} 75% ${52 - 22 * t}%)`;
}

/** Adds a closed line of [longitude, latitude], moved east. */
function path(points, shift) {
  points.forEach(([x, y], n) =>
    picture[n ? "lineTo" : "moveTo"]((x + shift - view.west) * scale(), (view.north - y) * scale()));
  picture.closePath();
}
const pairs = (flat) => Array.from({ length: flat.length / 2 }, (_, n) => [flat[2 * n], flat[2 * n + 1]]);

function draw() {
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.width * tall;
  picture.fillStyle = "#dfe6ea";
  picture.fillRect(0, 0, canvas.width, canvas.height);
  picture.beginPath();
  for (const shift of [-360, 0, 360]) for (const ring of land) path(ring, shift);
  picture.fillStyle = "#f6f6f4";
  picture.fill("evenodd");
  for (const arrow of shown.arrows) {
    picture.beginPath();
    path(pairs(arrow.outline), 0);
    picture.fillStyle = color(arrow.speed);
    picture.fill();
  }
}

/** Keeps the place under the pointer where it is. */
function zoom(factor, across = 0.5, down = 0.5) {
  const span = Math.min(Math.max(view.span * factor, 15), 360), less = view.span - span;
  move(across * less, down * less * tall, span);
}

function move(east, south, span = view.span) {
  view.span = span;
  view.west = ((view.west + east + 540) % 360) - 180;
  const least = tall * span - highest;
  view.north = Math.min(Math.max(view.north - south, least), highest);
  placeSoon();
}

canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  zoom(Math.exp(event.deltaY / 500), event.offsetX / canvas.clientWidth, event.offsetY / canvas.clientHeight);
}, { passive: false });
canvas.addEventListener("pointermove", (event) => {
  const degrees = view.span / canvas.clientWidth;
  if (event.buttons) return move(-event.movementX * degrees, -event.movementY * degrees);
  const x = Math.round(view.west + event.offsetX * degrees), y = Math.round(view.north - event.offsetY * degrees);
  if (Math.abs(y) > 90) return;
  told.textContent = `${Math.hypot(sample("u10", x, y), sample("v10", x, y)).toFixed(1)} m/s at ${y}° N, ${((x + 540) % 360) - 180}° E`;
});
canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
canvas.addEventListener("keydown", (event) => {
  const step = view.span / 8;
  const does = { "+": () => zoom(0.7), "-": () => zoom(1 / 0.7), ArrowLeft: () => move(-step, 0), ArrowRight: () => move(step, 0),
    ArrowUp: () => move(0, -step), ArrowDown: () => move(0, step) }[event.key];
  if (!does) return;
  event.preventDefault();
  does();
});
number.addEventListener("input", () => { number.nextElementSibling.value = number.value; placeSoon(); });
addEventListener("resize", draw);
place();
