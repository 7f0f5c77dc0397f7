// This file runs the page in a headless Chromium, and does there what the tests need.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const repository = resolve(dirname(fileURLToPath(import.meta.url)), '../..');
export const built = process.env.TEXREMAP_WEB ?? join(repository, 'build/packages/web');
export const native = process.env.TEXREMAP_NATIVE ?? join(repository, 'build/release/bin/texremap');
const modules = join(repository, 'build/web/node_modules');

const chromium = [process.env.CHROMIUM, 'chromium-headless-shell', 'chromium', 'google-chrome'].find(
  (name) => name && spawnSync(name, ['--version']).status === 0);

export const skipBrowser = !chromium ? 'Chromium is not installed (apt-get install --no-install-recommends chromium-headless-shell)'
  : !existsSync(modules) ? 'the modules of the page are not fetched (scripts/package web)'
  : false;
export const skip = skipBrowser || (!existsSync(join(built, 'texremap.html')) ? 'the page is not built (scripts/package web)' : false);
export const skipNative = skip || (existsSync(native) ? false : 'texremap is not built (TEXREMAP_NATIVE names another one)');

/** A package of the page. */
export const loaded = async (name) => import(pathToFileURL(createRequire(join(modules, 'x')).resolve(name)).href);

const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

/** The folder by a server of this machine: { url, close }. */
export async function served() {
  const server = createServer((request, response) => {
    const path = join(built, 'texremap-web', request.url === '/' ? 'index.html' : request.url);
    if (!existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'text/plain' }).end(readFileSync(path));
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export const fileUrl = () => pathToFileURL(join(built, 'texremap.html')).href;

export async function startBrowser(...flags) {
  const { default: puppeteer } = await loaded('puppeteer-core');
  const path = spawnSync('which', [chromium], { encoding: 'utf8' }).stdout.trim();
  return puppeteer.launch({ executablePath: path, headless: true, args: [...(process.getuid?.() === 0 ? ['--no-sandbox'] : []), '--enable-unsafe-swiftshader', ...flags] });
}

/** One visit: what a person does, and what the page says. */
export class Visit {
  static async begin(browser, url, downloads) {
    const visit = new Visit();
    visit.page = await browser.newPage();
    visit.errors = [];
    visit.requests = [];
    visit.page.on('console', (message) => message.type() === 'error' && visit.errors.push(message.text()));
    visit.page.on('pageerror', (error) => visit.errors.push(error.message));
    visit.page.on('request', (request) => visit.requests.push(request.url()));
    visit.session = await visit.page.createCDPSession();
    visit.downloads = downloads;
    mkdirSync(downloads, { recursive: true });
    await (await browser.target().createCDPSession()).send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: downloads, eventsEnabled: true });
    await visit.page.setViewport({ width: 1100, height: 1400 });
    await visit.page.goto(url);
    await visit.#wait(() => document.querySelectorAll('#to option').length > 0);
    return visit;
  }

  // Drops files on the page, as a file manager does.
  async drop(...files) {
    const box = await (await this.page.$('#drop')).boundingBox();
    const data = { items: [], files, dragOperationsMask: 1 };
    const place = { x: box.x + box.width / 2, y: box.y + 20, data };
    for (const type of ['dragEnter', 'dragOver', 'drop']) await this.session.send('Input.dispatchDragEvent', { type, ...place });
    await this.#wait(() => !document.getElementById('convert').disabled);
  }

  async choose(input, ...files) {
    await (await this.page.$(input)).uploadFile(...files);
    await this.#wait(() => !document.getElementById('convert').disabled);
  }

  // waitForFunction() would need `eval`, which the page forbids.
  async #wait(condition) {
    for (const end = Date.now() + 20000; Date.now() < end;) {
      if (await this.page.evaluate(condition)) return;
      await new Promise((done) => setTimeout(done, 20));
    }
    throw new Error(`${condition}: not within 20 s; ${this.errors.join('; ')} ${await this.page.$eval('#report', (report) => report.innerText)}`);
  }

  /** The report, once it is there. */
  async convert({ from = '', to = 'gltf', more = '' } = {}) {
    for (const [field, value] of [['#from', from], ['#to', to]]) {
      const [chosen] = await this.page.select(field, value);
      if (chosen !== value) throw new Error(`${field} does not have ${value}`);
    }
    await this.page.$eval('#more', (input, text) => { input.value = text; }, more);
    await this.page.focus('#convert');
    await this.page.keyboard.press('Enter');
    await this.#wait(() => !document.body.hasAttribute('aria-busy') && !document.getElementById('report').textContent.includes('Converting'));
    return this.page.$eval('#report', (report) => report.innerText);
  }

  /** { name, bytes } */
  async download() {
    const name = await this.page.$eval('#download', (link) => link.download);
    const file = join(this.downloads, name);
    rmSync(file, { force: true });
    await this.page.focus('#download');
    await this.page.keyboard.press('Enter');
    for (let tries = 0; tries < 200 && !existsSync(file); ++tries) await new Promise((done) => setTimeout(done, 50));
    return { name, bytes: new Uint8Array(readFileSync(file)) };
  }

  close() {
    return this.page.close();
  }
}

export function filesBelow(root, below = '') {
  return readdirSync(join(root, below), { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesBelow(root, join(below, entry.name)) : [join(below, entry.name)]).sort();
}
