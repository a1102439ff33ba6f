// A surface of fewer triangles: vertices are merged in cells (Rossignac and Borrel 1993).

const WIDTH = 2.5; // of a cell, in mean edges

function meanEdge({ place, corners }) {
  let sum = 0;
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b] = [3 * corners[t], 3 * corners[t + 1]];
    sum += Math.hypot(place[a] - place[b], place[a + 1] - place[b + 1], place[a + 2] - place[b + 2]);
  }
  return (3 * sum) / (corners.length || 1);
}

/** The cell of each vertex, numbered from 0, and how many there are. */
function cellsOf({ place }, width) {
  const numbers = new Map();
  const cells = new Uint32Array(place.length / 3);
  for (let n = 0; n < cells.length; ++n) {
    const [x, y, z] = [0, 1, 2].map((k) => Math.floor(place[3 * n + k] / width) + 512);
    const key = x + 1024 * (y + 1024 * z);
    if (!numbers.has(key)) numbers.set(key, numbers.size);
    cells[n] = numbers.get(key);
  }
  return { cells, count: numbers.size };
}

/** A mesh of volume.js with some seventh of its triangles: each vertex the mean of those in its cell. */
export function merged(mesh) {
  const { cells, count } = cellsOf(mesh, WIDTH * meanEdge(mesh) || 1);
  const [place, normal, shares] = [new Float32Array(3 * count), new Float32Array(3 * count), new Float32Array(count)];
  cells.forEach((cell, n) => {
    shares[cell] += 1;
    for (let k = 0; k < 3; ++k) {
      place[3 * cell + k] += mesh.place[3 * n + k];
      normal[3 * cell + k] += mesh.normal[3 * n + k];
    }
  });
  for (let n = 0; n < place.length; ++n) place[n] /= shares[Math.floor(n / 3)];
  const corners = [];
  for (let t = 0; t < mesh.corners.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => cells[mesh.corners[t + k]]);
    if (a !== b && b !== c && c !== a) corners.push(a, b, c);
  }
  return { place, normal, corners: Uint32Array.from(corners) };
}
