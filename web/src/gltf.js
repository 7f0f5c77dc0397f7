// This file reads what the page shows of glTF files: their images and materials. The program does the conversion.

const isGlb = (bytes) => bytes.length >= 20 && new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true) === 0x46546c67;

const folderOf = (path) => path.slice(0, path.lastIndexOf('/') + 1);

function joined(folder, uri) {
  const parts = [];
  for (const part of `${folder}${decodeURIComponent(uri)}`.split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '.') parts.push(part);
  }
  return parts.join('/');
}

function bytesOfDataUri(uri) {
  const comma = uri.indexOf(',');
  const text = uri.slice(comma + 1);
  if (!uri.slice(0, comma).endsWith(';base64')) return new TextEncoder().encode(decodeURIComponent(text));
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

// Returns { document, binary } of a .glb or .gltf file.
function opened(bytes) {
  if (!isGlb(bytes)) return { document: JSON.parse(new TextDecoder().decode(bytes)) };
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const chunks = [];
  for (let at = 12; at + 8 <= bytes.length;) {
    const length = view.getUint32(at, true);
    chunks.push(bytes.subarray(at + 8, at + 8 + length));
    at += 8 + length;
  }
  return { document: JSON.parse(new TextDecoder().decode(chunks[0])), binary: chunks[1] };
}

export const isGltf = (path) => /\.(gltf|glb)$/i.test(path);

/** An asset of the files [{ path, bytes }]: { imageCount, imageBytes(index) }; null where it is damaged. */
export function openAsset(files, path) {
  const byPath = new Map(files.map((file) => [file.path, file.bytes]));
  try {
    const { document, binary } = opened(byPath.get(path));
    const bytesAt = (uri) => (uri.startsWith('data:') ? bytesOfDataUri(uri) : byPath.get(joined(folderOf(path), uri)));
    const imageBytes = (index) => {
      const image = document.images?.[index];
      if (image?.uri !== undefined) return bytesAt(image.uri);
      const view = document.bufferViews?.[image?.bufferView];
      if (!view) return undefined;
      const uri = document.buffers?.[view.buffer]?.uri;
      const first = view.byteOffset ?? 0;
      return (uri === undefined ? binary : bytesAt(uri))?.subarray(first, first + view.byteLength);
    };
    return {
      imageCount: document.images?.length ?? 0,
      imageBytes,
    };
  } catch {
    return null;
  }
}
