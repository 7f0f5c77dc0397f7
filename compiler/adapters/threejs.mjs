// This file renders by three.js in headless Chromium (SwiftShader): its standard, physical and Phong materials.
//
// Each pixel centre is one vertex on the exact sphere, with its normal, drawn as a point. This avoids tessellation, and the
// roughness that three.js adds on meshes for the change of the normal between pixels. The render target holds linear
// floats. Rows of WebGL start at the bottom.
import fs from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';
import readline from 'node:readline';
import { pathToFileURL } from 'node:url';

const home = path.join(process.env.REMAP_RENDERERS, 'threejs-r187');
const require = createRequire(path.join(home, 'package.json'));
const build = path.join(home, 'node_modules', 'three', 'build');
const revision = JSON.parse(fs.readFileSync(path.join(build, '..', 'package.json'))).version;
const prefix = `threejs-r${revision.split('.')[1]}`;

const parameter = (name, role, least, most, more = {}) => ({ name, role, range: [least, most], ...more });
// The shader clamps smaller roughness.
const roughness = parameter('roughness', 'roughness', 0.0525, 1, { convention: 'roughness' });
const models = [
  { name: `${prefix}/standard-metal`, precision: 2e-6, textures: true,
    parameters: [roughness, parameter('color', 'specular', 0, 1)] },
  { name: `${prefix}/physical-dielectric`, precision: 2e-6, textures: true,
    parameters: [roughness, parameter('specularIntensity', 'specular', 0, 1, { grey: true }),
      parameter('color', 'diffuse', 0, 1), parameter('ior', 'other', 1, 2.333, { default: 1.5, grey: true })] },
  { name: `${prefix}/phong`, precision: 2e-6,
    parameters: [parameter('shininess', 'roughness', 0.01, 20000, { convention: 'exponent' }),
      parameter('specular', 'specular', 0, 1), parameter('color', 'diffuse', 0, 1)] },
];

