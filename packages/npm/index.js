// This is the library of the package: arrays in, arrays out. index.d.ts describes all functions.
import makeCore from './texremap.mjs';
import { bytesOf } from './wasm_bytes.js';

// This many texels are copied to the core and converted at a time, because they fit into the cache of a
// processor.
const BAND = 8192;

// These are the element types of arrays: their names in the core, and the largest value of integers.
const ARRAYS = {
  Float32Array: { Type: Float32Array, core: 'float', highest: 1 },
  Float64Array: { Type: Float64Array, core: 'double', highest: 1 },
  Uint8Array: { Type: Uint8Array, core: 'uint8', highest: 255 },
  Uint8ClampedArray: { Type: Uint8ClampedArray, core: 'uint8', highest: 255 },
  Uint16Array: { Type: Uint16Array, core: 'uint16', highest: 65535 },
};
const OUTPUTS = {
  float32: ARRAYS.Float32Array,
  float64: ARRAYS.Float64Array,
  uint8: ARRAYS.Uint8Array,
  uint16: ARRAYS.Uint16Array,
};
// Returns the class name of a typed array, even from another realm or for a subclass such as Buffer.
const nameOfArray = Object.getOwnPropertyDescriptor(Object.getPrototypeOf(Uint8Array.prototype), Symbol.toStringTag).get;
const kindOf = (value) => ARRAYS[nameOfArray.call(value)];
const isWhole = (kind) => kind.highest !== 1;
// These are names of parameters here, and in the core.
const CORE_NAMES = new Map([
  ['roughness', 'roughness'],
  ['specular', 'specular'],
  ['diffuse', 'diffuse'],
  ['baseColor', 'base_color'],
  ['metallic', 'metallic'],
  ['metalMask', 'metal_mask'],
  ['residual', 'residual'],
  ['metallicUncertainty', 'metallic_uncertainty'],
  ['issues', 'issues'],
]);
const OWN_NAMES = new Map([...CORE_NAMES].map(([own, core]) => [core, own]));
const COLORS = new Set(['specular', 'diffuse', 'baseColor']);
const MEASURES = ['residual', 'metallicUncertainty', 'issues'];

const OWN_OPTIONS = ['via', 'dielectricF0', 'metallicBias'];
const CONVERTER_OPTIONS = ['source', 'target', ...OWN_OPTIONS];
const MAP_OPTIONS = [
  'width', 'firstRow', 'transfer', 'type', 'sourceEncoding', 'targetEncoding', 'badTexels', 'dither', 'measures', 'into',
];
const SOURCES = ['roughness', 'specular', 'diffuse', 'baseColor', 'metallic', 'metalMask'];
const GIVEN = [...SOURCES, 'glossiness'];

/** An error of the library. `kind` is usage, input, output or numeric, as in C++. */
export class RemapError extends Error {
  constructor(message, kind = 'usage') {
    super(message);
    this.name = 'RemapError';
    this.kind = kind;
  }
}

let core = null;
let loading = null;

/** Makes the library ready. Needed once; later calls return at once. */
export async function load(source = new URL('./texremap.wasm', import.meta.url)) {
  if (core !== null) return;
  loading ??= (async () => {
    const bytes = await bytesOf(source, (text) => new RemapError(text, 'input'));
    if (!(bytes instanceof ArrayBuffer) && !ArrayBuffer.isView(bytes))
      throw new RemapError('load: expected bytes, a URL or a Response of texremap.wasm');
    // Compile first, because the glue would print an error and wait forever.
    await WebAssembly.compile(bytes);
    core = await makeCore({ wasmBinary: bytes });
  })();
  try {
    await loading;
  } finally {
    loading = null;
  }
}

function call(request) {
  if (core === null) throw new RemapError('the library is not loaded (first: await load())');
  const text = JSON.stringify(request);
  const place = allocated(core.lengthBytesUTF8(text) + 1);
  try {
    core.stringToUTF8(text, place, core.lengthBytesUTF8(text) + 1);
    return answerAt(core._texremap_call(place));
  } finally {
    core._free(place);
  }
}

function answerAt(place) {
  const { answer, failure, kind } = JSON.parse(core.UTF8ToString(place));
  if (failure !== undefined) throw new RemapError(failure, kind);
  return answer;
}

// Holds the maps that the core has begun, as text. The core keeps them, because the next call often has the same maps.
let begunMaps = null;

