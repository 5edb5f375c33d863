// What the package exports beside `createMesher`, which browsers and Node make differently.

export { CancelledError, HexmillError, InputError, InternalError, LimitError, OptionsError } from './errors.js';
export { MOST_HEXES } from './hex-options.js';
export type { GridOptions, Growth, HexOptions, Method, RefineHexesOptions } from './hex-options.js';
export { HexMesh, Surface } from './loaded.js';
export { HexedSolid, QuadMesh, RefinedHexes } from './made.js';
export type { Mesher } from './mesher.js';
export { MOST_QUADS } from './options.js';
export type {
  Bounds,
  CallOptions,
  FileInput,
  HexArrays,
  HexFormat,
  HexInput,
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
export type {
  AddedHexes,
  Estimate,
  HexInfo,
  HexMetric,
  HexPlan,
  HexQuality,
  HexStage,
  HexStagePlan,
  MeshQuality,
  Metric,
  QualitySummary,
  SurfaceInfo,
} from './results.js';
export { MOST_HEXES_OF_SOLIDS } from './solid-options.js';
export type { Background, MeshSolidOptions, PlanSolidOptions, SecondOrderHex, SolidOptions } from './solid-options.js';
export type {
  BodyReport,
  Captured,
  CoreReport,
  DistanceSummary,
  FeatureReport,
  FoundSolid,
  LostFeature,
  SecondOrder,
  SecondOrderReport,
  SolidAttempt,
  SolidCurve,
  SolidPlan,
  SolidReport,
  SolidResult,
  SolidSurface,
  SurfaceDistances,
} from './solid-results.js';
export { MOST_THREADS } from './start.js';
export type { MesherOptions } from './start.js';
