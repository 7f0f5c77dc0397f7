// This file checks the needs of a test. It reports what is missing, and the test is skipped (77), or fails if REMAP_REQUIRE
// holds "npm".
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { packageFolder } from './package.mjs';

function skipAll(reason) {
  console.log(`skipped: npm: ${reason}`);
  const isRequired = (process.env.REMAP_REQUIRE ?? '').split(',').includes('npm');
  process.exit(isRequired ? 1 : 77);
}

export function needFile(file, remedy) {
  if (!file || !existsSync(file)) skipAll(`${file || 'a file'} is not there (${remedy})`);
  return file;
}

/** The exports of a package of npm, as the package under test finds it. */
export async function needPackage(name) {
  let file;
  try {
    file = createRequire(join(packageFolder, 'cli.js')).resolve(name);
  } catch {
    skipAll(`${name} is not installed (packages/npm/tests/install.bash ${packageFolder})`);
  }
  // If a package has two forms, use the one that `import` takes.
  const other = file.replace(/\.cjs$/, '.js');
  return import(pathToFileURL(existsSync(other) ? other : file).href);
}
