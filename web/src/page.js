// This is the page: files in, a conversion by the worker, its report and files out.
import { zipSync } from 'fflate';
import { startWorker, wasmBytes } from 'parts';

import { archived } from './conversion.js';
import { Core } from './core.js';
import { bytesOf, filesOfDrop, filesOfInput } from './intake.js';
import { Viewer } from '../viewer/viewer.js';

const $ = (id) => document.getElementById(id);

let core = null;
let files = [];  // [{ path, file }]

function report(lines) {
  $('report').replaceChildren(...lines.map((line) => {
    const paragraph = document.createElement('p');
    paragraph.textContent = line.replace(/^texremap: /, '');
    if (/^texremap: warning: /.test(line)) paragraph.className = 'warning';
    else if (/^(texremap: )?error: /.test(line)) paragraph.className = 'error';
    return paragraph;
  }));
}

const fail = (text) => report([`error: ${text}`]);

function optionGroup(label, options) {
  const group = document.createElement('optgroup');
  group.label = label;
  group.append(...options.map(([value, text = value, title = '']) => Object.assign(new Option(text, value), { title })));
  return group;
}

const named = ({ title, name, model }) => [name, model === name ? title : `${title} (${model})`];

let engines = new Set();  // their programs expect their own file names

function fillNames({ programs, formats, models, engines: names }) {
  engines = new Set(names);
  for (const list of [$('from'), $('to')])
    list.append(
      optionGroup('Programs', programs.map(named)),
      optionGroup('File formats', formats.map(named)),
      optionGroup('Renderers and research models', models.map((name) => [name])));
  $('to').querySelector('optgroup:nth-of-type(2)').append(new Option('glTF, packed into its files', 'gltf layout'));
  $('to').value = 'gltf';
}

const isAsset = (path) => /\.(gltf|glb|mtl|obj)$/i.test(path);
const sized = (bytes) => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

function take(found) {
  files = found;
  $('download').hidden = true;
  const size = found.reduce((sum, { file }) => sum + file.size, 0);
  const first = found.find(({ path }) => isAsset(path)) ?? found[0];
  $('chosen').textContent = found.length === 0 ? 'There are no files in this.'
    : found.length === 1 ? `${first.path}, ${sized(size)}`
    : `${found.length} files, ${sized(size)}: ${first.path} and others`;
  $('convert').disabled = found.length === 0 || core === null;
  if (found.some(({ path }) => isAsset(path))) {
    $('from').value = '';
    $('to').value = 'gltf';
  }
}

let link = null;

function offer(results) {
  if (link) URL.revokeObjectURL(link);
  link = null;
  $('download').hidden = results.length === 0;
  if (results.length === 0) return;
  const [only] = results;
  // The same results give the same bytes.
  const entries = () =>
    Object.fromEntries([...archived(results)].map(([name, bytes]) => [name, [bytes, { level: 0, mtime: new Date(1980, 0, 1) }]]));
  const bytes = results.length === 1 ? only.bytes : zipSync(entries());
  const name = results.length === 1 ? only.path.slice(only.path.lastIndexOf('/') + 1) : 'texremap.zip';
  link = URL.createObjectURL(new Blob([bytes]));
  Object.assign($('download'), { href: link, download: name, textContent: `Download ${name} (${sized(bytes.length)})` });
}

// The conversion stays valid, even if the pictures fail.
async function draw(lines) {
  try {
    const shown = await core.call('report');
    $('stage').hidden = false;
    new Viewer($('viewer'), shown);
  } catch (error) {
    report([...lines, `texremap: note: it has no pictures: ${error.message}`]);
  }
}

let isBusy = false;

async function convert() {
  if (isBusy || files.length === 0 || core === null) return;
  isBusy = true;
  const chosen = $('to').value;
  const [to, isPacked] = chosen.split(' ');
  const layout = isPacked ? to : '';
  const request = { from: $('from').value, to, layout, isEngine: isPacked || engines.has(to), more: $('more').value };
  $('download').hidden = true;
  $('stage').hidden = true;
  document.body.setAttribute('aria-busy', 'true');
  report(['Converting…']);
  try {
    const given = await bytesOf(files);
    const answer = await core.call('convert', { files: given, request }, given.map(({ bytes }) => bytes.buffer));
    $('command').firstElementChild.textContent = answer.command;
    const lines = [...answer.report];
    if (answer.status !== 0) lines.push(`error: not everything was converted (exit code ${answer.status})`);
    report(lines);
    offer(answer.files);
    if (answer.status === 0) await draw(lines);
  } catch (error) {
    fail(error.message);
  } finally {
    isBusy = false;
    document.body.removeAttribute('aria-busy');
  }
}

function listen() {
  $('form').addEventListener('submit', (event) => {
    event.preventDefault();
    convert();
  });
  for (const kind of ['files', 'folder']) {
    $(`choose-${kind}`).addEventListener('click', () => $(kind).click());
    $(kind).addEventListener('change', () => take(filesOfInput($(kind))));
  }
  // Accept files anywhere on the page, because a file that misses the box would replace the page.
  addEventListener('dragover', (event) => {
    event.preventDefault();
    $('drop').classList.add('over');
  });
  addEventListener('dragleave', () => $('drop').classList.remove('over'));
  addEventListener('drop', async (event) => {
    event.preventDefault();
    $('drop').classList.remove('over');
    try {
      take(await filesOfDrop(event.dataTransfer));
    } catch (error) {
      fail(`the files cannot be read: ${error.message}`);
    }
  });
}

async function start() {
  listen();
  try {
    const begun = new Core(startWorker());
    const wasm = await wasmBytes();
    const names = await begun.call('start', { wasm }, [wasm]);
    fillNames(names);
    core = begun;
    take(files);
    if (files.length === 0) $('chosen').textContent = 'No files yet.';
  } catch (error) {
    fail(`the page cannot start: ${error.message} (serve the folder by a web server, or open texremap.html, which needs none)`);
  }
}

start();
