// This file tests the page in a headless Chromium. Files are given as a person gives them, and downloads are compared with
// what the program of the C++ build writes: images by every value, other files by bytes. If something that a test needs is
// missing, the test is skipped with the reason.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';

import { pngChunks } from '../../packages/tests/png_chunks.mjs';
import { Visit, fileUrl, filesBelow, loaded, native, repository, served, skip, skipNative, startBrowser } from './browser.mjs';

const folder = mkdtempSync(join(tmpdir(), 'texremap-web-'));
const inputs = join(folder, 'inputs');
const hasOiiotool = spawnSync('oiiotool', ['--help']).status === 0;
const skipOiiotool = skipNative || (hasOiiotool ? false : 'oiiotool is not installed (apt-get install openimageio-tools)');

let browser, server, decode, encode, unzipSync;

before(async () => {
  if (skip) return;
  execFileSync('python3', [join(repository, 'packages/tests/make_inputs.py'), inputs, ...(hasOiiotool ? ['oiiotool'] : [])]);
  ({ decode, encode } = await loaded('fast-png'));
  ({ unzipSync } = await loaded('fflate'));
  browser = await startBrowser();
  server = await served();
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true, force: true });
});

const path = (name) => join(inputs, name);

async function visited(url, work) {
  const visit = await Visit.begin(browser, url, join(folder, 'downloads'));
  try {
    await work(visit);
    assert.deepEqual(visit.errors, []);
  } finally {
    await visit.close();
  }
}

// Returns the files of a download, by name.
const filesOf = ({ name, bytes }) => (name.endsWith('.zip') ? unzipSync(bytes) : { [name]: bytes });

// Runs the command that the page shows in the program, on the same files in a folder `in`. Returns { status, err, files }.
async function runProgram(visit, ...names) {
  const work = mkdtempSync(join(folder, 'native-'));
  mkdirSync(join(work, 'in'));
  for (const name of names) execFileSync('cp', ['-r', path(name), join(work, 'in')]);
  const command = await visit.page.$eval('#command', (line) => line.innerText);
  assert.match(command, /^texremap convert in /);
  const { status, stderr } = spawnSync('sh', ['-c', `"$0" ${command.slice('texremap '.length)}`, native], { cwd: work, encoding: 'utf8' });
  const out = join(work, 'out');
  const files = existsSync(out) ? filesBelow(out).filter((file) => file !== '.texremap.jsonl') : [];
  return { status, stderr, files: Object.fromEntries(files.map((file) => [file, new Uint8Array(readFileSync(join(out, file)))])) };
}

async function byProgram(visit, ...names) {
  const { status, stderr, files } = await runProgram(visit, ...names);
  assert.equal(status, 0, stderr);
  return files;
}

function requireSameImage(own, other, place) {
  const [a, b] = [decode(own), decode(other)];
  assert.deepEqual([a.width, a.height, a.channels, a.depth], [b.width, b.height, b.channels, b.depth], place);
  assert.deepEqual(a.data, b.data, place);
  assert.deepEqual(pngChunks(own), pngChunks(other), place);
}

function openGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  const length = view.getUint32(12, true);
  const document = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const binary = bytes.subarray(28 + length);
  const parts = (document.bufferViews ?? []).map(({ byteOffset = 0, byteLength }) => binary.subarray(byteOffset, byteOffset + byteLength));
  const images = new Set((document.images ?? []).map(({ bufferView }) => bufferView));
  // Compressed images may differ in length, so the data after them may be at other places.
  for (const part of document.bufferViews ?? []) delete part.byteOffset;
  for (const image of images) delete document.bufferViews[image].byteLength;
  for (const buffer of document.buffers ?? []) delete buffer.byteLength;
  return { document, parts, images };
}

function requireSameGlb(own, other, place) {
  const [a, b] = [openGlb(own), openGlb(other)];
  assert.equal(JSON.stringify(a.document), JSON.stringify(b.document), place);
  a.parts.forEach((part, i) => {
    if (a.images.has(i)) requireSameImage(part, b.parts[i], `${place}, view ${i}`);
    else assert.deepEqual(part, b.parts[i], `${place}, view ${i}`);
  });
}

