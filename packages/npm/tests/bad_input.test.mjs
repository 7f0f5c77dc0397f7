// These tests check that any input gives an answer or an error with a message, and that the library works afterwards.
import assert from 'node:assert/strict';
import test from 'node:test';

import { randomArray, randomNumbers, texremap } from './package.mjs';

const { convert, converter, converterOfFit, load, models, path } = texremap;
await load();

const names = { source: 'mitsuba/ward', target: 'mitsuba/ggx' };
const maps = { roughness: new Float32Array([0.2, 0.3]), specular: new Float32Array([0.5, 0.6]) };

function stillWorks() {
  const found = convert({ ...names, ...maps });
  assert.ok(found.roughness[0] > 0 && found.roughness[0] < 1);
}

const refused = (call, words) => {
  assert.throws(call, (error) => error.name === 'RemapError' && words.test(error.message) && !/undefined/.test(error.message) || assert.fail(error));
  stillWorks();
};

test('what is wrong is said', () => {
  refused(() => convert(), /source is required/);
  refused(() => convert(null), /expected an object of options/);
  refused(() => convert({ ...names }), /roughness is required/);
  refused(() => convert({ ...names, ...maps, colour: 1 }), /unknown option 'colour'/);
  refused(() => convert({ ...names, ...maps, diffuse: 0.5 }), /diffuse: .* does not take it \(it takes roughness, specular\)/);
  refused(() => convert({ ...names, roughness: new Float32Array(2), specular: new Float32Array(5) }), /specular: has 5 values for 2 texels \(give 2, 6 or 8\)/);
  refused(() => convert({ ...names, roughness: new Float32Array(2), specular: [new Float32Array(2), new Float32Array(2), new Float32Array(3)] }), /channels differ in length/);
  refused(() => convert({ ...names, roughness: new Float32Array(2), specular: [new Float32Array(2), new Float32Array(2), new Uint8Array(2)] }), /channels differ in type/);
  refused(() => convert({ ...names, roughness: new Int8Array(2), specular: 0 }), /roughness: expected Float32Array/);
  refused(() => convert({ ...names, roughness: new BigInt64Array(2), specular: 0 }), /roughness: expected Float32Array/);
  refused(() => convert({ ...names, roughness: new DataView(new ArrayBuffer(8)), specular: 0 }), /roughness: expected Float32Array/);
  refused(() => convert({ ...names, roughness: '0.2', specular: 0 }), /roughness: expected a number/);
  refused(() => convert({ ...names, roughness: NaN, specular: 0 }), /constants must be finite, found NaN/);
  refused(() => convert({ ...names, roughness: 30, specular: 0 }), /^roughness: 30: values lie between 0 and 1 \(write roughness: 0.3\)$/);
  refused(() => convert({ ...names, glossiness: 130, specular: 0 }), /\(write glossiness: 0.51\)$/);
  refused(() => convert({ ...names, roughness: 0.1, specular: [80, 40, 20] }), /\(write specular: \[0.31, 0.16, 0.08\]\)$/);
  refused(() => convert({ ...names, roughness: 1e6, specular: 0 }), /^roughness: 1000000: values lie between 0 and 1$/);
  refused(() => convert({ ...names, roughness: new Float32Array(9000).fill(30), specular: 0 }), /half of the values are above 30, .* \(divide them by 255, or give them as Uint8Array\)$/);
  refused(() => convert({ ...names, roughness: new Float64Array(4).fill(3e4), specular: 0 }), /\(divide them by 65535, or give them as Uint16Array\)$/);
  refused(() => convert({ ...names, roughness: 0.1, specular: [0.1, 0.2] }), /specular has 2 channels/);
  refused(() => convert({ ...names, ...maps, type: 'half' }), /type: expected one of float32/);
  refused(() => convert({ ...names, ...maps, type: 'constructor' }), /type: expected one of float32/);
  refused(() => convert({ ...names, ...maps, transfer: 'gamma' }), /transfer: expected linear or srgb/);
  refused(() => convert({ ...names, ...maps, badTexels: 'drop' }), /badTexels/);
  refused(() => convert({ ...names, ...maps, sourceEncoding: 'gloss' }), /sourceEncoding/);
  refused(() => convert({ ...names, ...maps, width: 3 }), /width: 2 texels are no whole rows of 3/);
  refused(() => convert({ ...names, ...maps, width: 1.5 }), /width: expected a whole number/);
  refused(() => convert({ ...names, ...maps, firstRow: -1 }), /firstRow: expected a whole number/);
  refused(() => convert({ ...names, ...maps, measures: ['residual'] }), /does not make 'residual'/);
  refused(() => convert({ ...names, ...maps, dielectricF0: 'x' }), /dielectricF0: expected a number/);
  refused(() => convert({ source: 'specular:gltf', target: 'metallic', dielectricF0: 2, baseColor: 1, metallic: 0, roughness: 0.5 }), /source specular:gltf: the model gltf has the metallic workflow/);
  refused(() => converter('mitsuba/ward', 'mitsuba/ggx', { via: 'mitsuba/as' }), /via: expected a list of names/);
  refused(() => converter('a'.repeat(100000), 'mitsuba/ggx'), /.+/);
  refused(() => converter('mitsuba/ward\0', 'mitsuba/ggx'), /without control characters/);
  refused(() => converter('\ud800', 'mitsuba/ggx'), /unknown model|request/);
  refused(() => converterOfFit(12), /expected the text/);
  refused(() => converterOfFit('['.repeat(100000)), /fit/);
  refused(() => path('mitsuba/ward', 'mitsuba/ward'), /.+/);
});

