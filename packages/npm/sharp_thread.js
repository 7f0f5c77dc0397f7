// This file decodes and encodes by sharp. The caller sleeps until the flag is set (images.js).
import { workerData } from 'node:worker_threads';

import { requirePlausible } from './png.js';

const { flag, port } = workerData;

async function loaded() {
  try {
    return (await import('sharp')).default;
  } catch (error) {
    const state = error.code === 'ERR_MODULE_NOT_FOUND' ? 'is not installed' : 'has no program for this machine';
    const isGlobal = new URL('../..', import.meta.url).pathname.endsWith('/lib/');
    throw new Error(`JPEG, WebP and TIFF need sharp, which ${state} (npm install${isGlobal ? ' --global' : ''} --include=optional sharp)`);
  }
}

async function decoded(sharp, { bytes }) {
  const image = sharp(bytes, { limitInputPixels: 2 ** 28, failOn: 'truncated' });
  const { width, height, depth, channels: stored } = await image.metadata();
  if (depth !== 'uchar' && depth !== 'ushort') throw new Error(`holds ${depth} values, and not 8 or 16 bits`);
  const isWide = depth === 'ushort';
  requirePlausible(width, height, stored * (isWide ? 2 : 1), bytes.length);
  const isGrey = stored < 3;
  // Named spaces keep sharp from changing values.
  const space = isGrey ? (isWide ? 'grey16' : 'b-w') : isWide ? 'rgb16' : 'srgb';
  const { data, info } = await image
    .pipelineColourspace(space)
    .toColourspace(space)
    .raw({ depth: isWide ? 'ushort' : 'uchar' })
    .toBuffer({ resolveWithObject: true });
  return { width: info.width, height: info.height, channels: info.channels, depth: isWide ? 16 : 8, data: new Uint8Array(data) };
}

async function encoded(sharp, { format, image, setting }) {
  const { width, height, channels, depth, data } = image;
  const isWide = depth === 16;
  const space = channels < 3 ? (isWide ? 'grey16' : 'b-w') : isWide ? 'rgb16' : 'srgb';
  const input = sharp(data, { raw: { width, height, channels } }).pipelineColourspace(space).toColourspace(space);
  const output = format === 'jpeg' ? input.jpeg({ quality: setting, chromaSubsampling: '4:4:4' }) : input.tiff({ compression: 'deflate' });
  return new Uint8Array(await output.toBuffer());
}

port.on('message', async (request) => {
  let message;
  try {
    const sharp = await loaded();
    message = { answer: await (request.call === 'decode' ? decoded : encoded)(sharp, request) };
  } catch (error) {
    message = { failure: String(error.message) };
  }
  port.postMessage(message);
  Atomics.store(flag, 0, 1);
  Atomics.notify(flag, 0);
});
