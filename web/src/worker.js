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

onmessage = async ({ data: { call, number, ...given } }) => {
  try {
    const answer = await calls[call](given);
    postMessage({ number, answer });
  } catch (error) {
    postMessage({ number, failure: `${error.message ?? error}` });
  }
};
