// build.mjs OUT MODULES PROGRAM makes the page: the folder OUT to serve, and beside it texremap.html, the same page in one
// file. MODULES is the folder node_modules. PROGRAM is the folder with page.mjs and page.wasm.
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const [out, modules, program] = process.argv.slice(2).map((path) => resolve(path));
const { build } = createRequire(join(modules, 'x'))('esbuild');
const repository = join(dirname(fileURLToPath(import.meta.url)), '..');
const source = join(repository, 'web/src');
const sourceText = (name) => readFileSync(join(source, name), 'utf8');
const style = ['../viewer/page.css', '../viewer/viewer.css', 'style.css'].map(sourceText).join('');

async function bundled(entry, alias = {}) {
  const { outputFiles } = await build({
    entryPoints: [join(source, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    nodePaths: [modules],
    alias: { 'page.mjs': join(program, 'page.mjs'), ...alias },
    loader: { '.glsl': 'text' },
    define: { 'import.meta.url': '""' },
    legalComments: 'none',
    logLevel: 'warning',
  });
  return outputFiles[0].text;
}

// In HTML, a script ends at the first `</script`.
const inline = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const filled = (values) => sourceText('index.html').replace(/%([A-Z]+)%/g, (_, name) => values[name]);

// With this policy, the browser itself prevents that the page sends anything to other servers.
const policy = (scripts, worker, connect) =>
  `default-src 'none'; script-src ${scripts} 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src data: blob:; `
  + `worker-src ${worker}; connect-src ${connect}; base-uri 'none'; form-action 'none'`;

const licenses = [readFileSync(join(repository, 'packages/NOTICES'), 'utf8'), ...['fast-png', 'fflate', 'iobuffer'].map((name) =>
  `=== ${name}\n\n${readFileSync(join(modules, name, 'LICENSE'), 'utf8').trim()}\n`)].join('\n');

const wasm = readFileSync(join(program, 'page.wasm'));
const worker = await bundled('worker.js');
const page = (kind) => bundled('page.js', { parts: join(source, `parts_${kind}.js`) });

const folder = join(out, 'texremap-web');
rmSync(out, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, 'texremap.wasm'), wasm);
writeFileSync(join(folder, 'worker.js'), worker);
writeFileSync(join(folder, 'page.js'), await page('folder'));
writeFileSync(join(folder, 'style.css'), style);
writeFileSync(join(folder, 'licenses.txt'), licenses);
writeFileSync(join(folder, 'index.html'), filled({
  POLICY: policy("'self'", "'self'", "'self'"),
  STYLE: '<link rel="stylesheet" href="style.css">',
  SCRIPT: '<script src="page.js" defer></script>',
}));
writeFileSync(join(out, 'texremap.html'), filled({
  POLICY: policy("'unsafe-inline' blob:", 'blob:', "'none'"),
  STYLE: `<style>\n${style}</style>`,
  SCRIPT: `<script type="text/plain" id="wasm">${gzipSync(wasm, { level: 9 }).toString('base64')}</script>\n`
    + `<script type="text/plain" id="worker">${inline(worker)}</script>\n`
    + `<script>${inline(await page('single'))}</script>\n<!--\n${licenses.replaceAll('--', '- -')}-->`,
}));
