// This file draws two looks of a material on a ball with WebGL 2, each by the formulas of its own BRDF model.
import BRDF_TEXT from '../../runtime/look/brdf.glsl';
import SHADING_TEXT from './shading.glsl';

const HEADER = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
#define real float
struct LocalGeometry { float cos_light, cos_view, cos_half, cos_light_half, half_length_2, cos_mirror; };
`;

const TRIANGLE = `#version 300 es
void main() { gl_Position = vec4(vec2[3](vec2(-1.0, -1.0), vec2(3.0, -1.0), vec2(-1.0, 3.0))[gl_VertexID], 0.0, 1.0); }`;

// Shows linear radiance as sRGB: the first look left of the wipe, the second right of it.
const DISPLAY = `#version 300 es
precision highp float;
uniform sampler2D left, right;
uniform float exposure, border;
out vec4 color;
void main() {
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 mean = gl_FragCoord.x < border ? texelFetch(left, place, 0) : texelFetch(right, place, 0);
  vec3 linear = clamp(exposure * mean.rgb / max(mean.a, 0.0001), 0.0, 1.0);
  vec3 shown = mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  color = vec4(shown * mean.a, mean.a);
}`;

const SAMPLES = 16;  // samples per pixel in each frame
const FRAMES = 128;
// Without a graphics processor a frame takes long. The picture is then drawn at half the resolution, and refined no longer
// than this.
const SLOW_FRAME = 250, LONGEST = 5000;  // milliseconds
const MAPS = ['roughness', 'specular', 'diffuse', 'normal'];

// Returns the texels of the light, [Float32Array] from fine to coarse, whose values are at most 1, and the factor.
function lightLevels({ width, height, rgbe }) {
  const bytes = Uint8Array.from(atob(rgbe), (letter) => letter.charCodeAt(0));
  const texels = new Float32Array(4 * width * height);
  let range = 0;
  for (let i = 0; i < texels.length; i += 4) {
    const scale = 2 ** (bytes[i + 3] - 136);
    for (let c = 0; c < 3; ++c) range = Math.max(range, (texels[i + c] = bytes[i + c] * scale));
  }
  for (let i = 0; i < texels.length; ++i) texels[i] /= range;
  const levels = [{ width, height, texels }];
  for (let fine = levels[0]; fine.height > 1; fine = levels.at(-1)) {
    const coarse = { width: fine.width / 2, height: fine.height / 2, texels: new Float32Array(fine.texels.length / 4) };
    for (let y = 0; y < coarse.height; ++y)
      for (let x = 0; x < coarse.width; ++x)
        for (let c = 0; c < 3; ++c) {
          let sum = 0;
          let weights = 0;
          for (let j = 0; j < 2; ++j) {
            const row = 2 * y + j;  // the weight of a row is its part of the sphere
            const weight = Math.cos((Math.PI * row) / fine.height) - Math.cos((Math.PI * (row + 1)) / fine.height);
            for (let i = 0; i < 2; ++i) sum += weight * fine.texels[4 * (row * fine.width + 2 * x + i) + c];
            weights += 2 * weight;
          }
          coarse.texels[4 * (y * coarse.width + x) + c] = sum / weights;
        }
    levels.push(coarse);
  }
  return { levels, range };
}

/** Shades looks { brdf, schlick, range, roughness, specular, diffuse, normal }, whose maps are images or null. */
export class Shading {
  #gl;
  #programs = new Map();  // by the name of the BRDF
  #light;
  #display;  // the program that shows the means
  #sides = [];  // { look, textures, frames: two textures, count }
  #key = '';  // what the frames were drawn with
  #request = 0;
  #scale = 1;  // of the resolution
  #sync = null;  // of the last frame
  #begun = 0;  // times of the picture and of the last frame
  #drawn = 0;

  /** Throws if the browser lacks WebGL 2 or textures of floats. */
  constructor(canvas, light) {
    const gl = canvas.getContext('webgl2', { alpha: true, antialias: false, preserveDrawingBuffer: true });
    if (!gl || !gl.getExtension('EXT_color_buffer_float')) throw new Error('this browser has no WebGL 2 with floats');
    this.#gl = gl;
    this.#light = this.#lightTexture(light);
    this.#display = this.#program(DISPLAY);
  }

  #program(fragment) {
    const gl = this.#gl;
    const program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, TRIANGLE], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const places = new Map();
    const place = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name);
    };
    return { program, place };
  }

  #programOf(brdf) {
    if (!this.#programs.has(brdf))
      this.#programs.set(brdf, this.#program(`${HEADER}${BRDF_TEXT}\n#define SHAPE ${brdf}\n${SHADING_TEXT}`));
    return this.#programs.get(brdf);
  }

  #texture(wrap, filter, magnified = filter) {
    const gl = this.#gl;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wrap);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, magnified);
    return texture;
  }

  #lightTexture(light) {
    const gl = this.#gl;
    const { levels, range } = lightLevels(light);
    const texture = this.#texture(gl.REPEAT, gl.LINEAR_MIPMAP_LINEAR, gl.LINEAR);
    levels.forEach(({ width, height, texels }, level) =>
      gl.texImage2D(gl.TEXTURE_2D, level, gl.RGBA16F, width, height, 0, gl.RGBA, gl.FLOAT, texels));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, levels.length - 1);
    return { texture, range, height: light.height };
  }

  #mapTexture(image, isColor) {
    const gl = this.#gl;
    const texture = this.#texture(gl.CLAMP_TO_EDGE, gl.LINEAR_MIPMAP_LINEAR, gl.LINEAR);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.texImage2D(gl.TEXTURE_2D, 0, isColor ? gl.SRGB8_ALPHA8 : gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.generateMipmap(gl.TEXTURE_2D);
    return texture;
  }

  /** Shows two looks, left and right of the wipe. */
  show(left, right) {
    const gl = this.#gl;
    for (const { textures } of this.#sides) Object.values(textures).forEach((texture) => gl.deleteTexture(texture));
    const before = this.#sides;
    this.#sides = (left === right ? [left] : [left, right]).map((look, i) => ({
      look,
      program: this.#programOf(look.brdf),
      textures: Object.fromEntries(MAPS.filter((map) => look[map]).map((map) => [
        map, this.#mapTexture(look[map], map === 'specular' || map === 'diffuse')])),
      frames: before[i]?.frames ?? [],
      count: 0,
    }));
    before.slice(this.#sides.length).forEach(({ frames }) => this.#drop(frames));
    this.#key = '';
  }

  #drop(frames) {
    for (const { texture, buffer } of frames) {
      this.#gl.deleteTexture(texture);
      this.#gl.deleteFramebuffer(buffer);
    }
  }

  // Makes the textures that hold the means of frames, two for each side.
  #resize() {
    const gl = this.#gl;
    const { width, height } = gl.canvas;
    for (const side of this.#sides) {
      this.#drop(side.frames);
      side.frames = [0, 1].map(() => {
        const texture = this.#texture(gl.CLAMP_TO_EDGE, gl.NEAREST);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
        const buffer = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
        return { texture, buffer };
      });
    }
  }

  #bind({ place }, name, unit, texture) {
    const gl = this.#gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniform1i(place(name), unit);
  }

  #shade(side, state) {
    const gl = this.#gl;
    const { look, program, textures, frames, count } = side;
    const { place } = program;
    gl.useProgram(program.program);
    const spare = textures.roughness;  // a map that the look lacks is not read
    MAPS.forEach((map, unit) => this.#bind(program, `${map}_map`, unit, textures[map] ?? spare));
    this.#bind(program, 'light_map', 4, this.#light.texture);
    this.#bind(program, 'previous', 5, frames[(count + 1) % 2].texture);
    gl.uniform2f(place('size'), gl.canvas.width, gl.canvas.height);
    gl.uniform2f(place('center'), state.center[0], state.center[1]);
    // Each frame looks through another place of the pixel, so that the mean of the frames has smooth edges.
    const jitter = (step) => (state.isStill ? 0 : ((count * step) % 1) - 0.5);
    gl.uniform2f(place('jitter'), jitter(0.7548776662), jitter(0.569840291));
    gl.uniform1f(place('zoom'), state.zoom);
    gl.uniform1f(place('turn'), (state.light * Math.PI) / 180);
    gl.uniform1f(place('specular_range'), look.range);
    gl.uniform1f(place('light_range'), this.#light.range);
    gl.uniform1f(place('light_height'), this.#light.height);
    gl.uniform1i(place('has_schlick'), look.schlick);
    gl.uniform1i(place('has_diffuse'), 'diffuse' in textures);
    gl.uniform1i(place('has_normals'), 'normal' in textures);
    gl.uniform1i(place('is_shader_ball'), state.object === 'shader ball');
    gl.uniform1i(place('sample_count'), SAMPLES);
    gl.uniform1i(place('frame'), count);
    gl.uniform1i(place('frame_count'), FRAMES);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frames[count % 2].buffer);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    side.count = count + 1;
  }

  #present({ exposure, wipe }) {
    const gl = this.#gl;
    gl.useProgram(this.#display.program);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    [this.#sides[0], this.#sides.at(-1)].forEach(({ frames, count }, i) =>
      this.#bind(this.#display, i === 0 ? 'left' : 'right', i, frames[(count + 1) % 2].texture));
    gl.uniform1f(this.#display.place('exposure'), 2 ** exposure);
    gl.uniform1f(this.#display.place('border'), Math.round(gl.canvas.width * wipe));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** True as soon as the picture is no longer refined. */
  get isFinished() {
    return this.#request === 0;
  }

  /** Draws, and refines the picture until it has FRAMES. `state` has wipe 0 to 1, light in degrees, zoom, center,
   * exposure in stops, object. */
  draw(state) {
    cancelAnimationFrame(this.#request);
    this.#request = 0;
    const { canvas } = this.#gl;
    const ratio = state.isStill ? 1 : this.#scale * Math.min(globalThis.devicePixelRatio ?? 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.round(side * ratio));
    if (this.#sides.length === 0 || width === 0 || height === 0) return;
    if (canvas.width !== width || canvas.height !== height || this.#sides.some(({ frames }) => frames.length === 0)) {
      Object.assign(canvas, { width, height });
      this.#resize();
      this.#key = '';
    }
    this.#gl.viewport(0, 0, width, height);
    const { light, zoom, center, object } = state;
    const key = JSON.stringify([light, zoom, center, object]);
    if (key !== this.#key) {
      for (const side of this.#sides) side.count = 0;
      this.#begun = performance.now();
    }
    this.#key = key;
    this.#refine(state);
  }

  // Returns true if the last frame is on the screen. Frames that wait for the processor would block the page.
  #isDrawn() {
    const gl = this.#gl;
    if (this.#sync && gl.clientWaitSync(this.#sync, 0, 0) === gl.TIMEOUT_EXPIRED) return false;
    gl.deleteSync(this.#sync);
    this.#sync = null;
    return true;
  }

  #refine(state) {
    const gl = this.#gl;
    const now = performance.now();
    let isRefined = this.#sides[0].count < FRAMES && (state.isStill || now - this.#begun < LONGEST);
    if (isRefined && this.#isDrawn()) {
      if (!state.isStill && this.#scale === 1 && this.#sides[0].count > 0 && now - this.#drawn > SLOW_FRAME) {
        this.#scale = 0.5;
        return this.draw(state);
      }
      this.#drawn = now;
      for (const side of this.#sides) this.#shade(side, state);
      this.#sync = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
      isRefined = this.#sides[0].count < FRAMES;
    }
    this.#present(state);
    gl.flush();
    this.#request = isRefined ? requestAnimationFrame(() => this.#refine(state)) : 0;
  }
}
