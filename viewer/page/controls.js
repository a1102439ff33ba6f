// Controls that the pages of 2D and 3D have alike: the slider, layers, theme, colour key.
import { onDark } from "./colors.js";
import { DARK, LIGHT } from "./draw.js";
import { legendMarks } from "./legend.js";
import { withUnits } from "./words.js";

export const byId = (id) => /** @type {any} */ (document.getElementById(id));

/** Layers' boxes. @returns {{name: string, input: HTMLInputElement}[]} */
function boxes() {
  return [...document.querySelectorAll("[data-layer]")].map((box) => {
    const input = /** @type {HTMLInputElement} */ (box);
    return { name: String(input.dataset.layer), input };
  });
}

/** Lets the boxes change what is shown; those of layers that there are none of go. */
export function connectLayers(show, isThere, changed) {
  for (const { name, input } of boxes()) {
    if (!isThere(name)) input.closest("label")?.remove();
    input.addEventListener("change", () => {
      show[name] = input.checked;
      changed();
    });
  }
}

/** What an address shows. */
export function restoreLayers(show, names) {
  const wished = names?.split(",");
  if (wished) for (const name of Object.keys(show)) show[name] = wished.includes(name);
  for (const { name, input } of boxes()) input.checked = show[name];
}

export const layerNames = (show) => Object.keys(show).filter((name) => show[name]).join(",");

/** The slider: `slide` puts it at a place, `keys` have what a key does in its place. */
export function connectSlider(slider, player, slide, keys) {
  slider.addEventListener("input", () => {
    player.play(false);
    slide(Number(slider.value));
  });
  slider.addEventListener("keydown", (event) => {
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
}

/** The buttons that zoom by a factor about the middle, and show all. */
export function connectZoom(view, factor, changed) {
  const zoom = (by) => () => {
    view.zoomAt(view.size[0] / 2, view.size[1] / 2, by);
    changed();
  };
  byId("closer").addEventListener("click", zoom(factor));
  byId("farther").addEventListener("click", zoom(1 / factor));
  byId("whole").addEventListener("click", () => {
    view.reset();
    changed();
  });
}

/** For keys in the picture: whether there was something to do. */
export const doing = (keys) => (key) => {
  keys[key]?.();
  return Boolean(keys[key]);
};

/** Gives canvases the stage's size, which is returned, in pixels of the screen. */
export function fit(...layers) {
  const { clientWidth: w, clientHeight: h } = byId("stage");
  const ratio = devicePixelRatio || 1;
  for (const layer of layers) [layer.width, layer.height] = [Math.round(w * ratio), Math.round(h * ratio)];
  return [Math.max(1, w), Math.max(1, h)];
}

/** The heading and the last line. */
export function introduce(run) {
  document.title = run.title;
  byId("title").textContent = run.title;
  byId("made").textContent = `Made by flowgrain ${run.version}`;
}

/** Light or dark: as the system, or as was chosen. */
export class Theme {
  /** @param {any} run @param {object} key of legendMarks @param {() => void} chosen @param {() => void} changed what is drawn again */
  constructor(run, key, chosen, changed) {
    Object.assign(this, { run, key, changed, choice: "", palettes: { light: run.palette, dark: onDark(run.palette) },
      system: matchMedia("(prefers-color-scheme: dark)") });
    this.system.addEventListener("change", () => this.apply());
    byId("theme").addEventListener("change", () => {
      this.choice = byId("theme").value;
      this.apply();
      chosen();
    });
  }

  /** Of an address. */
  restore(choice) {
    this.choice = ["light", "dark"].includes(choice) ? choice : "";
  }

  get isDark() {
    return this.choice === "dark" || (!this.choice && this.system.matches);
  }

  get colors() {
    return this.isDark ? DARK : LIGHT;
  }

  get palette() {
    return this.palettes[this.isDark ? "dark" : "light"];
  }

  /** The colour key as SVG. */
  get legend() {
    return legendMarks(this.run, this.palette, this.colors.text, this.key);
  }

  apply() {
    const { run } = this;
    document.documentElement.classList.toggle("dark", this.isDark);
    byId("theme").value = this.choice;
    byId("legend").setAttribute("viewBox", "0 0 240 72");
    byId("legend").setAttribute("aria-label", `Speeds from ${withUnits(run.speeds[0], run.units)} to ${withUnits(run.speeds[1], run.units)}`);
    byId("legend").innerHTML = this.legend;
    this.changed();
  }
}
