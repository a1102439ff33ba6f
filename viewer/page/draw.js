// What the picture shows, as layers that a canvas or an SVG file draws.
import { velocityAt } from "./field.js";
import { outline } from "./outline.js";
import { colorOf } from "./colors.js";

/**
 * @typedef {object} Layer
 * @property {string} name
 * @property {(Float64Array | number[])[]} [paths] in the plane: x, y, x, y, …
 * @property {boolean} [closed]
 * @property {string} [fill] @property {string} [stroke]
 * @property {number} [width] pixels @property {number} [opacity]
 * @property {string} [rule]
 * @property {HTMLCanvasElement} [image] @property {number[]} [box] west, south, east, north
 */

export const LIGHT = { page: "#ffffff", sea: "#ffffff", land: "#ebebea", shore: "#8f8f8f", degrees: "#d3d3d3",
  frame: "#777777", tint: [70, 110, 160], tintShare: 0.2, flow: "#33506e", hedgehog: "#6b7280", missing: "#eef0f3", ring: "#d0021b", text: "#1b1f24" };
export const DARK = { page: "#14171c", sea: "#14171c", land: "#24282e", shore: "#7d858f", degrees: "#363c45",
  frame: "#8b929c", tint: [120, 160, 215], tintShare: 0.22, flow: "#a9c3de", hedgehog: "#8b929c", missing: "#20242b", ring: "#ffb454", text: "#e8eaed" };

/** Arrows, slow ones first, so that fast ones lie above. */
export function arrowLayers(arrows, look) {
  return [...arrows].sort((a, b) => a.speed - b.speed).map((arrow) => ({
    name: "arrow",
    paths: [(arrow.outline && !arrow.share) ? arrow.outline : outline(arrow)],
    closed: true,
    fill: colorOf(look.palette, look.speeds, arrow.speed),
    opacity: arrow.share ?? 1,
  }));
}

export function mapLayers(map, colors, show) {
  if (!map) return { under: [], over: [] };
  const under = show.coast ? [
    { name: "land", paths: map.land, closed: true, fill: colors.land, rule: "evenodd" },
    { name: "lakes", paths: map.lakes, closed: true, fill: colors.sea, rule: "evenodd" },
  ] : [];
  const over = [];
  if (show.degrees) over.push({ name: "degrees", paths: map.degrees, stroke: colors.degrees, width: 0.8 });
  if (show.coast) {
    over.push({ name: "banks", paths: map.banks, stroke: colors.shore, width: 0.5 });
    over.push({ name: "coast", paths: map.shore, stroke: colors.shore, width: 0.8 });
  }
  return { under, over };
}

/** @type {{key: string, layer: Layer} | undefined} */
let straight; // as long as the view stays

/** Straight arrows on a screen's grid, for comparison. */
export function hedgehog(field, view, fastest, color) {
  const key = [...view.size, ...view.center, view.zoom, color].join();
  if (straight?.key !== key) straight = { key, layer: makeHedgehog(field, view, fastest, color) };
  return straight.layer;
}

function makeHedgehog(field, view, fastest, color) {
  const gap = 26;
  const paths = [];
  const [w, h] = view.size;
  for (let py = gap / 2; py < h; py += gap)
    for (let px = gap / 2; px < w; px += gap) {
      const [x, y] = view.toPlane(px, py);
      const v = velocityAt(field, x, y);
      if (!v) continue;
      const speed = Math.hypot(...v);
      const long = (0.95 * gap * Math.min(1, speed / fastest)) / view.scale;
      if (!(speed > 0)) continue;
      const [dx, dy] = [(v[0] / speed) * long, (v[1] / speed) * long];
      const [tx, ty] = [x + dx / 2, y + dy / 2];
      paths.push([x - dx / 2, y - dy / 2, tx, ty], [tx - 0.35 * dx - 0.2 * dy, ty - 0.35 * dy + 0.2 * dx, tx, ty,
        tx - 0.35 * dx + 0.2 * dy, ty - 0.35 * dy - 0.2 * dx]);
    }
  return { name: "hedgehog", paths, stroke: color, width: 1 };
}

const images = new WeakMap();

// Of an even raster, the first row at the south: share(n) of a colour.
function raster(key, [width, height], color, share) {
  const made = images.get(key);
  if (made?.color === String(color)) return made.image;
  const image = document.createElement("canvas");
  [image.width, image.height] = [width, height];
  const context = /** @type {CanvasRenderingContext2D} */ (image.getContext("2d"));
  const pixels = context.createImageData(width, height);
  for (let n = 0; n < width * height; ++n) {
    const at = 4 * ((height - 1 - Math.floor(n / width)) * width + (n % width));
    pixels.data.set([...color, Math.round(255 * share(n))], at);
  }
  context.putImageData(pixels, 0, 0);
  images.set(key, { image, color: String(color) });
  return image;
}

/** The clusters that arrows began from, or are nearest to. */
export function tintLayer(density, colors, opacity) {
  const { nodes, origin, spacing, u, labels } = density;
  const image = raster(density, nodes, colors.tint, (n) => (labels[n] > 0 ? colors.tintShare * Math.min(3 * u[n], 1) : 0));
  const box = [0, 1].map((k) => origin[k] - spacing[k] / 2);
  return { name: "clusters", image, opacity, box: [...box, ...[0, 1].map((k) => box[k] + nodes[k] * spacing[k])] };
}

