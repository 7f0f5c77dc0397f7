// These tests check that images which claim more than they hold are refused before fast-png or sharp allocates memory. They
// need no WebAssembly.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import test from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';

const folder = resolve(process.env.TEXREMAP_PACKAGE ?? fileURLToPath(new URL('../../../build/wasm/npm', import.meta.url)));
const skip = existsSync(join(folder, 'node_modules/fast-png')) ? false : `fast-png is not in ${folder} (packages/npm/tests/install.bash)`;
const { decodedPng, encodedPng } = skip ? {} : await import(pathToFileURL(join(folder, 'png.js')).href);

const HEADER = 33;  // bytes of the signature and the first chunk
const SIDE = 8;

const good = () => encodedPng({ width: SIDE, height: SIDE, channels: 4, depth: 8, data: new Uint8Array(4 * SIDE * SIDE) }, 6);

// Returns a good file with another size in its header.
function claiming(width, height) {
  const bytes = good();
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  view.setUint32(16, width);
  view.setUint32(20, height);
  return bytes;
}

test('a good file is decoded, also from the middle of a buffer, and with more behind its end', { skip }, () => {
  const bytes = good();
  const inside = new Uint8Array(bytes.length + 5).subarray(5);
  inside.set(bytes);
  for (const file of [bytes, Buffer.from(bytes), inside, Buffer.concat([bytes, Buffer.alloc(99, 255)])]) assert.equal(decodedPng(file).data.length, 4 * SIDE * SIDE);
});

test('claims are compared with the limit and with the file', { skip }, () => {
  assert.throws(() => decodedPng(claiming(32768, 32769)), /32768x32769 texels are more than 1073741824/);
  assert.throws(() => decodedPng(claiming(2 ** 32 - 1, 2 ** 32 - 1)), /are more than/);
  assert.throws(() => decodedPng(claiming(30000, 30000)), /claims 30000x30000 texels in \d+ bytes/);
});

test('a second header counts, too', { skip }, () => {
  const [first, second] = [good(), claiming(30000, 30000)];
  const bytes = new Uint8Array([...first.subarray(0, HEADER), ...second.subarray(8, HEADER), ...first.subarray(HEADER)]);
  assert.throws(() => decodedPng(bytes), /claims 30000x30000 texels/);
});

test('chunks that are cut or claim more than the file', { skip }, () => {
  const long = good();
  new DataView(long.buffer, long.byteOffset).setUint32(HEADER, 2 ** 31 - 1);
  assert.throws(() => decodedPng(long), /a chunk claims to be longer than the file/);
  for (let length = 2; length < good().length; ++length) assert.throws(() => decodedPng(good().subarray(0, length)), Error);
});

test('a TIFF whose strip has no bytes', { skip: skip || (existsSync(join(folder, 'node_modules/sharp')) ? false : 'sharp is not there') }, async () => {
  const tags = [[256, 15000], [257, 15000], [258, 8], [259, 1], [262, 1], [273, 8], [277, 1], [278, 15000], [279, 0]];
  const bytes = Buffer.alloc(10 + 12 * tags.length + 4);
  bytes.write('II*\0\x08');
  bytes.writeUInt16LE(tags.length, 8);
  tags.forEach((tag, i) => [tag[0], 4, 1, tag[1]].forEach((value, j) =>
    (j < 2 ? bytes.writeUInt16LE(value, 10 + 12 * i + 2 * j) : bytes.writeUInt32LE(value, 10 + 12 * i + 4 * (j - 1)))));
  const { close, decode } = await import(pathToFileURL(join(folder, 'images.js')).href);
  assert.throws(() => decode(bytes), /claims 15000x15000 texels in 122 bytes/);
  close();
});
