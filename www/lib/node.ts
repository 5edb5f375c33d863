import { availableParallelism } from 'node:os';
import { pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';

import { startMesher } from './mesher.js';
import type { Mesher, MesherOptions } from './mesher.js';
import type { Platform } from './platform.js';

export * from './exports.js';

const node: Platform = {
  cores: () => availableParallelism(),
  sharesMemory: () => true,
  wasmUrl: (file) =>
    file === 'mesher.wasm'
      ? new URL('../wasm/mesher/mesher.wasm', import.meta.url)
      : new URL('../wasm/mesher-threads/mesher-threads.wasm', import.meta.url),
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
