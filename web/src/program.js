// One instance of the program: files in memory, and runs over them.
import makeInstance from 'page.mjs';

const LONGEST_REPORT = 2 ** 20;  // characters; a run over very many files says no more

/** `module` is page.wasm, compiled; `images` decodes and encodes whole files (images.js). */
export async function makeProgram(module, images) {
  let lines = { out: [], err: [] };
  let length = 0;
  const hear = (list) => (text) => {
    const line = text.replace(/^.*\x1b\[K/s, '');  // progress, as on a terminal
    length += line.length;
    if (length < LONGEST_REPORT) lines[list].push(line);
  };
  const instance = await makeInstance({
    images,
    locateFile: (name) => name,
    noInitialRun: true,
    thisProgram: 'texremap',
    print: hear('out'),
    printErr: hear('err'),
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(module, imports).then(done);
      return {};
    },
  });
  const { FS } = instance;

  /** Puts files where the program finds them. */
  function write(files) {
    for (const { path, bytes } of files) {
      FS.mkdirTree(path.slice(0, path.lastIndexOf('/')) || '/');
      FS.writeFile(path, bytes);
    }
  }

  /** The files below a folder, sorted: [{ path, bytes }], paths without the folder. */
  function read(folder) {
    const found = [];
    const visit = (path) => {
      for (const name of FS.readdir(path).sort()) {
        if (name === '.' || name === '..') continue;
        const whole = `${path}/${name}`;
        if (FS.isDir(FS.stat(whole).mode)) visit(whole);
        else found.push({ path: whole.slice(folder.length + 1), bytes: FS.readFile(whole) });
      }
    };
    if (FS.analyzePath(folder).exists) visit(folder);
    return found;
  }

  /** { status, out, err }: what the program prints, as lines. It runs in the folder `/`. */
  function run(words) {
    lines = { out: [], err: [] };
    length = 0;
    FS.chdir('/');
    const status = instance.callMain(words);
    return { status, ...lines };
  }

  const names = () => JSON.parse(instance.UTF8ToString(instance._texremap_names()));
  return { write, read, run, names };
}
