// Whether the clusters' icons of two outputs of examples/core.c agree to rounding:
// node compare.mjs ONE OTHER
import { readFileSync } from "node:fs";

const most_difference = 1e-9; // of coordinates in [0, 1]

const points = (file) =>
  readFileSync(file, "utf8")
    .split("\n")
    .filter((line) => line.startsWith("cluster "))
    .map((line) => line.split(" "));

// "0x1.8p-3"
function number(text) {
  const [, sign, whole, part, power] = /^(-?)0x(\d)\.?([0-9a-f]*)p([+-]\d+)$/.exec(text);
  return (sign ? -1 : 1) * (parseInt(whole + part, 16) / 16 ** part.length) * 2 ** Number(power);
}

const [one, other] = process.argv.slice(2, 4).map(points);
let most = one.length > 0 && one.length === other.length ? 0 : Infinity;
let same = 0;
for (let n = 0; most < Infinity && n < one.length; ++n) {
  if (one[n][1] !== other[n][1]) most = Infinity;
  for (let k = 2; k < 5; ++k) most = Math.max(most, Math.abs(number(one[n][k]) - number(other[n][k])));
  same += one[n].join() === other[n].join();
}
console.log(`icons of clusters: ${same} of ${one.length} points are the same, the others to ${most}`);
process.exitCode = most <= most_difference ? 0 : 1;
