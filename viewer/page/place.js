// Longitudes and latitudes of places on a map's plane, from directions at the nodes of a raster.

/** @param {{nodes: number[], low: number[], high: number[], directions: Float32Array} | undefined} table */
export function locator(table, isDegrees) {
  if (isDegrees) return (x, y) => [x - 360 * Math.round(x / 360), y];
  if (!table) return () => undefined;
  const { nodes: [width, height], low, high, directions } = table;
  return (x, y) => {
    const place = [((x - low[0]) / (high[0] - low[0])) * (width - 1), ((y - low[1]) / (high[1] - low[1])) * (height - 1)];
    const [i, j] = [Math.min(Math.floor(place[0]), width - 2), Math.min(Math.floor(place[1]), height - 2)];
    if (!(i >= 0 && j >= 0)) return undefined;
    const [a, b] = [place[0] - i, place[1] - j];
    const at = [0, 1, 2].map((k) => {
      const d = (di, dj) => directions[3 * ((j + dj) * width + i + di) + k];
      return (d(0, 0) * (1 - a) + d(1, 0) * a) * (1 - b) + (d(0, 1) * (1 - a) + d(1, 1) * a) * b;
    });
    if (at.some(Number.isNaN)) return undefined;
    return [(Math.atan2(at[1], at[0]) * 180) / Math.PI, (Math.atan2(at[2], Math.hypot(at[0], at[1])) * 180) / Math.PI];
  };
}
