// This file converts the materials of a glTF-Transform document. The program treats them like the materials of a file.
import { Document, PropertyType, WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';

import { RemapError } from './index.js';
import { startProgram } from './memory_program.js';
import makeInstance from './program_memory.mjs';
import { bytesOf } from './wasm_bytes.js';

// These are options of the command, keyed by their names here.
const COMMAND_OPTIONS = {
  from: '--from',
  to: '--to',
  extensions: '--extensions',
  metallicBias: '--metallic-bias',
  resample: '--resample',
  jpeg: '--compression=jpeg',
};
const OWN_OPTIONS = ['codec', 'program'];
const FLAGS = ['resample'];

const FILE = 'document.gltf', OUT = 'out';

function wordsOf(options) {
  const words = ['convert', FILE, '-o', OUT, '--json', '--keep-unused'];  // prune() of glTF-Transform removes unused parts
  for (const [name, value] of Object.entries(options)) {
    if (!(name in COMMAND_OPTIONS) || value === undefined || value === false) continue;
    words.push(FLAGS.includes(name) ? COMMAND_OPTIONS[name] : `${COMMAND_OPTIONS[name]}=${value}`);
  }
  return words;
}

function requireOptions(options) {
  const known = [...Object.keys(COMMAND_OPTIONS), ...OWN_OPTIONS];
  for (const [name, value] of Object.entries(options)) {
    if (!known.includes(name)) throw new RemapError(`remapMaterials: unknown option '${name}' (known: ${known.join(', ')})`);
    if (FLAGS.includes(name) && value !== undefined && typeof value !== 'boolean')
      throw new RemapError(`${name}: expected true or false`);
  }
}

let compiled = null;  // the module of the program

async function moduleOf(source) {
  compiled ??= bytesOf(source ?? new URL('./program.wasm', import.meta.url), (text) => new RemapError(text, 'input'))
    .then((bytes) => WebAssembly.compile(bytes));
  try {
    return await compiled;
  } catch (error) {
    compiled = null;
    throw error;
  }
}

const keyOf = (bytes) => {
  let hash = 0x811c9dc5;  // FNV-1a
  for (const byte of bytes) hash = Math.imul(hash ^ byte, 0x01000193);
  return `${bytes.length}:${hash >>> 0}`;
};
const areEqual = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);

// Images gives the program its images. The program cannot wait, but a codec may take time. An image that is not decoded yet
// is refused, and the program runs again once it is ready. New images are only numbered, and encoded after the run.
class Images {
  #codec;
  #decoded = new Map();  // by keyOf(): [{ bytes, image, failure or waiting }]
  #made = [];

  constructor(codec) {
    this.#codec = codec;
  }

  decode(bytes) {
    const entry = this.#find(bytes) ?? this.#begin(bytes);
    if (entry.failure !== undefined) throw new Error(entry.failure);
    if (entry.image === undefined) throw new Error('is not decoded yet');
    return entry.image;
  }

  encode(format, image, setting) {
    this.#made.push({ format, image, setting });
    return new TextEncoder().encode(`${this.#made.length - 1}`);
  }

  /** Waits for the images that were refused; whether there were any. */
  async decodeRefused() {
    const waiting = [...this.#decoded.values()].flat().filter((entry) => entry.waiting);
    await Promise.all(waiting.map((entry) => entry.waiting));
    for (const entry of waiting) delete entry.waiting;
    if (waiting.length > 0) this.#made = [];
    return waiting.length > 0;
  }

  /** The file of a new image, of what encode() gave. */
  async fileOf(number) {
    const { format, image, setting } = this.#made[Number(new TextDecoder().decode(number))];
    return this.#codec.encode(format, image, setting);
  }

  #find(bytes) {
    return this.#decoded.get(keyOf(bytes))?.find((entry) => areEqual(entry.bytes, bytes));
  }

  #begin(bytes) {
    const entry = { bytes };
    const key = keyOf(bytes);
    this.#decoded.set(key, [...(this.#decoded.get(key) ?? []), entry]);
    const done = (image) => (entry.image = image);
    const failed = (error) => (entry.failure = String(error?.message ?? error));
    try {
      const image = this.#codec.decode(bytes);
      if (typeof image?.then === 'function') entry.waiting = image.then(done, failed);
      else done(image);
    } catch (error) {
      failed(error);
    }
    return entry;
  }
}

function dependenciesOf(properties) {
  const found = new Set(properties);
  for (const property of found)
    for (const child of property.getGraph().listChildren(property)) found.add(child);
  return [...found].filter(({ propertyType }) => propertyType !== PropertyType.TEXTURE_INFO);  // copied together with their owners
}

// Copies properties of one document, and what they refer to, into another. `known` maps properties to existing copies, and
// receives the new copies. Properties in `properties` are copied in any case.
function copyInto(document, source, properties, known) {
  const all = dependenciesOf(properties);
  const missing = all.filter((property) => !known.has(property));
  for (const property of missing) {
    const extension = source.getRoot().listExtensionsUsed().find(({ extensionName }) => extensionName === property.extensionName);
    if (extension) document.createExtension(extension.constructor).setRequired(extension.isRequired());
    known.set(property, new property.constructor(document.getGraph()));
  }
  const resolve = (property) => known.get(property) ?? property;
  for (const property of new Set([...properties, ...missing])) known.get(property).copy(property, resolve);
}

const isBelow = (uri) => /^[^/\\:][^\\:]*$/.test(uri) && !uri.includes('..') && !/%(?![0-9a-f]{2})/i.test(uri);

