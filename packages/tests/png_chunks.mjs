// Returns the chunks of a PNG that a picture needs, and the chunks that define how colors are read, with their bytes.
// Returns null for another file.
const COMPARED = new Set(['IHDR', 'PLTE', 'cHRM', 'cICP', 'gAMA', 'iCCP', 'IDAT', 'IEND', 'sRGB']);
const COMPRESSED = new Set(['iCCP', 'IDAT']);

export function pngChunks(file) {
  if (file[0] !== 0x89 || file[1] !== 0x50) return null;
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const chunks = new Map();
  for (let at = 8, length; at + 12 <= file.length; at += 12 + length) {
    length = view.getUint32(at);
    const name = String.fromCharCode(...file.subarray(at + 4, at + 8));
    if (COMPARED.has(name)) chunks.set(name, COMPRESSED.has(name) ? 'compressed' : [...file.subarray(at + 8, at + 8 + length)].join());
  }
  return Object.fromEntries([...chunks].sort());
}
