// A viewer at some distance who goes round the field's box and looks at it: a central projection.

const DISTANCE = 5; // in half diagonals of the box, as in the program's pictures
const FILLED = 0.93; // of the window
const MOST_ZOOM = 60;
const DEGREE = Math.PI / 180;
const TURN = 0.35; // degrees a pixel

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const along = (a, t, b) => [a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]];

export class Camera {
  /** @param {number[]} half of the box's sides @param {number[]} view azimuth and elevation, degrees */
  constructor(half, view) {
    this.half = half;
    this.radius = Math.hypot(...half);
    this.first = view;
    this.size = [1, 1];
    this.reset();
  }

  reset() {
    [this.azimuth, this.elevation] = this.first;
    this.zoom = 1;
    this.target = [0, 0, 0];
    this.settle();
  }

  /** Pixels in a unit at the target. */
  get scale() {
    const [w, h] = this.size;
    const wide = Math.hypot(this.half[0], this.half[1]);
    const tilt = Math.abs(this.first[1]) * DEGREE;
    const high = this.half[2] * Math.cos(tilt) + wide * Math.sin(tilt);
    return (this.zoom * FILLED * Math.min(w / wide, h / high)) / 2;
  }

  settle() {
    const [a, e] = [this.azimuth * DEGREE, this.elevation * DEGREE];
    this.right = [Math.cos(a), Math.sin(a), 0];
    this.forward = [-Math.sin(a) * Math.cos(e), Math.cos(a) * Math.cos(e), -Math.sin(e)];
    this.up = cross(this.right, this.forward);
    this.distance = DISTANCE * this.radius;
    this.eye = along(this.target, -this.distance, this.forward);
  }

  /** Where a point is seen, in pixels, and how far before the viewer. */
  project(point) {
    const to = along(point, -1, this.eye);
    const depth = dot(to, this.forward);
    const factor = (this.scale * this.distance) / depth;
    return [this.size[0] / 2 + factor * dot(to, this.right), this.size[1] / 2 - factor * dot(to, this.up), depth];
  }

  /** The direction of the ray through a pixel, of length 1 along `forward`. */
  ray(px, py) {
    const factor = this.scale * this.distance;
    return along(along(this.forward, (px - this.size[0] / 2) / factor, this.right), (this.size[1] / 2 - py) / factor, this.up);
  }

  /** For WebGL: columns of the matrix from the view box to the window. */
  get matrix() {
    const [w, h] = this.size;
    const factor = this.scale * this.distance;
    const reach = this.radius + Math.hypot(...this.target) + 0.5;
    const near = Math.max(this.distance - reach, 0.02 * this.distance);
    const far = this.distance + reach;
    const rows = [
      [...this.right.map((x) => (2 * factor * x) / w), (-2 * factor * dot(this.right, this.eye)) / w],
      [...this.up.map((x) => (2 * factor * x) / h), (-2 * factor * dot(this.up, this.eye)) / h],
      [0, 0, 0, 0],
      [...this.forward, -dot(this.forward, this.eye)],
    ];
    const [a, b] = [(far + near) / (far - near), (-2 * far * near) / (far - near)];
    rows[2] = rows[3].map((x, k) => a * x + (k === 3 ? b : 0));
    return Float32Array.from({ length: 16 }, (_, n) => rows[n % 4][n >> 2]);
  }

  zoomAt(px, py, factor) {
    const before = this.scale;
    this.zoom = Math.min(Math.max(this.zoom * factor, 0.4), MOST_ZOOM);
    const shift = 1 / before - 1 / this.scale; // what is at the pixel stays there
    this.slide((px - this.size[0] / 2) * shift, (this.size[1] / 2 - py) * shift);
  }

  slide(right, up) {
    this.target = along(along(this.target, right, this.right), up, this.up)
      .map((x, k) => Math.min(Math.max(x, -this.half[k]), this.half[k]));
    this.settle();
  }

  /** Goes round; or, where it `slides`, moves what is looked at. */
  pan(dx, dy, slides) {
    if (slides) return this.slide(-dx / this.scale, dy / this.scale);
    this.azimuth = (((this.azimuth - TURN * dx) % 360) + 360) % 360;
    this.elevation = Math.min(Math.max(this.elevation + TURN * dy, -89.9), 89.9);
    this.settle();
  }

  /** Whether the inside of the box's side at half[axis] * side is seen. */
  seesInside(axis, side) {
    return this.eye[axis] * side < this.half[axis];
  }
}
