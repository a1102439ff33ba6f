// Which part of the plane the picture shows, and how pointers and keys change that.

const MOST_ZOOM = 400;

export class View {
  /** @param {number[]} box what there is to see: west, south, east, north */
  constructor(box) {
    this.box = box;
    this.size = [1, 1];
    this.reset();
  }

  reset() {
    this.center = [(this.box[0] + this.box[2]) / 2, (this.box[1] + this.box[3]) / 2];
    this.zoom = 1;
  }

  /** Pixels in a unit of the plane. */
  get scale() {
    const [w, h] = this.size;
    return this.zoom * Math.min(w / (this.box[2] - this.box[0]), h / (this.box[3] - this.box[1]));
  }

  toScreen(x, y) {
    return [this.size[0] / 2 + (x - this.center[0]) * this.scale, this.size[1] / 2 - (y - this.center[1]) * this.scale];
  }

  toPlane(px, py) {
    return [this.center[0] + (px - this.size[0] / 2) / this.scale, this.center[1] - (py - this.size[1] / 2) / this.scale];
  }

  /** The part of the field that is seen; undefined: all of it. */
  get part() {
    const [west, north] = this.toPlane(0, 0);
    const [east, south] = this.toPlane(...this.size);
    const { box } = this;
    const seen = [Math.max(west, box[0]), Math.max(south, box[1]), Math.min(east, box[2]), Math.min(north, box[3])];
    const slack = 1e-6 * (box[2] - box[0] + box[3] - box[1]);
    return seen.every((place, k) => Math.abs(place - box[k]) <= slack) ? undefined : seen;
  }

  zoomAt(px, py, factor) {
    const [x, y] = this.toPlane(px, py);
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), MOST_ZOOM);
    this.center = [x - (px - this.size[0] / 2) / this.scale, y + (py - this.size[1] / 2) / this.scale];
    this.settle();
  }

  pan(dx, dy) {
    this.center = [this.center[0] - dx / this.scale, this.center[1] + dy / this.scale];
    this.settle();
  }

  // The window stays on the field, as far as it is smaller than that.
  settle() {
    for (let k = 0; k < 2; ++k) {
      const [low, high] = [this.box[k], this.box[k + 2]];
      const half = this.size[k] / this.scale / 2;
      const middle = (low + high) / 2;
      this.center[k] = 2 * half >= high - low ? middle : Math.min(Math.max(this.center[k], low + half), high - half);
    }
  }
}

/**
 * Lets pointers, the wheel and keys on an element change a view: its zoomAt, pan and reset. What
 * `grab` returns gets the steps of a pointer from there, in place of the view.
 * @param {{changed: () => void, hovered: (at?: number[]) => void, key: (key: string) => boolean,
 *   grab?: (at: number[]) => ((at: number[]) => void) | undefined}} told
 */
export function control(element, view, told) {
  const held = new Map();
  let drag; // of what was grabbed
  const at = (event) => {
    const box = element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const spread = () => {
    const [a, b] = [...held.values()];
    return { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.hypot(a[0] - b[0], a[1] - b[1]) };
  };
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    held.set(event.pointerId, at(event));
    drag = held.size === 1 ? told.grab?.(at(event)) : undefined;
    told.hovered(at(event));
  });
  element.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return told.hovered(at(event));
    const old = held.size === 2 ? spread() : undefined;
    held.set(event.pointerId, at(event));
    if (drag) return drag(at(event));
    const slides = old !== undefined || event.shiftKey || event.buttons > 1;
    if (old) {
      const now = spread();
      view.zoomAt(...now.middle, now.apart / (old.apart || 1));
      view.pan(now.middle[0] - old.middle[0], now.middle[1] - old.middle[1], slides);
    } else if (held.size === 1) {
      const now = at(event);
      view.pan(now[0] - before[0], now[1] - before[1], slides);
    }
    told.changed();
  });
  for (const end of ["pointerup", "pointercancel"])
    element.addEventListener(end, (event) => {
      held.delete(event.pointerId);
      drag = undefined;
    });
  element.addEventListener("pointerleave", () => told.hovered());
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoomAt(...at(event), 2 ** (-event.deltaY / (event.deltaMode ? 8 : 300)));
    told.changed();
  }, { passive: false });
  element.addEventListener("dblclick", (event) => {
    view.zoomAt(...at(event), event.shiftKey ? 0.5 : 2);
    told.changed();
  });
  const step = 60;
  const moves = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const middle = [view.size[0] / 2, view.size[1] / 2];
    if (moves[event.key]) view.pan(moves[event.key][0], moves[event.key][1], event.shiftKey);
    else if (event.key === "+" || event.key === "=") view.zoomAt(...middle, 1.5);
    else if (event.key === "-") view.zoomAt(...middle, 1 / 1.5);
    else if (event.key === "0") view.reset();
    else {
      if (told.key(event.key)) event.preventDefault();
      return;
    }
    event.preventDefault();
    told.changed();
  });
}
