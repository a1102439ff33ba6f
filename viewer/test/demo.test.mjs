// The demonstration page, in Chromium.
import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";
import { test } from "node:test";
import { hasBrowser, serve, startBrowser } from "./browser.mjs";

const skip = (await hasBrowser()) ? false : "no Chromium, or no playwright-core (npm ci)";

test("the demonstration keeps the number of arrows in view", { skip }, async () => {
  const server = await serve(fileURLToPath(new URL("../../", import.meta.url)));
  const browser = await startBrowser();
  try {
    const page = await browser.newPage({ viewport: { width: 1100, height: 760 } });
    const faults = [];
    page.on("console", (message) => faults.push(message.text()));
    page.on("pageerror", (error) => faults.push(error.message));
    await page.goto(`${server.address}viewer/demo/index.html`);
    const told = page.locator("#told"), map = page.locator("#map");
    const made = () => map.evaluate((canvas) => Number(canvas.dataset.made ?? 0));
    /** Waits until arrows are there that were asked for after those. */
    const madeAfter = (last) => page.waitForFunction((last) => Number(document.getElementById("map").dataset.made) > last, last);
    await madeAfter(0);
    assert.match(await told.textContent(), /^60 arrows/);
    await page.locator("#number").fill("25");
    await madeAfter(1);
    assert.match(await told.textContent(), /^25 arrows/);
    const before = await map.screenshot(), last = await made();
    await map.press("+");
    await madeAfter(last);
    assert.match(await told.textContent(), /^25 arrows/);
    assert.notDeepEqual(await map.screenshot(), before);
    await map.hover({ position: { x: 300, y: 200 } });
    await page.waitForFunction(() => /^[0-9.]+ m\/s at -?[0-9]+° N/.test(document.getElementById("told").textContent));
    assert.deepEqual(faults, []);
  } finally {
    await browser.close();
    server.close();
  }
});
