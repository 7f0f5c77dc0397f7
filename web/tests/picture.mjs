// Draws docs/web.png. It shows the page with worn paint on brass: in the specular workflow before the conversion, in the
// metallic workflow after it.
// Usage: node web/tests/picture.mjs [dark]
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { Visit, loaded, repository, served, skip, startBrowser } from './browser.mjs';

const SIZE = 512;

let state = 21;
const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;

// Returns smooth noise that repeats, with `cells` squares a side.
function noise(cells) {
  const values = Float64Array.from({ length: cells * cells }, random);
  const at = (i, j) => values[(j % cells) * cells + (i % cells)];
  const smooth = (t) => t * t * (3 - 2 * t);
  const mix = (a, b, t) => a + (b - a) * t;
  return (x, y) => {
    const [u, v] = [(x * cells) / SIZE, (y * cells) / SIZE];
    const [i, j] = [Math.floor(u), Math.floor(v)];
    const [s, t] = [smooth(u - i), smooth(v - j)];
    return mix(mix(at(i, j), at(i + 1, j), s), mix(at(i, j + 1), at(i + 1, j + 1), s), t);
  };
}

const srgb = (value) => Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));

function wornPaint() {
  const octaves = [4, 8, 16, 32, 64].map(noise);
  const diffuse = new Uint8Array(3 * SIZE * SIZE);
  const specular = new Uint8Array(4 * SIZE * SIZE);
  for (let y = 0, at = 0; y < SIZE; ++y)
    for (let x = 0; x < SIZE; ++x, ++at) {
      const height = octaves.reduce((sum, octave, i) => sum + octave(x, y) / 2 ** i, 0) / 1.9375;
      const paint = Math.min(1, Math.max(0, 30 * (height - 0.5) + 0.5));
      const fine = (octaves[3](x, y) + octaves[4](x, y)) / 2;
      [0.03, 0.16, 0.19].forEach((color, c) => { diffuse[3 * at + c] = srgb(paint * color); });
      [0.91, 0.62, 0.26].forEach((color, c) => { specular[4 * at + c] = srgb((1 - paint) * color + paint * 0.04); });
      specular[4 * at + 3] = Math.round(255 * ((1 - paint) * (0.55 + 0.25 * fine) + paint * (0.62 + 0.12 * octaves[1](x, y))));
    }
  return [{ channels: 3, data: diffuse }, { channels: 4, data: specular }];
}

if (skip) throw new Error(skip);
const { encode } = await loaded('fast-png');
const extension = 'KHR_materials_pbrSpecularGlossiness';
const asset = {
  asset: { version: '2.0' },
  extensionsUsed: [extension],
  images: wornPaint().map((image) => ({
    uri: `data:image/png;base64,${Buffer.from(encode({ width: SIZE, height: SIZE, depth: 8, ...image })).toString('base64')}`,
  })),
  textures: [{ source: 0 }, { source: 1 }],
  materials: [{ name: 'worn paint', extensions: { [extension]: { diffuseTexture: { index: 0 }, specularGlossinessTexture: { index: 1 } } } }],
};

const folder = mkdtempSync(join(tmpdir(), 'texremap-web-'));
writeFileSync(join(folder, 'worn.gltf'), JSON.stringify(asset));
const [browser, server] = [await startBrowser(), await served()];
const visit = await Visit.begin(browser, server.url, folder);
await visit.page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: process.argv[2] ?? 'light' }]);
await visit.page.setViewport({ width: 1000, height: 1150 });
await visit.drop(join(folder, 'worn.gltf'));
await visit.convert();
await visit.page.evaluate(() => document.activeElement.blur());
await visit.page.screenshot({ path: join(repository, 'docs/web.png'), fullPage: true });
await browser.close();
server.close();
rmSync(folder, { recursive: true });
