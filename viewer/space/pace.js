// Whether a picture that moves is drawn coarsely: where a fine frame takes long, as without a graphics
// processor.

const SLOW = 40; // milliseconds of a fine frame
const LONGEST = 200; // that are counted: what takes longer has another reason, too
const REST = 250; // milliseconds without motion: it rests
const SOON = 20; // milliseconds until a fine frame follows the first one

export class Pace {
  /** @param {() => void} redraw */
  constructor(redraw) {
    this.redraw = redraw;
    this.frames = 0;
    this.mean = 0; // milliseconds of fine frames, the last ones most
    this.timer = 0;
  }

  /** Before the first frame, which is coarse: it is there at once. */
  start() {
    this.restAfter(SOON);
  }

  /** The picture moves. */
  move() {
    if (this.isCoarse || this.mean >= SLOW) this.restAfter(REST);
  }

  restAfter(milliseconds) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.redraw();
    }, milliseconds);
  }

  get isCoarse() {
    return this.timer !== 0;
  }

  /** When an animation frame draws finely: it takes until the browser is ready for the next one. */
  measure() {
    const begin = performance.now();
    requestAnimationFrame(() => this.count(Math.min(performance.now() - begin, LONGEST)));
  }

  // The first frame builds the programs, too, and tells only until there is another.
  count(took) {
    this.frames += 1;
    this.mean = this.frames > 2 ? (this.mean + took) / 2 : took;
  }
}
