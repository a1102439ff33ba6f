// What the program packs: whole numbers, as differences in planes of bytes, deflated.
import { bytes } from "../page/field.js";

/** @returns {Promise<Int32Array>} */
export async function unpack(text) {
  const stream = new Blob([bytes(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = planes.length / 4;
  const out = new Int32Array(count);
  for (let n = 0, value = 0; n < count; ++n) {
    const zigzag = planes[n] | (planes[count + n] << 8) | (planes[2 * count + n] << 16) | (planes[3 * count + n] << 24);
    value = (value + ((zigzag >>> 1) ^ -(zigzag & 1))) | 0;
    out[n] = value;
  }
  return out;
}

const AXES = ["x", "y", "z"];

/** The components x, y, z of something packed. */
export function unpackAxes(packed) {
  return Promise.all(AXES.map((name) => unpack(packed[name])));
}
