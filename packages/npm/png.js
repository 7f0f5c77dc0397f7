// This file reads and writes PNG files in memory by fast-png, without waiting, for node and for pages.
import { decode, encode } from 'fast-png';

export const isPng = (bytes) => bytes[0] === 0x89 && bytes[1] === 0x50;

const MOST_TEXELS = 2 ** 30;
const MOST_BYTES_OF_A_BYTE = 1e6;  // no format packs more bytes of pixels into a byte of the file
const SIGNATURE = 8, CHUNK = 12;  // sizes of the signature, and of a chunk without data
const IHDR = 0x49484452, IEND = 0x49454e44;
const CHANNELS = [1, 1, 3, 1, 2, 2, 4];  // by the color type

/** Refuses an image of `size` bytes that claims more texels than any is decoded with, or than its bytes can hold. */
export function requirePlausible(width, height, texelBytes, size) {
  if (width * height > MOST_TEXELS) throw new Error(`${width}x${height} texels are more than ${MOST_TEXELS}`);
  if (width * height * texelBytes > MOST_BYTES_OF_A_BYTE * size)
    throw new Error(`is damaged: claims ${width}x${height} texels in ${size} bytes`);
}

// Checks the headers, because fast-png allocates what the file claims in its last header.
function examine(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let at = SIGNATURE, end; at + CHUNK <= bytes.length; at = end) {
    const name = view.getUint32(at + 4);
    if (name === IEND) return;  // anything may follow
    end = at + CHUNK + view.getUint32(at);
    if (end > bytes.length) throw new Error('is damaged: a chunk claims to be longer than the file');
    if (name !== IHDR) continue;
    if (end - at < CHUNK + 13) throw new Error('is damaged: its header is too short');
    const texelBytes = (Math.max(bytes[at + 16], 8) / 8) * (CHANNELS[bytes[at + 17]] ?? 4);
    requirePlausible(view.getUint32(at + 8), view.getUint32(at + 12), texelBytes, bytes.length);
  }
}

// Unpacks samples of fewer than 8 bits, which fast-png leaves packed, one row at a time.
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

// Expands like libpng: palettes to RGB, fewer bits than 8 to 8, and a transparent color to opacity.
export function decodedPng(bytes) {
  examine(bytes);
  const png = decode(bytes, { checkCrc: true });
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

/** The bytes of a file; `level` is that of zlib, 1 to 9. */
export function encodedPng(image, level) {
  return encode(image, { zlib: { level } });
}
