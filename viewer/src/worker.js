// A worker with a core: answers what src/client.js asks.
import { evolve, load } from "./here.js";

const left = new Set(); // of what was asked for, what is not wanted any more

// Between two scales messages are read: what is left is not gone on with.
const breath = () => new Promise((resolve) => setTimeout(resolve, 0));

async function answer({ id, input }) {
  try {
    for await (const scale of evolve(input)) {
      if (left.has(id)) break;
      postMessage({ id, scale });
      await breath();
    }
    postMessage({ id, done: true });
  } catch (error) {
    const { name, message, hint } = /** @type {any} */ (error);
    postMessage({ id, error: { name, message, hint } });
  }
  left.delete(id);
}

// One at a time, in the order in which they were asked for.
let last = Promise.resolve();

addEventListener("message", ({ data }) => {
  if (data.load) load(data.load).catch(() => {}); // told to who asks for scales
  if (data.leave) left.add(data.leave);
  if (data.input)
    last = last.then(() => (left.delete(data.id) ? undefined : answer(data)));
});
