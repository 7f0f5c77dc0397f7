#!/usr/bin/env node
// This file runs the program texremap, compiled to WebAssembly, over the files of this machine.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { hostname } from 'node:os';
import { isatty } from 'node:tty';

import * as images from './images.js';

// The program needs these for the marks of unfinished files (runtime/core/files.hpp), and for reports.
const processes = {
  own: process.pid,
  machine: hostname(),
  hasEnded(number) {
    try {
      process.kill(number, 0);
      return false;
    } catch (error) {
      return error.code === 'ESRCH';
    }
  },
  use() {
    const { userCPUTime, systemCPUTime, maxRSS } = process.resourceUsage();
    return [(userCPUTime + systemCPUTime) / 1e6, maxRSS * 1024];
  },
};
const makeProgram = createRequire(import.meta.url)('./program.cjs');
const program = await makeProgram({
  wasmBinary: readFileSync(new URL('./program.wasm', import.meta.url)),
  images,
  processes,
  noInitialRun: true,
  thisProgram: 'texremap',
});
for (const fd of [0, 1, 2]) program.FS.streams[fd].tty = isatty(fd);
process.exitCode = program.callMain(process.argv.slice(2));
images.close();