// Returns only the materials and textures of the document, in their order.
function documentOfMaterials(document) {
  const small = new Document().setLogger(document.getLogger());
  const root = document.getRoot();
  copyInto(small, document, [...root.listMaterials(), ...root.listTextures()], new Map());
  for (const extension of root.listExtensionsUsed())
    if (/_texture_/.test(extension.extensionName)) small.createExtension(extension.constructor).setRequired(extension.isRequired());
  // The program reads images in the folder of the file, each by a separate name.
  const uris = new Set();
  for (const texture of small.getRoot().listTextures()) {
    const uri = texture.getURI();
    if (!isBelow(uri) || uris.has(uri)) texture.setURI('');
    uris.add(uri);
  }
  return small;
}

// Returns what the program needs of meshes: the materials of primitives with vertex colors.
function meshesOf(document) {
  const materials = document.getRoot().listMaterials();
  const indexOf = (material) => (material ? materials.indexOf(material) : undefined);
  return document.getRoot().listMeshes().map((mesh) => ({
    primitives: mesh.listPrimitives().map((primitive) => {
      const variants = primitive.getExtension('KHR_materials_variants');
      return {
        attributes: primitive.getAttribute('COLOR_0') ? { COLOR_0: 0 } : {},
        material: indexOf(primitive.getMaterial()),
        extensions: variants
          ? { KHR_materials_variants: { mappings: variants.listMappings().map((mapping) => ({ material: indexOf(mapping.getMaterial()) })) } }
          : undefined,
      };
    }),
  }));
}

function ioFor(document) {
  const extensions = document.getRoot().listExtensionsUsed().map((extension) => extension.constructor);
  const names = new Set(extensions.map(({ EXTENSION_NAME }) => EXTENSION_NAME));
  const others = ALL_EXTENSIONS.filter(({ EXTENSION_NAME }) => !names.has(EXTENSION_NAME));
  return new WebIO().setLogger(document.getLogger()).registerExtensions([...extensions, ...others]);
}

// Returns { status, err, report, files } of the program over a file.
async function converted({ json, resources }, words, module, images) {
  for (;;) {
    const program = await startProgram(makeInstance, module, images);
    program.write([
      { path: `/${FILE}`, bytes: new TextEncoder().encode(JSON.stringify(json)) },
      ...Object.entries(resources).map(([uri, bytes]) => ({ path: `/${decodeURIComponent(uri)}`, bytes })),
    ]);
    const { status, out, err } = program.run(words);
    if (await images.decodeRefused()) continue;
    const files = new Map(program.read(`/${OUT}`).map(({ path, bytes }) => [path, bytes]));
    return { status, err, files, report: out.length > 0 ? JSON.parse(out.join('\n')) : null };
  }
}

// Sets the materials of the document to the materials of the result.
async function carryOver(document, result, changed, images) {
  const [root, made] = [document.getRoot(), result.getRoot()];
  const known = new Map();
  root.listMaterials().forEach((material, i) => known.set(made.listMaterials()[i], material));
  root.listTextures().forEach((texture, i) => known.set(made.listTextures()[i], texture));
  for (const texture of made.listTextures().slice(root.listTextures().length))
    texture.setImage(await images.fileOf(texture.getImage()));
  for (const index of changed) {
    const [material, target] = [root.listMaterials()[index], made.listMaterials()[index]];
    const before = material.listExtensions();
    for (const property of target.listExtensions()) {
      const own = material.getExtension(property.extensionName);
      if (own?.equals(property)) known.set(property, own);
    }
    const extras = material.getExtras();
    copyInto(document, result, [target], known);
    material.setExtras(extras);
    for (const property of before) if (property.listParents().length === 0) property.dispose();
  }
}

const without = (start, line) => (line.startsWith(start) ? line.slice(start.length) : line);

// Sends warnings to the logger of the document, and joins failures into one error.
function tell(document, { status, err }) {
  const failures = [];
  for (const line of err.map((each) => without('texremap: ', each))) {
    if (line.startsWith('warning: ')) document.getLogger().warn(without(`${FILE}: `, without('warning: ', line)));
    else if (line.startsWith(`${FILE}: `) && !line.includes(': failed: ')) document.getLogger().debug(line);
    else failures.push(without(`${FILE}: `, line));
  }
  if (status !== 0) throw new RemapError(failures.join('\n'), status === 2 ? 'usage' : 'input');
}

/** A function for document.transform(); gltf_transform.d.ts says what it does. */
export function remapMaterials(options = {}) {
  requireOptions(options);
  const words = wordsOf(options);
  return async function remapMaterials(document) {
    if (!(document instanceof Document))
      throw new RemapError('remapMaterials: the document is of another copy of @gltf-transform/core (load it by import, not by require)');
    const module = await moduleOf(options.program);
    const codec = options.codec ?? (await import('#codec'));
    const images = new Images(codec);
    try {
      const io = ioFor(document);
      const source = await io.writeJSON(documentOfMaterials(document), { basename: 'image' });
      source.json.meshes = meshesOf(document);
      const done = await converted(source, words, module, images);
      const changed = (done.report?.materials ?? []).filter(({ state }) => state === 'converted').map(({ index }) => index);
      if (changed.length > 0) {
        const json = JSON.parse(new TextDecoder().decode(done.files.get(FILE)));
        delete json.meshes;
        const bytesAt = (uri) => source.resources[uri] ?? done.files.get(decodeURIComponent(uri));
        const resources = Object.fromEntries((json.images ?? []).filter(({ uri }) => uri).map(({ uri }) => [uri, bytesAt(uri)]));
        await carryOver(document, await io.readJSON({ json, resources }), changed, images);
        const left = new Set(json.extensionsUsed);
        for (const extension of document.getRoot().listExtensionsUsed())
          if (source.json.extensionsUsed?.includes(extension.extensionName) && !left.has(extension.extensionName)) extension.dispose();
      }
      tell(document, done);
    } finally {
      codec.close?.();
    }
  };
}
