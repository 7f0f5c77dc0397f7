// The parts of the page where it is a folder that is served.
export const startWorker = () => new Worker('worker.js');

export async function wasmBytes() {
  const response = await fetch('texremap.wasm');
  if (!response.ok) throw new Error(`texremap.wasm cannot be read: status ${response.status}`);
  return response.arrayBuffer();
}