/** Where the field is missing; undefined where it is everywhere. */
export function missingLayer(field, colors) {
  if (field.whole === undefined) field.whole = !field.u.some(Number.isNaN);
  if (field.whole) return undefined;
  const color = [1, 3, 5].map((k) => parseInt(colors.missing.slice(k, k + 2), 16));
  const image = raster(field, [field.width, field.height], color, (n) => (Number.isNaN(field.u[n]) ? 1 : 0));
  const half = [(field.x[1] - field.x[0]) / 2, (field.y[1] - field.y[0]) / 2];
  return { name: "missing", image, box: [field.x[0] - half[0], field.y[0] - half[1],
    field.x[field.width - 1] + half[0], field.y[field.height - 1] + half[1]] };
}

const known = new WeakMap();

// Paths in the plane; those of a map stay as they are.
function path2d(layer) {
  const made = known.get(layer.paths);
  if (made) return made;
  const path = new Path2D();
  for (const line of layer.paths) {
    for (let k = 0; k < line.length; k += 2) k ? path.lineTo(line[k], line[k + 1]) : path.moveTo(line[k], line[k + 1]);
    if (layer.closed) path.closePath();
  }
  known.set(layer.paths, path);
  return path;
}

/**
 * Draws layers within the border of the field, on a page of that colour or on nothing.
 * @param {CanvasRenderingContext2D} context @param {(Layer | undefined)[]} layers @param {string} [page]
 */
export function drawOnCanvas(context, layers, view, ratio, border, page) {
  const { scale } = view;
  const [w, h] = view.size;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.globalAlpha = 1;
  context.clearRect(0, 0, w * ratio, h * ratio);
  context.fillStyle = page ?? "";
  if (page) context.fillRect(0, 0, w * ratio, h * ratio);
  const world = () => context.setTransform(ratio * scale, 0, 0, -ratio * scale,
    ratio * (w / 2 - view.center[0] * scale), ratio * (h / 2 + view.center[1] * scale));
  context.save();
  world();
  context.clip(path2d(border));
  for (const layer of layers) {
    if (!layer) continue;
    context.globalAlpha = layer.opacity ?? 1;
    if (layer.image) {
      const [x0, y0] = view.toScreen(layer.box[0], layer.box[3]);
      const [x1, y1] = view.toScreen(layer.box[2], layer.box[1]);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.imageSmoothingQuality = "high";
      context.drawImage(layer.image, x0, y0, x1 - x0, y1 - y0);
      continue;
    }
    world();
    const path = path2d(layer);
    if (layer.fill) {
      context.fillStyle = layer.fill;
      context.fill(path, layer.rule ?? "nonzero");
    }
    if (layer.stroke) {
      context.strokeStyle = layer.stroke;
      context.lineWidth = layer.width / scale;
      context.lineJoin = context.lineCap = "round";
      context.stroke(path);
    }
  }
  context.restore();
}

/** The line round the field. */
export function frameLayer(border, colors) {
  return { ...border, stroke: colors.frame, width: 3 }; // half of it is outside, and clipped
}

const escape = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** The same as an SVG file, with `room` below it for what `extra` has of SVG. */
export function drawAsSvg(layers, view, colors, border, title, extra = "", room = 0) {
  const [w, h] = view.size;
  const number = (x) => String(Math.round(x * 10) / 10);
  const data = ({ paths, closed }) => paths.map((line) => {
    let text = "";
    for (let k = 0; k < line.length; k += 2) {
      const [x, y] = view.toScreen(line[k], line[k + 1]);
      text += `${k ? "L" : "M"}${number(x)} ${number(y)}`;
    }
    return text + (closed ? "Z" : "");
  }).join("");
  const parts = layers.filter(Boolean).map((layer) => {
    const opacity = layer.opacity !== undefined && layer.opacity < 1 ? ` opacity="${layer.opacity.toFixed(2)}"` : "";
    if (layer.image) {
      const [x0, y0] = view.toScreen(layer.box[0], layer.box[3]);
      const [x1, y1] = view.toScreen(layer.box[2], layer.box[1]);
      return `<image x="${number(x0)}" y="${number(y0)}" width="${number(x1 - x0)}" height="${number(y1 - y0)}" ` +
        `preserveAspectRatio="none" href="${layer.image.toDataURL()}"${opacity}/>`;
    }
    const rule = layer.rule ? ` fill-rule="${layer.rule}"` : "";
    const stroke = layer.stroke ? ` stroke="${layer.stroke}" stroke-width="${layer.width}" stroke-linejoin="round"` : "";
    return `<path d="${data(layer)}" fill="${layer.fill ?? "none"}"${rule}${stroke}${opacity}/>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${w}" height="${h + room}" viewBox="0 0 ${w} ${h + room}">` +
    `<title>${escape(title)}</title><rect width="100%" height="100%" fill="${colors.page}"/>` +
    `<clipPath id="frame"><path d="${data(border)}"/></clipPath><clipPath id="window"><rect width="${w}" height="${h}"/></clipPath>` +
    `<g clip-path="url(#window)"><g clip-path="url(#frame)">${parts.join("\n")}</g>` +
    `<path d="${data(border)}" fill="none" stroke="${colors.frame}"/></g>${extra}</svg>`;
}