// Compares .gltf files exactly, except for the compression of PNG images inside.
function requireSameGltf(own, other, place) {
  const opened = (bytes) => {
    const images = [];
    const text = Buffer.from(bytes).toString().replace(/data:image\/png;base64,([^"]*)/g, (_, image) => `PNG ${images.push(Buffer.from(image, 'base64'))}`);
    return { text, images };
  };
  const [a, b] = [opened(own), opened(other)];
  assert.equal(a.text, b.text, place);
  a.images.forEach((image, i) => requireSameImage(image, b.images[i], `${place}, image ${i}`));
}

function requireSame(own, other) {
  assert.deepEqual(Object.keys(own).sort(), Object.keys(other).sort());
  assert.ok(Object.keys(own).length > 0);
  for (const [name, bytes] of Object.entries(own)) {
    if (name.endsWith('.png')) requireSameImage(bytes, other[name], name);
    else if (name.endsWith('.glb')) requireSameGlb(bytes, other[name], name);
    else if (name.endsWith('.gltf')) requireSameGltf(bytes, other[name], name);
    else assert.deepEqual(bytes, other[name], name);
  }
}

// These are the cases of packages/tests that the page can run. It refuses names that it does not know before a run.
const CASES = JSON.parse(readFileSync(join(repository, 'packages/tests/cases.json'))).filter(
  ({ name, formats, arguments: words }) =>
    words[0] === 'convert' && formats.join() === 'png' && !['an unknown model', 'nothing there'].includes(name));

// Returns what a person chooses on the page for the words of a case.
function choiceOf([, input, ...words]) {
  const choice = { from: '', to: 'gltf', more: [] };
  while (words.length > 0) {
    const word = words.shift();
    if (word === '--from') choice.from = words.shift();
    else if (word === '--to') choice.to = words.shift();
    else if (word === '--layout') choice.to = `${words.shift()} layout`;
    else if (word === '-o') words.shift();
    else if (word !== '--recursive') choice.more.push(word);
  }
  // An asset comes with its files.
  const inputs = input.endsWith('.obj') ? [input, input.replace('.obj', '.mtl')] : [input.split('/')[0]];
  return { inputs, choice: { ...choice, more: choice.more.join(' ') } };
}

describe('a folder that is served', { skip }, () => {
  for (const { name, arguments: words } of CASES)
    test(name, { skip: skipNative }, () =>
      visited(server.url, async (visit) => {
        const { inputs: given, choice } = choiceOf(words);
        await visit.drop(...given.map(path));
        const report = await visit.convert(choice);
        const { status, stderr, files } = await runProgram(visit, ...given);
        assert.equal(/^error/m.test(report), status !== 0, report);
        if (status === 0) requireSame(filesOf(await visit.download()), files);
        else assert.ok(report.includes(stderr.trim().replace(/^texremap: /, '')), report);
        const figures = await visit.page.$$eval('#maps figure', (found) => found.length);
        assert.equal(figures >= 4, status === 0, `${figures} figures`);
      }));

  test('models are told by the names of maps', { skip: skipNative }, () =>
    visited(server.url, async (visit) => {
      await visit.choose('#folder', path('specgloss'));
      assert.match(await visit.convert(), /texremap uses --from gltf-specgloss/);
      requireSame(filesOf(await visit.download()), await byProgram(visit, 'specgloss'));
    }));

  test('a .glb that is dropped, the ball, and sliders by keyboard', { skip: skipNative }, () =>
    visited(server.url, async (visit) => {
      await visit.drop(path('model.glb'));
      assert.match(await visit.convert(), /2 materials converted/);
      requireSame(filesOf(await visit.download()), await byProgram(visit, 'model.glb'));
      const { page } = visit;
      assert.equal(await page.$eval('#ball', (canvas) => canvas.checkVisibility()), true);
      const picture = () => page.$eval('#ball', (canvas) => canvas.toDataURL());
      const pictures = [await picture()];
      for (const slider of ['#wipe', '#light']) {
        await page.focus(slider);
        for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowRight');
        pictures.push(await picture());
      }
      assert.equal(new Set(pictures).size, 3);
      assert.equal(await page.$eval('#wipe', (slider) => slider.value), '54');
      // The page requests only files of its own folder.
      assert.ok(visit.requests.every((url) => url.startsWith(server.url) || /^(blob|data):/.test(url)), visit.requests.join(' '));
    }));

  test('every value of 16 bits', () =>
    visited(server.url, async (visit) => {
      const set = join(folder, 'ramp');
      mkdirSync(set);
      const data = Uint16Array.from({ length: 65536 }, (_, i) => i);
      writeFileSync(join(set, 'a_roughness.png'), encode({ width: 256, height: 256, channels: 1, depth: 16, data }));
      writeFileSync(join(set, 'a_baseColor.png'), encode({ width: 256, height: 256, channels: 3, depth: 16, data: new Uint16Array(3 * 65536).fill(7) }));
      writeFileSync(join(set, 'a_metallic.png'), encode({ width: 256, height: 256, channels: 1, depth: 16, data }));
      await visit.drop(set);
      const report = await visit.convert({ from: 'gltf', to: 'gltf', more: '--output-encoding glossiness --layout separate' });
      const files = filesOf(await visit.download());
      const name = Object.keys(files).find((file) => /(glossiness|roughness)\.png$/.test(file));
      assert.ok(name, report);
      assert.deepEqual(decode(files[name]).data, data.map((value) => 65535 - value));
    }));

  // The pictures have chroma of half the size, an orientation that must be ignored, or only grey.
  for (const [format, decoder] of [['jpg', 'libjpeg-turbo'], ['webp', 'libwebp']])
    test(`every value of ${format}, as ${decoder} decodes it`, { skip: skipOiiotool }, () =>
      visited(server.url, async (visit) => {
        mkdirSync(path(`lossy_${format}`), { recursive: true });
        for (const [name, role] of [['diffuse', 'baseColor'], ['glossiness', 'roughness']])
          execFileSync('oiiotool', [path(`specgloss/tin_${name}.png`), '--resize', '64x48', '--attrib', 'Orientation', '6',
            ...(format === 'webp' ? ['--ch', '0,0,0'] : []), '-o', path(`lossy_${format}/a_${role}.${format}`)]);
        await visit.choose('#folder', path(`lossy_${format}`));
        // Source and target have the same material, so the stored values do not change.
        assert.doesNotMatch(await visit.convert({ from: 'gltf', to: 'gltf', more: '--layout separate --metallic 0' }), /^error/m);
        requireSame(filesOf(await visit.download()), await byProgram(visit, `lossy_${format}`));
      }));

  test('JPEG inside of a glTF file', { skip: skipOiiotool }, () =>
    visited(server.url, async (visit) => {
      const asset = path('embedded');
      mkdirSync(asset);
      execFileSync('oiiotool', [path('asset/diffuse.png'), '--ch', 'R,G,B', '-o', join(folder, 'diffuse.jpg')]);
      const document = JSON.parse(readFileSync(path('asset/model.gltf')));
      document.images = ['diffuse.jpg', 'specgloss.png'].map((name) => {
        const bytes = readFileSync(name.endsWith('.jpg') ? join(folder, name) : path(`asset/${name}`));
        return { uri: `data:image/${name.endsWith('.jpg') ? 'jpeg' : 'png'};base64,${bytes.toString('base64')}` };
      });
      writeFileSync(join(asset, 'model.gltf'), JSON.stringify(document));
      await visit.drop(join(asset, 'model.gltf'));
      assert.match(await visit.convert(), /2 materials converted/);
      requireSame(filesOf(await visit.download()), await byProgram(visit, 'embedded/model.gltf'));
    }));

  test('EXR is refused by name, with what to do', () =>
    visited(server.url, async (visit) => {
      const set = join(folder, 'exr');
      mkdirSync(set);
      for (const role of ['roughness', 'specular']) writeFileSync(join(set, `a_${role}.exr`), Uint8Array.of(0x76, 0x2f, 0x31, 1, 2, 0, 0, 0));
      await visit.drop(set);
      const report = await visit.convert({ from: 'mitsuba/ward', to: 'mitsuba/ggx' });
      assert.match(report, /a_roughness\.exr: EXR is not read by this page \(use the Debian or the Python package\)/);
      assert.equal(await visit.page.$eval('#download', (link) => link.hidden), true);
    }));

  test('a mistake is answered, and the page goes on', () =>
    visited(server.url, async (visit) => {
      await visit.drop(path('specgloss'));
      assert.match(await visit.convert({ more: '--sepcular 0.04' }), /did you mean/);
      assert.doesNotMatch(await visit.convert(), /^error/m);
    }));

  test('names for screen readers', () =>
    visited(server.url, async (visit) => {
      const { page } = visit;
      await visit.drop(path('model.glb'));
      await visit.convert();
      const nodes = [];
      const walk = (node) => {
        nodes.push(node);
        node.children?.forEach(walk);
      };
      walk(await page.accessibility.snapshot());
      const controls = nodes.filter(({ role }) => ['button', 'combobox', 'slider', 'textbox', 'link', 'img', 'image'].includes(role));
      assert.ok(controls.length > 10);
      for (const control of controls) assert.ok(control.name, JSON.stringify(control));
      assert.equal(await page.$eval('#report', (report) => report.getAttribute('aria-live')), 'polite');
    }));
});

test('one file from disk', { skip: skipNative }, async (run) => {
  const start = Date.now();
  await visited(fileUrl(), async (visit) => {
    await visit.drop(path('deep'));
    await visit.convert({ from: 'mitsuba/ward', to: 'mitsuba/as' });
    await visit.download();
    run.diagnostic(`${(Date.now() - start) / 1000} s from a new tab to the first set on disk`);
    for (const name of ['model.glb', 'specgloss']) {
      await visit.drop(path(name));
      assert.doesNotMatch(await visit.convert(), /^error/m);
      requireSame(filesOf(await visit.download()), await byProgram(visit, name));
    }
    assert.ok(visit.requests.every((url) => url === fileUrl() || /^(blob|data):/.test(url)), visit.requests.join(' '));
  });
});
