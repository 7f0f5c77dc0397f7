// This file tests remapMaterials() of the package for node, bundled for a browser. On a document of glTF-Transform, it must
// give images with the same values as in node.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, writeFileSync, mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

import { loaded, repository, skip, startBrowser } from './browser.mjs';

const npm = process.env.TEXREMAP_PACKAGE ?? join(repository, 'build/wasm/npm');
const needed = ['program_memory.mjs', 'node_modules/@gltf-transform/extensions'].find((name) => !existsSync(join(npm, name)));
const reason = skip || (needed ? `${needed} is not in ${npm} (scripts/package npm, then packages/npm/tests/install.bash)` : false);

// This program runs in the page and in node. It converts a document of one material and returns the images.
const PROGRAM = `
import { Document } from '@gltf-transform/core';
import { KHRMaterialsPBRSpecularGlossiness } from '@gltf-transform/extensions';
import { decode, encode } from 'fast-png';
import { remapMaterials } from 'PACKAGE/gltf_transform.js';

export async function converted(options, jpeg) {
  const document = new Document();
  const extension = document.createExtension(KHRMaterialsPBRSpecularGlossiness);
  const data = (channels) => Uint8Array.from({ length: 64 * channels }, (_, i) => (i * 37) % 251);
  const texture = (channels) =>
    document.createTexture().setMimeType('image/png').setImage(encode({ width: 8, height: 8, channels, depth: 8, data: data(channels) }));
  const diffuse = jpeg ? document.createTexture().setMimeType('image/jpeg').setImage(jpeg) : texture(3);
  const gloss = extension.createPBRSpecularGlossiness().setDiffuseTexture(diffuse).setSpecularGlossinessTexture(texture(4));
  document.createMaterial('paint').setExtension('KHR_materials_pbrSpecularGlossiness', gloss);
  await document.transform(remapMaterials({ from: 'gltf-specgloss', to: 'gltf', ...options }));
  const images = document.getRoot().listTextures().slice(2).map((texture) => decode(texture.getImage()));
  return images.map(({ width, height, channels, data }) => ({ width, height, channels, data: [...data] }));
}
`;

test('a document in a browser', { skip: reason }, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'texremap-document-'));
  const { build } = await loaded('esbuild');
  await build({
    stdin: { contents: `${PROGRAM.replace('PACKAGE', npm)} window.converted = converted;`, resolveDir: npm },
    bundle: true,
    format: 'esm',
    external: ['node:*'],  // glTF-Transform and the package load these only in node
    outfile: join(folder, 'page.js'),
    logLevel: 'error',
  });
  // Node loads the files of the package without a bundle.
  const program = join(npm, `document_${process.pid}.mjs`);
  writeFileSync(program, PROGRAM.replace('PACKAGE', '.'));
  const files = { '/page.js': join(folder, 'page.js'), '/program.wasm': join(npm, 'program.wasm') };
  const server = createServer(({ url }, response) => {
    response.setHeader('content-type', url.endsWith('.js') ? 'text/javascript' : url.endsWith('.wasm') ? 'application/wasm' : 'text/html');
    response.end(files[url] ? readFileSync(files[url]) : '<!doctype html><script type="module" src="/page.js"></script>');
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const browser = await startBrowser();
  try {
    const page = await browser.newPage();
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    await page.waitForFunction(() => window.converted !== undefined);
    const own = await page.evaluate(() => window.converted({ program: '/program.wasm' }));
    const { converted } = await import(pathToFileURL(program).href);
    assert.equal(own.length, 2);
    assert.deepEqual(own, await converted({}));
    const ofJpeg = await page.evaluate(async () => {
      const canvas = new OffscreenCanvas(8, 8);
      const context = canvas.getContext('2d');
      context.fillStyle = '#804020';
      context.fillRect(0, 0, 8, 8);
      const blob = await canvas.convertToBlob({ type: 'image/jpeg' });
      return window.converted({ program: '/program.wasm' }, new Uint8Array(await blob.arrayBuffer()));
    });
    assert.deepEqual(ofJpeg.map(({ width, height }) => [width, height]), [[8, 8], [8, 8]]);
  } finally {
    await browser.close();
    server.close();
    rmSync(program);
    rmSync(folder, { recursive: true });
  }
});
