// These are the parts of a page that is a served folder.
export const startWorker = () => new Worker('worker.js');

export async function wasmBytes() {
  const response = await fetch('texremap.wasm');
  if (!response.ok) throw new Error(`texremap.wasm cannot be read: status ${response.status}`);
  return response.arrayBuffer();
}
