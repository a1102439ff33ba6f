// Programs for the graphics processor (WebGL2).

/** A WebGL2 context of a canvas; undefined where the browser has none. */
export function graphics(canvas, antialias = true) {
  return canvas.getContext("webgl2", { alpha: true, premultipliedAlpha: true, antialias }) ?? undefined;
}

/** @param {WebGL2RenderingContext} gl */
export function build(gl, vertex, fragment) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${text}`);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(gl.getProgramInfoLog(program) ?? "a shader");
  const places = new Map();
  const at = (name) => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
    return places.get(name);
  };
  return { program, at };
}

/** "#rrggbb" as three parts from 0 to 1. */
export function parts(color) {
  return [1, 3, 5].map((k) => parseInt(color.slice(k, k + 2), 16) / 255);
}
