// The texture of the part in view: noise that is smeared along the flow (line integral
// convolution, Cabral and Leedom 1993), by WebGL2.
import { part } from "./field.js";
import { build, graphics, parts } from "./shaders.js";

const MOST = 2048; // pixels of a side
const GRAIN = 256; // of the noise, a pixel each; it repeats

const vertex = `
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

const fragment = `
uniform sampler2D flow; // its direction, and 1 where it is known
uniform sampler2D noise;
uniform vec2 size;
uniform float grain; // pixels
uniform vec3 color;
out vec4 pixel;
const int STEPS = 24;
vec2 way(vec2 at) {
  vec2 v = texture(flow, at / size).xy;
  float far = length(v);
  return far > 0.0 ? v / far : vec2(0.0);
}
void main() {
  vec2 here = gl_FragCoord.xy;
  float sum = texture(noise, here / grain / ${GRAIN}.0).r, all = 1.0;
  for (int sign = -1; sign < 2; sign += 2) {
    vec2 at = here;
    float step = float(sign) * grain * 0.5;
    for (int n = 1; n <= STEPS; ++n) {
      vec2 half_way = way(at + 0.5 * step * way(at));
      if (half_way == vec2(0.0) || texture(flow, at / size).z < 0.5) break;
      at += step * half_way;
      float weight = 0.5 + 0.5 * cos(3.14159 * float(n) / float(STEPS + 1));
      sum += weight * texture(noise, at / grain / ${GRAIN}.0).r;
      all += weight;
    }
  }
  float dark = clamp(0.5 + (0.5 - sum / all) * 3.2, 0.0, 1.0);
  float a = 0.42 * dark * step(0.75, texture(flow, here / size).z);
  pixel = vec4(color * a, a);
}`;

export class Streaks {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => this.prepare());
  }

  /** Whether the browser has WebGL2. */
  get ready() {
    if (!this.gl) {
      this.gl = graphics(this.canvas);
      if (this.gl) this.prepare();
    }
    return Boolean(this.gl);
  }

  prepare() {
    const gl = this.gl;
    this.key = undefined;
    this.program = build(gl, vertex, fragment);
    this.flow = gl.createTexture();
    const noise = gl.createTexture();
    // the same streaks each time (xorshift, Marsaglia 2003)
    let word = 2463534242;
    const grains = Uint8Array.from({ length: GRAIN * GRAIN }, () => {
      word ^= word << 13;
      word ^= word >>> 17;
      word ^= word << 5;
      return word & 255;
    });
    gl.bindTexture(gl.TEXTURE_2D, noise);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, GRAIN, GRAIN, 0, gl.RED, gl.UNSIGNED_BYTE, grains);
    this.noise = noise;
    this.filter(gl.REPEAT);
  }

  filter(wrap) {
    const gl = this.gl;
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, wrap);
  }

  /** Of what is seen at once, in a colour "#rrggbb"; the same as long as that stays. */
  layer(field, view, ratio, color) {
    const box = view.part ?? field.box;
    const key = [...box, view.scale, ratio, color].join();
    if (this.key !== key) {
      this.key = key;
      this.made = { name: "texture", image: this.draw(field, box, view.scale * ratio, color), box };
    }
    return this.made;
  }

  draw(field, box, scale, color) {
    const { gl, canvas } = this;
    const wide = [box[2] - box[0], box[3] - box[1]];
    const fit = Math.min(scale, MOST / Math.max(...wide));
    [canvas.width, canvas.height] = wide.map((side) => Math.max(1, Math.round(side * fit)));
    const { width, height, y, u, v } = part(field, box);
    const samples = new Float32Array(4 * width * height);
    for (let n = 0; n < u.length; ++n) {
      const known = u[n] === u[n] && v[n] === v[n];
      const narrow = field.axes === "degrees" ? Math.max(Math.cos((y[Math.floor(n / width)] * Math.PI) / 180), 0.01) : 1;
      const speed = known ? Math.hypot(u[n] / narrow, v[n]) || 1 : 1;
      if (known) samples.set([u[n] / narrow / speed, v[n] / speed, 1], 4 * n);
    }
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.flow);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, width, height, 0, gl.RGBA, gl.FLOAT, samples);
    this.filter(gl.CLAMP_TO_EDGE);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.noise);
    gl.viewport(0, 0, canvas.width, canvas.height);
    const { program, at } = this.program;
    gl.useProgram(program);
    gl.uniform1i(at("flow"), 0);
    gl.uniform1i(at("noise"), 1);
    gl.uniform2f(at("size"), canvas.width, canvas.height);
    gl.uniform1f(at("grain"), Math.max(1, 1.3 * (fit / scale) * (globalThis.devicePixelRatio || 1)));
    gl.uniform3fv(at("color"), parts(color));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const image = document.createElement("canvas");
    [image.width, image.height] = [canvas.width, canvas.height];
    /** @type {CanvasRenderingContext2D} */ (image.getContext("2d")).drawImage(canvas, 0, 0);
    return image;
  }
}
