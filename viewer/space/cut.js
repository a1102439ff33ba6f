// A plane through the volume, across an axis: colours of the speed on it, and arrows along the
// flow in it.
import { build } from "../page/shaders.js";
import { along, cross } from "./camera.js";
import { velocityAt } from "./volume.js";

const GLYPHS = 22; // along the longer side
const LONGEST = 0.92; // of the room of a glyph
const THICK = 0.1; // of it
const SLOWEST = 0.04; // of the fastest: no glyph
const LIFT = 0.002; // over the plane, towards the viewer

const faceVertex = `
uniform mat4 view;
uniform vec3 middle, along_x, along_y;
out vec3 place;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  place = middle + corner.x * along_x + corner.y * along_y;
  gl_Position = view * vec4(place, 1.0);
}`;

const faceFragment = `
precision highp sampler3D;
in vec3 place;
uniform sampler3D velocity;
uniform sampler2D palette;
uniform vec2 speeds;
uniform vec3 half_sides;
uniform vec4 plain; // where there is no colour of speeds
uniform float opacity;
out vec4 pixel;
void main() {
  vec3 nodes = vec3(textureSize(velocity, 0));
  vec3 share = clamp(place / half_sides / 2.0 + 0.5, 0.0, 1.0);
  vec4 v = texture(velocity, (share * (nodes - 1.0) + 0.5) / nodes);
  if (v.w < 0.5) discard;
  float wide = float(textureSize(palette, 0).x);
  float t = clamp((length(v.xyz / v.w) - speeds.x) / (speeds.y - speeds.x), 0.0, 1.0);
  vec3 color = texture(palette, vec2((t * (wide - 1.0) + 0.5) / wide, 0.5)).rgb;
  vec4 shown = plain.a > 0.0 ? plain : vec4(color, opacity);
  pixel = vec4(shown.rgb * shown.a, shown.a);
}`;

const glyphVertex = `
layout(location = 0) in vec4 corner; // and whether the plane is dark there
uniform mat4 view;
flat out float dark;
void main() {
  dark = corner.w;
  gl_Position = view * vec4(corner.xyz, 1.0);
}`;

const glyphFragment = `
flat in float dark;
uniform vec3 inks[2];
out vec4 pixel;
void main() { pixel = vec4(inks[dark > 0.5 ? 1 : 0], 1.0) * 0.88; }`;

/** Middle of the plane and its half sides, in the view box. */
export function planeOf({ axis, share }, half) {
  const unit = (k) => [0, 1, 2].map((i) => (i === k ? half[k] : 0));
  const at = (2 * share - 1) * half[axis];
  const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
  return { middle: [0, 1, 2].map((k) => (k === axis ? at : 0)), at, sides: [unit(i), unit(j)], others: [i, j] };
}

/** The three triangles of a shaft and a head in a plane: along the way, and across it. */
function corners(middle, way, normal, thick) {
  const size = Math.hypot(...way);
  const side = cross(normal, way).map((x) => (x / size) * thick);
  const head = Math.min(4.2 * thick, 0.6 * size);
  const [tail, base, tip] = [-0.5, 0.5 - head / size, 0.5];
  return [[tail, -0.5], [tail, 0.5], [base, -0.5], [base, -0.5], [tail, 0.5], [base, 0.5], [base, -1.8], [base, 1.8], [tip, 0]]
    .map(([t, s]) => along(along(middle, t, way), s, side));
}

/** Arrows on the plane: corners of triangles, and 1 where the plane's colour is dark. */
function glyphsOf(cut, volume, { speeds, isDark }) {
  const fastest = speeds[1];
  const { half, velocity } = volume;
  const { middle, others: [i, j] } = planeOf(cut, half);
  const normal = [0, 1, 2].map((k) => Number(k === cut.axis));
  const gap = (2 * Math.max(half[i], half[j])) / GLYPHS;
  const out = [];
  const counts = [i, j].map((k) => Math.max(1, Math.round((2 * half[k]) / gap)));
  for (let b = 0; b < counts[1]; ++b)
    for (let a = 0; a < counts[0]; ++a) {
      const place = [...middle];
      place[i] = ((2 * a + 1) / counts[0] - 1) * half[i];
      place[j] = ((2 * b + 1) / counts[1] - 1) * half[j];
      const v = velocityAt(velocity, place);
      if (!v) continue;
      const speed = Math.hypot(v[i], v[j]);
      if (speed < SLOWEST * fastest) continue;
      const way = [0, 0, 0];
      for (const k of [i, j]) way[k] = (v[k] / speed) * LONGEST * gap * Math.min(1, 0.25 + (0.75 * speed) / fastest);
      const dark = cut.shows !== "arrows" && isDark(Math.hypot(...v)) ? 1 : 0;
      for (const corner of corners(place, way, normal, THICK * gap)) out.push(...corner, dark);
    }
  return Float32Array.from(out);
}

