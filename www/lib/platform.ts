import type { FromWorker, ToWorker } from './protocol.js';

/** What a module does: mesh surfaces, refine hexes, or fill solids with hexes. */
export type ModuleName = 'mesher' | 'hexes' | 'solids';

/** The modules' files: on one thread, and on a pool of workers. */
export type WasmFile = `${ModuleName}.wasm` | `${ModuleName}-threads.wasm`;

/** A worker as the calling thread sees it. */
export interface WorkerHandle {
  post(message: ToWorker): void;
  /** Ends the worker at once, whatever it does. */
  terminate(): void;
  /** Says whether this worker has work; where it has none, Node may exit. */
  setBusy(busy: boolean): void;
}

/** What a worker tells. */
export interface WorkerEvents {
  onMessage(message: FromWorker): void;
  /** The worker could not be started, or died. */
  onError(message: string): void;
}

/** What differs between browsers and Node. */
export interface Platform {
  /** Threads that this machine runs at once. */
  cores(): number;
  /** True if memory can be shared between workers. */
  sharesMemory(): boolean;
  /** Starts a worker, from the package's own file where `url` is undefined. */
  spawn(url: string | URL | undefined, events: WorkerEvents): WorkerHandle;
  /** The address of the package's own module. */
  wasmUrl(file: WasmFile): URL;
  /** An address as workers understand it, who are elsewhere than the caller. */
  resolve(url: string | URL): string;
}
