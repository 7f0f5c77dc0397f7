// This file tests the command that the page shows, and the names in its archive. It needs neither the page nor a browser.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import test from 'node:test';

import { archived, quoted } from '../src/conversion.js';

test('a shell takes each word of the command for what it is', () => {
  const words = ['convert', '--from=a', "it's", "'; touch x; '", '$(touch x)', '`touch x`', '"', '\\', '', ' ', 'a\nb', '=ls', '~', '*', '!!', 'é'];
  const shown = execFileSync('sh', ['-c', `printf '%s\\0' ${words.map(quoted).join(' ')}`]).toString();
  assert.deepEqual(shown.split('\0').slice(0, -1), words);
  for (const word of ['in', '--to', 'gltf-specgloss', 'a/b.png', 'cycles-5/ggx', '0.04,0.1']) assert.equal(quoted(word), word);
});

test('names of an archive have no backslash, and no file is lost', () => {
  const paths = ['a/b.png', '..\\..\\x.png', '.._.._x.png', '__proto__'];
  const names = [...archived(paths.map((path) => ({ path, bytes: path }))).keys()];
  assert.deepEqual(names, ['a/b.png', '.._.._x.png', '_.._.._x.png', '__proto__']);
});
