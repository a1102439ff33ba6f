// Headless Chromium, and a server of the package for it.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const dist = fileURLToPath(new URL("../../build-viewer/package/dist/", import.meta.url));
const kinds = { ".js": "text/javascript", ".wasm": "application/wasm", ".html": "text/html" };

export const chromium = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser"]
  .find((path) => path && existsSync(path));

/** Whether there is a browser, and what speaks with it: viewer/node_modules, by `npm ci`. */
export async function hasBrowser() {
  return Boolean(chromium) && import("playwright-core").then(() => true, () => false);
}

export async function startBrowser() {
  const { chromium: player } = await import("playwright-core");
  return player.launch({ executablePath: chromium, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
}

/** Serves the package's modules, and an empty page; or another folder. */
export async function serve(folder = dist) {
  const server = createServer(async (request, answer) => {
    const path = normalize(new URL(request.url, "http://localhost").pathname);
    if (path === "/") return answer.setHeader("content-type", "text/html").end("<!doctype html><title>flowgrain</title>");
    try {
      answer.setHeader("content-type", kinds[extname(path)] ?? "text/plain").end(await readFile(join(folder, path)));
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}