// Runs in the page, where `THREE` is global.
function preparePage() {
  const renderer = new THREE.WebGLRenderer({ antialias: false });
  renderer.toneMapping = THREE.NoToneMapping;
  const scene = new THREE.Scene();
  const lamp = new THREE.PointLight(0xffffff, 1, 0, 2);
  const ball = new THREE.Points(new THREE.BufferGeometry());
  ball.frustumCulled = false;
  scene.add(lamp, ball);
  const withPoints = (material) => {
    material.onBeforeCompile = (shader) => {
      shader.vertexShader = shader.vertexShader.replace('#include <fog_vertex>',
        '#include <fog_vertex>\n gl_PointSize = 1.0;');
    };
    return material;
  };
  const materials = {
    'standard-metal': withPoints(new THREE.MeshStandardMaterial({ metalness: 1 })),
    'physical-dielectric': withPoints(new THREE.MeshPhysicalMaterial({ metalness: 0 })),
    phong: withPoints(new THREE.MeshPhongMaterial()),
  };
  let target = null, size = 0;

  const place = (pixels, camera) => {
    const half = Math.tan(camera.half_angle * Math.PI / 180), d = camera.distance, points = [];
    for (let row = 0; row < pixels; ++row) {
      for (let column = 0; column < pixels; ++column) {
        const x = (2 * (column + 0.5) / pixels - 1) * half, y = (2 * (row + 0.5) / pixels - 1) * half;
        const a = x * x + y * y + 1, inside = d * d - a * (d * d - 1);
        if (inside <= 0) continue;
        const t = (d - Math.sqrt(inside)) / a;
        points.push(t * x, t * y, d - t);
      }
    }
    ball.geometry.dispose();
    ball.geometry = new THREE.BufferGeometry();
    ball.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    ball.geometry.setAttribute('normal', new THREE.Float32BufferAttribute(points, 3));
    const places = [];
    for (let i = 0; i < points.length; i += 3)
      places.push(0.5 + Math.atan2(points[i], points[i + 2]) / Math.PI, Math.acos(points[i + 1]) / Math.PI);
    ball.geometry.setAttribute('uv', new THREE.Float32BufferAttribute(places, 2));
    if (target !== null) target.dispose();
    target = new THREE.WebGLRenderTarget(pixels, pixels, { type: THREE.FloatType });
    size = pixels;
  };

  // Reads floats that Node.js sends, and makes a texture of RGBA. The first row in memory has v = 0.
  const floatTexture = async ({ index, width, height, channels }, moved = (row, column) => row * width + column) => {
    const texels = new Float32Array(await (await fetch(`/map/${index}`)).arrayBuffer());
    const rgba = new Float32Array(4 * width * height).fill(1);
    for (let row = 0; row < height; ++row)
      for (let column = 0; column < width; ++column)
        for (let c = 0; c < (channels === 1 ? 4 : 3); ++c)
          rgba[4 * (row * width + column) + c] = texels[channels * moved(row, column) + (channels === 1 ? 0 : c)];
    const texture = new THREE.DataTexture(rgba, width, height, THREE.RGBAFormat, THREE.FloatType);
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  };

  // Prefilters the environment, as users of three.js do. The middle column of three.js is +x, and its first row -y.
  const environmentOf = async (light) => {
    const { width, height } = light;
    const map = await floatTexture({ ...light, channels: 3 },
      (row, column) => (height - 1 - row) * width + (column + Math.round(width / 4)) % width);
    map.mapping = THREE.EquirectangularReflectionMapping;
    const generator = new THREE.PMREMGenerator(renderer), filtered = generator.fromEquirectangular(map);
    map.dispose();
    generator.dispose();
    return filtered;
  };
  const mapOf = { color: 'map', roughness: 'roughnessMap', specularIntensity: 'specularIntensityMap' };

  // Returns red, green, blue of every pixel, row 0 at the top, as base64.
  globalThis.draw = async (model, values, where, pixels) => {
    if (pixels !== size) place(pixels, where.camera);
    const eye = new THREE.PerspectiveCamera(2 * where.camera.half_angle, 1, 0.1, 100);
    eye.position.set(0, 0, where.camera.distance);
    const filtered = where.light.environment ? await environmentOf(where.light) : null;
    scene.environment = filtered?.texture ?? null;
    lamp.position.set(...(where.light.position ?? [0, 0, 3]));
    lamp.intensity = where.light.intensity ?? 0;
    const material = materials[model], textures = [];
    for (const name of Object.values(mapOf)) if (name in material) material[name] = null;
    for (const [name, value] of Object.entries(values)) {
      const list = Array.isArray(value) ? value : [1];
      if (list !== value) textures.push(material[mapOf[name]] = await floatTexture(value));
      if (material[name].isColor) material[name].setRGB(list[0], list.at(list.length === 3 ? 1 : 0), list.at(-1));
      else material[name] = list[0];
    }
    material.needsUpdate = true;
    ball.material = material;
    renderer.setRenderTarget(target);
    renderer.render(scene, eye);
    for (const texture of textures) texture.dispose();
    filtered?.dispose();
    const rgba = new Float32Array(4 * pixels * pixels), rgb = new Float32Array(3 * pixels * pixels);
    renderer.readRenderTargetPixels(target, 0, 0, pixels, pixels, rgba);
    for (let i = 0; i < pixels * pixels; ++i) {
      const from = 4 * ((pixels - 1 - Math.floor(i / pixels)) * pixels + i % pixels);
      for (let c = 0; c < 3; ++c) rgb[3 * i + c] = rgba[from + c];
    }
    const bytes = new Uint8Array(rgb.buffer);
    let text = '';
    for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
    return btoa(text);
  };
}

let maps = [];  // the files of the request, which the page may read

// Returns a map or environment whose file the page finds by its index. Throws if the file has another size.
function registered(place, file, channels) {
  const expected = 4 * place.width * place.height * channels, found = fs.statSync(file).size;
  if (found !== expected) throw new Error(`${file} has ${found} bytes, not ${expected}`);
  return { ...place, index: maps.push(file) - 1 };
}

