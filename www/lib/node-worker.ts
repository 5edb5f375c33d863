// The worker thread of Node: the one that meshes, and each thread of its pool.

import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { parentPort } from 'node:worker_threads';
import type { TransferListItem } from 'node:worker_threads';

import type { ToWorker } from './protocol.js';
import { serve } from './serve.js';

const port = parentPort;
if (!port) throw new Error('This module is a worker thread of hexmill: it is not to be imported.');

const take = serve({
  post: (message, transfer) => port.postMessage(message, transfer as TransferListItem[]),
  compile: async (url) => WebAssembly.compile(await bytesAt(url)),
});

port.on('message', (message: ToWorker) => void take(message));

async function bytesAt(url: string): Promise<BufferSource> {
  if (url.startsWith('file:')) return new Uint8Array(await readFile(fileURLToPath(url)));
  const response = await fetch(url);
  if (!response.ok) throw new Error(`status ${response.status}`);
  return response.arrayBuffer();
}
