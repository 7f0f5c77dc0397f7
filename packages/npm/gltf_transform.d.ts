/**
 * Converts the materials of a document of glTF-Transform, as the command `texremap convert` does those of a file:
 *
 *     await document.transform(remapMaterials({ from: 'gltf-specgloss', to: 'gltf' }));
 */
import type { Transform } from '@gltf-transform/core';

/** Texels in rows from the top, channels interleaved; opacity is not multiplied into colors. */
export interface Image {
  width: number;
  height: number;
  /** 1 grey, 2 grey and opacity, 3 RGB, 4 RGB and opacity. */
  channels: number;
  depth: 8 | 16;
  data: Uint8Array | Uint16Array;
}

/** Decodes and encodes whole image files. Values are those of the file, without a curve or a profile applied. */
export interface ImageCodec {
  decode(bytes: Uint8Array): Image | Promise<Image>;
  /** `setting`: the level of PNG, 1 to 9, or the quality of JPEG. */
  encode(format: 'png' | 'jpeg', image: Image, setting: number): Uint8Array | Promise<Uint8Array>;
  /** Called after each document. */
  close?(): void;
}

/** Those of the command (docs/assets.md), and where images and the program come from. */
export interface MaterialOptions {
  from?: 'gltf-specgloss' | 'gltf';
  to: 'gltf' | 'gltf-specgloss';
  /**
   * KHR_materials_specular and KHR_materials_ior. write: exact in viewers that read them, wrong in others.
   * fold: replaces them by core, for viewers that do not read them.
   */
  extensions?: 'write' | 'fold';
  /** How much of two alike materials that nearer to metallic 0 or 1 is preferred; 1e-5 for scans and JPEG. */
  metallicBias?: number;
  /** Enlarges smaller images of a material, and puts maps with different KHR_texture_transform onto one grid. */
  resample?: boolean;
  /** New images of color become JPEG of this quality, 1 to 100. */
  jpeg?: number;
  /** By default PNG alone in node, others where sharp is installed; in a browser PNG, and reading of JPEG and WebP. */
  codec?: ImageCodec;
  /** program.wasm of the package: its bytes, a URL or a Response; by default the file beside this one. */
  program?: ArrayBuffer | ArrayBufferView | URL | string | Response;
}

/**
 * Materials, their names, extras and other extensions stay the same objects, and so does everything else; old textures stay
 * until `prune()`. Warnings go to the logger of the document. Throws a RemapError with the text of the command for options that
 * it refuses, and, after the others are converted, for materials that cannot be converted.
 */
export function remapMaterials(options: MaterialOptions): Transform;
