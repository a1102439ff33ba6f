// How long vortex3 takes to 12 clusters in a worker of Chromium, and other work of the page:
//     viewer/build && node viewer/bench.mjs
import { serve, startBrowser } from "./test/browser.mjs";

const server = await serve();
const browser = await startBrowser();
const page = await browser.newPage();
await page.goto(server.address);
const lines = await page.evaluate(async () => {
  const { arrows, evolve } = await import("/index.js");
  const cores = [[0.28, 0.3, 1], [0.74, 0.34, -1], [0.48, 0.74, 1]];
  const vortex3 = (nodes) => {
    const x = Float64Array.from({ length: nodes }, (_, k) => k / (nodes - 1));
    const [u, v] = [new Float32Array(nodes * nodes), new Float32Array(nodes * nodes)];
    for (let n = 0; n < u.length; ++n)
      for (const [cx, cy, circulation] of cores) {
        const [dx, dy] = [x[n % nodes] - cx, x[Math.floor(n / nodes)] - cy];
        const strength = circulation / (dx * dx + dy * dy + 0.0064);
        u[n] -= strength * dy;
        v[n] += strength * dx;
      }
    return { u, v, width: nodes, height: nodes, x, y: x, nodes };
  };
  const said = [];
  const time = async (name, work) => {
    const times = [];
    for (let n = 0; n < 7; ++n) {
      const begin = performance.now();
      await work();
      times.push(performance.now() - begin);
    }
    times.sort((a, b) => a - b);
    said.push(`${name}: least ${times[0].toFixed(0)} ms, median ${times[3].toFixed(0)} ms`);
  };
  await arrows({ ...vortex3(33), n: 5 });
  for (const nodes of [129, 257]) {
    const field = vortex3(nodes);
    await time(`12 clusters, ${nodes} nodes`, () => arrows({ ...field, kind: "clusters", n: 12 }));
  }
  const field = vortex3(257);
  for (const n of [12, 50, 200])
    await time(`${n} arrows, quick`, () => arrows({ ...field, n, start: "even", effort: "quick" }));
  return said;
});
console.log(lines.join("\n"));
await browser.close();
server.close();
