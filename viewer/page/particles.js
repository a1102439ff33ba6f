// Particles that move with the flow, each with the way it came. They are moved here, in the
// plane of the field, so that a zoom keeps their ways; drawn by WebGL2.
import { velocityAt } from "./field.js";
import { build, graphics, parts } from "./shaders.js";

const LENGTH = 24; // places of a way
const PIXELS = 420; // of the view for each particle
const MOST = 4000;
const FASTEST = 90; // pixels in a second
const OLDEST = 3.5; // seconds
const STRONGEST = 0.55; // share of the colour where a particle is

// A piece of a way is a strip of two triangles, from one kept place to the next. A particle
// that began anew between them has another age there, and no piece.
const vertex = `
layout(location = 0) in vec3 from; // place in the box of the field, from 0 to 1, and birth
layout(location = 1) in vec3 to;
uniform vec4 view; // scale and shift from the box to the window, from -1 to 1
uniform vec2 size; // of the window, in pixels
uniform vec2 share; // of what is seen, at the ends
uniform float width; // half, pixels
out float alpha;
out float side;
void main() {
  vec2 a = from.xy * view.xy + view.zw, b = to.xy * view.xy + view.zw;
  vec2 along = (b - a) * size / 2.0;
  float far = length(along);
  bool end = gl_VertexID > 1;
  alpha = end ? share.y : share.x;
  side = (gl_VertexID & 1) == 0 ? width + 1.0 : -width - 1.0;
  vec2 across = vec2(-along.y, along.x) / max(far, 1e-4) * side * 2.0 / size;
  bool none = from.z != to.z || far < 1e-4;
  gl_Position = none ? vec4(2.0, 2.0, 0.0, 1.0) : vec4((end ? b : a) + across, 0.0, 1.0);
}`;

const fragment = `
in float alpha;
in float side;
uniform vec3 color;
uniform float width;
out vec4 pixel;
void main() {
  float a = alpha * clamp(width + 0.5 - abs(side), 0.0, 1.0);
  pixel = vec4(color * a, a);
}`;

