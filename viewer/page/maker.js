// Makes arrows of the field, or of the part in view, in two workers: one goes through the scales,
// the other answers at once.
import { Client } from "../src/client.js";
import { part } from "./field.js";

/**
 * How many arrows each scale has, from most to fewest, some 28 of them: whole steps to the half, so
 * that a run's 200, 100, 50 and 25 are among them.
 */
export function numbersOf(most, fewest, count = 28) {
  const halvings = Math.log2(most / fewest);
  const steps = Math.max(1, Math.ceil((count - 1) / (halvings || 1)));
  const out = [];
  for (let k = 0; k <= halvings * steps; ++k) {
    const n = Math.round(most * 2 ** (-k / steps));
    if (n > fewest && n !== out[out.length - 1]) out.push(n);
  }
  return [...out, fewest];
}

let named = 0;

// Arrows of clusters get ids of their own; each goes into that of the cluster where it lay.
function follow(before, scale) {
  for (const arrow of scale.arrows) arrow.id = ++named;
  const { nodes, origin, spacing, labels } = scale.density;
  const of = new Map(scale.arrows.map((arrow) => [arrow.cluster, arrow.id]));
  for (const arrow of before?.arrows ?? []) {
    const [i, j] = [0, 1].map((k) => Math.min(Math.max(Math.round((arrow.center[k] - origin[k]) / spacing[k]), 0), nodes[k] - 1));
    arrow.parent = of.get(labels[j * nodes[0] + i]) ?? 0;
  }
}

const KEPT = 4; // sets of scales that are remembered

export class Maker {
  /**
   * @param {{numbers: number[], lengths: string, told: () => void, own?: {arrows: any[], choice: any}}} about
   *   own: a run's arrows, and the choice that they are of
   */
  constructor(field, { numbers, lengths, told, own }) {
    this.field = field;
    this.numbers = numbers;
    this.lengths = lengths;
    this.told = told;
    this.own = own;
    this.sets = new Map();
    this.ready = false;
    this.turn = 0;
  }

  /** @param {() => Worker} worker @param {WebAssembly.Module} module */
  start(worker, module) {
    this.startOne = () => new Client(worker(), module);
    this.runner = this.startOne();
    this.ready = true;
  }

  /** The run's arrows, where they are n of a box and a choice. */
  ownOf(box, choice, n) {
    const { own } = this;
    return !box && own?.arrows.length === n && JSON.stringify(choice) === JSON.stringify(own.choice) ? own.arrows : undefined;
  }

  input(box, choice) {
    return { ...part(this.field, box), ...choice, lengths: this.lengths, effort: "quick" };
  }

  /**
   * The scales of a box (undefined: all) as far as they are made: {scales, done, error}.
   * @param {{kind: string, seed: number, anisotropy: number, coverage: number}} choice
   */
  set(box, choice) {
    const key = JSON.stringify([box ?? null, choice]);
    let set = this.sets.get(key);
    if (!set) {
      const own = this.ownOf(box, choice, this.numbers[0]);
      set = { box, choice: { ...choice }, own, scales: own ? [{ arrows: own }] : [], begun: false, done: false, error: undefined };
      this.sets.set(key, set);
      for (const [old, { box: some }] of this.sets)
        if (this.sets.size > KEPT && some && old !== key) this.sets.delete(old);
    }
    return set;
  }

  /** Goes through the scales of a set; those of another are left. */
  async run(set) {
    this.running = set;
    if (set.begun || !this.ready) return;
    set.begun = true;
    const input = { ...this.input(set.box, set.choice), numbers: this.numbers, first: set.own };
    let made = 0;
    try {
      for await (const scale of this.runner.evolve(input)) {
        if (set.choice.kind === "clusters") follow(set.scales[made - 1], scale);
        if (set.own && !made) scale.arrows = set.own; // the same objects
        set.scales[made++] = scale;
        this.told(set);
        if (this.running !== set && set.box) break;
      }
      set.done = made === this.numbers.length;
      set.begun = set.done;
    } catch (error) {
      set.error = error;
    }
    this.told(set);
  }

  /** Exactly n arrows of a box at once; undefined where something newer was asked since. */
  async ask(box, choice, n) {
    const turn = ++this.turn;
    await this.last?.catch(() => {});
    if (turn !== this.turn) return undefined;
    const first = this.ownOf(box, choice, n);
    this.asked ??= this.startOne();
    this.last = this.asked.arrows({ ...this.input(box, choice), n, first });
    const scale = await this.last;
    if (first) scale.arrows = first;
    return turn === this.turn ? scale : undefined;
  }
}