function beginMaps(request) {
  const text = JSON.stringify(request);
  if (text === begunMaps) return;
  begunMaps = null;
  call(request);
  begunMaps = text;
}

function closeConverter(number) {
  begunMaps = null;
  call({ call: 'close', converter: number });
}

// Converts rows of the maps that were begun.
function convertBand(width, height, firstRow) {
  const failure = core._texremap_convert_band(width, height, firstRow);
  if (failure !== 0) answerAt(failure);
}

function allocated(bytes) {
  const place = bytes < 2 ** 32 ? core._malloc(Math.max(bytes, 1)) : 0;
  if (place === 0) throw new RemapError('not enough memory (convert fewer texels at a time)', 'numeric');
  return place;
}

const fail = (message) => {
  throw new RemapError(message);
};

// Returns the options of `given` with these names, each read once. Refuses other names.
function optionsOf(given, place, known) {
  if (given === undefined) return {};
  if (typeof given !== 'object' || given === null || ArrayBuffer.isView(given))
    fail(`${place}: expected an object of options`);
  const options = {};
  for (const key of Object.keys(given)) {
    if (!known.includes(key)) fail(`${place}: unknown option '${key}' (known: ${known.join(', ')})`);
    if (given[key] !== undefined) options[key] = given[key];
  }
  return options;
}

function picked(options, names) {
  return Object.fromEntries(names.filter((name) => name in options).map((name) => [name, options[name]]));
}

const isText = (value) => typeof value === 'string';
const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);
const isTexts = (value) => Array.isArray(value) && value.every(isText);

const EXPECTED = {
  source: [isText, 'a name'],
  target: [isText, 'a name'],
  via: [isTexts, 'a list of names'],
  dielectricF0: [isNumber, 'a number'],
  metallicBias: [isNumber, 'a number'],
};

function checked(names) {
  for (const [name, value] of Object.entries(names))
    if (!EXPECTED[name][0](value)) fail(`${name}: expected ${EXPECTED[name][1]}`);
  for (const name of ['source', 'target']) if (!(name in names)) fail(`${name} is required`);
  return names;
}

// The following functions hold the given maps until their size is known.

// Returns `{ constants }`, or `{ arrays, type }`: one array, or one each for red, green and blue.
function valuesOf(name, value, isColor = COLORS.has(name)) {
  if (value instanceof HeldArray) value = value.array;
  else if (Array.isArray(value)) value = value.map((entry) => (entry instanceof HeldArray ? entry.array : entry));
  if (typeof value === 'number') return { name, isColor, constants: [value] };
  if (ArrayBuffer.isView(value)) value = [value];
  if (!Array.isArray(value) || value.length === 0)
    fail(`${name}: expected a number, a typed array${isColor ? ', or a list of three of either' : ''}`);
  const list = value;
  if (list.length !== 1 && !(isColor && list.length === 3))
    fail(`${name} has ${list.length} channels (give ${isColor ? '1 or 3' : '1'})`);
  if (list.every((entry) => typeof entry === 'number')) return { name, isColor, constants: list };
  for (const array of list) {
    if (kindOf(array) === undefined) fail(`${name}: expected ${Object.keys(ARRAYS).join(', ')}`);
    if (kindOf(array) !== kindOf(list[0])) fail(`${name}: channels differ in type`);
    if (array.length !== list[0].length) fail(`${name}: channels differ in length`);
    if (isFreed(array)) fail(`${name}: its array of allocate() was freed`);
  }
  return { name, isColor, arrays: list, kind: kindOf(list[0]) };
}

function arraysInto(name, value) {
  const given = valuesOf(`into.${name}`, value, COLORS.has(name));
  return given.arrays ? given : fail(`into.${name}: expected a typed array, or a list of three`);
}

const SURELY_NO_FRACTION = 2;  // values from 2 on cannot be fractions
const LOOKED_AT = 4093;  // a prime, so that no channel of interleaved values is skipped

// Refuses values that can only be per cent or 0 to 255. It skips exponents and wide ranges of specular.
function requireFractions(held, sources, encoding) {
  for (const source of sources) {
    const isExponent = source.name === 'roughness' && encoding === 'exponent';
    const isWide = source.name === 'specular' && held.info.domain.specular[1] > 1;
    if (isExponent || isWide) continue;
    const name = source.name === 'roughness' && encoding === 'glossiness' ? 'glossiness' : source.name;
    if (source.constants) requireFractionNumbers(name, source.constants);
    else if (!isWhole(source.kind)) source.arrays.forEach((array) => requireFractionArray(name, array));
  }
}

