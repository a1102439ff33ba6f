// The view as a file, with title and colour key.
import { captionText } from "../page/common.js";

const ROOM = 76; // below the view

async function imageOf(svg) {
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await image.decode();
  return image;
}

/**
 * A PNG file of the view, `ratio` pixels for one of the window.
 * @param {import("./camera.js").Camera} camera
 * @param {{scene: (ratio: number) => void, canvas: HTMLCanvasElement, labels: (context: CanvasRenderingContext2D) => void,
 *   title: string, words: string, colors: any, legend: string}} parts
 * @returns {Promise<Blob | null>}
 */
export async function drawPicture(camera, ratio, { scene, canvas, labels, title, words, colors, legend }) {
  const [w, h] = camera.size;
  const below = await imageOf(`<svg xmlns="http://www.w3.org/2000/svg" width="${ratio * w}" height="${ratio * ROOM}" viewBox="0 0 ${w} ${ROOM}">` +
    captionText(26, 15, title, colors.text, "bold") + captionText(46, 12, words, colors.text) +
    `<g transform="translate(${w - 252} 2)">${legend}</g></svg>`);
  const paper = document.createElement("canvas");
  [paper.width, paper.height] = [Math.round(ratio * w), Math.round(ratio * (h + ROOM))];
  const context = /** @type {CanvasRenderingContext2D} */ (paper.getContext("2d"));
  context.fillStyle = colors.page;
  context.fillRect(0, 0, paper.width, paper.height);
  [canvas.width, canvas.height] = [Math.round(ratio * w), Math.round(ratio * h)];
  scene(ratio);
  context.drawImage(canvas, 0, 0);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  labels(context);
  context.drawImage(below, 0, h, w, ROOM);
  return new Promise((resolve) => paper.toBlob(resolve));
}
