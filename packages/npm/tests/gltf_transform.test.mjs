// These tests compare remapMaterials() on documents of glTF-Transform with the program of the C++ build on the same files.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import test from 'node:test';

import { folder, pngValues, runNative } from './commands.mjs';
import { needPackage } from './needs.mjs';
import { packageFolder, randomNumbers, sourceFolder } from './package.mjs';

const [core, extensions, png] = [await needPackage('@gltf-transform/core'), await needPackage('@gltf-transform/extensions'), await needPackage('fast-png')];
const { Document, Format, Logger, NodeIO } = core;
const { remapMaterials } = await import(pathToFileURL(join(packageFolder, 'gltf_transform.js')).href);

const io = new NodeIO().setLogger(new Logger(Logger.Verbosity.ERROR)).registerExtensions(extensions.ALL_EXTENSIONS);
const assets = join(sourceFolder, '../shared/data/assets');
const TO_CORE = { from: 'gltf-specgloss', to: 'gltf' };
const GLOSS = 'KHR_materials_pbrSpecularGlossiness';

const isPng = (bytes) => bytes[0] === 0x89 && bytes[1] === 0x50;
const valuesOf = (bytes) => (isPng(bytes) ? pngValues(bytes) : Buffer.from(bytes));

// Returns materials as JSON, with the image and the sampler of each texture instead of its index.
async function materialsOf(document) {
  const { json, resources } = await io.writeJSON(document, { format: Format.GLTF });
  const visit = (value) => {
    if (Array.isArray(value)) return value.map(visit);
    if (typeof value !== 'object' || value === null) return value;
    const entries = Object.entries(value).filter(([key]) => key !== 'extras').map(([key, entry]) => [key, visit(entry)]);
    const { index, ...visited } = Object.fromEntries(entries);
    if (index === undefined) return visited;
    const texture = json.textures[index];
    const source = Object.values(texture.extensions ?? {})[0]?.source ?? texture.source;
    return { ...visited, image: valuesOf(resources[json.images[source].uri]), sampler: json.samplers[texture.sampler] };
  };
  return (json.materials ?? []).map((material) => ({ ...visit(material), extras: material.extras }));
}

function requireClose(own, other, place) {
  if (typeof own === 'number' && typeof other === 'number') return assert.ok(Math.abs(own - other) <= 1e-6, `${place}: ${own}, ${other}`);
  if (typeof own !== 'object' || own === null || ArrayBuffer.isView(own)) return assert.deepEqual(own, other, place);
  assert.deepEqual(Object.keys(own).sort(), Object.keys(other).sort(), place);
  for (const key of Object.keys(own)) requireClose(own[key], other[key], `${place}/${key}`);
}

// Returns the objects of the document that are neither materials nor textures, separately.
const othersOf = (document) => {
  const root = document.getRoot();
  return [...root.listScenes(), ...root.listNodes(), ...root.listMeshes(), ...root.listMeshes().flatMap((mesh) => mesh.listPrimitives()),
    ...root.listAccessors(), ...root.listBuffers(), ...root.listAnimations(), ...root.listSkins(), ...root.listCameras(), ...root.listMaterials()];
};
const labelsOf = (properties) => properties.map((property) => [property.getName(), JSON.stringify(property.getExtras())]);

async function requireSameAsCommand(file, options, words) {
  const out = mkdtempSync(join(folder, 'document-'));
  const command = runNative(['convert', file, ...words, '-o', out], dirname(file));
  assert.equal(command.status, 0, command.stderr);
  const [own, expected] = [await io.read(file), await io.read(join(out, basename(file)))];
  const [others, textures] = [othersOf(own), own.getRoot().listTextures()];
  const labels = labelsOf(others);
  await own.transform(remapMaterials(options));
  requireClose(await materialsOf(own), await materialsOf(expected), file);
  assert.deepEqual(labelsOf(othersOf(own)), labels);
  assert.ok(othersOf(own).every((property, i) => property === others[i]));
  assert.ok(textures.every((texture, i) => own.getRoot().listTextures()[i] === texture));
  assert.deepEqual(own.getRoot().listExtensionsUsed().map((one) => one.extensionName).sort(), expected.getRoot().listExtensionsUsed().map((one) => one.extensionName).sort());

  const before = await io.writeJSON(own, { format: Format.GLTF });
  await own.transform(remapMaterials(options));
  assert.deepEqual(await io.writeJSON(own, { format: Format.GLTF }), before);
}

const glossFiles = () => {
  const found = ['box_specgloss/BoxTextured.gltf', 'gltf/04_sphere_specular_glossiness/04_sphere_specular_glossiness.gltf'].map((name) => join(assets, name));
  const specgloss = join(assets, 'specgloss');
  for (const name of existsSync(specgloss) ? readdirSync(specgloss, { recursive: true }) : [])
    if (/\.(gltf|glb)$/.test(name)) found.push(join(specgloss, name));
  return found;
};