async function openPage() {
  const server = http.createServer((request, response) => {
    const script = request.url.startsWith('/three/'), map = maps[request.url.match(/^\/map\/(\d+)$/)?.[1]];
    response.setHeader('Content-Type', map ? 'application/octet-stream' : script ? 'text/javascript' : 'text/html');
    response.end(map ? fs.readFileSync(map) : script ? fs.readFileSync(path.join(build, path.basename(request.url))) : '<!doctype html>');
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const puppeteer = (await import(pathToFileURL(require.resolve('puppeteer-core')))).default;
  const browser = await puppeteer.launch({
    executablePath: '/usr/bin/chromium-headless-shell', headless: 'shell', pipe: true,
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist'] });
  const page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  await page.evaluate(async () => { globalThis.THREE = await import('/three/three.module.js'); });
  await page.evaluate(preparePage);
  return { browser, page, version: await browser.version() };
}

function refuseUnknown(request) {
  const model = models.find((candidate) => candidate.name === request.model);
  if (!model) throw new Error(`unknown model ${request.model} (choose ${models.map((m) => m.name).join(', ')})`);
  for (const { name, range, grey } of model.parameters) {
    const list = request.parameters[name];
    if (!list) throw new Error(`${name} has no value`);
    if (!Array.isArray(list)) {
      if (!model.textures || name === 'ior') throw new Error(`${name} accepts no map (send a list of numbers)`);
      if ((grey || name === 'roughness') && list.channels !== 1) throw new Error(`the map of ${name} has ${list.channels} channels, but ${name} takes one`);
      request.parameters[name] = registered(list, list.map, list.channels);
      const values = new Float32Array(new Uint8Array(fs.readFileSync(list.map)).buffer);
      if (!values.every((value) => value >= range[0] && value <= range[1])) throw new Error(`the map of ${name} has values out of range (${range[0]} to ${range[1]})`);
      continue;
    }
    if (grey && list.length !== 1) throw new Error(`${name} has ${list.length} values, but takes one`);
    for (const value of list)
      if (!(value >= range[0] && value <= range[1])) throw new Error(`${name} = ${value} is out of range (${range[0]} to ${range[1]})`);
  }
}

async function render(page, request) {
  maps = [];
  refuseUnknown(request);
  const { light } = request.scene;
  if (light.environment) request.scene.light = registered(light, light.environment, 3);
  const { resolution: side, samples_per_axis: samples } = request.scene, channels = request.channels;
  const size = side * samples;
  const text = await page.evaluate((...all) => globalThis.draw(...all), request.model.split('/')[1],
    request.parameters, request.scene, size);
  const bytes = Buffer.from(text, 'base64');
  const rgb = new Float32Array(bytes.buffer, bytes.byteOffset, 3 * size * size);
  const picture = new Float64Array(side * side * channels);
  for (let row = 0; row < size; ++row)
    for (let column = 0; column < size; ++column)
      for (let c = 0; c < channels; ++c)
        picture[(Math.floor(row / samples) * side + Math.floor(column / samples)) * channels + c] +=
          rgb[3 * (row * size + column) + (channels === 1 ? 1 : c)] / samples ** 2;
  fs.writeFileSync(request.image, new Uint8Array(new Float32Array(picture).buffer));
}

let opened = null;
for await (const line of readline.createInterface({ input: process.stdin })) {
  const request = JSON.parse(line), answer = { id: request.id };
  if (request.request === 'quit') break;
  try {
    if (request.request === 'describe') {
      if (request.protocol !== 1) throw new Error(`protocol version ${request.protocol} is not supported (this worker speaks 1)`);
      opened ??= await openPage();
      Object.assign(answer, { protocol: 1, renderer: `three.js r${revision} (${opened.version})`, models });
    } else {
      await render(opened.page, request);
    }
  } catch (failure) {
    answer.error = String(failure.message ?? failure).replaceAll('\n', ' ');
  }
  process.stdout.write(`${JSON.stringify(answer)}\n`);
}
await opened?.browser.close();
process.exit(0);
