// The web worker: the one that meshes, and each thread of its pool.

import type { ToWorker } from './protocol.js';
import { serve } from './serve.js';

/** What is used of a dedicated worker's global scope (its type library clashes with that of pages). */
interface WorkerScope {
  postMessage(message: unknown, transfer: ArrayBufferLike[]): void;
  addEventListener(type: 'message', listener: (event: MessageEvent<ToWorker>) => void): void;
}

const scope = globalThis as unknown as WorkerScope;

const take = serve({
  post: (message, transfer) => scope.postMessage(message, transfer),
  compile: async (url) => {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`status ${response.status}`);
    // Streaming needs the media type application/wasm, which not every server sends.
    const streams = response.headers.get('Content-Type')?.startsWith('application/wasm') ?? false;
    return streams ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
  },
});

scope.addEventListener('message', (event) => void take(event.data));
