// Fields for the tests, on axes from 0 to 1.

function make(width, height, velocity) {
  const u = new Float32Array(width * height);
  const v = new Float32Array(width * height);
  for (let n = 0; n < u.length; ++n)
    [u[n], v[n]] = velocity((n % width) / (width - 1), Math.floor(n / width) / (height - 1));
  const axis = (count) => Float64Array.from({ length: count }, (_, k) => k / (count - 1));
  return { u, v, width, height, x: axis(width), y: axis(height) };
}

// Vortices that turn against each other in a stream: [x, y, strength].
const swirl = (vortices) => (x, y) => {
  let [u, v] = [0.15, 0.05];
  for (const [cx, cy, strength] of vortices) {
    const turn = (0.1 * strength) / (0.02 + (x - cx) ** 2 + (y - cy) ** 2);
    u -= turn * (y - cy);
    v += turn * (x - cx);
  }
  return [u, v];
};

const three = [[0.25, 0.3, 1], [0.72, 0.6, -1.3], [0.35, 0.8, 0.7]];

export const vortices = (nodes) => make(nodes, nodes, swirl(three));

/** Broad, with a hole. */
export const holed = () =>
  make(73, 49, (x, y) => ((x - 0.6) ** 2 + (y - 0.4) ** 2 < 0.02 ? [NaN, NaN] : swirl(three)(x, y)));

/** Rather a jet with waves. */
export const jet = () => make(65, 65, (x, y) => [1 - 2 * Math.abs(y - 0.5), 0.4 * Math.sin(9 * x)]);

/** An archive of NumPy: u, v, x, y. */
export function toNpz({ u, v, x, y, width, height }) {
  const parts = [
    ["u", "<f4", u, [height, width]],
    ["v", "<f4", v, [height, width]],
    ["x", "<f8", x, [width]],
    ["y", "<f8", y, [height]],
  ].map(([name, type, array, shape]) => [name, npy(type, array, shape)]);
  return zip(parts);
}

function npy(type, array, shape) {
  const words = `{'descr': '${type}', 'fortran_order': False, 'shape': (${shape.join(", ")},), }`;
  const header = Buffer.from(words.padEnd(117) + "\n", "latin1");
  const start = Buffer.from([0x93, 0x4e, 0x55, 0x4d, 0x50, 0x59, 1, 0, header.length, 0]);
  return Buffer.concat([start, header, Buffer.from(array.buffer, array.byteOffset, array.byteLength)]);
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = (crc >>> 1) ^ (0xedb88320 & -(crc & 1));
  }
  return ~crc >>> 0;
}

// An archive without compression.
function zip(parts) {
  const files = [];
  const directory = [];
  let offset = 0;
  for (const [name, bytes] of parts) {
    const file = Buffer.from(`${name}.npy`);
    const about = Buffer.alloc(26);
    about.writeUInt16LE(20, 0);
    about.writeUInt32LE(crc32(bytes), 10);
    about.writeUInt32LE(bytes.length, 14);
    about.writeUInt32LE(bytes.length, 18);
    about.writeUInt16LE(file.length, 22);
    files.push(Buffer.from("PK\x03\x04", "latin1"), about, file, bytes);
    const entry = Buffer.alloc(16);
    entry.writeUInt32LE(offset, 12);
    directory.push(Buffer.from("PK\x01\x02\x14\x00", "latin1"), about, entry.subarray(2), file);
    offset += 30 + file.length + bytes.length;
  }
  const list = Buffer.concat(directory);
  const end = Buffer.alloc(22);
  end.write("PK\x05\x06", "latin1");
  end.writeUInt16LE(parts.length, 8);
  end.writeUInt16LE(parts.length, 10);
  end.writeUInt32LE(list.length, 12);
  end.writeUInt32LE(offset, 16);
  return Buffer.concat([...files, list, end]);
}
