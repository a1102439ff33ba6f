// The code of the page for users, docs/users/browser.md, as it stands there.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { chmodSync, copyFileSync, existsSync, mkdirSync, mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";
import { hasBrowser, serve, startBrowser } from "./browser.mjs";

const root = fileURLToPath(new URL("../../", import.meta.url));
const program = process.env.FLOWGRAIN_PROGRAM;
const makesPages = program && /^with .*viewer/m.test(execFileSync(program, ["--version"], { encoding: "utf8" }));
const noBrowser = (await hasBrowser()) ? false : "no Chromium, or no playwright-core (npm ci)";
const blocks = (language) => execFileSync(join(root, "scripts/blocks"), [join(root, "docs/users/browser.md"), language], { encoding: "utf8" });

let folder;
before(() => {
  folder = mkdtempSync(join(tmpdir(), "flowgrain-"));
  mkdirSync(join(folder, "node_modules"));
  symlinkSync(join(root, "build-viewer/package"), join(folder, "node_modules/flowgrain"));
});
after(() => rmSync(folder, { recursive: true }));

test("its script for Node.js has 50, 25 and 10 arrows", () => {
  writeFileSync(join(folder, "scales.mjs"), blocks("js"));
  const told = execFileSync(process.execPath, ["scales.mjs"], { cwd: folder, encoding: "utf8" });
  assert.deepEqual(told.trim().split("\n").map((line) => line.split(" ")[0]), ["50", "25", "10"]);
});

test("its commands run, and view opens a browser until it is interrupted", { skip: makesPages ? false : "no program with the viewer" }, () => {
  copyFileSync(join(root, "data/gfs_20140131.nc"), join(folder, "wind.nc"));
  // a browser that ends the program, whose process is its parent, as Ctrl-C would
  writeFileSync(join(folder, "browse"), '#!/bin/sh\necho "$1" >>opened\nkill -INT "$PPID"\n');
  chmodSync(join(folder, "browse"), 0o755);
  const commands = `flowgrain() { "$PROGRAM" "$@" || [ $? = 130 -a "$1" = view ]; }\n${blocks("sh")}wc -l <opened\n`;
  const told = execFileSync("bash", ["-euc", commands], { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"],
    env: { ...process.env, PROGRAM: program, BROWSER: join(folder, "browse") } });
  assert.ok(existsSync(join(folder, "pictures/index.html")));
  assert.match(told, /http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/\n[^]*\n2\n$/);
});

test("its page draws arrows", { skip: noBrowser }, async () => {
  writeFileSync(join(folder, "page.html"), blocks("html"));
  const [server, browser] = [await serve(folder), await startBrowser()];
  try {
    const page = await browser.newPage();
    const faults = [];
    page.on("pageerror", (error) => faults.push(error.message));
    await page.goto(`${server.address}page.html`);
    const drawn = () => page.locator("#picture").evaluate((canvas) =>
      canvas.getContext("2d").getImageData(0, 0, 480, 480).data.filter((a, n) => n % 4 === 3 && a > 128).length);
    for (let k = 0; k < 100 && !(await drawn()); ++k) await page.waitForTimeout(100);
    const share = (await drawn()) / 480 ** 2;
    assert.ok(share > 0.01 && share < 0.3, `${share} of the picture is drawn`);
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/page.png` });
    assert.deepEqual(faults, []);
  } finally {
    await browser.close();
    server.close();
  }
});
