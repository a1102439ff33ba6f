// All that is drawn by WebGL2: box, arrows, cut, surfaces.
import { build, graphics, parts } from "../page/shaders.js";
import { colorOf } from "../page/colors.js";
import { edgesOf } from "./axes.js";
import { Cut, planeOf } from "./cut.js";
import { COARSE, FINE } from "./frames.js";
import { Samples } from "./samples.js";
import { Surfaces } from "./surfaces.js";
import { Tubes } from "./tubes.js";

const FAR = 100; // beyond everything

const lineVertex = `
layout(location = 0) in vec3 at;
uniform mat4 view;
void main() { gl_Position = view * vec4(at, 1.0); }`;

const lineFragment = `
uniform vec4 plain;
out vec4 pixel;
void main() { pixel = vec4(plain.rgb * plain.a, plain.a); }`;

const mix = (a, b, t) => a.map((x, k) => x + t * (b[k] - x));

/** A speed's colour, from 0 to 1. */
const colorParts = (palette, speeds, speed) => colorOf(palette, speeds, speed).match(/\d+/g).map((c) => Number(c) / 255);

export class Scene {
  /** @param {HTMLCanvasElement} canvas @param {any} volume @param {any} run */
  constructor(canvas, volume, run) {
    Object.assign(this, { canvas, volume, run });
    this.gl = graphics(canvas, false); // samples.js has it
    if (!this.gl) return;
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.prepare();
  }

  get ready() {
    return Boolean(this.gl);
  }

  prepare() {
    const { gl } = this;
    this.samples = new Samples(gl);
    this.tubes = new Tubes(gl);
    this.surfaces = new Surfaces(gl);
    this.cut = new Cut(gl, this.volume, this.run.field.unit);
    this.lines = build(gl, lineVertex, lineFragment);
    this.lineBuffer = gl.createBuffer();
    this.lineArray = gl.createVertexArray();
    gl.bindVertexArray(this.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lineBuffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    this.palette = gl.createTexture();
    if (this.theme) this.setColors(...this.theme.given);
  }

  /** @param {string[]} palette @param {any} colors of draw.js */
  setColors(palette, colors) {
    const { gl } = this;
    const bytes = Uint8Array.from(palette.flatMap((c) => [...parts(c).map((x) => Math.round(255 * x)), 255]));
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, palette.length, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    const [page, text] = [parts(colors.page), parts(colors.text)];
    const isLight = page[0] > 0.5;
    this.theme = {
      given: [palette, colors], page, ink: text, name: colors.page,
      frame: mix(page, parts(colors.frame), 0.75),
      shadow: mix(page, isLight ? [0, 0, 0] : [1, 1, 1], isLight ? 0.13 : 0.1),
      wall: mix(page, isLight ? [0, 0, 0] : [1, 1, 1], isLight ? 0.035 : 0.045),
      tint: isLight ? [0.36, 0.52, 0.72] : [0.5, 0.66, 0.86],
      domain: isLight ? [0.42, 0.45, 0.5] : [0.62, 0.66, 0.72],
    };
  }

  /** What the programs are told of the view. */
  setUp(at) {
    const { gl, camera, wall, clip } = this;
    gl.uniformMatrix4fv(at("view"), false, this.matrix);
    gl.uniform3fv(at("eye"), camera.eye);
    gl.uniform3fv(at("up"), camera.up);
    gl.uniform3fv(at("right"), camera.right);
    gl.uniform3fv(at("page"), this.theme.page);
    gl.uniform4fv(at("cut"), clip);
    gl.uniform3fv(at("wall"), wall);
  }

  // The half space that stays, where what is before the cut is hidden.
  clipOf(cut, camera) {
    if (!cut || !cut.hides) return [0, 0, 0, FAR];
    const { at } = planeOf(cut, this.volume.half);
    const side = camera.eye[cut.axis] > at ? 1 : -1;
    return [...[0, 1, 2].map((k) => (k === cut.axis ? side : 0)), side * at];
  }

  /**
   * @param {import("./camera.js").Camera} camera
   * @param {{arrows: any[], clusters: {mesh: any, share: number}[], cut: any, outline: boolean, shadows: boolean, picked: number}} what
   * @param {number} ratio pixels of the canvas in one of the window
   * @param {boolean} coarse without samples, rims and round arrows
   */
  draw(camera, what, ratio, coarse = false) {
    const { gl } = this;
    if (gl.isContextLost()) return;
    const size = camera.size.map((length) => Math.round(length * ratio));
    if (!coarse) this.samples.begin(size);
    gl.viewport(0, 0, ...size);
    this.drawAll(camera, what, ratio, coarse ? COARSE : FINE);
    if (!coarse) this.samples.end();
  }

  drawAll(camera, what, ratio, detail) {
    const { gl, volume, theme } = this;
    const { half, period } = volume;
    Object.assign(this, { camera, matrix: camera.matrix, eye: camera.eye, size: camera.size, clip: this.clipOf(what.cut, camera) });
    this.wall = period.map((p, k) => (p > 0 ? half[k] + 1e-4 : FAR));
    gl.clearColor(...theme.page, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    this.drawBox(camera);
    this.tubes.set(what.arrows, volume, detail);
    const floor = what.shadows && camera.seesInside(2, -1) ? -half[2] + 0.001 : undefined;
    const fog = [camera.distance - camera.radius, 2 * camera.radius];
    const about = { setUp: (at) => this.setUp(at), matrix: this.matrix, eye: this.eye, size: this.size, palette: this.palette, scale: ratio * camera.scale,
      speeds: this.run.speeds, ...theme, theme: theme.name, floor, fog, picked: what.picked,
      isCoarse: detail === COARSE,
      isClosed: !what.cut?.hides && !period.some((p) => p > 0), // no arrow is cut open
     
      isDark: (speed) => luminance(colorParts(theme.given[0], this.run.speeds, speed)) < 0.3 };
    this.tubes.draw(about);
    if (what.cut) this.cut.draw(about, what.cut);
    const layers = what.clusters.map(({ mesh, share }) => ({ mesh, color: theme.tint, opacity: [0.07 * share, 0.42 * share] }));
    if (what.outline && volume.outline) layers.push({ mesh: volume.outline, color: theme.domain, opacity: [0.02, 0.24] });
    this.surfaces.draw(about, layers);
  }

  // Sides whose inside is seen, and the edges of those.
  drawBox(camera) {
    const { gl, theme } = this;
    const { half } = camera;
    const { program, at } = this.lines;
    const edges = edgesOf(camera).flatMap(({ ends }) => ends);
    const floor = [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]].map(([a, b]) => [a * half[0], b * half[1], -half[2]]);
    const below = camera.seesInside(2, -1) ? floor : [];
    gl.useProgram(program);
    gl.uniformMatrix4fv(at("view"), false, this.matrix);
    gl.bindVertexArray(this.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lineBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from([...below, ...edges].flat()), gl.DYNAMIC_DRAW);
    gl.disable(gl.BLEND);
    gl.depthMask(false);
    gl.uniform4fv(at("plain"), [...theme.wall, 1]);
    gl.drawArrays(gl.TRIANGLES, 0, below.length);
    gl.uniform4fv(at("plain"), [...theme.frame, 1]);
    gl.drawArrays(gl.LINES, below.length, edges.length);
    gl.depthMask(true);
  }
}

/** Of WCAG. */
function luminance(color) {
  const [r, g, b] = color.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
