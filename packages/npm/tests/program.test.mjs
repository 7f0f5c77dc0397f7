// The command of the package against the program of the C++ build, over the same sets and assets: pixels are equal.
// TEXREMAP_NATIVE is that program. What is missing is skipped, with its reason.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { pathToFileURL } from 'node:url';

import { packageFolder, randomArray, randomNumbers } from './package.mjs';

function png() {
  try {
    return createRequire(join(packageFolder, 'cli.js')).resolve('fast-png');
  } catch {
    return undefined;
  }
}
const native = process.env.TEXREMAP_NATIVE;
const skip = !existsSync(join(packageFolder, 'program.wasm')) ? 'program.wasm is not built'
  : png() === undefined ? `fast-png is not installed (cd ${packageFolder} && npm install)`
  : false;
const skipNative = skip || (native ? false : 'TEXREMAP_NATIVE names no program');
const { decode, encode } = skip ? {} : await import(pathToFileURL(png()).href);

const folder = mkdtempSync(join(tmpdir(), 'texremap-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));

const runOwn = (...words) => spawnSync(process.execPath, [join(packageFolder, 'cli.js'), ...words], { encoding: 'utf8', cwd: folder });
const runNative = (...words) => execFileSync(native, words, { encoding: 'utf8', cwd: folder, stdio: 'pipe' });

function writePng(file, width, height, channels, depth, random) {
  const data = randomArray(depth === 16 ? Uint16Array : Uint8Array, width * height * channels, random);
  writeFileSync(file, encode({ width, height, channels, depth, data }));
}

function filesBelow(root, below = '') {
  return readdirSync(join(root, below), { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesBelow(root, join(below, entry.name)) : [join(below, entry.name)]).sort();
}

function requireSamePixels(own, other) {
  const files = filesBelow(own);
  assert.deepEqual(files, filesBelow(other));
  assert.ok(files.length > 0);
  for (const file of files) {
    const a = readFileSync(join(own, file));
    const b = readFileSync(join(other, file));
    if (!file.endsWith('.png')) continue;
    const [x, y] = [decode(a), decode(b)];
    assert.deepEqual([x.width, x.height, x.channels, x.depth], [y.width, y.height, y.channels, y.depth], file);
    assert.deepEqual(x.data, y.data, file);
  }
}

function makeSets() {
  const random = randomNumbers(7);
  const root = join(folder, 'sets');
  if (existsSync(root)) return root;
  for (const [set, depth] of [['metal', 8], ['paint', 16]]) {
    mkdirSync(join(root, set), { recursive: true });
    writePng(join(root, set, `${set}_diffuse.png`), 37, 21, 3, depth, random);
    writePng(join(root, set, `${set}_specular.png`), 37, 21, 3, depth, random);
    writePng(join(root, set, `${set}_glossiness.png`), 37, 21, 1, depth, random);
  }
  return root;
}

test('help and refusals are those of the program', { skip }, () => {
  assert.match(runOwn('--help').stdout, /Convert texture maps/);
  const wrong = runOwn('convert', '--from', 'mitsuba/wrd');
  assert.notEqual(wrong.status, 0);
  assert.match(wrong.stderr, /^texremap: /);
});

test('files of other formats are refused by name', { skip }, () => {
  writeFileSync(join(folder, 'map.exr'), Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]));
  const refused = runOwn('convert', '--from', 'mitsuba/ward', '--to', 'mitsuba/ggx', '--roughness', 'map.exr', '--specular', '0.5', '-o', 'out');
  assert.equal(refused.status, 1);
  assert.match(refused.stderr, /EXR is not read by the package for node/);
});

for (const [from, to] of [['gltf-specgloss', 'gltf'], ['specular', 'cycles-5/principled']])
  test(`sets, ${from} to ${to}: the pixels of the program`, { skip: skipNative }, () => {
    const sets = makeSets();
    const name = to.replace('/', '_');
    const words = (out) => ['convert', sets, '--recursive', '--from', from, '--to', to, '-o', join(folder, out)];
    runNative(...words(`native_${name}`));
    const own = runOwn(...words(`own_${name}`));
    assert.equal(own.status, 0, own.stderr);
    requireSamePixels(join(folder, `own_${name}`), join(folder, `native_${name}`));
  });

test('a glTF file: the JSON and the pixels of the program', { skip: skipNative }, () => {
  const random = randomNumbers(9);
  const root = join(folder, 'asset');
  mkdirSync(root);
  writePng(join(root, 'diffuse.png'), 16, 16, 3, 8, random);
  writePng(join(root, 'specgloss.png'), 16, 16, 4, 8, random);
  writeFileSync(join(root, 'model.gltf'), JSON.stringify({
    asset: { version: '2.0' },
    extensionsUsed: ['KHR_materials_pbrSpecularGlossiness'],
    images: [{ uri: 'diffuse.png' }, { uri: 'specgloss.png' }],
    textures: [{ source: 0 }, { source: 1 }],
    materials: [{
      name: 'm',
      extensions: { KHR_materials_pbrSpecularGlossiness: { diffuseTexture: { index: 0 }, specularGlossinessTexture: { index: 1 } } },
    }],
  }));
  const words = (out) => ['convert', join(root, 'model.gltf'), '--to', 'gltf', '-o', join(folder, out)];
  runNative(...words('native_asset'));
  const own = runOwn(...words('own_asset'));
  assert.equal(own.status, 0, own.stderr);
  requireSamePixels(join(folder, 'own_asset'), join(folder, 'native_asset'));
  for (const file of filesBelow(join(folder, 'own_asset')).filter((name) => name.endsWith('.gltf')))
    assert.deepEqual(JSON.parse(readFileSync(join(folder, 'own_asset', file))), JSON.parse(readFileSync(join(folder, 'native_asset', file))));
});
