#!/usr/bin/env node
// bench.mjs MAP_SPEED [INSTRUCTIONS] measures the speed of the package, as a fraction of one core of the C++ library
// (tests/bits/map_speed.cpp). It uses arrays of JavaScript, and arrays in memory of the library. Both programs convert the
// same maps in turn and must give the same bits. Times are processor times, so that other programs disturb little.
import { execFileSync } from 'node:child_process';

import { texremap } from './tests/package.mjs';

await texremap.load();
const COUNT = 2048 * 2048;
const PASSES = 5;
const valueAt = (i) => (Math.imul(i, 0x9e3779b1) >>> 8) * 2 ** -24;
const roughness = Float32Array.from({ length: COUNT }, (_, i) => valueAt(i));
const specular = Float32Array.from({ length: 3 * COUNT }, (_, i) => valueAt(i));
// As in the C++ program, results go to existing memory.
const into = { roughness: new Float32Array(COUNT), specular: new Float32Array(3 * COUNT) };
const plain = { roughness, specular, into };
const held = inMemoryOfLibrary();

function inMemoryOfLibrary() {
  const [width, color, widthOut, colorOut] = [1, 3, 1, 3].map((values) => texremap.allocate('float32', values * COUNT));
  width.array.set(roughness);
  color.array.set(specular);
  return { roughness: width, specular: color, into: { roughness: widthOut, specular: colorOut } };
}

function checksumOf(arrays) {
  let sum = 0;
  for (const array of arrays)
    for (const bits of new Uint32Array(array.buffer, array.byteOffset, array.length)) sum = (Math.imul(sum, 31) + bits) | 0;
  return (sum >>> 0).toString(16).padStart(8, '0');
}

// Returns the fastest of several passes, in Mtexel/s, and its result.
function measured(source, target, maps) {
  let seconds = Infinity;
  let made;
  for (let pass = 0; pass < PASSES; ++pass) {
    const start = process.cpuUsage();
    made = texremap.convert({ source, target, ...maps });
    const { user, system } = process.cpuUsage(start);
    seconds = Math.min(seconds, (user + system) / 1e6);
  }
  return { speed: COUNT / seconds / 1e6, checksum: checksumOf([made.roughness, made.specular]) };
}

let isEqual = true;
console.log('converter                                     C++   node  ratio   held  ratio (Mtexel/s)');
for (const line of execFileSync(process.argv[2], process.argv.slice(3), { encoding: 'utf8' }).trim().split('\n')) {
  const [source, target, speed, checksum] = line.split(' ');
  const results = [plain, held].map((maps) => measured(source, target, maps));
  const isSame = results.every((result) => result.checksum === checksum);
  isEqual &&= isSame;
  const columns = results.map((result) => `${result.speed.toFixed(1).padStart(6)} ${(result.speed / speed).toFixed(2).padStart(6)}`);
  console.log(`${`${source} to ${target}`.padEnd(42)} ${speed.padStart(6)} ${columns.join(' ')}${isSame ? '' : ' OTHER BITS'}`);
}
process.exitCode = isEqual ? 0 : 1;
