// This file reads the bytes of a .wasm file, wherever it is.

/** Of bytes, a URL or a Response. `fail` makes the error of an address that cannot be read. */
export async function bytesOf(source, fail) {
  if (source instanceof Response) return source.arrayBuffer();
  if (source instanceof URL || typeof source === 'string') {
    const url = new URL(source, import.meta.url);
    if (url.protocol === 'file:') return (await import('node:fs/promises')).readFile(url);
    const response = await fetch(url);
    if (!response.ok) throw fail(`${url}: cannot be read: status ${response.status}`);
    return response.arrayBuffer();
  }
  return source;
}
