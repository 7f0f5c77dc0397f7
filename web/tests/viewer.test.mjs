// This file tests the viewer of reports in a headless Chromium: its pictures against those of remapc, its controls, and what
// is shown without WebGL.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { loaded, native, repository, skipBrowser, startBrowser } from './browser.mjs';

const remapc = join(dirname(native), 'remapc');
const skip = skipBrowser || ([native, remapc].every(existsSync) ? false : 'texremap and remapc are not built');
const folder = mkdtempSync(join(tmpdir(), 'texremap-viewer-'));
const SIDE = 128;

let browser, decode, encode, shading;

before(async () => {
  if (skip) return;
  ({ decode, encode } = await loaded('fast-png'));
  const { build } = await loaded('esbuild');
  const { outputFiles } = await build({
    entryPoints: [join(repository, 'web/viewer/shading.js')],
    bundle: true, write: false, format: 'iife', globalName: 'shading', loader: { '.glsl': 'text' },
  });
  shading = outputFiles[0].text;
  browser = await startBrowser();
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

const texremap = (...words) => execFileSync(native, ['convert', ...words], { stdio: ['ignore', 'ignore', 'pipe'] });
const dataOf = (file) => JSON.parse(/<script type="application\/json" id="data">(.*?)<\/script>/s.exec(readFileSync(file, 'utf8'))[1]);

// Returns the folder of a set. `values` are functions of the place, 0 to 1, or one value for all texels.
function madeSet(name, values) {
  const set = join(folder, name);
  mkdirSync(set, { recursive: true });
  for (const [role, value] of Object.entries(values)) {
    const side = typeof value === 'function' ? 64 : 4;
    const texels = Array.from({ length: side * side }, (_, i) =>
      (typeof value === 'function' ? value((i % side) / side, Math.floor(i / side) / side) : value));
    writeFileSync(join(set, `a_${role}.png`),
      encode({ width: side, height: side, channels: texels[0].length, depth: 16, data: Uint16Array.from(texels.flat(), (part) => 65535 * part) }));
  }
  return set;
}

// Returns the display values, 0 to 1, of the ball in a column of a sheet that `remapc preview` wrote.
function ballOfSheet(file, column, columns) {
  const { width, height, channels, data } = decode(readFileSync(file));
  const cell = width / columns;
  const margin = [Math.floor((cell - SIDE) / 2), Math.floor((height - SIDE) / 2)];
  return (x, y, c) => data[channels * ((y + margin[1]) * width + x + margin[0] + column * cell) + c] / 255;
}

// Returns the root mean square of the difference over the ball, without the pixels of its edge.
function difference(a, b) {
  let [sum, count] = [0, 0];
  for (let y = 0; y < SIDE; ++y)
    for (let x = 0; x < SIDE; ++x)
      if (Math.hypot(x + 0.5 - SIDE / 2, y + 0.5 - SIDE / 2) < SIDE / 2 - 1.5)
        for (let c = 0; c < 3; ++c, ++count) sum += (a(x, y, c) - b(x, y, c)) ** 2;
  return Math.sqrt(sum / count);
}

// Returns the display values of the converted look as the viewer shades it.
async function shaded(page, report) {
  const [{ looks, normal }] = report.materials;
  const base64 = await page.evaluate(async (side, { light, images }, shown) => {
    const canvas = document.body.appendChild(document.createElement('canvas'));
    canvas.style.cssText = `display: block; width: ${side}px; height: ${side}px`;
    const image = async (index) => index !== undefined && createImageBitmap(
      new Blob([Uint8Array.from(atob(images[index].split(',')[1]), (letter) => letter.charCodeAt(0))]),
      { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
    const maps = {};
    for (const map of ['roughness', 'specular', 'diffuse', 'normal']) maps[map] = await image(shown[map]);
    const shader = new globalThis.shading.Shading(canvas, light);
    const look = { ...shown, ...maps };
    shader.show(look, look);
    shader.draw({ wipe: 1, light: 0, zoom: 1, center: [0, 0], exposure: 0, object: 'ball', isStill: true });
    while (!shader.isFinished) await new Promise(requestAnimationFrame);
    const url = canvas.toDataURL();
    canvas.remove();
    return url.split(',')[1];
  }, SIDE, report, { ...looks.at(-1), normal });
  const { channels, data } = decode(Buffer.from(base64, 'base64'));
  return (x, y, c) => data[channels * (y * SIDE + x) + c] / 255;
}

// Returns the difference of the converted ball between viewer and remapc.
async function differenceToRemapc(page, set, ...words) {
  const [sheet, html] = [join(set, '../sheet.png'), join(set, '../report.html')];
  const ends = words.slice(0, 4);
  execFileSync(remapc, ['preview', set, ...ends, '--no-labels', '--resolution', String(SIDE), '--directions', '6000', '--force', '-o', sheet], { stdio: 'ignore' });
  texremap(set, ...words, '-o', join(folder, 'out'), '--dry-run', '--force', '--report', html);
  const report = dataOf(html);
  const columns = report.materials[0].looks.length;
  return difference(ballOfSheet(sheet, columns - 1, columns), await shaded(page, report));
}

describe('the viewer', { skip }, () => {
  const opened = async (work) => {
    const page = await browser.newPage();
    await page.goto('about:blank');
    await page.addScriptTag({ content: `${shading}; globalThis.shading = shading;` });
    await work(page);
    await page.close();
  };
  for (const model of ['ggx', 'ward', 'ward-duer', 'ward-balanced', 'phong', 'beckmann', 'as'])
    test(`${model} is shaded as remapc shades it`, { timeout: 600000 }, (run) => opened(async (page) => {
      for (const alpha of [0.1, 0.25, 0.5, 0.8]) {
        const set = madeSet(`${model}-${alpha}`, { roughness: [alpha], specular: [0.7, 0.5, 0.3], diffuse: [0.1, 0.2, 0.3] });
        const ends = model === 'ggx' ? ['--from', 'mitsuba/ward', '--to', 'mitsuba/ggx'] : ['--from', 'mitsuba/ggx', '--to', `mitsuba/${model}`];
        const error = await differenceToRemapc(page, set, ...ends, ...(model === 'phong' ? ['--output-encoding', 'exponent=10000'] : []));
        run.diagnostic(`alpha ${alpha}: ${(100 * error).toFixed(2)} % of the display's range`);
        assert.ok(error < 0.005, `${model}, alpha ${alpha}: ${error}`);
      }
    }));

  test('normal maps bend the light as in remapc', { timeout: 600000 }, (run) => opened(async (page) => {
    const wave = (place) => 0.5 + 0.2 * Math.sin(12 * place);
    const set = madeSet('bent', { roughness: [0.5], specular: [0.7, 0.5, 0.3], diffuse: [0.1, 0.2, 0.3], normal_gl: (x, y) => [wave(x), wave(y), 0.95] });
    const error = await differenceToRemapc(page, set, '--from', 'mitsuba/ward', '--to', 'mitsuba/ggx');
    run.diagnostic(`${(100 * error).toFixed(2)} % of the display's range`);
    assert.ok(error < 0.005, `${error}`);
  }));
});

describe('a report', { skip }, () => {
  const html = join(folder, 'copper.html');
  const opened = async (work, ...flags) => {
    if (!existsSync(html)) texremap(join(repository, 'examples/samples/painted_copper.glb'), '-o', join(folder, 'copper.glb'), '--report', html);
    const own = await startBrowser(...flags);
    const page = await own.newPage();
    const [errors, requests] = [[], []];
    page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
    page.on('pageerror', (error) => errors.push(error.message));
    page.on('request', (request) => requests.push(request.url()));
    await page.setViewport({ width: 700, height: 900 });
    await page.goto(pathToFileURL(html).href);
    try {
      await work(page);
      assert.deepEqual(errors, []);
      assert.deepEqual(requests.filter((url) => !/^(blob|data):/.test(url)), [pathToFileURL(html).href]);
    } finally {
      await own.close();
    }
  };
  const finished = async (page) => {
    for (const end = Date.now() + 60000; Date.now() < end; await new Promise((done) => setTimeout(done, 50)))
      if (await page.evaluate(() => globalThis.viewer.isFinished && document.querySelectorAll('#maps figure').length > 0)) return;
    throw new Error('the picture is not finished within 60 s');
  };

  test('has controls that change the picture, by keyboard', () => opened(async (page) => {
    const picture = () => page.$eval('#ball', (canvas) => canvas.toDataURL());
    await finished(page);
    const pictures = [await picture()];
    for (const slider of ['#wipe', '#light', '#zoom', '#exposure']) {
      await page.focus(slider);
      for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowRight');
      await finished(page);  // a frame waits for the one before it
      pictures.push(await picture());
    }
    for (const [select, value] of [['#right', '1'], ['#object', '1']]) {
      await page.select(select, value);
      await finished(page);
      pictures.push(await picture());
    }
    assert.equal(new Set(pictures).size, 7);
  }));

  test('shows the same ball as its still picture', () => opened(async (page) => {
    await finished(page);
    const report = dataOf(html);
    const { rms, ssim, still } = report.materials[0].looks.at(-1);
    assert.ok(rms < 0.02 && ssim > 0.99);
    const error = await page.evaluate(async (url) => {
      const canvas = document.getElementById('ball');
      const image = new Image();
      image.src = url;
      await image.decode();
      const small = document.createElement('canvas');
      small.width = small.height = 100;
      const context = small.getContext('2d', { willReadFrequently: true });
      const read = (source, x, y, width, height) => {
        context.clearRect(0, 0, 100, 100);
        context.drawImage(source, x, y, width, height, 0, 0, 100, 100);
        return context.getImageData(15, 15, 70, 70).data;
      };
      const side = Math.min(canvas.width, canvas.height);
      document.getElementById('wipe').value = 0;
      document.getElementById('wipe').dispatchEvent(new Event('input'));
      const a = read(canvas, (canvas.width - side) / 2, (canvas.height - side) / 2, side, side);
      const b = read(image, 0, 0, image.width, image.height);
      return Math.sqrt(a.reduce((sum, value, i) => sum + (value - b[i]) ** 2, 0) / a.length) / 255;
    }, report.images[still]);
    assert.ok(error < 0.04, `${error}`);  // both have noise
  }));

  test('shows still pictures without WebGL', () => opened(async (page) => {
    assert.match(await page.$eval('#viewer-note', (note) => note.textContent), /no WebGL 2/);
    const stills = await page.$$eval('.view img', (images) => images.map((image) => [image.checkVisibility(), image.naturalWidth, image.alt]));
    assert.deepEqual(stills, [[true, 192, 'painted_copper: source'], [true, 192, 'painted_copper: converted']]);
  }, '--disable-3d-apis'));

  test('names its controls for screen readers', () => opened(async (page) => {
    await finished(page);
    const nodes = [];
    const walk = (node) => {
      nodes.push(node);
      node.children?.forEach(walk);
    };
    walk(await page.accessibility.snapshot());
    const controls = nodes.filter(({ role }) => ['button', 'combobox', 'slider', 'img', 'image'].includes(role));
    assert.ok(controls.length > 15);
    for (const control of controls) assert.ok(control.name, JSON.stringify(control));
  }));

  test('has less than 10 MB for maps of 1024 texels full of detail', () => {
    const [side, set] = [1024, join(folder, 'detail')];
    mkdirSync(set);
    let state = 7;
    const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
    // Every texel differs from its neighbours, as in photographs of stone.
    const noise = (channels, spread) => {
      const data = new Uint8Array(channels * side * side);
      for (let i = 0; i < data.length; ++i)
        data[i] = 128 + 60 * Math.sin(i / 9000 + (i % channels)) + spread * (random() + random() - 1);
      return encode({ width: side, height: side, channels, depth: 8, data });
    };
    for (const [role, channels] of [['baseColor', 3], ['roughness', 1], ['metallic', 1]])
      writeFileSync(join(set, `a_${role}.png`), noise(channels, 40));
    const file = join(folder, 'detail.html');
    texremap(set, '--from', 'blender', '--to', 'threejs', '-o', join(folder, 'detail_out'), '--report', file);
    assert.equal(dataOf(file).materials[0].maps.before[0].width, side);
    assert.ok(statSync(file).size < 10e6, `${statSync(file).size}`);
  });
});
