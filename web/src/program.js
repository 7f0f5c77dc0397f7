// This file makes one instance of the program: files in memory, and runs over them.
import makeInstance from 'page.mjs';

import { startProgram } from '../../packages/npm/memory_program.js';

/** `module` is page.wasm, compiled; `images` decodes and encodes whole files (images.js). */
export async function makeProgram(module, images) {
  const { instance, ...program } = await startProgram(makeInstance, module, images);
  const names = () => JSON.parse(instance.UTF8ToString(instance._texremap_names()));
  return { ...program, names };
}
