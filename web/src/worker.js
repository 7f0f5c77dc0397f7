// The worker: one instance of the program a conversion, so that memory is given back.
import { convert } from './conversion.js';
import { Images } from './images.js';
import { makeProgram } from './program.js';

let compiled = null;

const calls = {
  async start({ wasm }) {
    compiled = await WebAssembly.compile(wasm);
    return (await makeProgram(compiled, new Images())).names();
  },
  async convert({ files, request }) {
    const images = new Images();
    return convert(await makeProgram(compiled, images), files, request, images);
  },
};

// The program itself ends by `abort` for one reason: its memory, of 2 GB at most, is full.
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
