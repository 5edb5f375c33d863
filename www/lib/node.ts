import { availableParallelism } from 'node:os';
import { pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';

import type { Mesher } from './mesher.js';
import type { Platform, WasmFile } from './platform.js';
import { startMesher } from './start.js';
import type { MesherOptions } from './start.js';

export * from './exports.js';

const MODULES: Readonly<Record<WasmFile, () => URL>> = {
  'mesher.wasm': () => new URL('../wasm/mesher/mesher.wasm', import.meta.url),
  'mesher-threads.wasm': () => new URL('../wasm/mesher-threads/mesher-threads.wasm', import.meta.url),
  'hexes.wasm': () => new URL('../wasm/hexes/hexes.wasm', import.meta.url),
  'hexes-threads.wasm': () => new URL('../wasm/hexes-threads/hexes-threads.wasm', import.meta.url),
  'solids.wasm': () => new URL('../wasm/solids/solids.wasm', import.meta.url),
  'solids-threads.wasm': () => new URL('../wasm/solids-threads/solids-threads.wasm', import.meta.url),
};

const node: Platform = {
  cores: () => availableParallelism(),
  sharesMemory: () => true,
  wasmUrl: (file) => MODULES[file](),
  resolve: (url) => new URL(url, pathToFileURL('./')).href,
  spawn: (url, events) => {
    const worker = new Worker(url ?? new URL('./node-worker.js', import.meta.url), { name: 'hexmill' });
    worker.on('message', (message) => events.onMessage(message));
    worker.on('error', (error) => events.onError(error.message));
    worker.on('exit', () => events.onError('it ended'));
    return {
      post: (message) => worker.postMessage(message),
      terminate: () => void worker.terminate(),
      setBusy: (busy) => (busy ? worker.ref() : worker.unref()),
    };
  },
};

/**
 * Starts a mesher in worker threads.
 *
 * @throws {@link InternalError} if the worker or its module cannot be loaded.
 */
export function createMesher(options: MesherOptions = {}): Promise<Mesher> {
  return startMesher(node, options);
}
