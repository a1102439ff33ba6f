// What the map shows: a NetCDF file of winds, and coasts.

/** Variables of a file in the classic format of NetCDF, without a record dimension, unpacked. */
export async function readNetcdf(address) {
  const view = new DataView(await (await fetch(address)).arrayBuffer());
  const sizes = [0, 1, 1, 2, 4, 4, 8];
  let at = 8; // after the magic number and the count of records
  const integer = () => view.getInt32((at += 4) - 4);
  const name = () => {
    const length = integer(), begin = at;
    at += Math.ceil(length / 4) * 4;
    return new TextDecoder().decode(view.buffer.slice(begin, begin + length));
  };
  const number = (type, place) => [, () => view.getInt8(place), () => view.getUint8(place), () => view.getInt16(place),
    () => view.getInt32(place), () => view.getFloat32(place), () => view.getFloat64(place)][type]();
  const list = (item) => { integer(); return Array.from({ length: integer() }, item); };
  const attribute = () => {
    const key = name(), type = integer(), count = integer(), first = number(type, at);
    at += Math.ceil(count * sizes[type] / 4) * 4;
    return [key, first];
  };
  const lengths = list(() => (name(), integer()));
  list(attribute); // of the whole file
  return Object.fromEntries(list(() => {
    const key = name(), shape = Array.from({ length: integer() }, () => lengths[integer()]);
    const { scale_factor = 1, add_offset = 0 } = Object.fromEntries(list(attribute));
    const type = integer(), begin = (integer(), integer());
    const count = shape.reduce((product, length) => product * length, 1);
    return [key, Float32Array.from({ length: count }, (_, n) => number(type, begin + n * sizes[type]) * scale_factor + add_offset)];
  }));
}

/** Rings round land: [longitude, latitude] each. data/coast-*.bin, which src/coast/coast.h describes. */
export async function readLand(address) {
  const bytes = new Uint8Array(await (await fetch(address)).arrayBuffer());
  let at = 0;
  const integer = () => {
    let value = 0, shift = 0, byte;
    do value |= ((byte = bytes[at++]) & 127) << shift; while ((shift += 7, byte > 127));
    return value;
  };
  const difference = () => { const code = integer(); return 0.002 * (code % 2 ? -(code + 1) / 2 : code / 2); };
  return Array.from({ length: integer() }, () => {
    let place = [0, 0];
    return Array.from({ length: integer() }, () => (place = place.map((x) => x + difference())));
  });
}
