// This file prepares materials for drawing, in the worker: textures of 8 bits, at most LARGEST texels a side.
//   { name, workflow: 'metallic', 'specular' or 'brdf', size, maps: [{ role, width, height, rgba }] }
// Colors are sRGB, roughness is perceptual (the square root of alpha).
import { isGltf, openAsset } from './gltf.js';

const LARGEST = 1024;
const CHANNELS = { R: 0, G: 1, B: 2, A: 3 };

const toRoughness = {
  roughness: (value) => value,
  glossiness: (value) => 1 - value,
  alpha: (value) => Math.sqrt(value),
  squared: (value) => Math.sqrt(Math.sqrt(value)),
  exponent: (value) => value,  // drawn as it is stored
};
const toSrgb = (value) => (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
const toLinear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

// Returns RGBA of a map, by closest texels. `valuesAt(texel)` gives red, green and blue from 0 to 1.
function drawn(image, valuesOf) {
  const step = Math.max(1, Math.ceil(Math.max(image.width, image.height) / LARGEST));
  const width = Math.max(1, Math.floor(image.width / step));
  const height = Math.max(1, Math.floor(image.height / step));
  const rgba = new Uint8ClampedArray(4 * width * height);
  const { data, channels, depth } = image;
  const scale = depth === 16 ? 65535 : 255;
  const texel = [0, 0, 0, 1];
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const from = (y * step * image.width + x * step) * channels;
      if (channels < 3) {
        texel[0] = texel[1] = texel[2] = data[from] / scale;
        texel[3] = channels === 2 ? data[from + 1] / scale : 1;
      } else {
        for (let c = 0; c < channels; ++c) texel[c] = data[from + c] / scale;
      }
      const values = valuesOf(texel);
      const to = 4 * (y * width + x);
      for (let c = 0; c < 3; ++c) rgba[to + c] = 255 * values[c];
      rgba[to + 3] = 255;
    }
  return { width, height, rgba };
}

const ONE_TEXEL = { width: 1, height: 1, channels: 3, depth: 8, data: new Uint8Array([255, 255, 255]) };

function greyMap(role, image, channel, factor, encoding) {
  const c = CHANNELS[channel] ?? 0;
  const convert = toRoughness[encoding] ?? ((value) => value);
  return { role, ...drawn(image ?? ONE_TEXEL, (texel) => Array(3).fill(convert(texel[c] * factor))) };
}

function colorMap(role, image, factor, isLinear) {
  const isPlain = !isLinear && factor.slice(0, 3).every((value) => value === 1);
  const convert = (value, c) => (isPlain ? value : toSrgb((isLinear ? value : toLinear(value)) * factor[c]));
  return { role, ...drawn(image ?? ONE_TEXEL, (texel) => texel.slice(0, 3).map(convert)) };
}

function drawnOfAsset({ name, workflow, color, specular, metallic, roughness }, asset, images) {
  const decoded = new Map();
  const imageAt = (index) => {
    if (index === undefined) return undefined;
    if (!decoded.has(index)) decoded.set(index, images.decode(asset.imageBytes(index)));
    return decoded.get(index);
  };
  const maps = [colorMap(workflow === 'metallic' ? 'base color' : 'diffuse', imageAt(color.image), color.factor)];
  if (metallic) maps.push(greyMap('metallic', imageAt(metallic.image), metallic.channel, metallic.factor));
  if (specular) maps.push(colorMap('specular', imageAt(specular.image), specular.factor));
  maps.push(greyMap('roughness', imageAt(roughness.image), roughness.channel, roughness.factor, roughness.encoding));
  return { name, workflow, maps };
}

/** The materials of each glTF file, [{ key, draw(images) }]. */
export function materialsOfAssets(files) {
  return files.filter((file) => isGltf(file.path)).flatMap(({ path }) => {
    const asset = openAsset(files, path);
    return (asset?.materials ?? []).map((material, i) => ({
      key: `${path} ${i}`,
      draw: (images) => drawnOfAsset(material, asset, images),
    }));
  });
}

// Returns the place of a map from `plan` of the program's report: a file, and its channels after a colon.
function placeOf(words) {
  const [, file, channel] = /^(.*?)(?::([A-Z,]+))?$/.exec(words);
  return { file, channel };
}

/** The material of a set: `plan` has lines { role, input, encoding }; `bytesOf(file name)` are those of a map. */
export function materialOfSet(name, workflow, plan, bytesOf, images) {
  const maps = [];
  for (const { role, input, encoding } of plan) {
    const { file, channel } = placeOf(input);
    const bytes = input && role ? bytesOf(file) : undefined;
    if (!bytes || !['roughness', 'metallic', 'specular', 'diffuse', 'base_color'].includes(role)) continue;
    const image = images.decode(bytes);
    if (role === 'roughness' || role === 'metallic') maps.push(greyMap(role, image, channel, 1, encoding));
    else maps.push(colorMap(role.replace('_', ' '), image, [1, 1, 1], encoding === 'linear'));
  }
  return { name, workflow, maps };
}