export class Cut {
  /** @param {WebGL2RenderingContext} gl @param {any} volume */
  constructor(gl, volume, fastest) {
    Object.assign(this, { gl, volume, fastest });
    this.face = build(gl, faceVertex, faceFragment);
    this.glyphs = build(gl, glyphVertex, glyphFragment);
    const { nodes, samples } = volume.velocity;
    this.velocity = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_3D, this.velocity);
    // in units of the fastest, for halves
    const shares = samples.map((v, n) => (n % 4 === 3 ? v : v / fastest));
    gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA16F, ...nodes, 0, gl.RGBA, gl.FLOAT, shares);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_3D, name, gl.LINEAR);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) gl.texParameteri(gl.TEXTURE_3D, name, gl.CLAMP_TO_EDGE);
    this.empty = gl.createVertexArray();
    this.array = gl.createVertexArray();
    this.buffer = gl.createBuffer();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
  }

  /** @param {any} scene @param {{axis: number, share: number, shows: string}} cut */
  draw(scene, cut) {
    const { gl } = this;
    const plane = planeOf(cut, this.volume.half);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (cut.shows !== "arrows") gl.depthMask(true);
    else gl.depthMask(false);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    this.drawFace(scene, cut, plane);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (cut.shows !== "speed") this.drawGlyphs(scene, cut, plane);
    gl.depthMask(true);
  }

  drawFace(scene, cut, { middle, sides }) {
    const { gl } = this;
    const { program, at } = this.face;
    gl.useProgram(program);
    scene.setUp(at);
    gl.bindVertexArray(this.empty);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, scene.palette);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_3D, this.velocity);
    gl.uniform1i(at("palette"), 0);
    gl.uniform1i(at("velocity"), 1);
    gl.uniform2f(at("speeds"), scene.speeds[0] / this.fastest, scene.speeds[1] / this.fastest);
    gl.uniform3fv(at("half_sides"), this.volume.half);
    gl.uniform3fv(at("middle"), middle);
    gl.uniform3fv(at("along_x"), sides[0]);
    gl.uniform3fv(at("along_y"), sides[1]);
    gl.uniform4fv(at("plain"), cut.shows === "arrows" ? [...scene.shadow, 0.35] : [0, 0, 0, 0]);
    gl.uniform1f(at("opacity"), 0.9);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }

  drawGlyphs(scene, cut, { at: offset }) {
    const { gl } = this;
    const key = [cut.axis, cut.share, cut.shows, scene.theme].join();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    if (this.key !== key) {
      this.key = key;
      this.made = glyphsOf(cut, this.volume, scene);
      gl.bufferData(gl.ARRAY_BUFFER, this.made, gl.DYNAMIC_DRAW);
    }
    const { program, at } = this.glyphs;
    gl.useProgram(program);
    const lifted = Float32Array.from(scene.matrix);
    const lift = Math.sign(scene.eye[cut.axis] - offset) * LIFT;
    for (let k = 0; k < 4; ++k) lifted[12 + k] += lift * scene.matrix[4 * cut.axis + k];
    gl.uniformMatrix4fv(at("view"), false, lifted);
    gl.uniform3fv(at("inks"), [...(cut.shows === "arrows" ? scene.ink : [0.08, 0.09, 0.11]), 1, 1, 1]);
    gl.bindVertexArray(this.array);
    gl.drawArrays(gl.TRIANGLES, 0, this.made.length / 4);
  }
}
