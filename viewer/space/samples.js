// A picture of several samples a pixel, which then go to the canvas. A canvas made with antialiasing
// has them always, and where there is no graphics processor a picture that moves has no time for them.

const SAMPLES = 4;

export class Samples {
  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.gl = gl;
    this.frame = gl.createFramebuffer();
    this.buffers = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    this.size = [0, 0];
  }

  /** What is drawn from here on has samples, of a canvas of that size. */
  begin(size) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.frame);
    if (size.every((length, k) => length === this.size[k])) return;
    this.size = size;
    const count = Math.min(SAMPLES, gl.getParameter(gl.MAX_SAMPLES));
    [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]].forEach(([format, place], k) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, this.buffers[k]);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, count, format, ...size);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, this.buffers[k]);
    });
  }

  /** The means of pixels go to the canvas. */
  end() {
    const { gl } = this;
    const [w, h] = this.size;
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    gl.blitFramebuffer(0, 0, w, h, 0, 0, w, h, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.invalidateFramebuffer(gl.READ_FRAMEBUFFER, [gl.COLOR_ATTACHMENT0, gl.DEPTH_ATTACHMENT]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }
}
