// How many frames a second a page shows while its slider is dragged, in headless Chromium: from when it is
// opened, and again.
//     node viewer/frames.mjs RUN/index.html[#ADDRESS] [WIDTH HEIGHT [FROM TO]]
// FROM and TO are shares of the slider; ADDRESS is the page's, as #show=arrows,clusters.
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { startBrowser } from "./test/browser.mjs";

const [given = "", width = "1280", height = "800", from = "0", to = "1"] = process.argv.slice(2);
const [file, address = ""] = given.split("#");
if (!file || !existsSync(file)) throw new Error("which page?");
const browser = await startBrowser();
const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) }, bypassCSP: true });
await page.goto(`file://${resolve(file)}#${address}`);
await page.waitForFunction(() => document.getElementById("picture").dataset.made === "yes");
console.log(`opened in ${(await page.evaluate(() => performance.now())).toFixed(0)} ms`);
await page.waitForFunction(() => { // in 2D scales are placed by the page
  const made = document.getElementById("picture").dataset.scales;
  return made === undefined || Number(made) > Number(document.getElementById("scale").max);
}, undefined, { timeout: 0 });
await page.waitForTimeout(1000);

/** Drags as a hand does: an event for each frame, there and back in four seconds. */
const drag = ([from, to, seconds]) => new Promise((done) => {
  const slider = document.getElementById("scale");
  const begin = performance.now();
  const times = [];
  const step = (now) => {
    times.push(now);
    const passed = (performance.now() - begin) / 1000;
    if (passed > seconds) {
      const gaps = times.slice(1).map((t, n) => t - times[n]).sort((a, b) => a - b);
      return done({ frames: gaps.length, seconds: (times.at(-1) - times[0]) / 1000,
        median: gaps[gaps.length >> 1], slowest: gaps.at(-1) });
    }
    const share = Math.abs(((passed / 4) % 1) * 2 - 1);
    slider.value = String(Number(slider.max) * (to + (from - to) * share));
    slider.dispatchEvent(new Event("input"));
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
});

for (const name of ["first drag", "second"]) {
  const { frames, seconds, median, slowest } = await page.evaluate(drag, [Number(from), Number(to), 6]);
  console.log(`${name}: ${(frames / seconds).toFixed(1)} frames a second, median ${median.toFixed(0)} ms, slowest ${slowest.toFixed(0)} ms`);
}
await browser.close();
