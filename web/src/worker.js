// The worker makes one instance of the program for each conversion, so that its memory is freed.
import { Conversion } from './conversion.js';
import { Images } from './images.js';
import { makeProgram } from './program.js';

let compiled = null;
let last = null;

const calls = {
  async start({ wasm }) {
    compiled = await WebAssembly.compile(wasm);
    return (await makeProgram(compiled, new Images())).names();
  },
  async convert({ files, request }) {
    const images = new Images();
    last = new Conversion(await makeProgram(compiled, images), images);
    return last.run(files, request);
  },
  // Runs later, so that files need not wait for pictures.
  report: () => last.report(),
};

// The program itself calls `abort` only if its memory, of 2 GB at most, is full.
const textOf = (error) =>
  error instanceof WebAssembly.RuntimeError || error instanceof RangeError
    ? `not enough memory (convert fewer files at a time): ${error.message}` : `${error.message ?? error}`;

onmessage = async ({ data: { call, number, ...given } }) => {
  try {
    const answer = await calls[call](given);
    postMessage({ number, answer });
  } catch (error) {
    postMessage({ number, failure: textOf(error) });
  }
};
