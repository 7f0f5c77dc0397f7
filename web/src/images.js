// This file decodes and encodes whole image files while the program waits. PNG can be decoded at once. The browser decodes
// JPEG and WebP in its own time, so they are decoded before the program runs and found again by their bytes.
import { decodedPng, encodedPng, isPng } from '../../packages/npm/png.js';
import { decodeByBrowser, isOfBrowser } from './browser_images.js';

const keyOf = (bytes) => {
  let hash = 0x811c9dc5;  // FNV-1a
  for (const byte of bytes) hash = Math.imul(hash ^ byte, 0x01000193);
  return `${bytes.length}:${hash >>> 0}`;
};
const areEqual = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);

export class Images {
  #decoded = new Map();  // by keyOf(): [{ bytes, image or failure }]

  /** Decodes a file ahead, if the browser is needed for it. */
  async prepare(bytes) {
    if (!isOfBrowser(bytes) || this.#find(bytes)) return;
    const entry = { bytes };
    try {
      entry.image = await decodeByBrowser(bytes);
    } catch (error) {
      entry.failure = error.message;
    }
    const key = keyOf(bytes);
    this.#decoded.set(key, [...(this.#decoded.get(key) ?? []), entry]);
  }

  #find(bytes) {
    return this.#decoded.get(keyOf(bytes))?.find((entry) => areEqual(entry.bytes, bytes));
  }

  /** { width, height, channels, depth: 8 or 16, data }; opacity is not multiplied into colors. */
  decode(bytes) {
    if (isPng(bytes)) return decodedPng(bytes);
    if (!isOfBrowser(bytes)) throw new Error('TIFF is not read by this page (convert it to PNG, or use the Debian or the Python package)');
    const found = this.#find(bytes);
    if (!found) throw new Error('is JPEG or WebP in a file that this page does not search for images (convert it to PNG)');
    if (found.failure) throw new Error(found.failure);
    return found.image;
  }

  encode(format, image, level) {
    if (format !== 'png') throw new Error(`${format} is not written by this page (use --format png)`);
    return encodedPng(image, level);
  }
}