test('bright values that are meant', () => {
  convert({ ...names, source: 'mitsuba/phong', roughness: 30, specular: 0.5 });
  convert({ ...names, source: 'mitsuba/phong', roughness: new Float32Array(9000).fill(300), specular: 0.5 });
  convert({ ...names, roughness: 30, sourceEncoding: 'exponent', specular: 0.5 });
  convert({ ...names, roughness: new Uint8Array(4).fill(200), specular: 1.2 });
  convert({ ...names, roughness: 0.2, specular: Float32Array.from({ length: 9000 }, (_, i) => (i % 3 === 0 ? 8 : 0.5)) });
});

test('a closed converter says so', () => {
  const made = converter('mitsuba/ward', 'mitsuba/ggx');
  made.convert(maps);
  made.close();
  made.close();
  refused(() => made.convert(maps), /converter: is closed/);
});

test('detached, empty and shared buffers', () => {
  const detached = new Float32Array([0.2, 0.3]);
  structuredClone(detached.buffer, { transfer: [detached.buffer] });
  refused(() => convert({ ...names, roughness: detached, specular: 0.5 }), /no texels \(is their buffer detached\?\)/);
  refused(() => convert({ ...names, roughness: detached, specular: maps.specular }), /.+/);
  refused(() => convert({ ...names, roughness: maps.roughness, specular: detached }), /specular: has 0 values for 2 texels/);
  refused(() => convert({ ...names, roughness: new Float32Array(0), specular: 0.5 }), /no texels/);
  const shared = new Float32Array(new SharedArrayBuffer(8));
  shared.set(maps.roughness);
  assert.deepEqual(convert({ ...names, ...maps, roughness: shared }).roughness, convert({ ...names, ...maps }).roughness);
});

test('options whose getters change maps', () => {
  const roughness = new Float32Array([0.2, 0.3]);
  const request = { ...names, roughness, specular: 0.5 };
  Object.defineProperty(request, 'dither', {
    enumerable: true,
    get() {
      structuredClone(roughness.buffer, { transfer: [roughness.buffer] });
      return false;
    },
  });
  refused(() => convert(request), /no texels/);
});

test('many converters are kept and freed', () => {
  const targets = models().filter(({ kind }) => kind === 'brdf').map(({ name }) => name);
  let count = 0;
  for (const target of targets) {
    try {
      assert.equal(convert({ source: 'mitsuba/ward', target, roughness: 0.3, specular: 0.5 }).statistics.texels, 1);
      ++count;
    } catch (error) {
      assert.match(error.message, /no converters join these models|are the same model/);
    }
  }
  assert.ok(count > 20, `${count}`);
  stillWorks();
});

