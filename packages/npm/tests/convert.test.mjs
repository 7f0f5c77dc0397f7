// These tests convert arrays and compare them with the converters' golden texels, which the compiler computed in another
// way.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';

import { packageFolder, randomArray, randomNumbers, sourceFolder, texremap } from './package.mjs';

const { convert, converter, converterOfFit, load, models, path } = texremap;

test('nothing works before load()', () => {
  assert.throws(() => models(), { name: 'RemapError', message: 'the library is not loaded (first: await load())' });
});

test('bytes that are no WebAssembly are refused, and load() can be called again', async () => {
  await assert.rejects(load(new Uint8Array([1, 2, 3, 4])));
  await assert.rejects(load(42), /expected bytes, a URL or a Response/);
  await assert.rejects(load(new URL('missing.wasm', import.meta.url)));
  await Promise.all([load(), load(readFileSync(`${packageFolder}/texremap.wasm`))]);
  await load();
});

test('every shipped converter gives its golden texels', () => {
  const { converters } = JSON.parse(readFileSync(`${sourceFolder}/generated/converters.json`));
  let count = 0;
  for (const data of converters) {
    const made = converter(data.source.model, data.target.model);
    if (made.id !== data.id) continue; // another one joins the same two models better
    ++count;
    const column = (i) => Float32Array.from(data.golden, (row) => row[i]);
    const found = made.convert({ roughness: column(0), specular: column(1) });
    data.golden.forEach(([, , roughness, specular, ofRoughness, ofSpecular], i) => {
      assert.ok(Math.abs(found.roughness[i] - roughness) <= ofRoughness + 1e-7 * roughness, `${data.id} ${i}`);
      assert.ok(Math.abs(found.specular[i] - specular) <= ofSpecular + 1e-7 * specular, `${data.id} ${i}`);
    });
    made.close();
  }
  assert.ok(count >= converters.length - 3, `${count}`);
});

test('planes, interleaved arrays, opacity and single texels give the same bits', () => {
  const random = randomNumbers(1);
  const count = 300001; // more than a band
  const roughness = randomArray(Float32Array, count, random);
  const planes = [0, 1, 2].map(() => randomArray(Float32Array, count, random));
  const rgb = new Float32Array(3 * count);
  const rgba = new Float32Array(4 * count);
  for (let i = 0; i < count; ++i) {
    for (let c = 0; c < 3; ++c) rgb[3 * i + c] = rgba[4 * i + c] = planes[c][i];
    rgba[4 * i + 3] = i;
  }
  const names = { source: 'mitsuba/ward', target: 'mitsuba/as' };
  const ofPlanes = convert({ ...names, roughness, specular: planes });
  const ofRgb = convert({ ...names, roughness, specular: rgb });
  const ofRgba = convert({ ...names, roughness, specular: rgba });
  assert.deepEqual(ofPlanes.statistics, ofRgb.statistics);
  assert.equal(ofPlanes.statistics.texels, count);
  assert.deepEqual(ofPlanes.roughness, ofRgb.roughness);
  for (let i = 0; i < count; ++i) {
    for (let c = 0; c < 3; ++c) {
      assert.equal(ofRgb.specular[3 * i + c], ofPlanes.specular[c][i]);
      assert.equal(ofRgba.specular[4 * i + c], ofPlanes.specular[c][i]);
    }
    assert.equal(ofRgba.specular[4 * i + 3], i);
  }
  for (const i of [0, 1, 65535, 65536, count - 1]) {
    const one = convert({ ...names, roughness: roughness[i], specular: planes.map((plane) => plane[i]) });
    assert.equal(one.roughness, ofPlanes.roughness[i]);
    assert.deepEqual(one.specular, planes.map((_, c) => ofPlanes.specular[c][i]));
  }
});

test('results go to arrays that are given, also to those of the sources', () => {
  const random = randomNumbers(3);
  const names = { source: 'mitsuba/ward', target: 'mitsuba/as' };
  const roughness = randomArray(Float32Array, 300000, random);
  const specular = randomArray(Float32Array, 900000, random);
  const made = convert({ ...names, roughness, specular });
  const into = { roughness: new Float32Array(300000), specular: new Float32Array(900000) };
  const given = convert({ ...names, roughness, specular, into });
  assert.equal(given.specular, into.specular);
  assert.deepEqual(into.specular, made.specular);
  convert({ ...names, roughness, specular, into: { roughness, specular } });
  assert.deepEqual(roughness, made.roughness);
  assert.deepEqual(specular, made.specular);
  assert.throws(() => convert({ ...names, roughness, specular, into: { specular: new Float32Array(3) } }), /into.specular: has 1 arrays of 3 values \(give 1 of 900000\)/);
  assert.throws(() => convert({ ...names, roughness, specular, into: { metallic: roughness } }), /into: unknown option 'metallic'/);
});

