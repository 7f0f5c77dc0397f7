#!/usr/bin/env node
// bench.mjs MAP_SPEED: the speed of the package, as a share of one core of the C++ library, whose program this is
// (tests/bits/map_speed.cpp). Both convert the same maps in turn and must give the same bits. Times are those of the
// processor, so that other programs disturb little.
import { execFileSync } from 'node:child_process';

import { texremap } from './tests/package.mjs';

await texremap.load();
const COUNT = 2048 * 2048;
const PASSES = 5;
const valueAt = (i) => (Math.imul(i, 0x9e3779b1) >>> 8) * 2 ** -24;
const roughness = Float32Array.from({ length: COUNT }, (_, i) => valueAt(i));
const specular = Float32Array.from({ length: 3 * COUNT }, (_, i) => valueAt(i));
// As in the program, results go to memory that is there.
const into = { roughness: new Float32Array(COUNT), specular: new Float32Array(3 * COUNT) };

function checksumOf(arrays) {
  let sum = 0;
  for (const array of arrays)
    for (const bits of new Uint32Array(array.buffer)) sum = (Math.imul(sum, 31) + bits) | 0;
  return (sum >>> 0).toString(16).padStart(8, '0');
}

let isEqual = true;
console.log('converter                                     C++   node  ratio (Mtexel/s)');
for (const line of execFileSync(process.argv[2], { encoding: 'utf8' }).trim().split('\n')) {
  const [source, target, speed, checksum] = line.split(' ');
  let seconds = Infinity;
  let made;
  for (let pass = 0; pass < PASSES; ++pass) {
    const start = process.cpuUsage();
    made = texremap.convert({ source, target, roughness, specular, into });
    const { user, system } = process.cpuUsage(start);
    seconds = Math.min(seconds, (user + system) / 1e6);
  }
  const own = COUNT / seconds / 1e6;
  const isSame = checksumOf([made.roughness, made.specular]) === checksum;
  isEqual &&= isSame;
  const name = `${source} to ${target}`.padEnd(42);
  console.log(`${name} ${speed.padStart(6)} ${own.toFixed(1).padStart(6)} ${(own / speed).toFixed(2).padStart(6)}${isSame ? '' : ' OTHER BITS'}`);
}
process.exitCode = isEqual ? 0 : 1;
