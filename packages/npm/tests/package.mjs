// This file loads the package under test, and gives the folder of the sources.
import { pathToFileURL, fileURLToPath } from 'node:url';

const root = new URL('../../../', import.meta.url);
export const sourceFolder = process.env.REMAP_SOURCE_DIR ?? fileURLToPath(root);
export const packageFolder = process.env.TEXREMAP_PACKAGE ?? fileURLToPath(new URL('build/wasm/npm', root));
export const texremap = await import(pathToFileURL(`${packageFolder}/index.js`).href);

// Returns numbers in 0 to 1, the same in every run (mulberry32, T. Ettinger).
export function randomNumbers(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

export function randomArray(Type, length, random) {
  const highest = Type === Float32Array || Type === Float64Array ? 1 : Type === Uint16Array ? 65535 : 255;
  return Type.from({ length }, () => (highest === 1 ? random() : Math.floor(random() * (highest + 1))));
}
