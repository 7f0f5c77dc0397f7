/**
 * This module converts maps of material parameters between the models of renderers.
 *
 * Shapes: a map of N texels is a typed array. With one channel it has N values. A color (specular, diffuse, base color) is
 * - interleaved: one array of 3 N values, with red, green and blue of each texel; with 4 N values, the fourth is opacity,
 *   which the result keeps;
 * - planar: a list of three arrays of N values;
 * - grey: one array of N values.
 * If all maps are colors, the first array is interleaved RGB, so its length is 3 N. A number, or a list of three numbers for
 * a color, means the same value for every texel.
 *
 * Units: Float32Array and Float64Array hold the values themselves; their colors are linear. Integers are fractions of 255 or
 * 65535; their colors are sRGB. `transfer` changes this. `roughness` has the encoding of its model (see `models()`): alpha,
 * perceptual roughness, a Phong exponent or alpha squared. It is never glossiness, which has a separate name.
 * `sourceEncoding` and `targetEncoding` change the encoding.
 */

export type MapArray = Float32Array | Float64Array | Uint8Array | Uint8ClampedArray | Uint16Array;
export type ScalarMap = number | MapArray | HeldArray;
export type ColorMap = number | [number, number, number] | MapArray | [MapArray, MapArray, MapArray] | HeldArray | [HeldArray, HeldArray, HeldArray];

export type Encoding = 'alpha' | 'roughness' | 'exponent' | 'glossiness' | 'squared';
export type Transfer = 'linear' | 'srgb';
export type Measure = 'residual' | 'metallicUncertainty' | 'issues';

/** These options choose the converter. */
export interface ConverterOptions {
  /** Models that the path visits, in this order. */
  via?: string[];
  /** F0 of dielectrics (metallic 0) in metallic workflows, 0 to 0.9. By default, the F0 of the model. */
  dielectricF0?: number;
  /** How strongly metallic 0 and 1 are preferred, 0 to 1: 1e-6 for clean maps (default), 1e-5 for scans and JPEG. */
  metallicBias?: number;
}

/** A BRDF model has roughness and specular. A workflow also has diffuse, or base color and metallic instead. */
export interface SourceMaps {
  roughness?: ScalarMap;
  /** 1 - roughness, instead of roughness. */
  glossiness?: ScalarMap;
  specular?: ColorMap;
  diffuse?: ColorMap;
  baseColor?: ColorMap;
  metallic?: ScalarMap;
  /** Chooses among metallic values that look alike. */
  metalMask?: ScalarMap;
}

export interface MapOptions {
  /** Number of texels in a row. Messages and dithering use it. */
  width?: number;
  /** Index of the first row of the arrays in the whole map. */
  firstRow?: number;
  /** Transfer of all colors, or of each color by its name. */
  transfer?: Transfer | { [color: string]: Transfer };
  /** Type of the results. By default, the type of the source with the same name, otherwise of the first map. */
  type?: 'float32' | 'float64' | 'uint8' | 'uint16';
  sourceEncoding?: Encoding;
  targetEncoding?: Encoding;
  /** What happens to NaN, infinite and negative values: kept if the result type can hold them (default), clamped, or an error. */
  badTexels?: 'keep' | 'clamp' | 'fail';
  /** Adds noise of half a step to 8-bit results. The noise is the same in every run. */
  dither?: boolean;
  /** Measures of a conversion to metallic that are computed as well. */
  measures?: Measure[];
  /** Existing arrays for the results, by name. They may be the arrays of the sources. */
  into?: { [target: string]: MapArray | [MapArray, MapArray, MapArray] | HeldArray | [HeldArray, HeldArray, HeldArray] };
}

export interface Statistics {
  texels: number;
  /** Number of texels outside of the measured range. */
  outOfDomain: number;
  nan: number;
  infinite: number;
  negative: number;
  /** Number of values (not texels) that integers cannot hold. */
  clippedValues: number;
  aboveOne: number;
}

