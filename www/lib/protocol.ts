// What the calling thread and the workers say to each other.

import type { Failure } from './errors.js';
import type { GridOptions, HexOptions } from './hex-options.js';
import type { Bounds, HexArrays, HexFormat, InputFormat, OutputFormat, QuadOptions } from './options.js';
import type { ModuleName } from './platform.js';
import type { PlanSolidOptions, SolidOptions } from './solid-options.js';
import type { SolidPlan, SolidReport } from './solid-results.js';
import type { AddedHexes, Estimate, HexInfo, HexMetric, HexPlan, HexQuality, HexStage, MeshQuality, Metric, SurfaceInfo } from './results.js';

/** A file; without a format its content tells it. */
export interface FileData {
  format: InputFormat | undefined;
  content: string | Uint8Array;
}

/** What a surface is loaded from. */
export type SurfaceSource = FileData | { nodes: Float64Array; offsets: Uint32Array | undefined; corners: Uint32Array };

/** What hexes are loaded from, or made around. */
export type HexSource = FileData | HexArrays | (GridOptions & Bounds);

/** What an input is loaded from, kept by the calling thread so that a new worker can load it again. */
export type Source = { want: 'surface'; from: SurfaceSource } | { want: 'hexes'; from: HexSource };

/** A loaded surface. */
export interface SurfaceData {
  kind: 'surface';
  info: SurfaceInfo;
  nodes: Float64Array;
  offsets: Uint32Array;
  corners: Uint32Array;
}

/** A loaded hex mesh. */
export interface HexMeshData extends HexArrays {
  kind: 'hexes';
  info: HexInfo;
}

/** A quad mesh as arrays. */
export interface QuadArrays {
  nodes: Float64Array;
  quads: Uint32Array;
  level: Uint8Array;
  parent: Uint32Array;
}

/** What is told of every mesh. */
export interface MadeData {
  nodes: Float64Array;
  hash: string;
  defects: string[];
}

/** A refined mesh. */
export interface QuadData extends QuadArrays, MadeData {
  capped: number;
  quality: MeshQuality;
}

/** A hex mesh with faces that belong to something, as arrays. */
export interface GroupedHexArrays extends HexArrays {
  groupedFaces: Uint32Array;
}

/** A refined hex mesh as arrays. */
export interface HexArraysMade extends GroupedHexArrays {
  level: Uint8Array;
  parent: Uint32Array;
}

/** What is told of every hex mesh that was made. */
export interface MadeHexData extends HexArrays, MadeData {
  nodes: Float64Array;
  quality: HexQuality;
}

/** A refined hex mesh. */
export interface HexData extends HexArraysMade, MadeHexData {
  nodes: Float64Array;
  capped: number;
  added: AddedHexes;
  stages: HexStage[];
  turned: number;
}

/** A mesh of a solid as arrays. */
export interface SolidArrays extends GroupedHexArrays {
  bodies: Uint32Array;
  /** Of hexes of the second order, else empty: the nodes beside the corners, and all nodes of each hex. */
  middleNodes: Float64Array;
  secondOrder: Uint32Array;
}

/** What file of a solid's mesh is wanted, and the names that it has for each surface besides. */
export interface SolidFile {
  format: HexFormat;
  surfaceGroups: string[][];
}

/** A mesh of a solid. */
export interface HexedSolidData extends SolidArrays, MadeHexData {
  nodes: Float64Array;
  report: SolidReport;
}

/** The elements that a size function decides on. */
export interface Candidates {
  centers: Float64Array;
  longest: Float64Array;
}

/**
 * The calls: what each takes and gives. `begin`, `advance` and `finish`, or `beginHexes`, `advance` and `planBegunHexes` or `finishHexes`,
 * are one refinement a level at a time; any other call ends it. The module of surfaces answers what stands above
 * `planHexes`, that of solids what stands from `planSolid` on, `reload` and `hexQuality`, that of hexes the rest, `load`,
 * `reload` and `advance`. `input` is the number that the calling thread gave a surface or hex mesh; `reload` tells nothing
 * of what is known already.
 */
export interface Calls {
  load: { takes: { input: number; source: Source }; gives: SurfaceData | HexMeshData };
  reload: { takes: { input: number; source: Source }; gives: null };
  estimate: { takes: { input: number; options: QuadOptions }; gives: Estimate };
  refine: { takes: { input: number; options: QuadOptions }; gives: QuadData };
  begin: { takes: { input: number; options: QuadOptions }; gives: Candidates };
  advance: { takes: { targets: Float64Array }; gives: Candidates | null };
  finish: { takes: object; gives: QuadData };
  export: { takes: { input: number; mesh: QuadArrays; format: OutputFormat }; gives: Uint8Array };
  quality: { takes: { mesh: QuadArrays; metric: Metric }; gives: Float32Array };
  planHexes: { takes: { input: number; options: HexOptions }; gives: HexPlan };
  beginHexes: { takes: { input: number; options: HexOptions }; gives: Candidates };
  planBegunHexes: { takes: object; gives: HexPlan };
  finishHexes: { takes: object; gives: HexData };
  refineHexes: { takes: { input: number; options: HexOptions }; gives: HexData };
  exportHexes: { takes: { input: number; mesh: HexArraysMade; format: HexFormat }; gives: Uint8Array };
  hexQuality: { takes: { mesh: HexArrays; metric: HexMetric }; gives: Float32Array };
  planSolid: { takes: { input: number; options: PlanSolidOptions }; gives: SolidPlan };
  meshSolid: { takes: { input: number; options: SolidOptions }; gives: HexedSolidData };
  exportSolid: { takes: { mesh: SolidArrays; file: SolidFile }; gives: Uint8Array };
  solidDistances: { takes: { input: number; mesh: HexArrays }; gives: Float32Array };
}

/** The name of a call. */
export type CallName = keyof Calls;

/** A call under way: its name and what it takes. */
export type Call = { [N in CallName]: { name: N } & Calls[N]['takes'] }[CallName];

/** What is shared with the main thread where memory is shared. */
export interface SharedControl {
  memory: WebAssembly.Memory;
  /** Where the control block stands in memory, in bytes. */
  address: number;
}

/** Messages to a worker. Its first is `start` for the one that meshes, `join` for the threads of its pool. */
export type ToWorker =
  /** Load the module, from its address if it is not compiled yet. `pool`: threads to prepare for; 0: the one-thread module. */
  | { type: 'start'; name: ModuleName; module: string | WebAssembly.Module; pool: number }
  | { type: 'join'; name: ModuleName; module: WebAssembly.Module; memory: WebAssembly.Memory }
  | { type: 'call'; id: number; call: Call }
  | { type: 'drop'; input: number };

/** Messages from a worker. */
export type FromWorker =
  | { type: 'started'; module: WebAssembly.Module; shared: SharedControl | null }
  | { type: 'joined' }
  | { type: 'progress'; id: number; stage: string; fraction: number }
  | { type: 'done'; id: number; result: unknown }
  /** The call was refused; the worker is well. */
  | { type: 'failed'; id: number; failure: Failure }
  /** The worker is of no more use. */
  | { type: 'crashed'; failure: Failure };

/**
 * The control block as src/web/listener.rs lays it out: the progress in its first 64 bits, then the flag to stop in
 * the third of its 32-bit words.
 */
export const CONTROL = { words: 3, cancelled: 2 } as const;
