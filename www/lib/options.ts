import { refuseUnknown } from './known.js';

/**
 * The most quads of a mesh, and the default of `maxQuads`: what 2 GiB of memory hold, which is all that browsers share
 * between threads. The command line goes further.
 */
export const MOST_QUADS = 11_000_000;

/** A point or a direction: x, y, z in model units. */
export type Vector = readonly [number, number, number];

/** Where to refine. All lengths are in model units. */
export type Shape =
  /** A box from corner to corner, turned about its centre by a unit quaternion x, y, z, w. */
  | { kind: 'box'; min: Vector; max: Vector; rotation?: readonly [number, number, number, number] }
  | { kind: 'sphere'; center: Vector; radius: number }
  /** A capped cylinder between the centres of its caps. */
  | { kind: 'cylinder'; from: Vector; to: Vector; radius: number }
  /** Everything within `radius` of one of the points. */
  | { kind: 'points'; points: readonly Vector[]; radius: number }
  /** Everything within `distance` of a triangle surface. */
  | {
      kind: 'surface';
      positions: readonly Vector[];
      triangles: readonly (readonly [number, number, number])[];
      distance: number;
    };

/** How far to refine: to edges no longer than `size`, or `level` times, counted from the input. */
export type Target = { size: number; level?: never } | { level: number; size?: never };

/** A shape in space and what is wanted of the elements that overlap it. */
export type Region = Shape & Target;

/** What the quad mesh is to be like. Without any of the first four the input is only made all-quad. */
export interface QuadOptions {
  /** No edge longer than this, anywhere. */
  edgeLength?: number | undefined;
  /** Refine everything at least this many times. */
  levels?: number | undefined;
  /** Where to refine further. */
  regions?: readonly Region[] | undefined;
  /** Turn of the surface's normal that one edge may span, in degrees. */
  curvature?: number | undefined;
  /** How much larger an element may be than its neighbour around a region with a size: more than 1, at most 2 (the default). */
  gradation?: number | undefined;
  /** Leave untouched quads as they are; for all-quad input whose nodes can be two-coloured. */
  keepCoarse?: boolean | undefined;
  /** No element is refined beyond this level. Default 12. */
  maxLevels?: number | undefined;
  /** Refuse a mesh of more quads than this. Default, and the most there can be, {@link MOST_QUADS}. */
  maxQuads?: number | undefined;
}

/** How far the work is. */
export interface Progress {
  /** What is being done, such as `refine` or `balance`. */
  stage: string;
  /** How much of the stage is done, from 0 to 1; it never falls within a stage. */
  fraction: number;
}

/** Options of every long call. */
export interface CallOptions {
  /**
   * Aborting rejects the call at once with a `CancelledError` and frees the processor within 200 ms: threads that
   * share memory see a flag and stop; a single thread's worker cannot see it and is ended, as threads are that have not
   * stopped after 100 ms. The next call goes to fresh workers, which load its surface again by themselves.
   */
  signal?: AbortSignal | undefined;
  /** Called on this thread about 25 times a second. */
  onProgress?: ((progress: Progress) => void) | undefined;
}

/**
 * Tells how fine each element is to be.
 *
 * Called once a level, on the caller's thread, with x, y, z of the centre of each element that may be refined and
 * its longest edge. Returns the longest edge allowed for each; `Infinity` where it does not matter. It must not
 * wait for another call of the same mesher, which would be waiting for this one.
 */
export type SizeFunction = (
  centers: Float64Array,
  longest: Float64Array,
) => Float64Array | Promise<Float64Array>;

/** Options of `refineQuads`. */
export interface RefineOptions extends QuadOptions, CallOptions {
  /** A size for each element beside what the other options ask for. */
  sizeFunction?: SizeFunction | undefined;
}

/** Formats that are read. */
export type InputFormat = 'obj' | 'stl' | 'vtu' | 'vtk' | 'msh' | 'inp' | 'medit';

/** Formats that are written. */
export type OutputFormat = Exclude<InputFormat, 'stl'> | 'glb';

/** Formats of hex meshes that are written; of GLB the boundary alone. */
export type HexFormat = Exclude<OutputFormat, 'obj'>;

