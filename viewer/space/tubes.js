// Solid arrows: a band between each two sections, whose corners the graphics processor makes.
import { build } from "../page/shaders.js";
import { SECTION } from "./frames.js";

const SIDES = 24;
const FEWER_SIDES = 10; // of arrows that move, where drawing is slow
const HALO = 1.6; // pixels of the page's colour round an arrow, so that crossing ones are told apart

const vertex = `
layout(location = 0) in vec4 from_place; // and radius
layout(location = 1) in vec4 from_tangent; // and speed
layout(location = 2) in vec4 from_normal; // and arrow
layout(location = 3) in vec4 to_place;
layout(location = 4) in vec4 to_tangent;
layout(location = 5) in vec4 to_normal;
uniform mat4 view;
uniform vec2 halo; // in the window, from -1 to 1
uniform float sides;
uniform float floor_at; // a shadow's; beyond the box: none
out vec3 place;
out vec3 normal;
out float speed;
flat out float arrow;
void main() {
  bool end = (gl_VertexID & 1) == 1;
  float angle = 6.2831853 * float(gl_VertexID >> 1) / sides;
  vec4 at = end ? to_place : from_place;
  vec3 tangent = end ? to_tangent.xyz : from_tangent.xyz;
  vec3 side = end ? to_normal.xyz : from_normal.xyz;
  vec3 away = cos(angle) * side + sin(angle) * cross(tangent, side);
  place = at.xyz + at.w * away;
  float far = max(dot(to_place.xyz - from_place.xyz, tangent), 0.0);
  float wider = to_place.w - from_place.w;
  vec3 out_of = away * far - tangent * wider;
  normal = dot(out_of, out_of) > 0.0 ? normalize(out_of) : away;
  speed = end ? to_tangent.w : from_tangent.w;
  arrow = from_normal.w;
  if (floor_at > -9.0) place.z = floor_at;
  gl_Position = view * vec4(place, 1.0);
  vec4 shifted = view * vec4(place + 0.001 * normal, 1.0);
  vec2 outwards = shifted.xy / shifted.w - gl_Position.xy / gl_Position.w;
  float size = length(outwards / halo);
  if (halo.x > 0.0 && size > 0.0) gl_Position.xy += outwards / size * gl_Position.w;
  if (from_normal.w != to_normal.w) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

/** What all that is solid has in common: the side of a cut, and the box of a periodic field. */
export const cutting = `
uniform vec4 cut; // a plane's normal and offset; what lies beyond is not seen
uniform vec3 wall; // of the box, half, where it is periodic; else far away
void stay_inside(vec3 place) {
  if (dot(cut.xyz, place) > cut.w || any(greaterThan(abs(place), wall))) discard;
}`;

const fragment = `
precision highp int;
in vec3 place;
in vec3 normal;
in float speed;
flat in float arrow;
uniform sampler2D palette;
uniform vec2 speeds;
uniform vec3 eye;
uniform vec3 up;
uniform vec3 right;
uniform vec3 page;
uniform vec2 fog; // depth where it begins, and how deep it is
uniform vec4 plain; // a colour instead; 0: the palette
uniform float picked;
out vec4 pixel;
${cutting}
void main() {
  stay_inside(place);
  if (plain.a > 0.0) {
    pixel = plain;
    return;
  }
  float share = clamp((speed - speeds.x) / (speeds.y - speeds.x), 0.0, 1.0);
  float wide = float(textureSize(palette, 0).x);
  vec3 color = texture(palette, vec2((share * (wide - 1.0) + 0.5) / wide, 0.5)).rgb;
  vec3 to_eye = normalize(eye - place);
  vec3 n = normalize(normal);
  if (dot(n, to_eye) < 0.0) n = -n;
  vec3 light = normalize(to_eye + 0.55 * up - 0.45 * right);
  float lit = 0.62 + 0.42 * max(dot(n, light), 0.0);
  float shine = 0.16 * pow(max(dot(n, normalize(light + to_eye)), 0.0), 40.0);
  vec3 shown = color * lit + shine;
  if (mod(arrow, 1024.0) == picked) shown = mix(shown, vec3(1.0), 0.25);
  float far = clamp((length(eye - place) - fog.x) / fog.y, 0.0, 1.0);
  pixel = vec4(mix(shown, page, 0.38 * far), 1.0);
}`;

export class Tubes {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.program = build(gl, vertex, fragment);
    this.buffer = gl.createBuffer();
    this.array = gl.createVertexArray();
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    for (let k = 0; k < 6; ++k) {
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, 4, gl.FLOAT, false, 4 * SECTION, 4 * (k < 3 ? 4 * k : SECTION + 4 * (k - 3)));
      gl.vertexAttribDivisor(k, 1);
    }
    this.bands = 0;
  }

  /** @param {Float32Array} sections of frames.js */
  set(sections) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, sections, gl.DYNAMIC_DRAW);
    this.bands = Math.max(sections.length / SECTION - 1, 0);
  }

  /** @param {any} scene what scene.js says of the view and the colours */
  draw(scene) {
    const { gl } = this;
    if (!this.bands) return;
    const { program, at } = this.program;
    gl.useProgram(program);
    scene.setUp(at);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, scene.palette);
    gl.uniform1i(at("palette"), 0);
    gl.uniform2fv(at("speeds"), scene.speeds);
    gl.uniform2fv(at("fog"), scene.fog);
    gl.uniform1f(at("picked"), scene.picked);
    gl.bindVertexArray(this.array);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    const sides = scene.quick ? FEWER_SIDES : SIDES;
    gl.uniform1f(at("sides"), sides);
    const pass = (halo, plain, floor) => {
      gl.uniform2f(at("halo"), halo * (2 / scene.size[0]), halo * (2 / scene.size[1]));
      gl.uniform4fv(at("plain"), plain);
      gl.uniform1f(at("floor_at"), floor);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 2 * (sides + 1), this.bands);
    };
    if (scene.floor !== undefined) pass(0, [...scene.shadow, 1], scene.floor);
    if (!scene.quick) {
      gl.enable(gl.CULL_FACE);
      gl.cullFace(gl.BACK); // bands wind the other way: what is seen of a thicker arrow behind the arrow itself
      pass(HALO, [...scene.page, 1], -10);
      gl.disable(gl.CULL_FACE);
    }
    pass(0, [0, 0, 0, 0], -10);
  }
}
