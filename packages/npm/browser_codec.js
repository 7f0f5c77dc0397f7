// This file handles whole image files in a browser: PNG by png.js, JPEG and WebP by the browser.
import { decodeByBrowser, isOfBrowser } from './browser_images.js';
import { decodedPng, encodedPng, isPng } from './png.js';

/** As decode() of images.js; of JPEG and WebP a promise. */
export function decode(bytes) {
  if (isPng(bytes)) return decodedPng(bytes);
  if (isOfBrowser(bytes)) return decodeByBrowser(bytes);
  throw new Error('is not PNG, JPEG or WebP (give a codec that reads it)');
}

export function encode(format, image, setting) {
  if (format !== 'png') throw new Error(`${format} is not written in a browser (give a codec that does)`);
  return encodedPng(image, setting);
}

export function close() {}