/** Says what the bytes are. */
export interface InputOptions {
  /** The format; by default that of the extension of `name`, else what the content is recognized as. */
  format?: InputFormat | undefined;
  /** The file's name, for its extension. */
  name?: string | undefined;
}

/** A surface as arrays. */
export interface SurfaceArrays {
  /** x, y, z of each node. */
  nodes: Float64Array;
  /** Where each face's corners start in `corners`, and the end of the last. Without it all faces are quads. */
  offsets?: Uint32Array | undefined;
  /** The nodes of all faces, face after face, counted from 0. */
  corners: Uint32Array;
}

/** A hex mesh as arrays. */
export interface HexArrays {
  /** x, y, z of each node. */
  nodes: Float64Array;
  /** The eight nodes of each hex in the order of VTK_HEXAHEDRON, counted from 0. */
  hexes: Uint32Array;
}

/** A box along the axes. */
export interface Bounds {
  min: Vector;
  max: Vector;
}

/** A file's text or bytes. */
export type FileInput = string | Uint8Array | ArrayBuffer | Blob;

/** What a surface can be loaded from: a file's text or bytes, or arrays. */
export type SurfaceInput = FileInput | SurfaceArrays;

/** What a hex mesh can be loaded from: a file's text or bytes, or arrays. */
export type HexInput = FileInput | HexArrays;

const EXTENSIONS: Readonly<Record<string, InputFormat>> = {
  obj: 'obj',
  stl: 'stl',
  vtu: 'vtu',
  vtk: 'vtk',
  msh: 'msh',
  inp: 'inp',
  mesh: 'medit',
  medit: 'medit',
};

/** The format that `options` name, by themselves or by a file's extension; undefined if they name none. */
export function inputFormat({ format, name }: InputOptions): InputFormat | undefined {
  if (format !== undefined) return format;
  const extension = name?.split('.').pop()?.toLowerCase() ?? '';
  return Object.hasOwn(EXTENSIONS, extension) ? EXTENSIONS[extension] : undefined;
}

/** Every quad option by name: the compiler holds this to be complete. */
const QUAD_OPTIONS: Readonly<Record<keyof QuadOptions, true>> = {
  edgeLength: true,
  levels: true,
  regions: true,
  curvature: true,
  gradation: true,
  keepCoarse: true,
  maxLevels: true,
  maxQuads: true,
};

/** The keys of each kind of region. */
const SHAPE_KEYS: { readonly [K in Shape['kind']]: readonly Exclude<keyof Extract<Shape, { kind: K }>, 'kind'>[] } = {
  box: ['min', 'max', 'rotation'],
  sphere: ['center', 'radius'],
  cylinder: ['from', 'to', 'radius'],
  points: ['points', 'radius'],
  surface: ['positions', 'triangles', 'distance'],
};

/**
 * `options` as the mesher takes them: plain data, without entries that are undefined. `besides` names what else the
 * caller could have given.
 *
 * @throws {@link OptionsError} if a key is unknown, as misspelt ones are.
 */
export function plainOptions(options: QuadOptions, besides: readonly string[] = []): QuadOptions {
  refuseUnknown(options, [...Object.keys(QUAD_OPTIONS), ...besides], 'option');
  refuseUnknownKeys(options.regions);
  return defined(options);
}

/** `options` without entries that are undefined. */
export function defined<O extends object>(options: O): O {
  return Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined)) as O;
}

/**
 * Refuses regions with a key that is none of their kind's.
 *
 * @throws {@link OptionsError} with the code `option-unknown`.
 */
export function refuseUnknownKeys(regions: readonly Region[] | undefined): void {
  if (Array.isArray(regions)) regions.forEach(refuseUnknownKeysOf);
}

/** Kinds that are none and values that do not fit are for the mesher to refuse. */
function refuseUnknownKeysOf(region: Region, index: number): void {
  if (typeof region !== 'object' || region === null || !Object.hasOwn(SHAPE_KEYS, region.kind)) return;
  const known = ['kind', ...SHAPE_KEYS[region.kind], 'size', 'level'];
  refuseUnknown(region, known, `regions[${index}], a ${region.kind}: key`);
}
