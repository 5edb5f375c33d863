// What the package exports beside `createMesher`, which browsers and Node make differently.

export { CancelledError, HexmillError, InputError, InternalError, LimitError, OptionsError } from './errors.js';
export { MOST_THREADS } from './mesher.js';
export type { Mesher, MesherOptions, QuadMesh, Surface } from './mesher.js';
export { MOST_QUADS } from './options.js';
export type {
  CallOptions,
  InputFormat,
  InputOptions,
  OutputFormat,
  Progress,
  QuadOptions,
  RefineOptions,
  Region,
  Shape,
  SizeFunction,
  SurfaceArrays,
  SurfaceInput,
  Target,
  Vector,
} from './options.js';
export type { WasmFile } from './platform.js';
export type { Estimate, MeshQuality, Metric, QualitySummary, SurfaceInfo } from './results.js';
