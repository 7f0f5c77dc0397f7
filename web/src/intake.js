// This file collects dropped or chosen files: [{ path, file }]. Paths include the folders that were given.

const isHidden = (path) => path.split('/').some((part) => part.startsWith('.'));

const promised = (start) => new Promise((done, fail) => start(done, fail));

// Uses handles of the File System API, which pages from disk have as well.
async function filesOfHandle(handle, folder, found) {
  const path = folder + handle.name;
  if (handle.kind === 'file') found.push({ path, file: await handle.getFile() });
  else for await (const inside of handle.values()) await filesOfHandle(inside, `${path}/`, found);
}

// Uses entries, which every browser has if the page is served.
async function filesOfEntry(entry, found) {
  if (entry.isFile) {
    found.push({ path: entry.fullPath.slice(1), file: await promised((done, fail) => entry.file(done, fail)) });
    return;
  }
  const reader = entry.createReader();
  for (;;) {  // each call returns only some of the entries
    const entries = await promised((done, fail) => reader.readEntries(done, fail));
    if (entries.length === 0) return;
    for (const inside of entries) await filesOfEntry(inside, found);
  }
}

const sorted = (files) => files.filter(({ path }) => !isHidden(path)).sort((a, b) => (a.path < b.path ? -1 : 1));

export async function filesOfDrop(transfer) {
  const found = [];
  // Items are gone after the first wait.
  const items = [...transfer.items].filter((item) => item.kind === 'file');
  if (items[0]?.getAsFileSystemHandle) {
    const handles = await Promise.all(items.map((item) => item.getAsFileSystemHandle()));
    for (const handle of handles) await filesOfHandle(handle, '', found);
  } else {
    const entries = items.map((item) => item.webkitGetAsEntry());
    for (const entry of entries) await filesOfEntry(entry, found);
  }
  return sorted(found);
}

export const filesOfInput = (input) =>
  sorted([...input.files].map((file) => ({ path: file.webkitRelativePath || file.name, file })));

export const bytesOf = (files) =>
  Promise.all(files.map(async ({ path, file }) => ({ path, bytes: new Uint8Array(await file.arrayBuffer()) })));
