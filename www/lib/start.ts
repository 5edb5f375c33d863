// Starts a mesher: chooses modules and the number of threads, and starts the workers.

import { Crew } from './crew.js';
import { Crews } from './crews.js';
import { OptionsError } from './errors.js';
import { refuseUnknown } from './known.js';
import { Mesher } from './mesher.js';
import type { ModuleName, Platform, WasmFile } from './platform.js';

/** How the mesher is to run. */
export interface MesherOptions {
  /**
   * Threads of the pool, from 1 to {@link MOST_THREADS}; by default as many as the processor runs at once, at most 16,
   * beyond which the work gains nothing. More than one needs shared memory, in browsers a cross-origin isolated page;
   * elsewhere there is one thread.
   */
  threads?: number | undefined;
  /**
   * Where the WebAssembly modules are, if they are not beside this package's files: a function that tells the address of
   * each file (`mesher.wasm` and, once hexes or solids are asked for, `hexes.wasm` or `solids.wasm`; for more than one
   * thread `mesher-threads.wasm` and so on), or the address of the mesher's alone.
   */
  wasmUrl?: string | URL | ((file: WasmFile) => string | URL) | undefined;
  /** Where the worker's script is, if it is not beside this package's files. */
  workerUrl?: string | URL | undefined;
}

/** The most threads that can be asked for. */
export const MOST_THREADS = 64;

/** Threads that are taken by default, at most. */
const USUAL_THREADS = 16;

/** Every option of a mesher by name: the compiler holds this to be complete. */
const MESHER_OPTIONS: Readonly<Record<keyof MesherOptions, true>> = { threads: true, wasmUrl: true, workerUrl: true };

/** Starts the workers of a mesher; those of hexes and of solids are started when they are first asked for. */
export async function startMesher(platform: Platform, options: MesherOptions): Promise<Mesher> {
  refuseUnknown(options, Object.keys(MESHER_OPTIONS), 'option of a mesher');
  const threads = threadsFor(platform, options.threads);
  const mesherOn = async (count: number): Promise<Mesher> => {
    const crews = new Crews((name) => startCrew(platform, options, name, count));
    await crews.of('mesher');
    return new Mesher(crews, count);
  };
  try {
    return await mesherOn(threads);
  } catch (error) {
    // Some browsers refuse so much shared memory; who asked for threads is told.
    const fixed = options.threads !== undefined || typeof options.wasmUrl === 'string' || options.wasmUrl instanceof URL;
    if (threads === 1 || fixed) throw error;
    return mesherOn(1);
  }
}

function startCrew(platform: Platform, options: MesherOptions, name: ModuleName, threads: number): Promise<Crew> {
  const file: WasmFile = threads > 1 ? `${name}-threads.wasm` : `${name}.wasm`;
  const { wasmUrl, workerUrl } = options;
  const told = typeof wasmUrl === 'function' ? wasmUrl(file) : name === 'mesher' ? wasmUrl : undefined;
  const module = platform.resolve(told ?? platform.wasmUrl(file));
  return Crew.start({ platform, workerUrl, name, module, pool: threads > 1 ? threads : 0 });
}

function threadsFor(platform: Platform, wanted: number | undefined): number {
  if (wanted !== undefined && !(Number.isInteger(wanted) && wanted >= 1 && wanted <= MOST_THREADS)) {
    throw new OptionsError('threads-invalid', `threads is ${wanted}; give a whole number from 1 to ${MOST_THREADS}.`);
  }
  return platform.sharesMemory() ? (wanted ?? Math.min(platform.cores(), USUAL_THREADS)) : 1;
}
