// This file reads JPEG and WebP by the browser's decoders, through a texture of WebGL. Only this gives stored values, even
// for files with profiles, gamma or opacity. A 2-D canvas would multiply colors by opacity. Without
// `colorSpaceConversion: 'none'`, the browser would convert colors.

const textAt = (bytes, at, length) => String.fromCharCode(...bytes.subarray(at, at + length));
const isJpeg = (bytes) => bytes[0] === 0xff && bytes[1] === 0xd8;
const isWebp = (bytes) => textAt(bytes, 0, 4) === 'RIFF' && textAt(bytes, 8, 4) === 'WEBP';

export const isOfBrowser = (bytes) => isJpeg(bytes) || isWebp(bytes);

const EXIF = 0xe1, START_OF_SCAN = 0xda;
const isStartOfFrame = (marker) => marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);

// Returns the number of components, and the file without EXIF, whose orientation would turn the image.
function lookIntoJpeg(bytes) {
  const kept = [bytes.subarray(0, 2)];
  let components = 0;
  let at = 2;
  while (at + 4 <= bytes.length && bytes[at] === 0xff && bytes[at + 1] !== START_OF_SCAN) {
    if (bytes[at + 1] === 0xff) {  // a fill byte
      ++at;
      continue;
    }
    const end = at + 2 + ((bytes[at + 2] << 8) | bytes[at + 3]);
    if (isStartOfFrame(bytes[at + 1])) components = bytes[at + 9];
    if (bytes[at + 1] !== EXIF) kept.push(bytes.subarray(at, end));
    at = end;
  }
  kept.push(bytes.subarray(at));
  return { components, parts: kept };
}

function hasOpacity(webp) {
  const kind = textAt(webp, 12, 4);
  if (kind === 'VP8X') return (webp[20] & 0x10) !== 0;
  return kind === 'VP8L' && (webp[24] & 0x10) !== 0;
}

let context = null;

function graphics() {
  if (context === null || context.isContextLost())
    context = new OffscreenCanvas(1, 1).getContext('webgl2', { antialias: false, depth: false });
  if (!context) throw new Error('JPEG and WebP need WebGL 2, which this browser does not have (convert them to PNG)');
  return context;
}

// Returns RGBA of the image, as it is stored.
function texelsOf(bitmap) {
  const gl = graphics();
  const { width, height } = bitmap;
  const largest = gl.getParameter(gl.MAX_TEXTURE_SIZE);
  if (width > largest || height > largest)
    throw new Error(`is larger than ${largest} texels, the most that this browser decodes (convert it to PNG)`);
  const texture = gl.createTexture();
  const frame = gl.createFramebuffer();
  const data = new Uint8Array(width * height * 4);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const failure = gl.getError();
  gl.deleteFramebuffer(frame);
  gl.deleteTexture(texture);
  if (failure !== gl.NO_ERROR) throw new Error('needs more memory than graphics have here (convert it to PNG)');
  return data;
}

function withChannels(rgba, channels) {
  if (channels === 4) return rgba;
  const data = new Uint8Array((rgba.length / 4) * channels);
  for (let from = 0, to = 0; from < rgba.length; from += 4)
    for (let c = 0; c < channels; ++c) data[to++] = rgba[from + c];
  return data;
}

/** As decode() of images.js, once it is done. Grey JPEG has one channel, as libjpeg says. */
export async function decodeByBrowser(bytes) {
  let parts = [bytes];
  let channels = 3;
  if (isJpeg(bytes)) {
    const jpeg = lookIntoJpeg(bytes);
    if (jpeg.components === 4) throw new Error('is CMYK (convert it to RGB)');
    parts = jpeg.parts;
    channels = jpeg.components === 1 ? 1 : 3;
  } else if (hasOpacity(bytes)) {
    channels = 4;
  }
  let bitmap;
  try {
    bitmap = await createImageBitmap(new Blob(parts), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  } catch {
    throw new Error('the image is damaged');
  }
  try {
    const data = withChannels(texelsOf(bitmap), channels);
    return { width: bitmap.width, height: bitmap.height, channels, depth: 8, data };
  } finally {
    bitmap.close();
  }
}
