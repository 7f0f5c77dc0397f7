#!/usr/bin/env node
// The program texremap, compiled to WebAssembly, over the files of this machine.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

import * as images from './images.js';

const makeProgram = createRequire(import.meta.url)('./program.cjs');
const program = await makeProgram({
  wasmBinary: readFileSync(new URL('./program.wasm', import.meta.url)),
  images,
  noInitialRun: true,
  thisProgram: 'texremap',
});
process.exitCode = program.callMain(process.argv.slice(2));
images.close();