test('sources are not changed', () => {
  const roughness = new Float32Array([0.2, 0.4]);
  const specular = new Float32Array([0.1, 0.2]);
  convert({ source: 'mitsuba/ward', target: 'mitsuba/ggx', roughness, specular });
  assert.deepEqual(roughness, new Float32Array([0.2, 0.4]));
  assert.deepEqual(specular, new Float32Array([0.1, 0.2]));
});

// By KHR_materials_pbrSpecularGlossiness and glTF 2.0, a metal has no diffuse, and a dielectric has an F0 of 0.04.
test('materials: metals and dielectrics of specular-gloss become those of metal-rough', () => {
  const made = convert({
    source: 'gltf-specgloss', target: 'gltf', glossiness: new Float32Array([0.75, 0.5]),
    diffuse: new Float32Array([0, 0, 0, 0.5, 0.4, 0.3]), specular: new Float32Array([0.9, 0.7, 0.3, 0.04, 0.04, 0.04]),
    measures: ['residual', 'issues'],
  });
  const near = (found, expected) => found.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 2e-3, `${found}`));
  near(made.metallic, [1, 0]);
  near(made.baseColor, [0.9, 0.7, 0.3, 0.5, 0.4, 0.3]);
  near(made.roughness, [0.25, 0.5]);
  near(made.residual, [0, 0]);
  assert.equal(made.issues.length, 2);
  const back = convert({ source: 'gltf', target: 'gltf-specgloss', roughness: made.roughness, baseColor: made.baseColor, metallic: made.metallic });
  near(back.specular, [0.9, 0.7, 0.3, 0.04, 0.04, 0.04]);
  near(back.diffuse, [0, 0, 0, 0.5, 0.4, 0.3]);
});

test('8 and 16 bits: colors are sRGB, and a conversion to the same model keeps every value', () => {
  for (const [Type, highest] of [[Uint8Array, 255], [Uint16Array, 65535]]) {
    const all = Type.from({ length: highest + 1 }, (_, i) => i);
    const same = convert({ source: 'gltf', target: 'gltf', roughness: all, baseColor: all, metallic: all });
    assert.deepEqual(same.metallic, all);
    assert.deepEqual(same.roughness, all);
    for (let i = 0; i <= highest; ++i) assert.equal(same.baseColor[3 * i], i);
  }
  const half = convert({ source: 'gltf', target: 'gltf', roughness: 0, metallic: 0, baseColor: new Uint8Array([188, 188, 188]), type: 'float32' });
  assert.ok(Math.abs(half.baseColor[0] - 0.5029) < 1e-4); // IEC 61966-2-1
  const linear = convert({ source: 'gltf', target: 'gltf', roughness: 0, metallic: 0, baseColor: new Uint8Array([188, 188, 188]), type: 'float32', transfer: 'linear' });
  assert.ok(Math.abs(linear.baseColor[0] - 188 / 255) < 1e-7);
});

test('encodings of roughness', () => {
  const made = (options) => convert({ source: 'gltf', target: 'gltf', baseColor: 0.5, metallic: 0, ...options });
  const same = (options) => made(options).roughness;
  const near = (found, expected) => assert.ok(Math.abs(found - expected) < 1e-6, `${found}`);
  near(same({ roughness: 0.25, sourceEncoding: 'alpha' }), 0.5);
  near(made({ roughness: 0.25, targetEncoding: 'glossiness' }).glossiness, 0.75);
  near(same({ glossiness: 0.25 }), 0.75);
  // `roughness` means roughness, whatever parameter the model uses.
  near(convert({ source: 'gltf-specgloss', target: 'gltf', diffuse: 0.5, specular: 0.04, roughness: 0.25 }).roughness, 0.25);
  const into = { glossiness: new Float32Array(1) };
  made({ roughness: new Float32Array([0.25]), targetEncoding: 'glossiness', into });
  near(into.glossiness[0], 0.75);
  assert.throws(() => made({ roughness: 0.25, glossiness: 0.75 }), /glossiness cannot be given with roughness/);
  near(same({ roughness: 6, sourceEncoding: 'exponent', targetEncoding: 'alpha' }), 0.5);
});

