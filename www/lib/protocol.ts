// What the calling thread and the workers say to each other.

import type { Failure } from './errors.js';
import type { InputFormat, OutputFormat, QuadOptions } from './options.js';
import type { Estimate, MeshQuality, Metric, SurfaceInfo } from './results.js';

/** A surface's source, kept by the calling thread so that a new worker can load it again. */
export type SurfaceSource =
  | { format: InputFormat | undefined; content: string | Uint8Array }
  | { nodes: Float64Array; offsets: Uint32Array | undefined; corners: Uint32Array };

/** A loaded surface. */
export interface SurfaceData {
  info: SurfaceInfo;
  nodes: Float64Array;
  offsets: Uint32Array;
  corners: Uint32Array;
}

/** A quad mesh as arrays. */
export interface QuadArrays {
  nodes: Float64Array;
  quads: Uint32Array;
  level: Uint8Array;
  parent: Uint32Array;
}

/** A refined mesh. */
export interface QuadData extends QuadArrays {
  capped: number;
  hash: string;
  quality: MeshQuality;
  defects: string[];
}

/** The elements that a size function decides on. */
export interface Candidates {
  centers: Float64Array;
  longest: Float64Array;
}

/**
 * The calls: what each takes and gives. `begin`, `advance` and `finish` are one refinement a level at a time; any
 * other call ends it. `surface` is the number that the calling thread gave the surface in `load`.
 */
export interface Calls {
  load: { takes: { surface: number; source: SurfaceSource }; gives: SurfaceData };
  estimate: { takes: { surface: number; options: QuadOptions }; gives: Estimate };
  refine: { takes: { surface: number; options: QuadOptions }; gives: QuadData };
  begin: { takes: { surface: number; options: QuadOptions }; gives: Candidates };
  advance: { takes: { targets: Float64Array }; gives: Candidates | null };
  finish: { takes: object; gives: QuadData };
  export: { takes: { surface: number; mesh: QuadArrays; format: OutputFormat }; gives: Uint8Array };
  quality: { takes: { mesh: QuadArrays; metric: Metric }; gives: Float32Array };
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
  | { type: 'start'; module: string | WebAssembly.Module; pool: number }
  | { type: 'join'; module: WebAssembly.Module; memory: WebAssembly.Memory }
  | { type: 'call'; id: number; call: Call }
  | { type: 'drop'; surface: number };

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
