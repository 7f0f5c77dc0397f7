// This file shows materials before and after a conversion: on a ball with a wipe, by figures, and as maps. The page and
// the report of `texremap convert --report` have the same viewer.
import { Shading } from './shading.js';

// Makes an element with properties, attributes (whose names have a dash or begin lower-case in HTML) and children.
function made(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties))
    if (name in element && !name.includes('-')) element[name] = value;
    else element.setAttribute(name, value);
  element.append(...children);
  return element;
}

const percent = (share) => `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} %`;
const SLIDERS = [
  // name, label, least, most, step, start
  ['wipe', 'Wipe between left and right', 0, 100, 1, 50],
  ['light', 'Turn the light, degrees', -180, 180, 1, 0],
  ['zoom', 'Zoom', 0, 5, 0.05, 0],  // powers of two
  ['exposure', 'Exposure, stops', -4, 4, 0.1, 0],
];
const OBJECTS = ['ball', 'shader ball'];
const BINS = 64;

// Decodes the images of data URIs once each; values stay as stored.
class ImageCache {
  #urls;
  #images = new Map();

  constructor(urls) {
    this.#urls = urls;
  }
  url(index) {
    return this.#urls[index];
  }
  of(index) {
    if (!this.#images.has(index)) this.#images.set(index, this.#decoded(this.#urls[index]));
    return this.#images.get(index);
  }
  // A page without network may not fetch() a data URI.
  async #decoded(url) {
    const bytes = Uint8Array.from(atob(url.slice(url.indexOf(',') + 1)), (letter) => letter.charCodeAt(0));
    const blob = new Blob([bytes], { type: /^data:([^;]*)/.exec(url)[1] });
    return createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  }
}

