// These tests compare the command of the package with the program of the C++ build: the cases of packages/tests in PNG.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { cpSync, existsSync, readFileSync, readlinkSync, truncateSync, writeFileSync } from 'node:fs';
import { hostname } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';

import { cases, copyOfInputs, filesBelow, folder, requireSame, requireSameResults, runNative, runOwn, startOwn } from './commands.mjs';
import { packageFolder } from './package.mjs';

// sharp.test.mjs tests JPEG and TIFF.
const own = ['png', 'jpg', 'tif'];
for (const one of cases) {
  const others = one.formats.filter((format) => !own.includes(format));
  if (others.length > 0) test(one.name, { skip: `the package does not read or write ${others}` }, () => {});
  else if (one.formats.every((format) => format === 'png')) test(one.name, () => requireSame(one));
}

test('help and refusals are those of the program', () => {
  assert.match(runOwn(['--help']).stdout, /Convert textures and materials/);
  const wrong = runOwn(['convert', '--from', 'mitsuba/wrd']);
  assert.notEqual(wrong.status, 0);
  assert.match(wrong.stderr, /^texremap: /);
});

test('files of other formats are refused by name', () => {
  writeFileSync(join(folder, 'map.exr'), Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]));
  const refused = runOwn(['convert', '--from', 'mitsuba/ward', '--to', 'mitsuba/ggx', '--roughness', 'map.exr', '--specular', '0.5', '-o', 'out']);
  assert.equal(refused.status, 1);
  assert.match(refused.stderr, /EXR is not read by the package for node/);
});

test('without sharp, a JPEG is refused with what to type', () => {
  for (const [place, words] of [['node_modules', 'npm install'], ['lib/node_modules', 'npm install --global']]) {
    const copy = join(folder, 'without', place, 'texremap');
    // Leaves out the program that gltf_transform.test.mjs writes and removes meanwhile.
    cpSync(packageFolder, copy, { recursive: true, filter: (path) => !/node_modules.(sharp|@img)$|example_\d+\.mjs$/.test(path) });
    writeFileSync(join(folder, 'map.jpg'), Buffer.from([0xff, 0xd8, 0xff, 0xe0]));
    const refused = spawnSync(process.execPath, [join(copy, 'cli.js'), 'convert', '--from', 'mitsuba/ward', '--to', 'mitsuba/ggx', '--roughness', 'map.jpg',
      '--specular', '0.5', '-o', 'out'], { encoding: 'utf8', cwd: folder });
    assert.equal(refused.status, 1);
    assert.ok(refused.stderr.includes(`map.jpg: cannot be read: JPEG, WebP and TIFF need sharp, which is not installed (${words} --include=optional sharp)`), refused.stderr);
  }
});

test('files too large for memory are refused by name, with a remedy', () => {
  const copy = copyOfInputs();
  truncateSync(join(copy, 'deep', 'deep_specular.png'), 5 * 2 ** 30);
  const refused = runOwn(['convert', 'deep', '--from', 'mitsuba/ward', '--to', 'mitsuba/as', '-o', 'out'], copy);
  assert.equal(refused.status, 1);
  assert.match(refused.stderr, /deep_specular.png: has 5120 MB, and .* \(use the Debian or the Python package\)/);
});

const library = ['convert', 'library', '--recursive', '--from', 'mitsuba/ward', '--to', 'mitsuba/as', '--roughness-encoding', 'roughness', '-o', 'out'];

test('the processor time is that of node', () => {
  const done = runOwn([...library, '--json', '--verbose'], copyOfInputs());
  const seconds = Number(/([0-9.]+) s of processor time/.exec(done.stderr)[1]);
  assert.ok(seconds > 0 && seconds < 3, done.stderr);
});

test('two commands at once in one folder give what one gives', async () => {
  const [together, alone] = [copyOfInputs(), copyOfInputs()];
  assert.deepEqual(await Promise.all([1, 2].map(() => startOwn([...library, '--force'], together))), [0, 0]);
  assert.equal(runOwn(library, alone).status, 0);
  await requireSameResults(together, alone);
});

// Computes FNV-1a like runtime/core/files.cpp.
function tagOfMachine() {
  let hash = 0x811c9dc5;
  for (const byte of Buffer.from(`${hostname()}/${readFileSync('/proc/sys/kernel/random/boot_id')}/${readlinkSync('/proc/self/ns/pid')}`)) hash = Math.imul(hash ^ byte, 0x01000193);
  return (hash >>> 0).toString(16).padStart(8, '0');
}

test('unfinished files of processes that have ended go, by either program; those of others stay', { skip: process.platform !== 'linux' && 'has no /proc' }, () => {
  const noProcess = 2 ** 30;
  for (const run of [runOwn, runNative]) {
    const copy = copyOfInputs();
    const name = (process) => join(copy, 'library', `.a.unfinished-${tagOfMachine()}-${process}-abc.png`);
    for (const number of [noProcess, process.pid]) writeFileSync(name(number), '');
    run(['convert', 'deep', '--from', 'mitsuba/ward', '--to', 'mitsuba/as', '-o', 'library'], copy);
    assert.deepEqual([existsSync(name(noProcess)), existsSync(name(process.pid))], [false, true], filesBelow(copy).join(' '));
  }
});
