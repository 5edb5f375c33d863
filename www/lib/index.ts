import type { Mesher } from './mesher.js';
import type { Platform, WasmFile } from './platform.js';
import { startMesher } from './start.js';
import type { MesherOptions } from './start.js';

export * from './exports.js';

// Bundlers find the modules and the worker by these very expressions.
const MODULES: Readonly<Record<WasmFile, () => URL>> = {
  'mesher.wasm': () => new URL('../wasm/mesher/mesher.wasm', import.meta.url),
  'mesher-threads.wasm': () => new URL('../wasm/mesher-threads/mesher-threads.wasm', import.meta.url),
  'hexes.wasm': () => new URL('../wasm/hexes/hexes.wasm', import.meta.url),
  'hexes-threads.wasm': () => new URL('../wasm/hexes-threads/hexes-threads.wasm', import.meta.url),
  'solids.wasm': () => new URL('../wasm/solids/solids.wasm', import.meta.url),
  'solids-threads.wasm': () => new URL('../wasm/solids-threads/solids-threads.wasm', import.meta.url),
};

const browser: Platform = {
  cores: () => navigator.hardwareConcurrency || 1,
  sharesMemory: () => globalThis.crossOriginIsolated === true && typeof SharedArrayBuffer === 'function',
  wasmUrl: (file) => MODULES[file](),
  resolve: (url) => new URL(url, globalThis.document?.baseURI ?? location.href).href,
  spawn: (url, events) => {
    const worker =
      url === undefined
        ? new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'hexmill' })
        : new Worker(url, { type: 'module', name: 'hexmill' });
    worker.addEventListener('message', (event: MessageEvent) => events.onMessage(event.data));
    worker.addEventListener('messageerror', () => events.onError('it sent something unreadable'));
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      events.onError(event.message || 'its script could not be loaded: see the option workerUrl');
    });
    return {
      post: (message) => worker.postMessage(message),
      terminate: () => worker.terminate(),
      setBusy: () => {},
    };
  },
};

/**
 * Starts a mesher in web workers: on a pool of them where the page is cross-origin isolated, else on one.
 *
 * @throws {@link InternalError} if the worker or its module cannot be loaded.
 */
export function createMesher(options: MesherOptions = {}): Promise<Mesher> {
  return startMesher(browser, options);
}