// Counts the stored values of a map, per channel; a grey map has one.
function histogram(image) {
  const canvas = new OffscreenCanvas(Math.min(image.width, 256), Math.min(image.height, 256));
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
  const counts = [0, 1, 2].map(() => new Uint32Array(BINS));
  let [sum, low, high, isGrey] = [0, 255, 0, true];
  for (let i = 0; i < data.length; i += 4) {
    isGrey &&= data[i] === data[i + 1] && data[i] === data[i + 2];
    for (let c = 0; c < 3; ++c) {
      const value = data[i + c];
      ++counts[c][Math.floor((value * BINS) / 256)];
      sum += value;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  const text = (value) => (value / 255).toFixed(2);
  return {
    counts: isGrey ? counts.slice(0, 1) : counts,
    words: `${text(low)} to ${text(high)}, mean ${text(sum / (0.75 * data.length))}`,
  };
}

function drawHistogram(canvas, counts) {
  const context = canvas.getContext('2d');
  const most = Math.max(...counts.map((channel) => Math.max(...channel)));
  const colors = counts.length === 1 ? [getComputedStyle(canvas).color] : ['#d33', '#2a2', '#36d'];
  counts.forEach((channel, c) => {
    context.fillStyle = colors[c];
    context.globalAlpha = counts.length === 1 ? 1 : 0.6;
    channel.forEach((count, i) => {
      const height = Math.ceil((canvas.height * count) / most);
      context.fillRect((i * canvas.width) / BINS, canvas.height - height, Math.ceil(canvas.width / BINS), height);
    });
  });
}

/** Shows `report` (docs/formats.md) in `container`. Without WebGL 2 it shows still pictures. */
export class Viewer {
  #report;
  #images;
  #shading = null;
  #material = null;
  #parts = {};
  #center = [0, 0];
  #shown = 0;  // counts choices, because images come later

  constructor(container, report) {
    this.#report = report;
    this.#images = new ImageCache(report.images);
    this.#build(container);
    try {
      this.#shading = new Shading(this.#parts.canvas, report.light);
    } catch (error) {
      this.#parts.view.classList.add('still');
      this.#parts.note.textContent = `The pictures cannot be turned: ${error.message}.`;
    }
    new ResizeObserver(() => this.draw()).observe(this.#parts.canvas);
    this.#listen();
    this.choose(0);
  }

  #build(container) {
    const parts = this.#parts;
    const choice = (name, label, options) => {
      parts[name] = made('select', { id: name }, ...options.map((text, i) => new Option(text, i)));
      return made('label', { for: name }, label, parts[name]);
    };
    parts.canvas = made('canvas', { id: 'ball', role: 'img', tabIndex: 0 });
    parts.stills = ['left', 'right'].map((side) => made('img', { className: `still-${side}`, alt: '' }));
    parts.tags = ['left', 'right'].map((side) => made('span', { className: `tag ${side}`, 'aria-hidden': 'true' }));
    parts.line = made('span', { className: 'line', 'aria-hidden': 'true' });
    parts.view = made('div', { className: 'view' }, parts.canvas, ...parts.stills, ...parts.tags, parts.line);
    parts.note = made('p', { id: 'viewer-note', role: 'status' });
    parts.figures = made('table', { id: 'figures' });
    parts.maps = made('div', { id: 'maps' });
    const sliders = SLIDERS.map(([name, label, min, max, step, value]) => {
      parts[name] = made('input', { id: name, type: 'range', min, max, step });
      parts[name].value = value;
      return made('label', { for: name, className: name }, label, parts[name]);
    });
    container.classList.add('viewer');
    container.replaceChildren(
      choice('material', 'Material', this.#report.materials.map(({ name }) => name)), parts.note,
      made('div', { className: 'fields' }, choice('left', 'Left', []), choice('right', 'Right', []),
        choice('object', 'Shape', OBJECTS)),
      parts.view, made('div', { className: 'fields' }, ...sliders), parts.figures, parts.maps);
    parts.material.parentElement.hidden = this.#report.materials.length < 2;
  }

  #listen() {
    const parts = this.#parts;
    parts.material.addEventListener('change', () => this.choose(Number(parts.material.value)));
    for (const side of ['left', 'right']) parts[side].addEventListener('change', () => this.#showLooks());
    for (const name of ['object', ...SLIDERS.map(([slider]) => slider)]) parts[name].addEventListener('input', () => this.draw());
    // A drag moves the wipe; with Shift it turns the light, and with Alt it moves an enlarged picture.
    const view = parts.canvas;
    const drag = (event) => {
      if (event.buttons === 0) return;
      const box = view.getBoundingClientRect();
      if (event.shiftKey) parts.light.value = Number(parts.light.value) + event.movementX / 2;
      else if (event.altKey) this.#pan(-2 * event.movementX / box.height, 2 * event.movementY / box.height);
      else parts.wipe.value = (100 * (event.clientX - box.left)) / box.width;
      this.draw();
    };
    view.addEventListener('pointerdown', (event) => {
      view.setPointerCapture(event.pointerId);
      drag(event);
    });
    view.addEventListener('pointermove', drag);
    view.addEventListener('wheel', (event) => {
      event.preventDefault();
      parts.zoom.value = Number(parts.zoom.value) - Math.sign(event.deltaY) / 4;
      this.draw();
    }, { passive: false });
    view.addEventListener('keydown', (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (!way) return;
      event.preventDefault();
      this.#pan(0.2 * way[0], 0.2 * way[1]);
      this.draw();
    });
    view.addEventListener('webglcontextlost', () => {
      this.#shading = null;
      parts.view.classList.add('still');
      this.draw();
    });
  }

  #pan(x, y) {
    const zoom = 2 ** Number(this.#parts.zoom.value);
    this.#center = [this.#center[0] + x / zoom, this.#center[1] + y / zoom].map((value) => Math.max(-1, Math.min(1, value)));
  }

  /** Shows the material of this index. */
  async choose(index) {
    this.#material = this.#report.materials[index];
    const titles = this.#material.looks.map(({ title }) => title);
    for (const side of ['left', 'right'])
      this.#parts[side].replaceChildren(...titles.map((title, i) => new Option(title, i)));
    this.#parts.left.value = 0;
    this.#parts.right.value = titles.length - 1;
    this.#fillFigures();
    await Promise.all([this.#showLooks(), this.#fillMaps()]);
  }

  #fillFigures() {
    const row = (cell, ...texts) => made('tr', {}, ...texts.map((text) => made(cell, cell === 'th' ? { scope: 'col' } : {}, text)));
    this.#parts.figures.replaceChildren(
      made('caption', {}, 'Compared with the source: error of display values (RMSE), and similarity (SSIM, 1 means equal)'),
      made('thead', {}, row('th', 'picture', 'shown by', 'error', 'SSIM')),
      made('tbody', {}, ...this.#material.looks.map(({ title, model, rms, ssim }) =>
        row('td', title, model, rms === undefined ? '' : percent(rms), ssim === undefined ? '' : ssim.toFixed(3)))));
    if (this.#material.outside > 0)
      this.#parts.figures.append(made('tfoot', {}, made('tr', {}, made('td', { colSpan: 4 },
        `${percent(this.#material.outside)} of the texels are outside the range that the conversion was measured for`))));
  }

  async #showLooks() {
    const number = ++this.#shown;
    const looks = ['left', 'right'].map((side) => this.#material.looks[Number(this.#parts[side].value)]);
    looks.forEach(({ title, still }, i) => {
      this.#parts.tags[i].textContent = title;
      this.#parts.stills[i].src = this.#images.url(still);
      this.#parts.stills[i].alt = `${this.#material.name}: ${title}`;
    });
    const words = looks.map(({ title, rms }) => title + (rms === undefined ? '' : `, error ${percent(rms)}`));
    this.#parts.canvas.setAttribute('aria-label', `${this.#material.name} on a ball. Left: ${words[0]}. Right: ${words[1]}.`);
    if (this.#shading) {
      const loaded = await Promise.all(looks.map((look) => this.#loaded(look)));
      if (number !== this.#shown || !this.#shading) return;
      this.#shading.show(...loaded);
    }
    this.draw();
  }

  async #loaded({ brdf, schlick, range, ...look }) {
    const image = (index) => (index === undefined || index === null ? null : this.#images.of(index));
    const [roughness, specular, diffuse, normal] = await Promise.all(
      [look.roughness, look.specular, look.diffuse, this.#material.normal].map(image));
    return { brdf, schlick, range, roughness, specular, diffuse, normal };
  }

  async #fillMaps() {
    const { maps } = this.#material;
    const groups = await Promise.all([['Before', maps.before], ['After', maps.after]].map(async ([title, shown]) => {
      const figures = await Promise.all(shown.map(async ({ name, image, width, height, shown_width: shownWidth }) => {
        const { counts, words } = histogram(await this.#images.of(image));
        const chart = made('canvas', { width: 128, height: 40, role: 'img', 'aria-label': `${name}: ${words}` });
        const picture = made('img', { src: this.#images.url(image), alt: `${name}, ${title.toLowerCase()}` });
        const enlarge = made('button', { type: 'button', title: 'enlarge', 'aria-pressed': 'false' }, picture);
        enlarge.addEventListener('click', () =>
          enlarge.setAttribute('aria-pressed', String(enlarge.parentElement.classList.toggle('large'))));
        const figure = made('figure', {}, enlarge, chart,
          made('figcaption', {}, made('b', {}, name),
            ` ${width} × ${height}${shownWidth < width ? `, shown ${shownWidth} wide` : ''}, ${words}`));
        return { figure, chart, counts };
      }));
      return { title, figures };
    }));
    if (maps !== this.#material.maps) return;
    this.#parts.maps.replaceChildren(...groups.map(({ title, figures }) => made('section', {}, made('h3', {}, title),
      made('div', { className: 'row' }, ...figures.map(({ figure }) => figure)))));
    for (const { figures } of groups) for (const { chart, counts } of figures) drawHistogram(chart, counts);
  }

  /** True as soon as the picture is no longer refined. */
  get isFinished() {
    return this.#shading === null || this.#shading.isFinished;
  }

  draw() {
    const number = (name) => Number(this.#parts[name].value);
    const wipe = number('wipe') / 100;
    this.#parts.line.style.left = `${100 * wipe}%`;
    this.#parts.view.style.setProperty('--wipe', `${100 * wipe}%`);
    const zoom = 2 ** number('zoom');
    if (zoom === 1) this.#center = [0, 0];
    this.#shading?.draw({
      wipe, zoom, light: number('light'), exposure: number('exposure'), center: this.#center,
      object: OBJECTS[number('object')],
    });
  }
}