function requireFractionNumbers(name, values) {
  const highest = Math.max(...values);
  if (!(highest >= SURELY_NO_FRACTION)) return;
  const whole = values.length === 1 && highest <= 100 ? 100 : 255;
  const listed = (numbers) => (numbers.length === 1 ? `${numbers[0]}` : `[${numbers.join(', ')}]`);
  const meant = values.map((value) => Math.round((100 * value) / whole) / 100);
  fail(`${name}: ${listed(values)}: values lie between 0 and 1${highest <= whole ? ` (write ${name}: ${listed(meant)})` : ''}`);
}

// Looks at some of the values. A few bright texels are common in maps, but not whole maps of them.
function requireFractionArray(name, array) {
  const looked = Math.min(array.length, LOOKED_AT);
  const seen = Float64Array.from({ length: looked }, (_, k) => array[Math.floor((k * array.length) / looked)]);
  if (2 * seen.filter((value) => value > 1).length <= looked) return;
  const some = seen.filter((value) => !Number.isNaN(value)).sort();
  const median = some[some.length >> 1];
  const [whole, Type] = median <= 255 ? [255, 'Uint8Array'] : [65535, 'Uint16Array'];
  const remedy = median <= whole ? ` (divide them by ${whole}, or give them as ${Type})` : '';
  fail(`${name}: half of the values are above ${Number(median.toPrecision(3))}, but they lie between 0 and 1${remedy}`);
}

// Returns the number of texels of all maps. A map of one channel decides, otherwise planes, otherwise a third of a color.
function texelCount(sources) {
  const maps = sources.filter((source) => source.arrays);
  const sure = maps.find((map) => !map.isColor || map.arrays.length === 3);
  if (maps.length === 0) return 1;
  if (sure) return sure.arrays[0].length;
  const length = maps[0].arrays[0].length;
  if (length % 3 !== 0)
    fail(`${maps[0].name}: has ${length} values, which is no multiple of 3 (give RGB, or planes as a list of three arrays)`);
  return length / 3;
}

// Sets how many values a texel has in each array: 1, or 3 or 4 for an interleaved color.
function layOut(source, count) {
  if (!source.arrays) return;
  const { name, arrays, isColor } = source;
  const length = arrays[0].length;
  if (arrays.length === 3 || !isColor) source.values = 1;
  else source.values = [1, 3, 4].find((values) => values * count === length);
  if (source.values === undefined || source.values * count !== length)
    fail(`${name}: has ${length} values for ${count} texels (give ${isColor ? `${count}, ${3 * count} or ${4 * count}` : count})`);
}

function transferOf(options, name, kind) {
  if (!COLORS.has(name)) return 'linear';
  const asked = typeof options.transfer === 'object' ? options.transfer?.[name] : options.transfer;
  if (asked !== undefined && asked !== 'linear' && asked !== 'srgb')
    fail(`transfer: expected linear or srgb, found ${String(asked)}`);
  // Follows usual_color_transfer() of the core: integers are in sRGB.
  return asked ?? (isWhole(kind) ? 'srgb' : 'linear');
}

// Lists arrays of allocate() that are not freed: their places, and where they end.
const ends = new Map();

