// This file shows the maps themselves, side by side, for models that three.js does not have. The wipe goes through each
// map.

function canvasOf({ width, height, rgba }) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  canvas.getContext('2d').putImageData(new ImageData(rgba, width, height), 0, 0);
  return canvas;
}

const GAP = 12;
// These are the counterparts of maps that the other workflow does not have.
const PARTNERS = { diffuse: 'base color', 'base color': 'diffuse', specular: 'metallic', metallic: 'specular' };

export class Flat {
  #canvas;
  #pairs = [];

  constructor(canvas) {
    this.#canvas = canvas;
  }

  show(before, after) {
    this.#pairs = before.maps.flatMap((map) => {
      const other = [map.role, PARTNERS[map.role]].map((wanted) => after.maps.find(({ role }) => role === wanted)).find(Boolean);
      return other ? [{ text: other.role === map.role ? map.role : `${map.role} | ${other.role}`, images: [canvasOf(map), canvasOf(other)] }] : [];
    });
  }

  draw({ wipe }) {
    const scale = Math.min(devicePixelRatio, 2);
    const width = Math.round(this.#canvas.clientWidth * scale);
    const height = Math.round(this.#canvas.clientHeight * scale);
    if (width === 0 || height === 0) return;
    this.#canvas.width = width;
    this.#canvas.height = height;
    const context = this.#canvas.getContext('2d');
    const count = Math.max(this.#pairs.length, 1);
    const gap = GAP * scale;
    const top = 3 * gap;
    const side = Math.min((width - gap * (count + 1)) / count, height - top - 3 * gap);
    const first = (width - count * side - (count - 1) * gap) / 2;
    context.imageSmoothingEnabled = false;
    context.fillStyle = '#fff';
    context.font = `${14 * scale}px system-ui, sans-serif`;
    context.textAlign = 'center';
    this.#pairs.forEach(({ text, images }, i) => {
      const left = first + i * (side + gap);
      const border = side * wipe;
      images.forEach((image, which) => {
        context.save();
        context.beginPath();
        context.rect(left + (which === 0 ? 0 : border), top, which === 0 ? border : side - border, side);
        context.clip();
        context.drawImage(image, left, top, side, side);
        context.restore();
      });
      context.fillRect(left + border - scale, top, 2 * scale, side);
      context.fillText(text, left + side / 2, top + side + 1.8 * gap);
    });
  }
}

/** A figure of a map. */
export function figureOf(map, when) {
  const figure = document.createElement('figure');
  const canvas = canvasOf(map);
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', `${map.role}, ${when}`);
  const caption = document.createElement('figcaption');
  caption.textContent = map.role;
  figure.append(canvas, caption);
  return figure;
}
