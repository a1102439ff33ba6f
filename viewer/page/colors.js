// Colours of speeds, on a light and on a dark page.

const toLinear = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const fromLinear = (c) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);

function toOklab(hex) {
  const [r, g, b] = [1, 3, 5].map((k) => toLinear(parseInt(hex.slice(k, k + 2), 16) / 255));
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s];
}

function toRgb([lightness, a, b]) {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
}

// As much of the chroma as the screen can show.
function toHex(lab) {
  for (let share = 1; ; share -= 0.05) {
    const rgb = toRgb([lab[0], share * lab[1], share * lab[2]]);
    if (share > 0.05 && rgb.some((c) => c < -0.001 || c > 1.001)) continue;
    return "#" + rgb.map((c) => Math.round(255 * fromLinear(Math.min(Math.max(c, 0), 1))).toString(16).padStart(2, "0")).join("");
  }
}

const SLOW_ON_DARK = 0.56; // lightness: 3 : 1 and more against the dark page
const FAST_ON_DARK = 0.93;

/** The palette for a dark page: hues stay, what was darkest becomes lightest. */
export function onDark(palette) {
  const labs = palette.map(toOklab);
  const lights = labs.map((lab) => lab[0]);
  const [low, high] = [Math.min(...lights), Math.max(...lights)];
  return labs.map(([lightness, a, b]) =>
    toHex([SLOW_ON_DARK + (FAST_ON_DARK - SLOW_ON_DARK) * ((high - lightness) / (high - low || 1)), a, b]));
}

/** A colour of the palette for a speed. */
export function colorOf(palette, speeds, speed) {
  const share = Math.min(Math.max((speed - speeds[0]) / (speeds[1] - speeds[0] || 1), 0), 1);
  const place = share * (palette.length - 1);
  const k = Math.min(Math.floor(place), palette.length - 2);
  const [a, b] = [palette[k], palette[k + 1]].map((hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)));
  return `rgb(${a.map((c, i) => Math.round(c + (place - k) * (b[i] - c))).join(",")})`;
}