// A HeldArray is an array from allocate().
class HeldArray {
  #memory;
  #length;
  constructor(kind, length) {
    this.#memory = new CoreArray(kind, 1, length);
    this.#length = length;
    ends.set(this.#memory.place, this.#memory.place + length * kind.Type.BYTES_PER_ELEMENT);
  }
  get array() {
    return this.#memory?.view(this.#length) ?? fail('allocate: the array was freed');
  }
  free() {
    if (this.#memory === null) return;
    ends.delete(this.#memory.place);
    this.#memory.free();
    this.#memory = null;
  }
}

const isInCore = (array) => array.buffer === core?.HEAPU8.buffer;

// Returns true if a view outlived its memory, which another array may use since.
const isFreed = (array) => isInCore(array)
  && ![...ends].some(([place, end]) => place <= array.byteOffset && array.byteOffset + array.byteLength <= end);

// Returns true if all arrays are in memory of the core. They are then converted without copies.
function areHeld(sources, targets) {
  const arrays = [...sources, ...targets].flatMap((map) => map.arrays);
  const held = arrays.filter(isInCore).length;
  if (held === 0) return false;
  if (held < arrays.length)
    fail('arrays of allocate() are given for some maps alone (give them for all sources and results, or for none)');
  return true;
}

// A CoreArray is memory of the core with an array in it: new memory, or an array of allocate().
class CoreArray {
  constructor(kind, valuesATexel, texels, place = allocated(texels * valuesATexel * kind.Type.BYTES_PER_ELEMENT)) {
    this.kind = kind;
    this.values = valuesATexel;
    this.place = place;
  }
  // Makes a view for each use, because memory moves when it grows.
  view(length) {
    return new this.kind.Type(core.HEAPU8.buffer, this.place, length);
  }
  channel(index, width) {
    const bytes = this.kind.Type.BYTES_PER_ELEMENT;
    return {
      at: this.place + index * bytes,
      type: this.kind.core,
      texelStride: this.values * bytes,
      rowStride: this.values * bytes * width,
    };
  }
  free() {
    core._free(this.place);
  }
}

function copyIn(inputs, first, texels) {
  for (const { arrays, bands, values } of inputs)
    arrays.forEach((array, i) => bands[i].view(texels * values).set(array.subarray(first * values, (first + texels) * values)));
}

function copyOut(targets, first, texels) {
  for (const { arrays, bands, values, alphaOf } of targets)
    arrays.forEach((array, i) => {
      const band = bands[i].view(texels * values);
      if (alphaOf) keepOpacity(array, band, first);
      array.set(band, first * values);
    });
}

function convertMaps(held, maps, options) {
  const sources = SOURCES.filter((name) => name in maps).map((name) => valuesOf(name, maps[name]));
  const used = new Set(held.sources);
  if (held.targets.includes('residual')) used.add('metalMask');
  for (const source of sources)
    if (!used.has(source.name)) fail(`${source.name}: ${held.info.id} does not take it (it takes ${held.sources.join(', ')})`);
  for (const name of held.sources)
    if (!sources.some((source) => source.name === name)) fail(`${name} is required (a typed array or a number)`);
  const count = texelCount(sources);
  if (count === 0) fail('maps have no texels (is their buffer detached?)');
  for (const source of sources) layOut(source, count);
  requireFractions(held, sources, options.sourceEncoding ?? held.info.sourceEncoding);
  const isPlain = sources.every((source) => !source.arrays);

  let { width = Math.min(count, BAND) } = options;
  const { firstRow = 0 } = options;
  if (!Number.isInteger(width) || width < 1) fail('width: expected a whole number of 1 or more');
  if ('width' in options && count % width !== 0) fail(`width: ${count} texels are no whole rows of ${width}`);
  if (!Number.isSafeInteger(firstRow) || firstRow < 0) fail('firstRow: expected a whole number of 0 or more');
  const measures = options.measures ?? [];
  if (!isTexts(measures)) fail('measures: expected a list of names');
  for (const name of measures)
    if (!MEASURES.includes(name) || !held.targets.includes(name))
      fail(`measures: ${held.info.id} does not make '${name}' (it makes ${held.targets.filter((t) => MEASURES.includes(t)).join(', ') || 'none'})`);
  if ('type' in options && !Object.hasOwn(OUTPUTS, options.type))
    fail(`type: expected one of ${Object.keys(OUTPUTS).join(', ')}`);

  const isGlossiness = (options.targetEncoding ?? held.info.targetEncoding) === 'glossiness';
  const shown = (name) => (name === 'roughness' && isGlossiness ? 'glossiness' : name);
  const into = optionsOf(options.into, 'into', held.targets.map(shown));

  // Each target has the layout of the source with its name, otherwise of the first color, otherwise of the first map.
  const inputs = sources.filter((source) => source.arrays);
  const specular = sources.find((source) => source.name === 'specular');
  const specularChannels = specular?.arrays ? (specular.values === 1 && specular.arrays.length === 1 ? 1 : 3)
    : specular?.constants.length ?? 3;
  const isOfBrdf = held.sources.length === 2;
  const targets = held.targets
    .filter((name) => !MEASURES.includes(name) || measures.includes(name))
    .map((name) => {
      const isColor = COLORS.has(name);
      const model = inputs.find((source) => source.name === name)
        ?? (isColor ? inputs.find((source) => source.isColor && (source.values > 1 || source.arrays.length === 3)) : undefined)
        ?? inputs[0];
      const given = shown(name) in into ? arraysInto(shown(name), into[shown(name)]) : undefined;
      const kind = given?.kind ?? ('type' in options ? OUTPUTS[options.type] : model?.kind ?? OUTPUTS.float32);
      let planes = 1;
      let values = 1;
      if (isColor) {
        const channels = isOfBrdf ? specularChannels : 3;
        if (channels === 3) {
          if (given ? given.arrays.length === 3 : model?.isColor && model.arrays.length === 3) planes = 3;
          else values = model?.isColor && model.values === 4 ? 4 : 3;
        }
      }
      if (given && (given.arrays.length !== planes || given.arrays[0].length !== count * values))
        fail(`into.${shown(name)}: has ${given.arrays.length} arrays of ${given.arrays[0].length} values (give ${planes} of ${count * values})`);
      const arrays = given?.arrays ?? Array.from({ length: planes }, () => new kind.Type(count * values));
      // Opacity stays.
      if (values === 4) copyOpacity(model, kind, arrays[0], count);
      return { name, arrays, kind, values, alphaOf: values === 4 ? model : undefined };
    });

  const isHeld = areHeld(inputs, targets);
  if (isHeld) width = options.width ?? count;
  const rows = Math.max(1, Math.floor(BAND / width));
  const bandTexels = isHeld ? count : Math.min(count, rows * width);
  const buffers = [];
  const buffer = ({ kind, values }, array) => {
    if (isHeld) return new CoreArray(kind, values, count, array.byteOffset);
    const made = new CoreArray(kind, values, bandTexels);
    buffers.push(made);
    return made;
  };
  let statistics;
  try {
    for (const source of inputs) source.bands = source.arrays.map((array) => buffer(source, array));
    for (const target of targets) target.bands = target.arrays.map((array) => buffer(target, array));
    const channelsOf = (map, channels) =>
      map.bands.length === 3
        ? map.bands.map((band) => band.channel(0, width))
        : Array.from({ length: channels }, (_, c) => map.bands[0].channel(c, width));
    beginMaps({
      call: 'begin',
      converter: held.number,
      width,
      ...picked(options, ['sourceEncoding', 'targetEncoding', 'badTexels', 'dither']),
      sources: sources.map((source) => ({
        parameter: CORE_NAMES.get(source.name),
        name: source.name,
        transfer: source.arrays ? transferOf(options, source.name, source.kind) : 'linear',
        ...(source.arrays ? { channels: channelsOf(source, Math.min(source.values, 3)) } : { constants: source.constants.map(toCore) }),
      })),
      targets: targets.map((target) => ({
        parameter: CORE_NAMES.get(target.name),
        transfer: transferOf(options, target.name, target.kind),
        channels: channelsOf(target, Math.min(target.values, 3)),
      })),
    });
    for (let first = 0; first < count; first += bandTexels) {
      const texels = Math.min(bandTexels, count - first);
      if (!isHeld) copyIn(inputs, first, texels);
      const whole = Math.floor(texels / width);
      // Without a given width, rows end where the maps end.
      const size = whole > 0 ? [width, whole] : [texels, 1];
      convertBand(...size, firstRow + Math.floor(first / width));
      if (!isHeld) copyOut(targets, first, texels);
    }
    statistics = call({ call: 'end' });
  } finally {
    for (const made of buffers.reverse()) made.free();  // the next call finds the same places
  }
  const result = { statistics };
  for (const target of targets) {
    if (isHeld) target.arrays = target.bands.map((band) => band.view(count * target.values));  // memory may have moved
    const name = shown(target.name);
    if (!isPlain) result[name] = target.arrays.length === 1 ? target.arrays[0] : target.arrays;
    else result[name] = target.arrays[0].length === 1 ? target.arrays[0][0] : Array.from(target.arrays[0]);
  }
  return result;
}

// Replaces infinity and NaN, which JSON lacks.
function toCore(value) {
  return Number.isFinite(value) ? value : fail(`constants must be finite, found ${value}`);
}

function copyOpacity(source, kind, to, count) {
  const from = source.arrays[0];
  const scale = kind.highest / source.kind.highest;
  const rounded = (value) => Math.min(Math.max(Math.round(value * scale), 0), kind.highest);
  const scaled = scale === 1 ? (value) => value : isWhole(kind) ? rounded : (value) => value * scale;
  for (let i = 3; i < 4 * count; i += 4) to[i] = scaled(from[i]);
}

function keepOpacity(array, band, first) {
  for (let i = 3; i < band.length; i += 4) band[i] = array[4 * first + i];
}

const registry = typeof FinalizationRegistry === 'undefined' ? null
  : new FinalizationRegistry(closeConverter);

// `roughness` means roughness even if a model uses glossiness, as in the program. `glossiness` is a separate name.
function widthNamed(options, info) {
  const { glossiness, ...others } = options;
  if (glossiness !== undefined) {
    if ('roughness' in others || 'sourceEncoding' in others) fail('glossiness cannot be given with roughness or sourceEncoding');
    return { ...others, roughness: glossiness, sourceEncoding: 'glossiness' };
  }
  return { sourceEncoding: info.sourceEncoding === 'glossiness' ? 'roughness' : info.sourceEncoding, ...others };
}

class MapConverter {
  constructor(request) {
    const { converter, sources, targets, ...info } = call({ call: 'open', ...request });
    this.number = converter;
    this.sources = Object.freeze(sources.map((parameter) => OWN_NAMES.get(parameter.name)));
    this.targets = Object.freeze(targets.map((parameter) => OWN_NAMES.get(parameter.name)));
    this.info = info;
    registry?.register(this, converter, this);
  }
  convert(maps) {
    if (this.number === 0) fail('converter: is closed (make another one)');
    const options = widthNamed(optionsOf(maps, 'convert', [...GIVEN, ...MAP_OPTIONS]), this.info);
    return convertMaps(this, picked(options, SOURCES), picked(options, MAP_OPTIONS));
  }
  close() {
    if (this.number === 0) return;
    registry?.unregister(this);
    closeConverter(this.number);
    this.number = 0;
  }
}

/** A converter for many calls. */
export function converter(source, target, options) {
  return publicOf(new MapConverter(checked({ source, target, ...optionsOf(options, 'converter', OWN_OPTIONS) })));
}

/** The converter of a fit file of remapc, from its text. */
export function converterOfFit(text) {
  if (!isText(text)) fail('converterOfFit: expected the text of a fit file');
  return publicOf(new MapConverter({ fit: text }));
}

function publicOf(held) {
  return Object.freeze({
    ...held.info,
    sources: held.sources,
    targets: held.targets,
    convert: (maps) => held.convert(maps),
    close: () => held.close(),
  });
}

// Keeps the converters of the last calls of convert().
const recent = new Map();
const MOST_RECENT = 16;

function recentConverter(names) {
  const key = JSON.stringify(names);
  let found = recent.get(key);
  if (found === undefined) {
    found = new MapConverter(names);
    if (recent.size >= MOST_RECENT) {
      const [oldest, held] = recent.entries().next().value;
      held.close();
      recent.delete(oldest);
    }
  } else {
    recent.delete(key);
  }
  recent.set(key, found);
  return found;
}

/** Converts maps, or single values, from one model to another. */
export function convert(request) {
  const options = optionsOf(request, 'convert', [...CONVERTER_OPTIONS, ...GIVEN, ...MAP_OPTIONS]);
  const held = recentConverter(checked(picked(options, CONVERTER_OPTIONS)));
  return held.convert(picked(options, [...GIVEN, ...MAP_OPTIONS]));
}

/** The models, workflows and other names that are known. */
export function models() {
  return call({ call: 'models' });
}

/** What leads from one model to another. */
export function path(source, target, options) {
  const held = new MapConverter(checked({ source, target, ...optionsOf(options, 'path', OWN_OPTIONS) }));
  const { path: found, notes, assumptions } = held.info;
  held.close();
  return { ...found, notes, assumptions };
}

/** The version of the library. */
export function version() {
  return call({ call: 'version' });
}

/** An array in memory of the library. Where all maps of a call are such arrays, nothing is copied. */
export function allocate(type, length) {
  if (core === null) fail('the library is not loaded (first: await load())');
  if (!Object.hasOwn(OUTPUTS, type)) fail(`type: expected one of ${Object.keys(OUTPUTS).join(', ')}`);
  if (!Number.isSafeInteger(length) || length < 0) fail('length: expected a whole number of 0 or more');
  return new HeldArray(OUTPUTS[type], length);
}
