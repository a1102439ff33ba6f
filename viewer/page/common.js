// What the pages of 2D and 3D do alike.

/** Has the browser save a file. */
export function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** Puts a note beside a place, within a window of that size. */
export function placeBeside(note, [x, y], [w, h]) {
  note.style.left = `${Math.max(0, Math.min(x + 16, w - note.offsetWidth - 4))}px`;
  note.style.top = `${Math.max(0, y + 16 + note.offsetHeight > h ? y - note.offsetHeight - 10 : y + 16)}px`;
}

/** Words of a caption's line for a picture in SVG. */
export function captionText(y, size, words, color, weight = "normal") {
  return `<text x="12" y="${y}" font-size="${size}" font-weight="${weight}" font-family="DejaVu Sans, sans-serif" fill="${color}">` +
    `${words.replace(/[&<>]/g, (c) => `&#${c.charCodeAt(0)};`)}</text>`;
}

/** A number that a text is, within limits; else undefined. */
export function numberIn(text, low, high) {
  return text !== undefined && text !== "" && Number(text) >= low && Number(text) <= high ? Number(text) : undefined;
}

/** Goes through the scales, as long as it plays. */
export class Player {
  /**
   * @param {HTMLElement} button
   * @param {{at: () => number, last: () => number, made: () => number, slide: (at: number) => void, pace: () => number}} scales
   *   where the slider is, its end, how many scales are made, what moves it, milliseconds from scale to scale
   */
  constructor(button, scales) {
    Object.assign(this, { button, scales, playing: false });
    button.addEventListener("click", () => this.play(!this.playing));
  }

  play(on) {
    this.playing = on && !this.playing;
    this.button.textContent = this.playing ? "Pause" : "Play";
    this.button.setAttribute("aria-label", this.playing ? "Pause" : "Play from many arrows to few");
    if (!this.playing) return;
    const { at, last, made, slide, pace } = this.scales;
    if (at() >= last()) slide(0);
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      const passed = Math.min(now - before, 100);
      before = now;
      const next = at() + passed / pace();
      if (Math.ceil(next) < made()) slide(next); // waits for scales that are being made
      else if (made() > last()) {
        slide(last());
        return this.play(false);
      } else slide(at());
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}
