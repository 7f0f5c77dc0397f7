// This file makes one instance of the program texremap over files in memory, for pages, workers and node.

const MOST_LINES = 1000;  // limit for the program's messages

/** `makeInstance` and `module`: its glue and its WebAssembly, compiled; `images` decodes and encodes whole files (images.js). */
export async function startProgram(makeInstance, module, images) {
  const start = performance.now();
  let out = [];
  let err = [];
  const instance = await makeInstance({
    images,
    locateFile: (name) => name,
    processes: { own: 1, machine: '', hasEnded: () => false, use: () => [(performance.now() - start) / 1e3, 0] },
    noInitialRun: true,
    thisProgram: 'texremap',
    print: (line) => out.push(line),
    printErr: (line) => err.push(line.replace(/^.*\x1b\[K/s, '')),  // without progress, as on a terminal
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
    out = [];
    err = [];
    FS.chdir('/');
    const status = instance.callMain(words);
    const more = err.length - MOST_LINES;
    if (more > 0) err.splice(MOST_LINES / 2, more, `(${more} lines are not shown)`);
    return { status, out, err };
  }

  return { instance, write, read, run };
}
