// These tests compare JPEG, TIFF and WebP, which sharp reads and writes for the command, with the program of the C++ build.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';

import { cases, copyOfInputs, missing, pngValues, requireSame, runOwn, setReader } from './commands.mjs';
import { needPackage } from './needs.mjs';
import { randomArray, randomNumbers } from './package.mjs';

const sharp = (await needPackage('sharp')).default;

// Returns the values of a file, as sharp stores them.
async function valuesOf(bytes) {
  const { depth, channels, space } = await sharp(bytes).metadata();
  const kept = { 'b-w': 'b-w', grey16: 'grey16', rgb16: 'rgb16', srgb: 'srgb' }[space];
  const { data, info } = await sharp(bytes).pipelineColourspace(kept).toColourspace(kept).raw({ depth }).toBuffer({ resolveWithObject: true });
  return { width: info.width, height: info.height, channels, depth, data };
}
for (const extension of ['.jpg', '.tif']) setReader(extension, valuesOf);
// Notes of a file of another format are not copied.
setReader('.png', pngValues);

for (const one of cases.filter(({ formats }) => formats.includes('tif') || formats.includes('jpg')))
  test(one.name, { skip: missing(one) }, () => requireSame(one));

// Writes maps of noise into `in` by sharp. Colors have 4 channels if they have opacity.
async function writeMaps(copy, { extension, depth = 8, opacity = false, written }) {
  const random = randomNumbers(5);
  mkdirSync(join(copy, 'in'));
  for (const [map, channels] of [['roughness', 1], ['specular', opacity ? 4 : 3]]) {
    const [width, height] = [37, 21];
    const data = randomArray(depth === 16 ? Uint16Array : Uint8Array, width * height * channels, random);
    const space = (channels === 1 ? ['b-w', 'grey16'] : ['srgb', 'rgb16'])[depth / 8 - 1];
    const image = sharp(data, { raw: { width, height, channels } }).pipelineColourspace(space).toColourspace(space);
    writeFileSync(join(copy, 'in', `a_${map}.${extension}`), await written(image).toBuffer());
  }
}

const words = (...more) => ['convert', 'in', '--from', 'mitsuba/ward', '--to', 'mitsuba/as', '--roughness-encoding', 'roughness', ...more, '-o', 'out'];
for (const [name, maps, ...more] of [
  ['JPEG with chroma of half the size', { extension: 'jpg', written: (image) => image.jpeg({ quality: 90, chromaSubsampling: '4:2:0' }) }, '--format', 'png'],
  ['progressive JPEG', { extension: 'jpg', written: (image) => image.jpeg({ quality: 70, progressive: true }) }, '--format', 'png'],
  ['WebP without losses', { extension: 'webp', written: (image) => image.webp({ lossless: true }) }, '--format', 'png'],
  ['WebP with losses', { extension: 'webp', written: (image) => image.webp({ quality: 80 }) }, '--format', 'png'],
  ['TIFF of 8 bits', { extension: 'tif', written: (image) => image.tiff({ compression: 'deflate' }) }],
  ['TIFF of 16 bits with opacity', { extension: 'tif', depth: 16, opacity: true, written: (image) => image.tiff({ compression: 'lzw' }) }],
  ['TIFF of 16 bits to PNG', { extension: 'tif', depth: 16, written: (image) => image.tiff({ compression: 'none' }) }, '--format', 'png'],
  ['PNG to TIFF', { extension: 'png', depth: 16, written: (image) => image.png() }, '--format', 'tif'],
])
  test(name, () => requireSame({ arguments: words(...more) }, (copy) => writeMaps(copy, maps)));

test('WebP with opacity, which the program refuses, gives the values of PNG', async () => {
  const results = [];
  for (const [extension, written] of [['webp', (image) => image.webp({ lossless: true, exact: true })], ['png', (image) => image.png()]]) {
    const copy = copyOfInputs();
    await writeMaps(copy, { extension, opacity: true, written });
    const done = runOwn(words('--format', 'png'), copy);
    assert.equal(done.status, 0, done.stderr);
    results.push(pngValues(readFileSync(join(copy, 'out', 'a_specular.png'))));
  }
  assert.equal(results[0].channels, 4);
  assert.deepEqual(results[0], results[1]);
});

test('damaged files are refused by name', () => {
  const copy = copyOfInputs();
  mkdirSync(join(copy, 'in'));
  for (const map of ['roughness', 'specular']) writeFileSync(join(copy, 'in', `a_${map}.jpg`), Buffer.from([0xff, 0xd8, 0xff, 0xe0, 0, 1]));
  const done = runOwn(words('--format', 'png'), copy);
  assert.equal(done.status, 1);
  assert.match(done.stderr, /in\/a_(roughness|specular).jpg: cannot be read: /);
});
