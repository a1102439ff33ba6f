// The WebAssembly core and what of its memory JavaScript reads and writes.

// columns of the table of arrows, as core/shim.c fills it
const COLUMNS = 18;
const KINDS = ["arrow", "ring", "spiral"];
const FACTS = 14;
const STATUS_MEMORY = 1;

/** What was refused or could not be done, in the library's words. */
export class FlowgrainError extends Error {
  /** @param {string} message @param {string} [hint] what to do about it */
  constructor(message, hint = "") {
    super(hint ? `${message}\n${hint}` : message);
    this.name = "FlowgrainError";
    this.hint = hint;
  }
}

// Of the system the core needs a clock; what it would print goes nowhere.
function system(memory) {
  const nothing = () => 0;
  return {
    clock_time_get(_clock, _precision, out) {
      const now = BigInt(Math.round(performance.now() * 1e6));
      new DataView(memory().buffer).setBigUint64(out, now, true);
      return 0;
    },
    fd_close: nothing,
    fd_seek: nothing,
    fd_write(_file, parts, count, out) {
      const view = new DataView(memory().buffer);
      let bytes = 0;
      for (let n = 0; n < count; ++n) bytes += view.getUint32(parts + 8 * n + 4, true);
      view.setUint32(out, bytes, true);
      return 0;
    },
  };
}

/** A core with a memory of its own. */
export class Core {
  /** @param {WebAssembly.Module} module */
  static async create(module) {
    const core = new Core();
    const instance = await WebAssembly.instantiate(module, {
      wasi_snapshot_preview1: system(() => core.calls.memory),
    });
    core.calls = /** @type {any} */ (instance.exports);
    core.calls._initialize();
    return core;
  }

  /** The version of the library, "0.1.0". */
  get version() {
    return this.text(this.calls.version());
  }

  /** Bytes that the memory has grown to. */
  get bytes() {
    return this.calls.memory.buffer.byteLength;
  }

  text(address) {
    const bytes = new Uint8Array(this.calls.memory.buffer);
    return new TextDecoder().decode(bytes.slice(address, bytes.indexOf(0, address)));
  }

  // Copies of arrays of the core: a view would be void as soon as its memory grows.
  copy(Kind, address, length) {
    return new Kind(this.calls.memory.buffer, address, length).slice();
  }

  /**
   * One scale after another, from many arrows to few. What the core holds for them is freed
   * when the iterator ends, is left, or fails.
   * @param {import("./options.js").Plan} plan
   */
  *scales(plan) {
    const taken = [];
    const pass = (array) => {
      if (!array) return 0;
      const address = this.calls.take(array.byteLength);
      if (!address) throw new FlowgrainError(`no memory for ${array.byteLength} bytes`);
      taken.push(address);
      new array.constructor(this.calls.memory.buffer, address, array.length).set(array);
      return address;
    };
    const giveBack = () => taken.splice(0).forEach((address) => this.calls.give(address));
    const scales = this.calls.scales_create();
    try {
      if (!scales) throw new FlowgrainError("no memory");
      const { calls } = this;
      const addresses = [plan.x, plan.y, plan.u, plan.v, plan.valid].map(pass);
      const numbers = pass(Int32Array.from(plan.numbers));
      if (plan.first) this.check(scales, calls.scales_give_first(scales, pass(plan.first), plan.numbers[0]));
      const has = pass(new Int32Array(1));
      const facts = pass(new Float64Array(16));
      this.check(scales, calls.scales_open(scales, plan.width, plan.height, ...addresses,
        ...plan.period, plan.degrees, numbers, plan.numbers.length, plan.clusters, plan.even,
        plan.effort, plan.fair, plan.nodes, plan.seed, plan.anisotropy, plan.coverage));
      for (;;) {
        this.check(scales, calls.scales_next(scales, has));
        if (!this.copy(Int32Array, has, 1)[0]) return;
        if (plan.regions) this.check(scales, calls.scales_find_regions(scales));
        yield this.read(scales, facts);
      }
    } finally {
      giveBack();
      this.calls.scales_close(scales);
    }
  }

  check(scales, status) {
    if (!status) return;
    const { calls } = this;
    const message = this.text(calls.scales_message(scales));
    if (status === STATUS_MEMORY && !message) throw new FlowgrainError("no memory");
    throw new FlowgrainError(message || `failure ${status}`, this.text(calls.scales_hint(scales)));
  }

  read(scales, address) {
    const { calls } = this;
    calls.scales_facts(scales, address);
    const [count, clusters, dropped, least, most, time, step, parents, nodesX, nodesY, ...place] =
      this.copy(Float64Array, address, FACTS);
    const [originX, originY, spacingX, spacingY] = place;
    const scale = {
      arrows: this.readArrows(scales, count),
      counts: { arrows: count, clusters, dropped },
      speedRange: [least, most],
      time,
      step,
      parents: Array.from(this.copy(Int32Array, calls.scales_parents(scales), parents)),
      density: undefined,
    };
    if (nodesX) {
      scale.density = {
        nodes: [nodesX, nodesY],
        origin: [originX, originY],
        spacing: [spacingX, spacingY],
        u: this.copy(Float32Array, calls.scales_density(scales), nodesX * nodesY),
        labels: this.copy(Int32Array, calls.scales_labels(scales), nodesX * nodesY),
      };
    }
    return scale;
  }

  readArrows(scales, count) {
    const { calls } = this;
    const rows = this.copy(Float64Array, calls.scales_rows(scales), count * COLUMNS);
    let points = calls.scales_points(scales);
    let vertices = calls.scales_vertices(scales);
    return Array.from({ length: count }, (_, n) => {
      const [kind, cluster, id, parent, area, speed, width, tailWidth, headLength, headWidth, x, y,
        seedX, seedY, back, on, pointCount, vertexCount] = rows.subarray(n * COLUMNS, (n + 1) * COLUMNS);
      const path = this.copy(Float64Array, points, 2 * pointCount);
      const outline = this.copy(Float64Array, vertices, 2 * vertexCount);
      points += path.byteLength;
      vertices += outline.byteLength;
      return { path, outline, kind: KINDS[kind], cluster, id, parent, area, speed, width, tailWidth,
        headLength, headWidth, center: [x, y], seed: [seedX, seedY], way: [back, on] };
    });
  }
}
