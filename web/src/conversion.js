// This file makes one conversion, like `texremap convert`, and prepares what the page shows of it.
import { isGltf, openAsset } from './gltf.js';
import { materialOfSet, materialsOfAssets } from './preview.js';

const IN = 'in', OUT = 'out';

const isAsset = (path) => isGltf(path) || /\.(mtl|obj)$/i.test(path);
const baseName = (path) => path.slice(path.lastIndexOf('/') + 1);

// Returns the words of a line, quoted as in a shell.
export function wordsOf(line) {
  return [...line.matchAll(/"([^"]*)"|'([^']*)'|(\S+)/g)].map((match) => match[1] ?? match[2] ?? match[3]);
}

/** A word as a shell takes it. */
export const quoted = (word) => (/^[\w./:,-][\w./:=,-]*$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

/** Files of an archive by name: unpackers of Windows take a backslash for a folder. */
export function archived(files) {
  const found = new Map();
  for (const { path, bytes } of files) {
    let name = path.replaceAll('\\', '_');
    while (found.has(name)) name = `_${name}`;
    found.set(name, bytes);
  }
  return found;
}

function commandOf(files, { from, to, layout, isEngine, more }) {
  const words = ['convert', IN, '--recursive'];
  if (files.some((file) => isAsset(file.path))) words.push('--assets');
  if (files.some((file) => /\.obj$/i.test(file.path))) words.push('--format', 'glb');
  // Maps that cannot be written here, or only with a loss.
  else if (!isEngine && files.some((file) => /\.(jpe?g|webp|tiff?)$/i.test(file.path)) && !words.includes('--assets'))
    words.push('--format', 'png');
  if (from) words.push('--from', from);
  if (to) words.push('--to', to);
  if (layout) words.push('--layout', layout);
  return [...words, ...wordsOf(more), '-o', OUT];
}

const jsonLines = (lines) => lines.flatMap((line) => {
  try {
    return [JSON.parse(line)];
  } catch {
    return [];
  }
});

// What a folder holds, by a report of a conversion of it that writes nothing.
function planOf(program, words) {
  const lines = jsonLines(program.run([...words, '--dry-run', '--json', '--quiet']).out);
  return { conversion: lines[0]?.conversion, sets: lines.flatMap((line) => line.set ?? []) };
}

// The model at one end, { name, workflow }; workflow is `brdf` for one without.
function endOf(conversion, end) {
  const workflow = conversion.workflow?.[end];
  return { name: workflow?.model ?? conversion[end], workflow: workflow?.workflow ?? 'brdf', diffuse: workflow?.diffuse };
}

const withoutRoot = (path) => path.slice(path.indexOf('/') + 1);

// Files of a folder by the name of a set and of a map: the set `in/metal/metal` has its maps in `metal/`.
function finder(files, set) {
  const folder = set.name.includes('/') ? withoutRoot(set.name).replace(/[^/]*$/, '') : '';
  const of = new Map(files.map((file) => [file.path, file.bytes]));
  const paths = [...(set.inputs ?? []), ...(set.results ?? [])].map(withoutRoot);
  return (name) => of.get(folder + name) ?? of.get(paths.find((path) => baseName(path) === baseName(name)));
}

// The plan of what was written: of a material by looking at it again, of a model by the names of results.
function planOfResults(program, plan, target) {
  if (target.workflow === 'brdf')
    return plan.sets.map((set) => ({
      ...set,
      plan: set.plan.map((line) => ({ ...line, input: line.output + (/:[A-Z,]+$/.exec(line.input)?.[0] ?? '') })),
    }));
  const other = target.name === 'gltf' ? 'gltf-specgloss' : 'gltf';
  return planOf(program, ['convert', OUT, '--recursive', '--from', target.name, '--to', other, '--force', '-o', 'again']).sets;
}

const MOST_SHOWN = 16;  // materials; each has textures before and after

// { source, target, pairs: [{ before, after }], count }: sets before, each with what it became.
function pairsOfSets(program, words, files, results, images) {
  const plan = planOf(program, [...words, '--force']);
  if (!plan.conversion) return {};
  const [source, target] = [endOf(plan.conversion, 'source'), endOf(plan.conversion, 'target')];
  const written = new Set(results.map(({ path }) => `${OUT}/${path}`));
  const made = planOfResults(program, plan, target);
  const found = plan.sets.flatMap((set) => {
    const names = new Set((set.results ?? []).filter((path) => written.has(path)));
    const after = made.find((one) => ((target.workflow === 'brdf' ? one.results : one.inputs) ?? []).some((path) => names.has(path)));
    return after ? [{ before: set, after }] : [];
  });
  const drawn = (set, end, of) => materialOfSet(withoutRoot(set.name), end.workflow, set.plan ?? [], finder(of, set), images);
  const pairs = found.slice(0, MOST_SHOWN).map(({ before, after }) => ({
    before: drawn(before, source, files),
    after: drawn(after, target, results),
  }));
  return { source, target, pairs, count: found.length };
}

function pairsOfAssets(files, results, images) {
  const [before, after] = [materialsOfAssets(files), materialsOfAssets(results)];
  const found = before.flatMap((one) => {
    const other = after.find(({ key }) => key === one.key);
    return other ? [{ before: one, after: other }] : [];
  });
  const pairs = found.slice(0, MOST_SHOWN).map((pair) => ({ before: pair.before.draw(images), after: pair.after.draw(images) }));
  return { pairs, count: found.length };
}

/** Images of files that the browser has to decode before the program runs. */
export async function prepareImages(files, images) {
  for (const { path, bytes } of files) {
    await images.prepare(bytes);
    const asset = isGltf(path) ? openAsset(files, path) : null;
    for (let i = 0; i < (asset?.imageCount ?? 0); ++i) {
      const image = asset.imageBytes(i);
      if (image) await images.prepare(image);
    }
  }
}

/** A conversion by one instance of the program. */
export class Conversion {
  #program;
  #images;
  #files;
  #words;

  constructor(program, images) {
    this.#program = program;
    this.#images = images;
  }

  // `isEngine`: files get the format that an engine reads.
  /** { status, report, command, files }; `files` are [{ path, bytes }], `request` is { from, to, layout, isEngine, more }. */
  async run(files, request) {
    await prepareImages(files, this.#images);
    this.#files = files;
    this.#words = commandOf(files, request);
    this.#program.write(files.map(({ path, bytes }) => ({ path: `/${IN}/${path}`, bytes })));
    const { status, err, out } = this.#program.run(this.#words);
    return { status, report: [...err, ...out], command: `texremap ${this.#words.map(quoted).join(' ')}`, files: this.#results() };
  }

  // Without the journal, which resumes a conversion where files stay.
  #results() {
    return this.#program.read(`/${OUT}`).filter(({ path }) => !baseName(path).startsWith('.'));
  }

  /** What the page draws of it: { source, target, pairs, count }. */
  preview() {
    const [words, files, results] = [this.#words, this.#files, this.#results()];
    return words.includes('--assets') ? pairsOfAssets(files, results, this.#images)
      : pairsOfSets(this.#program, words, files, results, this.#images);
  }
}
