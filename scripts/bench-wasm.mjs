// Times one refinement in WebAssembly, on one thread: what `npm run bench` runs beside the same work natively, which is
// `examples/throughput.rs`. The module www/wasm/mesher, or www/wasm/hexes for a hex mesh, has to be built.
//
//     node scripts/bench-wasm.mjs MESH.obj|MESH.vtk OPTIONS.json RUNS
//
// Prints a line of JSON: the best of RUNS in seconds, and the hash of the mesh.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { main, root } from './shell.mjs';

/** The compiled module of that name. */
async function module(name) {
  const folder = join(root, 'www', 'wasm', name);
  const bindings = await import(pathToFileURL(join(folder, `${name}.js`)));
  await bindings.default({ module_or_path: readFileSync(join(folder, `${name}.wasm`)) });
  return bindings;
}

/** A refinement of the surface or hex mesh in a file: gives something with a hash, to be freed. */
async function refinement(path) {
  const content = readFileSync(path);
  if (path.endsWith('.vtk')) {
    const hexes = await module('hexes');
    const mesh = hexes.HexMesh.read(content, 'vtk');
    return (options) => hexes.refineHexes(mesh, options).arrays();
  }
  const mesher = await module('mesher');
  const surface = mesher.Surface.read(content, 'obj');
  return (options) => mesher.refineQuads(surface, options);
}

await main(async ([path, options, runs]) => {
  // The bindings report progress and panics to the worker that they run in.
  globalThis.hexmillWorker = { progressed: () => false, panicked: (message) => console.error(message) };
  const refine = await refinement(path);
  let seconds = Infinity;
  let hash = '';
  for (let run = 0; run < Number(runs); run++) {
    const start = performance.now();
    const mesh = refine(JSON.parse(options));
    seconds = Math.min(seconds, (performance.now() - start) / 1000);
    hash = mesh.hash();
    mesh.free();
  }
  console.log(JSON.stringify({ seconds, hash }));
});
