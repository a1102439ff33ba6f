// Pages that the program writes, opened from disk in Chromium.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { hasBrowser, startBrowser } from "./browser.mjs";

const program = process.env.FLOWGRAIN_PROGRAM;
const makesPages = program && /^with .*viewer/m.test(execFileSync(program, ["--version"], { encoding: "utf8" }));

/** Why nothing can be tried; false: it can. */
export const skip = !makesPages ? "no program with the viewer" : (await hasBrowser()) ? false : "no Chromium, or no playwright-core (npm ci)";

/** Runs in a folder of their own, and a browser that opens their pages. */
export class Opened {
  async start() {
    this.folder = mkdtempSync(join(tmpdir(), "flowgrain-"));
    this.browser = await startBrowser();
  }

  run(out, ...given) {
    execFileSync(program, ["run", ...given, "-o", join(this.folder, out), "--quiet"]);
  }

  async end() {
    await this.browser?.close();
    if (this.folder) rmSync(this.folder, { recursive: true });
  }

  /**
   * A page of a run; what it says on the console or asks for, and errors, are in `faults`. Before all of the
   * page `first` runs there, of `given`.
   */
  async open(name, address = "", { first, given, ...options } = {}) {
    const context = await this.browser.newContext({ viewport: { width: 1100, height: 760 }, bypassCSP: true, ...options });
    context.setDefaultTimeout(180_000); // however slow the machine
    if (first) await context.addInitScript(first, given);
    const page = await context.newPage();
    const faults = [];
    // the driver without a graphics processor tells that it is slow
    page.on("console", (message) => message.text().includes("GL Driver Message") || faults.push(message.text()));
    page.on("pageerror", (error) => faults.push(error.message));
    page.on("request", (request) => /^(file|blob|data):/.test(request.url()) || faults.push(request.url()));
    await page.goto(`file://${join(this.folder, name, "index.html")}${address}`);
    return { page, faults, close: () => context.close() };
  }
}

export const address = (page) => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));
