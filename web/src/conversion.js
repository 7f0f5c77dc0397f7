// This file makes one conversion, like `texremap convert`, and its report.
import { isGltf, openAsset } from './gltf.js';

const IN = 'in', OUT = 'out', REPORT = 'report';

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
  // The page cannot write these formats, or only with a loss.
  else if (!isEngine && files.some((file) => /\.(jpe?g|webp|tiff?)$/i.test(file.path)) && !words.includes('--assets'))
    words.push('--format', 'png');
  if (from) words.push('--from', from);
  if (to) words.push('--to', to);
  if (layout) words.push('--layout', layout);
  return [...words, ...wordsOf(more), '-o', OUT];
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
  #words;

  constructor(program, images) {
    this.#program = program;
    this.#images = images;
  }

  // `isEngine`: files get the format that an engine reads.
  /** { status, report, command, files }; `files` are [{ path, bytes }], `request` is { from, to, layout, isEngine, more }. */
  async run(files, request) {
    await prepareImages(files, this.#images);
    this.#words = commandOf(files, request);
    this.#program.write(files.map(({ path, bytes }) => ({ path: `/${IN}/${path}`, bytes })));
    const { status, err, out } = this.#program.run(this.#words);
    return { status, report: [...err, ...out], command: `texremap ${this.#words.map(quoted).join(' ')}`, files: this.#results() };
  }

  // Leaves out the journal, which is only needed to resume a conversion.
  #results() {
    return this.#program.read(`/${OUT}`).filter(({ path }) => !baseName(path).startsWith('.'));
  }

  /** The data of `--report`, which the viewer shows (docs/report.md). Throws if nothing can be shown. */
  report() {
    const { status, err } = this.#program.run([...this.#words, '--dry-run', '--force', '--quiet', '--report', `${REPORT}/report.html`]);
    const [file] = this.#program.read(`/${REPORT}`);
    if (status !== 0 || !file) throw new Error(err.at(-1)?.replace(/^texremap: (error: )?/, '') ?? 'no report');
    const html = new TextDecoder().decode(file.bytes);
    return JSON.parse(/<script type="application\/json" id="data">(.*?)<\/script>/s.exec(html)[1]);
  }
}
