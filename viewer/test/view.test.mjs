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

/** Starts it; a page of its address, faults, and an end that tells the exit code. hold and go on: the run alone. */
async function view(given, options = {}) {
  const server = spawn(program, ["view", ...given, "--no-browser", "--quiet"], { stdio: ["ignore", "pipe", "ignore"] });
  servers.push(server);
  const ended = new Promise((resolve) => server.on("exit", resolve));
  const address = await new Promise((resolve, reject) => {
    server.stdout.once("data", (text) => resolve(String(text).trim()));
    server.once("exit", (code) => reject(new Error(`exit code ${code}`)));
  });
  const run = () => Number(readFileSync(`/proc/${server.pid}/task/${server.pid}/children`, "utf8"));
  const hold = () => process.kill(run(), "SIGSTOP");
  const goOn = () => process.kill(run(), "SIGCONT");
  if (options.held) hold();
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, bypassCSP: true, ...(options.scheme && { colorScheme: options.scheme }) });
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
  return { page, faults, close, hold, goOn };
}

test("a run is followed scale by scale, and ends as its page", { skip }, async () => {
  const { page, faults, close, hold, goOn } = await view(["synth:vortex3", "--arrows", "300,250,200,150,100", "--nodes", "129"], { held: true });
  goOn();
  await page.waitForSelector("#scales button >> text=300");
  hold();
  await page.click("#scales button >> text=300");
  assert.match(await page.getAttribute("#picture", "alt"), /300 arrows/);
  assert.ok(await page.locator("#picture").evaluate((image) => image.decode().then(() => image.naturalWidth > 100)));
  assert.ok(await page.locator("#share").isVisible());
  goOn();
  await page.waitForSelector("canvas#picture");
  await page.waitForFunction(() => document.getElementById("picture").dataset.made === "yes");
  assert.equal(await page.inputValue("#number"), "300");
  assert.deepEqual(faults, []);
  assert.equal(await close(), 130);
});

/** Shares of the pixels of the density that are inside of clusters, outside and missing. */
const density = (page) => page.locator("#density").evaluate((canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const shares = { inside: 0, outside: 0, missing: 0, width: canvas.width };
  for (let n = 0; n < data.length; n += 4) {
    const [red, , blue] = data.subarray(n, n + 3);
    const kind = blue < red ? "missing" : red < 120 ? "inside" : red > 240 ? "outside" : undefined;
    if (kind) shares[kind] += 4 / data.length;
  }
  return shares;
});

test("until there are arrows the density is shown as it evolves, and then when it is asked for", { skip }, async () => {
  const { page, faults, close, hold, goOn } = await view(["synth:vortex3", "--arrows", "300,250,200,150,100", "--nodes", "513"], { held: true });
  goOn();
  await page.waitForSelector("#density", { state: "visible" });
  hold();
  assert.ok(await page.locator("#picture").isHidden());
  goOn();
  await page.waitForSelector("#scales button >> text=300");
  hold();
  await page.waitForSelector("#scales button[aria-pressed=true]:not(#evolution)");
  assert.ok(await page.locator("#density").isHidden());
  await page.click("#evolution");
  assert.ok(await page.locator("#picture").isHidden());
  assert.deepEqual(await page.locator("[aria-pressed=true]").allTextContents(), ["Evolution"]);
  await page.waitForFunction(() => document.getElementById("density").dataset.left === "0");
  const { inside, outside, missing, width } = await density(page);
  assert.equal(width, 257); // every second node
  assert.ok(inside > 0.1 && outside > 0.3 && !missing, `${inside} ${outside} ${missing}`);
  await page.click("#scales button");
  assert.ok(await page.locator("#density").isHidden());
  assert.deepEqual(faults, []);
  goOn();
  await close();
});

for (const colorScheme of ["light", "dark"])
  test(`a run without a page keeps its pictures; WCAG AA holds on a ${colorScheme} page`, { skip }, async () => {
    const { page, faults, close } = await view(["synth:vortex3", "--clusters", "30,10", "--energy", "isotropic", "--nodes", "65"], { scheme: colorScheme });
    await page.waitForFunction(() => /has ended/.test(document.getElementById("doing").textContent));
    assert.equal(await page.locator("#scales button").count(), 2);
    await page.click("#scales button >> nth=0");
    assert.match(await page.getAttribute("#picture", "src"), /scale-00/);
    assert.equal(await page.getAttribute("#scales button >> nth=0", "aria-pressed"), "true");
    await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"));
    const { violations } = await page.evaluate(() => globalThis.axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "wcag22aa"] }));
    assert.deepEqual(violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" ")}`), []);
    await page.click("#evolution");
    await page.waitForSelector("#density", { state: "visible" });
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/view-${colorScheme}.png` });
    assert.deepEqual(faults, []);
    assert.equal(await close(), 130);
  });
