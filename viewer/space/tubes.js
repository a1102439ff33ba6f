// Solid arrows: a band between each two sections, whose corners the graphics processor makes. Where it
// draws slowly, arrows that move are ribbons that face the viewer, shaded as round. Sections are read
// from a texture and not as instances: drawing without a graphics processor takes a call for each of those.
import { build } from "../page/shaders.js";
import { COARSE, FINE, layOut, SECTION } from "./frames.js";

const FEWEST_SIDES = 8;
const MOST_SIDES = 24;
const SHADOW_SIDES = 8;
const FLAT = 0.25; // pixels between a circle and its sides
const HALO = 1.6; // pixels of the page's colour round an arrow, so that crossing ones are told apart
const TEXELS = SECTION / 4;
const ROW = 256; // sections in a row of the texture

const reading = `
uniform highp sampler2D sections;
uniform mat4 view;
uniform float floor_at; // a shadow's; beyond the box: none
out vec3 place;
out vec3 normal;
out float speed;
flat out float arrow;
vec4 section(int n, int part) {
  return texelFetch(sections, ivec2(${TEXELS} * (n % ${ROW}) + part, n / ${ROW}), 0);
}
void stand_at(vec3 at) {
  place = floor_at > -9.0 ? vec3(at.xy, floor_at) : at;
  gl_Position = view * vec4(place, 1.0);
}`;

// A band's first and last corner are there twice, so that nothing is drawn from band to band.
const tubeVertex = `${reading}
uniform vec2 halo; // in the window, from -1 to 1
uniform int sides;
void main() {
  int corners = 2 * sides + 4;
  int band = gl_VertexID / corners;
  int corner = clamp(gl_VertexID - corners * band - 1, 0, corners - 3);
  bool end = (corner & 1) == 1;
  int own = end ? band + 1 : band;
  float angle = 6.2831853 * float(corner >> 1) / float(sides);
  vec4 from = section(band, 0), to = section(band + 1, 0), at = end ? to : from;
  vec4 along = section(own, 1), across = section(own, 2);
  vec3 away = cos(angle) * across.xyz + sin(angle) * cross(along.xyz, across.xyz);
  float far = max(dot(to.xyz - from.xyz, along.xyz), 0.0);
  vec3 out_of = away * far - along.xyz * (to.w - from.w);
  normal = dot(out_of, out_of) > 0.0 ? normalize(out_of) : away;
  speed = along.w;
  arrow = across.w;
  stand_at(at.xyz + at.w * away);
  if (halo.x > 0.0) {
    vec4 shifted = view * vec4(place + 0.001 * normal, 1.0);
    vec2 outwards = shifted.xy / shifted.w - gl_Position.xy / gl_Position.w;
    float size = length(outwards / halo);
    if (size > 0.0) gl_Position.xy += outwards / size * gl_Position.w;
  }
  if (section(band, 2).w != section(band + 1, 2).w) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

// Arrows begin and end in points: nothing is drawn from one to the next.
const ribbonVertex = `${reading}
uniform vec3 eye;
uniform vec3 right;
void main() {
  vec4 at = section(gl_VertexID >> 1, 0), along = section(gl_VertexID >> 1, 1);
  vec3 to_eye = floor_at > -9.0 ? vec3(0.0, 0.0, 1.0) : normalize(eye - at.xyz);
  vec3 across = cross(along.xyz, to_eye);
  float size = length(across);
  vec3 away = size > 0.001 ? across / size : right;
  if ((gl_VertexID & 1) == 1) away = -away;
  normal = away + 0.6 * to_eye;
  speed = along.w;
  arrow = section(gl_VertexID >> 1, 2).w;
  stand_at(at.xyz + at.w * away);
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
    this.tube = build(gl, tubeVertex, fragment);
    this.ribbon = build(gl, ribbonVertex, fragment);
    this.none = gl.createVertexArray(); // there are no attributes
    this.sections = gl.createTexture();
    this.numbers = new Float32Array(0); // of the texture
    this.count = 0;
  }

  /** Arrows as FINE or COARSE sections, unless they are there. */
  set(arrows, { half, period }, detail) {
    if (this.arrows === arrows && this.detail === detail) return;
    Object.assign(this, { arrows, detail, widest: Math.max(0, ...arrows.map(({ headWidth }) => headWidth)) });
    const parts = layOut(arrows, half, period, detail);
    const length = parts.reduce((sum, part) => sum + part.length, 0);
    this.count = length / SECTION;
    if (!length) return;
    if (length > this.numbers.length) this.grow(length);
    let at = 0;
    for (const part of parts) {
      this.numbers.set(part, at);
      at += part.length;
    }
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.sections);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, TEXELS * ROW, Math.ceil(this.count / ROW), gl.RGBA, gl.FLOAT, this.numbers);
  }

  grow(length) {
    const { gl } = this;
    const rows = Math.ceil((1.5 * length) / (SECTION * ROW));
    this.numbers = new Float32Array(SECTION * ROW * rows);
    gl.bindTexture(gl.TEXTURE_2D, this.sections);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, TEXELS * ROW, rows, 0, gl.RGBA, gl.FLOAT, null);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  }

  /** So many that the arrows look round. @param {number} scale pixels of the canvas in a unit */
  sidesAt(scale) {
    const radius = Math.max((scale * this.widest) / 2, 1);
    return Math.min(Math.max(Math.ceil(Math.PI / Math.acos(1 - FLAT / radius)), FEWEST_SIDES), MOST_SIDES);
  }

  /** @param {any} scene what scene.js says of the view and the colours */
  draw(scene) {
    const { gl } = this;
    if (!this.count) return;
    const isFine = this.detail === FINE;
    const { at } = this.begin(isFine ? this.tube : this.ribbon, scene);
    const sides = this.sidesAt(scene.scale);
    const pass = (sides, plain, floor, halo = 0) => {
      gl.uniform4fv(at("plain"), plain);
      gl.uniform1f(at("floor_at"), floor);
      if (!isFine) return gl.drawArrays(gl.TRIANGLE_STRIP, 0, 2 * this.count);
      gl.uniform2f(at("halo"), halo * (2 / scene.size[0]), halo * (2 / scene.size[1]));
      gl.uniform1i(at("sides"), sides);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, (2 * sides + 4) * (this.count - 1));
    };
    if (isFine && scene.isClosed) this.seeOnly(gl.FRONT);
    if (scene.floor !== undefined) pass(SHADOW_SIDES, [...scene.shadow, 1], scene.floor);
    pass(sides, [0, 0, 0, 0], -10);
    if (isFine) {
      this.seeOnly(gl.BACK); // what is seen of a thicker arrow behind the arrow itself
      pass(sides, [...scene.page, 1], -10, HALO);
    }
    gl.disable(gl.CULL_FACE);
  }

  /** One side of each face, FRONT for what is seen from outside. */
  seeOnly(side) {
    const { gl } = this;
    gl.enable(gl.CULL_FACE);
    gl.cullFace(side === gl.FRONT ? gl.BACK : gl.FRONT);
  }

  begin(built, scene) {
    const { gl } = this;
    const { program, at } = built;
    gl.useProgram(program);
    scene.setUp(at);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.sections);
    gl.uniform1i(at("sections"), 1);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, scene.palette);
    gl.uniform1i(at("palette"), 0);
    gl.uniform2fv(at("speeds"), scene.speeds);
    gl.uniform2fv(at("fog"), scene.fog);
    gl.uniform1f(at("picked"), scene.picked);
    gl.bindVertexArray(this.none);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    return built;
  }
}