for (const file of glossFiles())
  for (const extensions of [undefined, 'write'])
    test(`${basename(file)}, ${extensions ? 'with' : 'without'} extensions`, { skip: !existsSync(file) && `${file} is not there` }, () =>
      requireSameAsCommand(file, { ...TO_CORE, extensions }, ['--to', 'gltf', ...(extensions ? ['--extensions', extensions] : [])]));

for (const name of ['01_alpha_mask', '08_combine_orm'].map((one) => join(assets, 'gltf', one, `${one}.gltf`)))
  test(`${basename(name)} to spec-gloss`, { skip: !existsSync(name) && `${name} is not there` }, () =>
    requireSameAsCommand(name, { from: 'gltf', to: 'gltf-specgloss' }, ['--to', 'gltf-specgloss']));

// Returns a document of materials with factors, one with maps, and one that is not spec-gloss, without URIs.
function generated(seed, count = 3) {
  const random = randomNumbers(seed);
  const document = new Document().setLogger(new Logger(Logger.Verbosity.SILENT));
  document.createBuffer();
  const gloss = document.createExtension(extensions.KHRMaterialsPBRSpecularGlossiness);
  const clearcoat = document.createExtension(extensions.KHRMaterialsClearcoat);
  const image = (channels) => {
    const data = Uint8Array.from({ length: 8 * 8 * channels }, () => Math.floor(random() * 256));
    return png.encode({ width: 8, height: 8, channels, depth: 8, data });
  };
  const color = () => [random(), random(), random()];
  const texture = (name, channels) => document.createTexture(name).setImage(image(channels)).setMimeType('image/png').setExtras({ own: name });
  for (let i = 0; i < count; ++i) {
    const property = gloss.createPBRSpecularGlossiness().setDiffuseFactor([...color(), random()]).setSpecularFactor(color()).setGlossinessFactor(random());
    if (i === 0) property.setDiffuseTexture(texture('paint', 4)).setSpecularGlossinessTexture(texture('shine', 4));
    document.createMaterial(`material ${i}`).setExtras({ studio: { id: i } }).setAlphaMode('BLEND').setDoubleSided(i === 1)
      .setEmissiveFactor(color()).setExtension(GLOSS, property).setExtension('KHR_materials_clearcoat', clearcoat.createClearcoat().setClearcoatFactor(random()));
  }
  document.createMaterial('metal').setMetallicFactor(1).setRoughnessFactor(0.3).setBaseColorTexture(texture('base', 3));
  const positions = document.createAccessor().setType('VEC3').setArray(Float32Array.from({ length: 9 }, random));
  const primitive = document.createPrimitive().setMaterial(document.getRoot().listMaterials()[0]).setAttribute('POSITION', positions);
  document.createScene().addChild(document.createNode('node').setMesh(document.createMesh('mesh').addPrimitive(primitive)));
  return document;
}

for (const seed of [1, 2, 3])
  test(`a generated document, ${seed}`, async () => {
    const file = join(mkdtempSync(join(folder, 'generated-')), 'generated.gltf');
    await io.write(file, generated(seed));
    await requireSameAsCommand(file, TO_CORE, ['--to', 'gltf']);
    const own = generated(seed);
    const coats = own.getRoot().listMaterials().map((material) => material.getExtension('KHR_materials_clearcoat'));
    await own.transform(remapMaterials(TO_CORE));
    const read = await io.read(file);
    await read.transform(remapMaterials(TO_CORE));
    requireClose(await materialsOf(own), await materialsOf(read), 'without URIs');
    assert.ok(own.getRoot().listMaterials().every((material, i) => material.getExtension('KHR_materials_clearcoat') === coats[i]));
    assert.equal(own.getRoot().listMaterials()[1].getExtras().studio.id, 1);
    assert.equal(own.getRoot().listMaterials()[0], own.getRoot().listMeshes()[0].listPrimitives()[0].getMaterial());
    assert.equal((await io.readBinary(await io.writeBinary(own))).getRoot().listMaterials().length, 4);
  });

test('JPEG by sharp', async () => {
  const sharp = (await needPackage('sharp')).default;
  const document = generated(10, 1);
  const pixels = Uint8Array.from({ length: 64 * 3 }, (_, i) => (i * 29) % 256);
  const jpeg = await sharp(pixels, { raw: { width: 8, height: 8, channels: 3 } }).jpeg({ quality: 95 }).toBuffer();
  document.getRoot().listMaterials()[0].getExtension(GLOSS).getDiffuseTexture().setImage(new Uint8Array(jpeg)).setMimeType('image/jpeg');
  const file = join(mkdtempSync(join(folder, 'jpeg-')), 'generated.gltf');
  await io.write(file, document);
  await requireSameAsCommand(file, TO_CORE, ['--to', 'gltf']);
});