test('bad texels: kept, clamped or refused', () => {
  const request = {
    source: 'mitsuba/ward', target: 'mitsuba/ggx', roughness: new Float32Array([0.2, NaN, Infinity, -1]), specular: new Float32Array([1, 1, 1, 1]),
  };
  const kept = convert(request);
  assert.ok(Number.isNaN(kept.roughness[1]));
  assert.deepEqual([kept.statistics.nan, kept.statistics.infinite, kept.statistics.negative], [1, 1, 1]);
  assert.ok(convert({ ...request, badTexels: 'clamp' }).roughness.every(Number.isFinite));
  assert.throws(() => convert({ ...request, badTexels: 'fail', width: 2, firstRow: 7 }), /roughness: texel \(1, 7\)/);
});

test('names: models, aliases, renderers, paths', () => {
  const names = models();
  assert.ok(names.some(({ name, kind, encoding }) => name === 'mitsuba/ward' && kind === 'brdf' && encoding === 'alpha'));
  assert.ok(names.some(({ name, kind }) => name === 'gltf-specgloss' && kind === 'specular'));
  assert.ok(names.some(({ name, model }) => name === 'unity' && model === 'gltf'));
  const found = path('mitsuba/ward', 'cycles-5');
  assert.equal(found.models[0], 'mitsuba/ward');
  assert.match(found.models.at(-1), /^cycles-5\//);
  assert.ok(found.expectedError > 0 && found.expectedError < 1);
  assert.ok(found.pictureDifference > 1 && found.pictureDifference < 20);
  assert.equal(path('gltf', 'metallic').expectedError, 0);
  assert.equal(path('gltf', 'metallic').pictureDifference, 0);
  assert.throws(() => path('mitsuba/wrd', 'mitsuba/ggx'), /source: unknown model 'mitsuba\/wrd' \(closest: mitsuba\/ward/);
});

test('a fit of one\'s own', () => {
  const text = readFileSync(`${sourceFolder}/fits/mitsuba_ward_to_mitsuba_as.json`, 'utf8');
  const maps = { roughness: new Float32Array([0.1, 0.3]), specular: new Float32Array([0.2, 0.9]) };
  const shipped = convert({ source: 'mitsuba/ward', target: 'mitsuba/as', ...maps });
  assert.deepEqual(converterOfFit(text).convert(maps), shipped);
  assert.throws(() => converterOfFit('{"kind": 1}'), /fit/);
});

test('arrays in memory of the library give the same, also after memory has grown, and over their sources', () => {
  const count = 8192 * 2 + 777;  // bands, and a part of one
  const random = randomNumbers(11);
  for (const [type, Type] of [['float32', Float32Array], ['uint16', Uint16Array]]) {
    const values = { roughness: randomArray(Type, count, random), specular: randomArray(Type, 3 * count, random) };
    const names = { source: 'mitsuba/ward', target: 'cycles-5/ggx' };
    const expected = convert({ ...names, ...values });
    const held = Object.fromEntries(Object.entries(values).map(([name, array]) => [name, texremap.allocate(type, array.length)]));
    texremap.allocate('float64', 5e6).free();
    for (const [name, array] of Object.entries(values)) held[name].array.set(array);
    const found = convert({ ...names, ...held, into: held });
    assert.deepEqual(found.statistics, expected.statistics);
    for (const name of Object.keys(values)) {
      assert.deepEqual(found[name], expected[name]);
      assert.deepEqual(held[name].array, expected[name]);
    }
    assert.throws(() => convert({ ...names, ...held }), /arrays of allocate\(\) are given for some maps alone/);
    const kept = held.roughness.array;
    for (const array of Object.values(held)) array.free();
    assert.throws(() => held.roughness.array, /the array was freed/);
    assert.throws(() => convert({ ...names, ...values, roughness: kept }), /roughness: its array of allocate\(\) was freed/);
    held.roughness.free();  // a second call changes nothing
  }
});

test('arrays in memory of the library that cannot be had', () => {
  assert.throws(() => texremap.allocate('float16', 1), /type: expected one of float32, /);
  for (const length of [-1, 0.5, NaN, '1', undefined]) assert.throws(() => texremap.allocate('uint8', length), /length: expected a whole number/);
  assert.throws(() => texremap.allocate('float64', 2 ** 33), /not enough memory/);
});
