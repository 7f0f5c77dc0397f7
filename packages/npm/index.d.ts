/**
 * Converts maps of material parameters between the models of renderers.
 *
 * Shapes. A map of N texels is a typed array of N values for one channel. A color (specular, diffuse, base color) is
 * - interleaved: one array of 3 N values, red, green, blue of the first texel, then of the second; with 4 N values the
 *   fourth is opacity, which the result keeps;
 * - planar: a list of three arrays of N values;
 * - grey: one array of N values.
 * N is the length of a map of one channel, else of a plane; where colors are all, a third of the first one's length.
 * A number, or a list of three for a color, stands for every texel.
 *
 * Units. Float32Array and Float64Array hold the values themselves, colors linear. Whole numbers are parts of 255 or 65535,
 * colors in sRGB; `transfer` says otherwise. Roughness is in the encoding of its model (`models()`): alpha, perceptual
 * roughness, a Phong exponent or alpha squared, and means roughness even where the model takes glossiness, which has a name
 * of its own; `sourceEncoding` and `targetEncoding` say otherwise.
 */

export type MapArray = Float32Array | Float64Array | Uint8Array | Uint8ClampedArray | Uint16Array;
export type ScalarMap = number | MapArray | HeldArray;
export type ColorMap = number | [number, number, number] | MapArray | [MapArray, MapArray, MapArray] | HeldArray | [HeldArray, HeldArray, HeldArray];

export type Encoding = 'alpha' | 'roughness' | 'exponent' | 'glossiness' | 'squared';
export type Transfer = 'linear' | 'srgb';
export type Measure = 'residual' | 'metallicUncertainty' | 'issues';

/** How a converter is found. */
export interface ConverterOptions {
  /** Models that the path visits, in this order. */
  via?: string[];
  /** F0 of metallic workflows where metallic is 0; from 0 to 0.9. */
  dielectricF0?: number;
  /** How much of two alike materials that nearer to metallic 0 or 1 is preferred; 1e-5 for scans and JPEG. */
  metallicBias?: number;
}

/** The maps of a model: roughness and specular; of a workflow: those with diffuse, or base color and metallic. */
export interface SourceMaps {
  roughness?: ScalarMap;
  /** 1 - roughness, in its place. */
  glossiness?: ScalarMap;
  specular?: ColorMap;
  diffuse?: ColorMap;
  baseColor?: ColorMap;
  metallic?: ScalarMap;
  /** Chooses among metallic values that look alike. */
  metalMask?: ScalarMap;
}

export interface MapOptions {
  /** Texels a row, for positions in messages and for dithering. Without it rows are of any length. */
  width?: number;
  /** The row of the whole map that the arrays begin with. */
  firstRow?: number;
  /** Of all colors, or of each. */
  transfer?: Transfer | { [color: string]: Transfer };
  /** Of the results; by default that of the source of the same name, else of the first map. */
  type?: 'float32' | 'float64' | 'uint8' | 'uint16';
  sourceEncoding?: Encoding;
  targetEncoding?: Encoding;
  /** NaN, infinite and negative values: kept as far as results can hold them (the default), clamped, or an error. */
  badTexels?: 'keep' | 'clamp' | 'fail';
  /** Adds noise of half a step to results of 8 bits, the same in every run. */
  dither?: boolean;
  /** What to compute of a conversion to metallic as well. */
  measures?: Measure[];
  /** Arrays that results are written to, by their names, in place of new ones; they may be those of the sources. */
  into?: { [target: string]: MapArray | [MapArray, MapArray, MapArray] | HeldArray | [HeldArray, HeldArray, HeldArray] };
}

export interface Statistics {
  texels: number;
  /** Texels outside of what was measured. */
  outOfDomain: number;
  nan: number;
  infinite: number;
  negative: number;
  /** Values, not texels, that whole numbers cannot hold. */
  clippedValues: number;
  aboveOne: number;
}

/** Arrays as the sources have them; numbers where the sources are numbers. */
export interface TargetMaps {
  roughness?: any;
  /** In place of roughness, where that is the encoding of the target. */
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
  /** From the source to the target; empty where both have one BRDF. */
  models: string[];
  steps: { id: string; expectedError: number }[];
  /** Difference of pictures, relative to the source's. */
  expectedError: number;
  /** How far pictures differ: RMSE of display values in per cent; null where nobody has compared them. */
  pictureDifference: number | null;
  /** Another model of the same renderer that matches the highlight more closely, if there is one. */
  closer: string | null;
  notes: string[];
  assumptions: string[];
}

export interface Model {
  name: string;
  kind: 'brdf' | 'specular' | 'metallic' | 'alias';
  /** Of its roughness. */
  encoding?: Encoding;
  /** The name of the specular parameter of a BRDF. */
  specular?: string;
  /** Of a workflow. */
  brdf?: string;
  /** What an alias stands for, and why. */
  model?: string;
  meaning?: string;
}

export interface Converter {
  readonly id: string;
  readonly source: string;
  readonly target: string;
  readonly sourceEncoding: Encoding;
  readonly targetEncoding: Encoding;
  /** The names of the maps that it takes, and that it makes. */
  readonly sources: readonly string[];
  readonly targets: readonly string[];
  /** What was measured: `[min, max]` of each parameter. */
  readonly domain: { [parameter: string]: [number, number] };
  readonly path: Omit<Path, 'notes' | 'assumptions'> | null;
  readonly notes: string[];
  readonly assumptions: string[];
  convert(maps: SourceMaps & MapOptions): TargetMaps;
  /** Frees its memory now; otherwise that is done some time after the last use. */
  close(): void;
}

export class RemapError extends Error {
  readonly kind: 'usage' | 'input' | 'output' | 'numeric';
}

/**
 * Makes the library ready: from the file of the package, or from bytes, a URL or a Response of texremap.wasm.
 * Everything else throws before.
 */
export function load(source?: ArrayBuffer | ArrayBufferView | URL | string | Response): Promise<void>;

/** Converts maps. Converters are kept for later calls. */
export function convert(
  request: { source: string; target: string } & ConverterOptions & SourceMaps & MapOptions,
): TargetMaps;

/**
 * A converter for many calls. `target` may be a renderer, such as cycles-5, for the closest of its models.
 * `specular:mitsuba/ward` and `metallic:mitsuba/ward` are layers over a BRDF model.
 */
export function converter(source: string, target: string, options?: ConverterOptions): Converter;

/** The converter in the text of a fit file of remapc. */
export function converterOfFit(text: string): Converter;

/** An array in memory of the library. */
export interface HeldArray {
  /** The array. Memory moves when it grows, so ask for it again after each call, and give the HeldArray itself to convert(). */
  readonly array: MapArray;
  /** Gives the memory back, which nothing else does. Do not use a typed array that you keep: it shows what comes into that memory next. */
  free(): void;
}

/**
 * An array in memory of the library, of 4 GB at most. Where all maps of a call are such arrays, results (`into`) too, nothing is copied,
 * which is a tenth to a quarter faster.
 */
export function allocate(type: 'float32' | 'float64' | 'uint8' | 'uint16', length: number): HeldArray;

export function models(): Model[];
export function path(source: string, target: string, options?: ConverterOptions): Path;
export function version(): string;
