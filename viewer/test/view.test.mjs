// What a browser shows of `flowgrain view`. What its server answers, tests/cli/view_test.sh asks.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { hasBrowser, startBrowser } from "./browser.mjs";

const program = process.env.FLOWGRAIN_PROGRAM;
const makesPages = program && /^with .*viewer/m.test(execFileSync(program, ["--version"], { encoding: "utf8" }));
const skip = !makesPages ? "no program with the viewer" : (await hasBrowser()) ? false : "no Chromium, or no playwright-core (npm ci)";

let browser;
const servers = [];
before(async () => {
  if (!skip) browser = await startBrowser();
});
after(async () => {
  for (const server of servers) server.kill("SIGKILL"); // those of tests that failed
  await browser?.close();
});

/** Starts it; a page of its address, faults, and an end that tells the exit code. */
async function view(given, options = {}) {
  const server = spawn(program, ["view", ...given, "--no-browser", "--quiet"], { stdio: ["ignore", "pipe", "ignore"] });
  servers.push(server);
  const ended = new Promise((resolve) => server.on("exit", resolve));
  const address = await new Promise((resolve, reject) => {
    server.stdout.once("data", (text) => resolve(String(text).trim()));
    server.once("exit", (code) => reject(new Error(`exit code ${code}`)));
  });
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, bypassCSP: true, ...options });
  context.setDefaultTimeout(180_000); // however slow the machine
  const page = await context.newPage();
  const faults = [];
  page.on("console", (message) => faults.push(`${message.text()} ${message.location().url}`));
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("request", (request) => /^(blob|data):/.test(request.url()) || request.url().startsWith(address) || faults.push(request.url()));
  await page.goto(address);
  const close = async () => {
    await context.close();
    server.kill("SIGINT");
    return ended;
  };
  return { page, faults, close };
}

test("a run is followed scale by scale, and ends as its page", { skip }, async () => {
  const { page, faults, close } = await view(["synth:vortex3", "--arrows", "150,80,40", "--nodes", "129"]);
  await page.waitForSelector("#scales button[aria-pressed=true] >> text=150");
  assert.match(await page.getAttribute("#picture", "alt"), /150 arrows/);
  assert.ok(await page.locator("#picture").evaluate((image) => image.decode().then(() => image.naturalWidth > 100)));
  assert.ok(await page.locator("#share").isVisible());
  await page.waitForSelector("canvas#picture");
  await page.waitForFunction(() => document.getElementById("picture").dataset.made === "yes");
  assert.equal(await page.inputValue("#number"), "150");
  assert.deepEqual(faults, []);
  assert.equal(await close(), 130);
});

for (const colorScheme of ["light", "dark"])
  test(`a run without a page keeps its pictures; WCAG AA holds on a ${colorScheme} page`, { skip }, async () => {
    const { page, faults, close } = await view(["synth:vortex3", "--clusters", "30,10", "--energy", "isotropic", "--nodes", "65"], { colorScheme });
    await page.waitForFunction(() => /has ended/.test(document.getElementById("doing").textContent));
    assert.equal(await page.locator("#scales button").count(), 2);
    await page.click("#scales button >> nth=0");
    assert.match(await page.getAttribute("#picture", "src"), /scale-00/);
    assert.equal(await page.getAttribute("#scales button >> nth=0", "aria-pressed"), "true");
    await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"));
    const { violations } = await page.evaluate(() => globalThis.axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"] }));
    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`), []);
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/view-${colorScheme}.png` });
    assert.deepEqual(faults, []);
    assert.equal(await close(), 130);
  });