test('random requests', () => {
  const random = randomNumbers(44);
  const pick = (list) => list[Math.floor(random() * list.length)];
  const types = [Float32Array, Float64Array, Uint8Array, Uint16Array, Uint8ClampedArray, Int32Array];
  const array = () => {
    const made = randomArray(pick(types), pick([0, 1, 2, 3, 6, 8, 9, 12, 100, 300]), random);
    if (made.length > 0 && random() < 0.3) made[Math.floor(random() * made.length)] = pick([NaN, Infinity, -Infinity, -1, 1e30, 1e-40]);
    return made;
  };
  const values = [
    array, array, array, () => [array(), array(), array()], () => { const one = array(); return [one, one.slice(), one.slice()]; },
    random, () => [random(), random(), random()], () => NaN, () => null, () => undefined, () => 'text', () => ({}), () => [], () => true, () => 1n,
    () => Symbol.iterator, () => () => 0,
  ];
  const someNames = [...models().map(({ name }) => name), 'cycles-5', '', 'unknown', 'mitsuba'];
  const options = {
    width: () => pick([0, 1, 2, 3, 4, -1, 1e9, 2 ** 53, 0.5, NaN, '2']), firstRow: () => pick([0, 1, -1, 2 ** 40, 2 ** 52, NaN]),
    transfer: () => pick(['linear', 'srgb', 'x', null, { specular: 'srgb' }]), type: () => pick(['float32', 'float64', 'uint8', 'uint16', 'int8', null]),
    sourceEncoding: () => pick(['alpha', 'roughness', 'exponent', 'glossiness', 'squared', 'x', 1]), targetEncoding: () => pick(['alpha', 'exponent', 'squared', null]),
    badTexels: () => pick(['keep', 'clamp', 'fail', '', 1]), dither: () => pick([true, false, 1, null]),
    measures: () => pick([[], ['residual'], ['issues', 'metallicUncertainty'], 'residual', [1]]), dielectricF0: () => pick([0, 0.04, 0.9, 1, -1, Infinity]),
    metallicBias: () => pick([0, 1e-5, 1, 2, -1]),
    into: () => pick([{}, null, { roughness: array() }, { roughness: 1 }, { specular: [array(), array(), array()] }, []]), via: () => pick([[], ['mitsuba/as'], ['x'], 'x', [1]]),
  };
  let answers = 0;
  for (let i = 0; i < 4000; ++i) {
    const request = random() < 0.5 ? { ...names } : { source: pick(someNames), target: pick(someNames) };
    const isWorkflow = random() < 0.4;
    if (isWorkflow) Object.assign(request, pick([{ source: 'gltf', target: 'gltf-specgloss' }, { source: 'gltf-specgloss', target: 'gltf' }, { source: 'specular', target: 'cycles-5/principled' }]));
    const count = pick([1, 4, 100]);
    const Type = pick(types);
    for (const name of ['roughness', 'specular', 'diffuse', 'baseColor', 'metallic', 'metalMask']) {
      const fits = isWorkflow ? (request.source === 'gltf' ? ['roughness', 'baseColor', 'metallic'] : ['roughness', 'specular', 'diffuse']) : ['roughness', 'specular'];
      if (fits.includes(name) ? random() < 0.97 : random() < 0.03)
        request[name] = random() < 0.8 ? randomArray(Type, count * (['roughness', 'metallic'].includes(name) ? 1 : pick([1, 3, 4])), random) : pick(values)();
    }
    for (const [name, value] of Object.entries(options)) if (random() < 0.06) request[name] = value();
    try {
      const made = convert(request);
      assert.ok(made.statistics.texels >= 1);
      ++answers;
    } catch (error) {
      assert.equal(error.name, 'RemapError', `${error.stack}`);
      assert.ok(error.message.length > 5);
    }
  }
  assert.ok(answers > 500, `${answers} answers`);
  stillWorks();
});
