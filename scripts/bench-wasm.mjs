// Times one refinement in WebAssembly, on one thread: what `npm run bench` runs beside the same work natively, which is
// `examples/throughput.rs`. The module www/wasm/mesher has to be built.
//
//     node scripts/bench-wasm.mjs SURFACE.obj OPTIONS.json RUNS
//
// Prints a line of JSON: the best of RUNS in seconds, and the hash of the mesh.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { main, root } from './shell.mjs';

await main(async ([path, options, runs]) => {
  const folder = join(root, 'www', 'wasm', 'mesher');
  // The bindings report progress and panics to the worker that they run in.
  globalThis.hexmillWorker = { progressed: () => false, panicked: (message) => console.error(message) };
  const mesher = await import(pathToFileURL(join(folder, 'mesher.js')));
  await mesher.default({ module_or_path: readFileSync(join(folder, 'mesher.wasm')) });
  const surface = mesher.Surface.read(readFileSync(path), 'obj');
  let seconds = Infinity;
  let hash = '';
  for (let run = 0; run < Number(runs); run++) {
    const start = performance.now();
    const quads = mesher.refineQuads(surface, JSON.parse(options));
    seconds = Math.min(seconds, (performance.now() - start) / 1000);
    hash = quads.hash();
    quads.free();
  }
  console.log(JSON.stringify({ seconds, hash }));
});