export class Particles {
  /** @param {any} field @param {import("./view.js").View} view @param {number} fastest speed */
  constructor(canvas, field, view, fastest) {
    Object.assign(this, { canvas, field, box: field.box, view, fastest, frames: 0, running: false, born: 0 });
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.stop();
    });
    canvas.addEventListener("webglcontextrestored", () => this.prepare());
  }

  prepare() {
    const gl = this.gl;
    this.program = build(gl, vertex, fragment);
    this.places = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.bufferData(gl.ARRAY_BUFFER, 12 * MOST * LENGTH, gl.DYNAMIC_DRAW);
    for (const k of [0, 1]) {
      gl.enableVertexAttribArray(k);
      gl.vertexAttribDivisor(k, 1);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.age = new Float32Array(MOST).fill(Infinity); // all begin at the first step
    this.now = new Float32Array(3 * MOST);
    this.head = 0;
  }

  /**
   * False: the browser has no WebGL2.
   * @param {() => string} color of the particles, "#rrggbb"
   */
  start(color) {
    if (this.running) return true;
    if (!this.gl) {
      this.gl = graphics(this.canvas);
      if (!this.gl) return false;
      this.prepare();
    }
    this.running = true;
    this.color = color;
    this.before = performance.now();
    this.due = 0;
    const frame = (time) => {
      if (!this.running) return;
      this.step(Math.min(time - this.before, 50) / 1000);
      this.before = time;
      this.draw();
      this.canvas.dataset.frames = String(++this.frames);
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    return true;
  }

  stop() {
    this.running = false;
    this.gl?.clear(this.gl.COLOR_BUFFER_BIT);
    this.age?.fill(Infinity);
  }

  get count() {
    const [w, h] = this.view.size;
    return Math.min(MOST, Math.ceil((w * h) / PIXELS));
  }

  // How far the flow goes from a place meanwhile; undefined where there is none.
  slope(x, y, pixels) {
    const v = velocityAt(this.field, x, y);
    if (!v) return undefined;
    if (this.field.axes === "degrees") v[0] /= Math.max(Math.cos((y * Math.PI) / 180), 0.01);
    const speed = Math.hypot(...v);
    // slow flow is seen to move, too
    const share = speed > 0 ? Math.min(speed / this.fastest, 1) ** 0.7 / speed : 0;
    return [v[0] * share * pixels, v[1] * share * pixels];
  }

  /** Moves all by so many seconds, and keeps their places thirty times in a second. */
  step(seconds) {
    const { box, now, age, view } = this;
    const [west, north] = view.toPlane(0, 0);
    const [east, south] = view.toPlane(...view.size);
    const seen = [Math.max(west, box[0]), Math.max(south, box[1]), Math.min(east, box[2]), Math.min(north, box[3])];
    const size = [box[2] - box[0], box[3] - box[1]];
    const pixels = (FASTEST * seconds) / view.scale;
    for (let n = 0; n < this.count; ++n) {
      const to = this.follow(box[0] + now[3 * n] * size[0], box[1] + now[3 * n + 1] * size[1], pixels);
      const slack = [0, 1].map((k) => (seen[k + 2] - seen[k]) / 20);
      age[n] += seconds;
      let began = !(age[n] <= OLDEST) || !to || [0, 1].some((k) => to[k] < seen[k] - slack[k] || to[k] > seen[k + 2] + slack[k]);
      const place = began ? [0, 1].map((k) => seen[k] + Math.random() * (seen[k + 2] - seen[k])) : to;
      if (began) age[n] = age[n] === Infinity ? Math.random() * OLDEST : 0;
      for (const k of [0, 1]) {
        let share = (place[k] - box[k]) / size[k];
        if (share < 0 || share >= 1) {
          began = true; // on the other side, if the field goes on there
          share -= Math.floor(share);
        }
        now[3 * n + k] = share;
      }
      if (began) now[3 * n + 2] = this.born = (this.born + 1) % 65536;
    }
    this.due += seconds;
    if (this.due < 1 / 30) return;
    this.due %= 1 / 30;
    this.head = (this.head + 1) % LENGTH;
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    gl.bufferSubData(gl.ARRAY_BUFFER, 12 * MOST * this.head, now);
  }

  /** The place a way of so many pixels' worth of the fastest flow farther; undefined: none. */
  follow(x, y, pixels) {
    const first = this.slope(x, y, pixels);
    const middle = first && this.slope(x + first[0] / 2, y + first[1] / 2, pixels);
    return middle && [x + middle[0], y + middle[1]];
  }

  draw() {
    const { gl, view, canvas } = this;
    const { program, at } = this.program;
    const ratio = canvas.width / view.size[0];
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(program);
    const { box } = this;
    const low = view.toScreen(box[0], box[1]);
    const high = view.toScreen(box[2], box[3]);
    const [w, h] = view.size;
    gl.uniform4f(at("view"), (2 * (high[0] - low[0])) / w, (2 * (low[1] - high[1])) / h, (2 * low[0]) / w - 1, 1 - (2 * low[1]) / h);
    gl.uniform2f(at("size"), canvas.width, canvas.height);
    gl.uniform1f(at("width"), 0.65 * ratio);
    gl.uniform3fv(at("color"), parts(this.color()));
    gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
    for (let k = 1; k < LENGTH; ++k) {
      const from = (this.head + k) % LENGTH;
      gl.uniform2f(at("share"), STRONGEST * ((k - 1) / (LENGTH - 1)) ** 1.5, STRONGEST * (k / (LENGTH - 1)) ** 1.5);
      gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 12, 12 * MOST * from);
      gl.vertexAttribPointer(1, 3, gl.FLOAT, false, 12, 12 * MOST * ((from + 1) % LENGTH));
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
    }
  }
}
