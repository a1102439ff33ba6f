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

const KEPT = 4; // sets of scales that are remembered

export class Maker {
  /** @param {() => Worker} start @param {WebAssembly.Module} module */
  constructor(start, module, field, { numbers, lengths, told }) {
    this.field = field;
    this.numbers = numbers;
    this.lengths = lengths;
    this.told = told;
    this.sets = new Map();
    [this.runner, this.asked] = [0, 1].map(() => new Client(start(), module));
    this.turn = 0;
  }

  input(box, seed) {
    return { ...part(this.field, box), seed, lengths: this.lengths, effort: "quick" };
  }

  /** The scales of a box (undefined: all) as far as they are made: {scales, done, error}. */
  set(box, seed) {
    const key = JSON.stringify([box ?? null, seed]);
    let set = this.sets.get(key);
    if (!set) {
      set = { box, seed, scales: [], begun: false, done: false, error: undefined };
      this.sets.set(key, set);
      for (const [old, { box: some }] of this.sets)
        if (this.sets.size > KEPT && some && old !== key) this.sets.delete(old);
    }
    return set;
  }

  /** Goes through the scales of a set; those of another are left. */
  async run(set) {
    this.running = set;
    if (set.begun) return;
    set.begun = true;
    try {
      for await (const scale of this.runner.evolve({ ...this.input(set.box, set.seed), numbers: this.numbers })) {
        set.scales.push(scale);
        this.told(set);
        if (this.running !== set && set.box) break;
      }
      set.done = set.scales.length === this.numbers.length;
      set.begun = set.done;
    } catch (error) {
      set.error = error;
    }
    this.told(set);
  }

  /** Exactly n arrows of a box at once; undefined where something newer was asked since. */
  async ask(box, seed, n) {
    const turn = ++this.turn;
    await this.last?.catch(() => {});
    if (turn !== this.turn) return undefined;
    this.last = this.asked.arrows({ ...this.input(box, seed), n });
    const scale = await this.last;
    return turn === this.turn ? scale : undefined;
  }
}
