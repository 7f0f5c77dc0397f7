/**
 * This module converts the materials of a glTF-Transform document, as the command `texremap convert` converts a file:
 *
 *     await document.transform(remapMaterials({ from: 'gltf-specgloss', to: 'gltf' }));
 */
import type { Transform } from '@gltf-transform/core';

/** An Image has its rows from top to bottom, with interleaved channels. Colors are not multiplied by opacity. */
export interface Image {
  width: number;
  height: number;
  /** 1 grey, 2 grey and opacity, 3 RGB, 4 RGB and opacity. */
  channels: number;
  depth: 8 | 16;
  data: Uint8Array | Uint16Array;
}

/** An ImageCodec decodes and encodes whole image files. It applies no curve and no profile to the values. */
export interface ImageCodec {
  decode(bytes: Uint8Array): Image | Promise<Image>;
  /** `setting` is the level of PNG, 1 to 9, or the quality of JPEG, 1 to 100. */
  encode(format: 'png' | 'jpeg', image: Image, setting: number): Uint8Array | Promise<Uint8Array>;
  /** This is called after each document. */
  close?(): void;
}

/** These are options of the command (docs/assets.md), the codec of images, and the place of the program. */
export interface MaterialOptions {
  from?: 'gltf-specgloss' | 'gltf';
  to: 'gltf' | 'gltf-specgloss';
  /**
   * KHR_materials_specular and KHR_materials_ior. write: exact in viewers that read them, wrong in others.
   * fold: replaces them by core, for viewers that do not read them.
   */
  extensions?: 'write' | 'fold';
  /** How strongly metallic 0 and 1 are preferred, 0 to 1: 1e-6 for clean maps (default), 1e-5 for scans and JPEG. */
  metallicBias?: number;
  /** Enlarges smaller images of a material, and puts maps with different KHR_texture_transform onto one grid. */
  resample?: boolean;
  /** Writes new color images as JPEG of this quality, 1 to 100. */
  jpeg?: number;
  /** Default in node: PNG, and other formats if sharp is installed. Default in a browser: PNG, and JPEG and WebP for reading. */
  codec?: ImageCodec;
  /** program.wasm of the package: its bytes, a URL or a Response. By default, the file beside this module. */
  program?: ArrayBuffer | ArrayBufferView | URL | string | Response;
}

/**
 * Materials, their names, extras and other extensions stay the same objects. Old textures stay until `prune()`. Warnings go
 * to the logger of the document. Throws a RemapError if the command refuses the options. If some materials cannot be
 * converted, the others are converted first.
 */
export function remapMaterials(options: MaterialOptions): Transform;
