// Numbers, units and directions in words.

const raised = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** "m s-1", "m s**-1" become "m s⁻¹". */
export function unitsOf(text) {
  return (text ?? "").replace(/(?<=[A-Za-z])(?:\*\*|\^)?(-?)(\d+)/g, (_, sign, digits) =>
    (sign ? "⁻" : "") + [...digits].map((d) => raised[d]).join(""));
}

export function shortNumber(x, figures = 3) {
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e6 || size < 1e-3) return x.toExponential(figures - 1).replace("e+", "e");
  return String(Number(x.toPrecision(size >= 1000 ? 4 : figures)));
}

const winds = ["north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"];

/** Where to, from a bearing in degrees from north, clockwise. */
export function bearing(degrees) {
  const turn = ((degrees % 360) + 360) % 360;
  return `${Math.round(turn) % 360}° (${winds[Math.round(turn / 45) % 8]})`;
}

export function degrees(longitude, latitude) {
  const half = (x, plus, minus) => `${Math.abs(x).toFixed(2)}° ${x < 0 ? minus : plus}`;
  return `${half(latitude, "N", "S")}, ${half(longitude, "E", "W")}`;
}
