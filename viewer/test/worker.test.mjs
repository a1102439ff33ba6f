// The package in a worker of Chromium.
import assert from "node:assert/strict";
import { test } from "node:test";
import { arrows } from "../../build-viewer/package/dist/here.js";
import { hasBrowser, serve, startBrowser } from "./browser.mjs";
import { jet } from "./fields.mjs";

const skip = (await hasBrowser()) ? false : "no Chromium, or no playwright-core (npm ci)";

test("a worker gives the same arrows, scales until they are left, and errors", { skip }, async () => {
  const server = await serve();
  const browser = await startBrowser();
  try {
    const page = await browser.newPage();
    await page.goto(server.address);
    const field = Object.fromEntries(Object.entries(jet()).map(([k, a]) => [k, a.length ? Array.from(a) : a]));
    const found = await page.evaluate(async (input) => {
      const { arrows: ask, evolve, FlowgrainError } = await import("/index.js");
      const one = await ask({ ...input, n: 7, start: "even" });
      const counts = [];
      for await (const scale of evolve({ ...input, start: "even", numbers: [9, 8, 7, 6] })) {
        counts.push(scale.counts.arrows);
        if (counts.length === 2) break;
      }
      const wrong = [];
      for (const bad of [{ u: input.v.map(() => 0), v: input.v.map(() => 0) }, { n: 0 }])
        await ask({ ...input, ...bad }).catch((e) => wrong.push([e instanceof FlowgrainError, e.message]));
      return { paths: one.arrows.map((a) => Array.from(a.path)), counts, wrong };
    }, field);
    const expected = await arrows({ ...field, n: 7, start: "even" });
    assert.deepEqual(found.paths, expected.arrows.map((a) => Array.from(a.path)));
    assert.deepEqual(found.counts, [9, 8]);
    assert.deepEqual(found.wrong.map(([own]) => own), [true, false]);
    assert.match(found.wrong[0][1], /zero everywhere/);
  } finally {
    await browser.close();
    server.close();
  }
});
