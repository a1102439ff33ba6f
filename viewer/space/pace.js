// Whether a picture that moves is drawn coarsely: where a fine frame takes long, as without a graphics
// processor.

const SLOW = 40; // milliseconds of a fine frame
const LONGEST = 200; // that are counted: what takes longer has another reason, too
const REST = 250; // milliseconds without motion: it rests

export class Pace {
  /** @param {() => void} redraw */
  constructor(redraw) {
    this.redraw = redraw;
    this.frames = 0;
    this.mean = 0; // milliseconds of fine frames, the last ones most
    this.timer = 0;
  }

  /** The picture moves. */
  move() {
    if (!this.isCoarse && this.mean < SLOW) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.redraw();
    }, REST);
  }

  get isCoarse() {
    return this.timer !== 0;
  }

  /** When a fine frame begins: it takes until the browser is ready for the next one. */
  measure() {
    const begin = performance.now();
    requestAnimationFrame(() => this.count(Math.min(performance.now() - begin, LONGEST)));
  }

  // The first frame builds the programs, too; where that is slow, another one tells.
  count(took) {
    this.frames += 1;
    if (this.frames === 1 && took >= SLOW) this.redraw();
    else this.mean = this.frames > 2 ? (this.mean + took) / 2 : took;
  }
}
