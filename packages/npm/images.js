// Whole image files in memory, decoded and encoded without waiting: PNG by fast-png, others by sharp where it is
// installed, which works in a thread of its own while this one sleeps.
import { MessageChannel, Worker, receiveMessageOnPort } from 'node:worker_threads';

import { decode as decodePng, encode as encodePng } from 'fast-png';

const isPng = (bytes) => bytes[0] === 0x89 && bytes[1] === 0x50;

// Samples of fewer than 8 bits, which fast-png leaves packed, a row at a time.
function unpacked({ width, height, data, depth }) {
  const samples = new Uint8Array(width * height);
  const rowBytes = Math.ceil((width * depth) / 8);
  const highest = (1 << depth) - 1;
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const bit = x * depth;
      samples[y * width + x] = (data[y * rowBytes + (bit >> 3)] >> (8 - depth - (bit & 7))) & highest;
    }
  return samples;
}

// As libpng expands: palettes to RGB, fewer bits than 8 to 8, a color that counts as transparent to opacity.
function decodedPng(bytes) {
  const png = decodePng(bytes, { checkCrc: true });
  const { width, height, palette, transparency } = png;
  const count = width * height;
  if (palette) {
    const indices = png.depth < 8 ? unpacked(png) : png.data;
    const channels = palette.some((color) => color.length === 4) ? 4 : 3;
    const data = new Uint8Array(count * channels);
    for (let i = 0; i < count; ++i) {
      const color = palette[indices[i]];
      if (color === undefined) throw new Error('a texel names a color that the palette does not have');
      for (let c = 0; c < channels; ++c) data[i * channels + c] = color[c] ?? 255;
    }
    return { width, height, channels, depth: 8, data };
  }
  const few = png.depth < 8;
  const samples = few ? unpacked(png) : png.data;
  const scale = few ? 255 / ((1 << png.depth) - 1) : 1;
  const depth = few ? 8 : png.depth;
  const scaled = few ? samples.map((value) => value * scale) : samples;
  if (!transparency?.length) return { width, height, channels: png.channels, depth, data: scaled };
  const channels = png.channels + 1;
  const data = new scaled.constructor(count * channels);
  for (let i = 0; i < count; ++i) {
    let isOpaque = false;
    for (let c = 0; c < png.channels; ++c) {
      isOpaque ||= samples[i * png.channels + c] !== transparency[c];
      data[i * channels + c] = scaled[i * png.channels + c];
    }
    data[i * channels + channels - 1] = isOpaque ? (depth === 16 ? 65535 : 255) : 0;
  }
  return { width, height, channels, depth, data };
}

// The thread with sharp, once it is needed.
let thread = null;

function startThread() {
  const flag = new Int32Array(new SharedArrayBuffer(4));
  const { port1, port2 } = new MessageChannel();
  const worker = new Worker(new URL('./sharp_thread.js', import.meta.url), {
    workerData: { flag, port: port2 },
    transferList: [port2],
  });
  worker.unref();
  return { flag, port: port1 };
}

function bySharp(request) {
  thread ??= startThread();
  Atomics.store(thread.flag, 0, 0);
  thread.port.postMessage(request);
  Atomics.wait(thread.flag, 0, 0);
  const { message } = receiveMessageOnPort(thread.port);
  if (message.failure) throw new Error(message.failure);
  return message.answer;
}

/** { width, height, channels, depth: 8 or 16, data } of a file; opacity is not multiplied into colors. */
export function decode(bytes) {
  return isPng(bytes) ? decodedPng(bytes) : bySharp({ call: 'decode', bytes });
}

/** The bytes of a file. `setting`: the level of png, the quality of jpeg. */
export function encode(format, image, setting) {
  if (format === 'png') return encodePng(image, { zlib: { level: setting } });
  return bySharp({ call: 'encode', format, image, setting });
}

/** Ends the thread, which would keep the process alive. */
export function close() {
  thread?.port.close();
  thread = null;
}
