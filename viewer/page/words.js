// Numbers, units and directions in words.
import { locator } from "./place.js";

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

/** A number with its unit, if any. */
export function withUnits(x, units, figures = 3) {
  return shortNumber(x, figures) + (units ? ` ${unitsOf(units)}` : "");
}

/** What is measured at a coordinate whose units are those of another scale: "-25 hPa". */
export function measured(x, units, figures) {
  const [, factor, logarithm, own] = /^(-?[\d.]+(?:e[-+]?\d+)?) (lg\(re 1 )?(.*?)\)?$/.exec(units) ?? [];
  if (!factor) return withUnits(x, units, figures);
  return withUnits(logarithm ? 10 ** (factor * x) : factor * x, own, figures);
}

/** Words for the speeds, directions and places of a run's field. */
export function tellerOf(run, field) {
  const placeOf = locator(field.places, run.axes === "degrees");

  const speedWords = (speed) => withUnits(speed, run.units);

  /** From north on a map, else from the x axis. */
  function directionWords(x, y, [u, v]) {
    const from = placeOf(x, y);
    if (!from) return `${Math.round((Math.atan2(v, u) * 180) / Math.PI)}° from x`;
    if (run.axes === "degrees") return `to ${bearing((Math.atan2(u, v) * 180) / Math.PI)}`;
    const step = (1e-3 * (field.box[2] - field.box[0])) / Math.hypot(u, v);
    const to = placeOf(x + step * u, y + step * v);
    if (!to) return "";
    const east = ((((to[0] - from[0] + 540) % 360) - 180) * Math.cos((from[1] * Math.PI) / 180));
    return `to ${bearing((Math.atan2(east, to[1] - from[1]) * 180) / Math.PI)}`;
  }

  function placeWords(x, y) {
    const place = placeOf(x, y);
    if (place) return degrees(...place);
    return `${run.xName} ${measured(x, run.xUnits, 4)}, ${run.yName} ${measured(y, run.yUnits, 4)}`;
  }

  return { speedWords, directionWords, placeWords };
}