/** Results have the shapes of the sources. If all sources are numbers, results are numbers. */
export interface TargetMaps {
  roughness?: any;
  /** Instead of roughness, if the encoding of the target is glossiness. */
  glossiness?: any;
  specular?: any;
  diffuse?: any;
  baseColor?: any;
  metallic?: any;
  residual?: any;
  metallicUncertainty?: any;
  issues?: any;
  statistics: Statistics;
}

export interface Path {
  /** The BRDF models from source to target. Empty if both ends have the same BRDF. */
  models: string[];
  steps: { id: string; expectedError: number }[];
  /** Expected difference of pictures, relative to the source's picture. */
  expectedError: number;
  /** RMSE of display values of rendered pictures, in per cent. Null if it was not measured. */
  pictureDifference: number | null;
  /** Another model of the same renderer that matches the highlight more closely, if there is one. */
  closer: string | null;
  notes: string[];
  assumptions: string[];
}

export interface Model {
  name: string;
  kind: 'brdf' | 'specular' | 'metallic' | 'alias';
  /** Encoding of its roughness. */
  encoding?: Encoding;
  /** The name of the specular parameter of a BRDF. */
  specular?: string;
  /** BRDF model of a workflow. */
  brdf?: string;
  /** The model that an alias means, and the reason. */
  model?: string;
  meaning?: string;
}

export interface Converter {
  readonly id: string;
  readonly source: string;
  readonly target: string;
  readonly sourceEncoding: Encoding;
  readonly targetEncoding: Encoding;
  /** Names of the maps that it reads, and of the maps that it makes. */
  readonly sources: readonly string[];
  readonly targets: readonly string[];
  /** Measured range of each parameter: `[min, max]`. */
  readonly domain: { [parameter: string]: [number, number] };
  readonly path: Omit<Path, 'notes' | 'assumptions'> | null;
  readonly notes: string[];
  readonly assumptions: string[];
  convert(maps: SourceMaps & MapOptions): TargetMaps;
  /** Frees its memory now. Without this call, the memory is freed some time after the last use. */
  close(): void;
}

export class RemapError extends Error {
  readonly kind: 'usage' | 'input' | 'output' | 'numeric';
}

/**
 * Loads the library from the file of the package, or from the bytes, a URL or a Response of texremap.wasm.
 * Until it is loaded, all other functions throw.
 */
export function load(source?: ArrayBuffer | ArrayBufferView | URL | string | Response): Promise<void>;

/** Converts maps. The converter is kept for later calls. */
export function convert(
  request: { source: string; target: string } & ConverterOptions & SourceMaps & MapOptions,
): TargetMaps;

/**
 * Returns a converter for many calls. If `target` is a renderer, such as cycles-5, the closest of its models is used.
 * `specular:mitsuba/ward` and `metallic:mitsuba/ward` are workflows over a BRDF model. `plain:` or `scaled:` before a
 * workflow states what diffuse means: the reflectance, or the reflectance times 1 - max(specular), as in glTF.
 */
export function converter(source: string, target: string, options?: ConverterOptions): Converter;

/** Returns the converter in the text of a fit file of remapc. */
export function converterOfFit(text: string): Converter;

/** A HeldArray is an array in the memory of the library. */
export interface HeldArray {
  /** The array. The memory moves when it grows: read this property again after each call, and pass the HeldArray to convert(). */
  readonly array: MapArray;
  /** Frees the memory; nothing else frees it. Do not use the typed array afterwards, because other data will be in its memory. */
  free(): void;
}

/**
 * Returns an array in the memory of the library, which has 4 GB at most. If all maps of a call are such arrays, including
 * the results (`into`), nothing is copied, and the call is 10 to 25 % faster.
 */
export function allocate(type: 'float32' | 'float64' | 'uint8' | 'uint16', length: number): HeldArray;

export function models(): Model[];
export function path(source: string, target: string, options?: ConverterOptions): Path;
export function version(): string;
