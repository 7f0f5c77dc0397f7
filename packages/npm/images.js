// This file decodes and encodes whole image files in memory, without waiting. PNG uses png.js. Other formats use sharp if
// it is installed. sharp works in a separate thread while this one sleeps.
import { MessageChannel, Worker, receiveMessageOnPort } from 'node:worker_threads';

import { decodedPng, encodedPng, isPng } from './png.js';

// Holds the thread with sharp, once it is needed.
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
  if (format === 'png') return encodedPng(image, setting);
  return bySharp({ call: 'encode', format, image, setting });
}

/** Ends the thread, which would keep the process alive. */
export function close() {
  thread?.port.close();
  thread = null;
}
