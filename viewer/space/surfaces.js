// Transparent surfaces, seen most where they are seen from the side.
import { build } from "../page/shaders.js";
import { merged } from "./merge.js";
import { cutting } from "./tubes.js";

const vertex = `
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 outwards;
uniform mat4 view;
uniform vec3 eye;
uniform vec2 opacity; // seen from the front and from the side
out vec3 place;
out float share;
void main() {
  place = at;
  float facing = abs(dot(normalize(eye - place), normalize(outwards)));
  share = mix(opacity.y, opacity.x, pow(facing, 0.6));
  gl_Position = view * vec4(at, 1.0);
}`;

const fragment = `
in vec3 place;
in float share;
uniform vec3 color;
out vec4 pixel;
${cutting}
void main() {
  stay_inside(place);
  pixel = vec4(color * share, share);
}`;

export class Surfaces {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.program = build(gl, vertex, fragment);
    this.made = new Map(); // buffers of a mesh
  }

  buffersOf(mesh) {
    const { gl } = this;
    let made = this.made.get(mesh);
    if (made) return made;
    made = { array: gl.createVertexArray(), count: mesh.corners.length };
    gl.bindVertexArray(made.array);
    [mesh.place, mesh.normal].forEach((values, k) => {
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, 3, gl.FLOAT, false, 0, 0);
    });
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, mesh.corners, gl.STATIC_DRAW);
    this.made.set(mesh, made);
    return made;
  }

  /** @param {any} scene @param {{mesh: any, color: number[], opacity: number[]}[]} layers */
  draw(scene, layers) {
    if (!layers.length) return;
    const { gl } = this;
    const { program, at } = this.program;
    const meshes = layers.map(({ mesh }) => this.buffersOf(scene.isCoarse ? mesh.merged ??= merged(mesh) : mesh));
    gl.useProgram(program);
    scene.setUp(at);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.depthMask(false);
    if (!scene.isCoarse) gl.enable(gl.CULL_FACE);
    for (const side of scene.isCoarse ? [gl.FRONT] : [gl.FRONT, gl.BACK]) { // what is behind first, unless there is no time
      gl.cullFace(side);
      layers.forEach(({ color, opacity }, k) => {
        gl.uniform3fv(at("color"), color);
        gl.uniform2fv(at("opacity"), opacity);
        gl.bindVertexArray(meshes[k].array);
        gl.drawElements(gl.TRIANGLES, meshes[k].count, gl.UNSIGNED_INT, 0);
      });
    }
    gl.disable(gl.CULL_FACE);
    gl.depthMask(true);
  }
}