test('a codec that takes its time gives the same', async () => {
  const own = await import(pathToFileURL(join(packageFolder, 'images.js')).href);
  const calls = [];
  const slow = (name) => async (...given) => {
    calls.push(name);
    await new Promise((done) => setTimeout(done, 5));
    return own[name](...given);
  };
  const [document, expected] = [generated(7), generated(7)];
  await document.transform(remapMaterials({ ...TO_CORE, codec: { decode: slow('decode'), encode: slow('encode') } }));
  await expected.transform(remapMaterials(TO_CORE));
  assert.deepEqual(await materialsOf(document), await materialsOf(expected));
  assert.deepEqual(calls.sort(), ['decode', 'decode', 'encode', 'encode']);
});

test('textures with one URI, or with one outside of the folder', async () => {
  const [document, expected] = [generated(8), generated(8)];
  const uris = ['../up.png', 'C:\\one.png', 'C:\\one.png'];
  document.getRoot().listTextures().forEach((texture, i) => texture.setURI(uris[i]));
  for (const one of [document, expected]) await one.transform(remapMaterials(TO_CORE));
  const [own, others] = [document, expected].map((one) => one.getRoot().listTextures().map((texture) => valuesOf(texture.getImage())));
  assert.equal(own.length, 5);
  assert.deepEqual(own, others);
  assert.deepEqual(document.getRoot().listTextures().slice(0, 3).map((texture) => texture.getURI()), uris);
});

// Compares refusals: the command gets a file, and the function gets a document.
async function refusals(words, options) {
  const file = join(mkdtempSync(join(folder, 'refused-')), 'document.gltf');
  await io.write(file, generated(4, 1));
  const said = runNative(['convert', 'document.gltf', '-o', 'out', ...words], dirname(file)).stderr.trim().replace(/^texremap: /, '');
  const failure = await generated(4, 1).transform(remapMaterials(options)).then(() => null, (error) => error);
  return [failure?.message, said];
}

for (const [words, options] of [
  [['--to', 'mitsuba/ward'], { to: 'mitsuba/ward' }],
  [['--to', 'gltf', '--from', 'mitsuba/ward'], { from: 'mitsuba/ward', to: 'gltf' }],
  [['--to', 'gltf-specgloss', '--extensions', 'write'], { to: 'gltf-specgloss', extensions: 'write' }],
  [['--to', 'gltf-specgloss', '--extensions', 'fold'], { to: 'gltf-specgloss', extensions: 'fold' }],
  [['--to', 'gltf', '--compression', 'jpeg=0'], { to: 'gltf', jpeg: 0 }],
])
  test(`refused as by the command: ${JSON.stringify(options)}`, async () => {
    const [own, expected] = await refusals(words, options);
    assert.equal(own, expected);
  });

test('a document of another copy of the library', async () => {
  await assert.rejects(remapMaterials(TO_CORE)({ getRoot() {} }), /another copy of @gltf-transform\/core/);
});

test('options that the function does not have', () => {
  assert.throws(() => remapMaterials({ to: 'gltf', form: 'gltf' }), /unknown option 'form' \(known: from, to, /);
  assert.throws(() => remapMaterials({ to: 'gltf', resample: 1 }), /resample: expected true or false/);
});

test('a material that fails is named, and the others are converted', async () => {
  const document = generated(5);
  document.getRoot().listMaterials()[0].getExtension(GLOSS).getDiffuseTexture().setImage(Uint8Array.from([1, 2, 3]));
  await assert.rejects(document.transform(remapMaterials(TO_CORE)), (error) => {
    assert.match(error.message, /material 0 "material 0": failed: .*not an image of a known format/);
    return error.kind === 'input';
  });
  assert.deepEqual(document.getRoot().listMaterials().map((material) => material.getExtension(GLOSS) !== null), [true, false, false, false]);
  assert.ok(document.getRoot().listExtensionsUsed().some((one) => one.extensionName === GLOSS));
});

test('warnings go to the logger', async () => {
  const said = [];
  const document = generated(6);
  document.setLogger({ debug() {}, info() {}, error() {}, warn: (text) => said.push(text) });
  document.getRoot().listMeshes()[0].listPrimitives()[0].setAttribute('COLOR_0', document.createAccessor().setType('VEC3').setArray(new Float32Array(3)));
  await document.transform(remapMaterials(TO_CORE));
  assert.ok(said.some((text) => /^material 0 "material 0": vertex colors of 1 primitive .* now tint its reflection/.test(text)), said.join('\n'));
});

test('the example of docs/npm.md', async () => {
  const page = readFileSync(join(sourceFolder, 'docs/npm.md'), 'utf8');
  const [, example] = /```js\n((?:(?!```)[^])*remapMaterials[^]*?)```/.exec(page);
  const cwd = mkdtempSync(join(folder, 'example-'));
  await io.write(join(cwd, 'paint.glb'), generated(9));
  const program = join(packageFolder, `example_${process.pid}.mjs`);  // a program in this folder can import the package by its name
  writeFileSync(program, example);
  const run = spawnSync(process.execPath, [program], { cwd, encoding: 'utf8' });
  rmSync(program);
  assert.equal(run.status, 0, run.stderr);
  const made = await io.read(join(cwd, 'paint_metal.glb'));
  assert.ok(made.getRoot().listMaterials().every((material) => material.getExtension(GLOSS) === null));
});
