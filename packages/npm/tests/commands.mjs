// This file compares the command of the package with the program of the C++ build (TEXREMAP_NATIVE), over copies of the
// same inputs.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

import { pngChunks } from '../../tests/png_chunks.mjs';
import { needFile, needPackage } from './needs.mjs';
import { packageFolder, sourceFolder } from './package.mjs';

const native = needFile(process.env.TEXREMAP_NATIVE, 'cmake --preset release && cmake --build --preset release, or set TEXREMAP_NATIVE');
const cli = needFile(join(packageFolder, 'cli.js'), 'cmake --build --preset wasm');
needFile(join(packageFolder, 'program.wasm'), 'cmake --build --preset wasm');
const png = await needPackage('fast-png');

export const folder = mkdtempSync(join(tmpdir(), 'texremap-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const hasOiiotool = spawnSync('oiiotool', ['--help']).status === 0;
const inputs = join(folder, 'inputs');
const shared = join(sourceFolder, 'packages', 'tests');
const making = spawnSync('python3', [join(shared, 'make_inputs.py'), inputs, ...(hasOiiotool ? ['oiiotool'] : [])], { encoding: 'utf8' });
assert.equal(making.status, 0, making.stderr);

/** The cases of the shared list (packages/tests). */
export const cases = JSON.parse(readFileSync(join(shared, 'cases.json'), 'utf8'));
/** Why a case cannot be run here; false where it can. */
export const missing = ({ formats }) => (formats.some((format) => format !== 'png') && !hasOiiotool ? 'oiiotool makes the inputs' : false);

/** A new copy of the inputs. */
export function copyOfInputs() {
  const copy = mkdtempSync(join(folder, 'copy-'));
  cpSync(inputs, copy, { recursive: true });
  return copy;
}

export const runOwn = (words, cwd = folder) => spawnSync(process.execPath, [cli, ...words], { encoding: 'utf8', cwd });
export const runNative = (words, cwd) => spawnSync(native, words, { encoding: 'utf8', cwd });
/** The exit code, later. */
export const startOwn = (words, cwd) =>
  new Promise((end) => spawn(process.execPath, [cli, ...words], { cwd, stdio: 'ignore' }).on('close', end));

export function filesBelow(root, below = '') {
  return readdirSync(join(root, below), { withFileTypes: true })
    .flatMap((entry) => (entry.isDirectory() ? filesBelow(root, join(below, entry.name)) : [join(below, entry.name)]))
    .sort();
}

// Returns what a PNG file holds around the picture: its chunks, its size in the world, notes. OpenImageIO adds its own
// notes.
function aroundPicture(file) {
  const notes = [];
  for (let at = 8; at + 12 <= file.length; at += 12 + file.readUInt32BE(at)) {
    const name = file.toString('latin1', at + 4, at + 8);
    const data = file.subarray(at + 8, at + 8 + file.readUInt32BE(at));
    if (name === 'pHYs' || (name === 'tEXt' && !data.toString('latin1').startsWith('oiio:'))) notes.push(`${name} ${data.toString('latin1')}`);
  }
  return { notes: notes.sort(), chunks: pngChunks(file) };
}

// These functions compare files of a format, by extension: values of images, and the other content.
const readers = { '.png': (bytes) => ({ ...aroundPicture(bytes), ...pngValues(bytes) }) };

/** The values of a PNG file. */
export function pngValues(bytes) {
  const { width, height, channels, depth, data } = png.decode(bytes);
  return { width, height, channels, depth, data };
}

/** Sets the reader of images: an object with `width`, `height`, `channels`, `depth` and `data` of the bytes of a file. */
export function setReader(extension, reader) {
  readers[extension] = reader;
}

async function requireSameImage(extension, own, other, name) {
  const [a, b] = [await readers[extension](own), await readers[extension](other)];
  const [{ data, ...layout }, { data: otherData, ...otherLayout }] = [a, b];
  assert.deepEqual(layout, otherLayout, name);
  assert.ok(Buffer.from(data.buffer, data.byteOffset, data.byteLength)
    .equals(Buffer.from(otherData.buffer, otherData.byteOffset, otherData.byteLength)), `values of ${name}`);
}

// Returns the document of a .glb without parts that depend on the sizes of encoded images, and these images.
function partsOfGlb(file) {
  const length = file.readUInt32LE(12);
  const document = JSON.parse(file.toString('utf8', 20, 20 + length));
  const binary = file.subarray(20 + length + 8);
  const views = document.bufferViews ?? [];
  const images = (document.images ?? []).filter((image) => 'bufferView' in image).map((image) => {
    const view = views[image.bufferView];
    const begin = view.byteOffset ?? 0;
    const bytes = binary.subarray(begin, begin + view.byteLength);
    delete view.byteLength;
    return { bytes, extension: image.mimeType === 'image/jpeg' ? '.jpg' : '.png' };
  });
  for (const view of views) delete view.byteOffset;
  for (const buffer of document.buffers ?? []) delete buffer.byteLength;
  return { document, images };
}

async function requireSameGlb(own, other, name) {
  const [a, b] = [partsOfGlb(own), partsOfGlb(other)];
  assert.deepEqual(a.document, b.document, name);
  for (const [i, { bytes, extension }] of a.images.entries()) await requireSameImage(extension, bytes, b.images[i].bytes, name);
}

async function requireSameFile(name, own, other) {
  if (extname(name) in readers) await requireSameImage(extname(name), own, other, name);
  else if (name.endsWith('.glb')) await requireSameGlb(own, other, name);
  else assert.equal(own.toString('latin1'), other.toString('latin1'), name);
}

// Returns the lines of a report, without times and in an order that does not depend on threads.
const comparable = (text) =>
  text.split('\n').sort().join('\n').replace(/"seconds": [0-9.e-]+/g, '"seconds": 0').replace(/[0-9.]+ s\b/g, '0 s');

/** What two commands left in `out` of two folders is equal. */
export async function requireSameResults(own, other) {
  const files = filesBelow(own);
  assert.deepEqual(files, filesBelow(other));
  // Skip the journal, because it has hashes of encoded files.
  for (const file of files.filter((name) => name.startsWith('out') && !name.endsWith('.texremap.jsonl')))
    await requireSameFile(file, readFileSync(join(own, file)), readFileSync(join(other, file)));
}

/** Runs both in copies of the inputs; what they say and leave behind is equal. */
export async function requireSame({ arguments: words }, prepare = () => {}) {
  const [own, other] = [copyOfInputs(), copyOfInputs()];
  for (const copy of [own, other]) await prepare(copy);
  const [a, b] = [runOwn(words, own), runNative(words, other)];
  assert.equal(comparable(a.stderr), comparable(b.stderr));
  assert.equal(comparable(a.stdout), comparable(b.stdout));
  assert.equal(a.status, b.status);
  await requireSameResults(own, other);
  for (const copy of [own, other]) rmSync(copy, { recursive: true });
}
