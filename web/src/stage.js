// This file shows before and after: the ball if three.js has both models, otherwise the maps themselves.
import { Ball } from './ball.js';
import { Flat, figureOf } from './flat.js';

// MeshStandardMaterial and MeshPhysicalMaterial draw these models.
const DRAWN = ['mitsuba/ggx', 'mitsuba3/ggx', 'threejs-r187/standard-metal'];

const $ = (id) => document.getElementById(id);

export class Stage {
  #materials;  // of names()
  #preview = null;
  #ball = null;
  #flat = new Flat($('flat'));
  #shown = null;

  constructor(materials) {
    this.#materials = materials;
    $('material').addEventListener('change', () => this.#choose());
    for (const id of ['wipe', 'light']) $(id).addEventListener('input', () => this.draw());
    new ResizeObserver(() => this.draw()).observe($('view'));
  }

  /** `preview` of conversion.js. */
  show(preview) {
    const pairs = (preview.pairs ?? []).filter(({ before, after }) => before.maps.length && after.maps.length);
    $('stage').hidden = pairs.length === 0;
    if (pairs.length === 0) return;
    this.#preview = { ...preview, pairs };
    $('material').replaceChildren(...pairs.map(({ before }, i) => new Option(before.name, i)));
    $('material-label').hidden = pairs.length < 2;
    $('material-note').textContent = preview.count > pairs.length ? `${pairs.length} of ${preview.count} are shown; all are converted.` : '';
    this.#choose();
  }

  // Returns the end without a counterpart in three.js, or nothing for glTF files.
  #foreign({ source, target }) {
    const brdfOf = ({ name }) => this.#materials.find((material) => material.name === name)?.brdf ?? name;
    return [source, target].find((end) => end && !DRAWN.includes(brdfOf(end)));
  }

  #choose() {
    const { pairs, source, target } = this.#preview;
    const { before, after } = pairs[Number($('material').value)];
    const foreign = this.#foreign(this.#preview);
    let note = foreign ? `three.js does not draw ${foreign.name}, so the maps themselves are shown.`
      : 'Drawn by three.js: an idea of the look, not a picture of either renderer.';
    this.#shown = null;
    if (!foreign) {
      try {
        this.#ball ??= new Ball($('ball'));
        this.#ball.show(before, after, { before: source?.diffuse !== 'plain', after: target?.diffuse !== 'plain' });
        this.#shown = this.#ball;
      } catch {
        note = 'This browser has no WebGL 2, so the maps themselves are shown.';
      }
    }
    if (!this.#shown) {
      this.#flat.show(before, after);
      this.#shown = this.#flat;
    }
    const isBall = this.#shown === this.#ball;
    $('ball').hidden = !isBall;
    $('flat').hidden = isBall;
    $('line').hidden = !isBall;
    $('light-label').hidden = !isBall;
    $('stage-note').textContent = note;
    const text = isBall ? `A ball of ${before.name}: before on the left, after on the right`
      : `Maps of ${before.name}: before on the left, after on the right`;
    $(isBall ? 'ball' : 'flat').setAttribute('aria-label', text);
    $('maps').replaceChildren(...[['Before', before], ['After', after]].map(([title, material]) => {
      const part = document.createElement('div');
      const heading = document.createElement('h3');
      heading.textContent = title;
      const row = document.createElement('div');
      row.className = 'row';
      row.append(...material.maps.map((map) => figureOf(map, title.toLowerCase())));
      part.append(heading, row);
      return part;
    }));
    this.draw();
  }

  draw() {
    const wipe = Number($('wipe').value) / 100;
    $('line').style.left = `${100 * wipe}%`;
    this.#shown?.draw({ wipe, light: Number($('light').value) });
  }
}
