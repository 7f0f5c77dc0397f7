// These are the parts of a page that is one file, with texts inside it.
const textOf = (id) => document.getElementById(id).textContent;

export const startWorker = () => new Worker(URL.createObjectURL(new Blob([textOf('worker')], { type: 'text/javascript' })));

export async function wasmBytes() {
  const packed = Uint8Array.from(atob(textOf('wasm')), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
