// Refinement natively (one thread and two) and in wasm (one thread), side by side in one run.
//
//     npm run bench
//
// Prints a Markdown table: millions of quads a second, ratios, and what a native process on one thread holds at most
// for each quad, with the pages that its allocator keeps from run to run.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { buildWasm } from './build-wasm.mjs';
import { setup } from './setup.mjs';
import { Failure, main, root } from './shell.mjs';

/** Each case is the best of this many runs. */
const RUNS = 7;

const ball = (level) => ({ kind: 'sphere', center: [16, 16, 2.5], radius: 10, level });

const CASES = [
  { name: 'uniform, 1 M quads', options: { levels: 5 } },
  { name: 'uniform, 4 M quads', options: { levels: 6 } },
  { name: 'adaptive, 1.3 M quads', options: { regions: [ball(6)] } },
  { name: 'adaptive, 5 M quads', options: { regions: [ball(7)] } },
];

/** A bent sheet of 32 x 32 quads as OBJ. */
function sheet() {
  const lines = [];
  for (let y = 0; y <= 32; y++) for (let x = 0; x <= 32; x++) lines.push(`v ${x} ${y} ${0.01 * x * y}`);
  for (let y = 0; y < 32; y++) {
    for (let x = 0; x < 32; x++) {
      const node = 33 * y + x + 1;
      lines.push(`f ${node} ${node + 1} ${node + 34} ${node + 33}`);
    }
  }
  return `${lines.join('\n')}\n`;
}

function native(path, options, threads) {
  const program = join(root, 'target', 'release', 'examples', 'throughput');
  return JSON.parse(execFileSync(program, [path, JSON.stringify(options), String(threads), String(RUNS)]));
}

function inWasm(mesher, obj, options) {
  const surface = mesher.Surface.read(new TextEncoder().encode(obj), 'obj');
  let seconds = Infinity;
  let hash = '';
  for (let run = 0; run < RUNS; run++) {
    const start = performance.now();
    const quads = mesher.refineQuads(surface, options);
    seconds = Math.min(seconds, (performance.now() - start) / 1000);
    hash = quads.hash();
    quads.free();
  }
  surface.free();
  return { seconds, hash };
}

async function loadMesher() {
  const folder = join(root, 'www', 'wasm', 'mesher');
  // The bindings report progress and panics to the worker that they run in.
  globalThis.hexmillWorker = { progressed: () => false, panicked: (message) => console.error(message) };
  const mesher = await import(pathToFileURL(join(folder, 'mesher.js')));
  await mesher.default({ module_or_path: readFileSync(join(folder, 'mesher.wasm')) });
  return mesher;
}

await main(async () => {
  await setup({ browser: false });
  execFileSync('cargo', ['build', '--release', '--example', 'throughput'], { cwd: root, stdio: 'inherit' });
  await buildWasm(['mesher']);
  const mesher = await loadMesher();
  const folder = mkdtempSync(join(tmpdir(), 'hexmill-bench-'));
  try {
    const path = join(folder, 'sheet.obj');
    const obj = sheet();
    writeFileSync(path, obj);
    console.log('| case | native, 1 thread | native, 2 threads | speed-up | wasm, 1 thread | native / wasm | bytes a quad |');
    console.log('|---|---|---|---|---|---|---|');
    for (const { name, options } of CASES) {
      const [one, two, wasm] = [native(path, options, 1), native(path, options, 2), inWasm(mesher, obj, options)];
      if (one.hash !== wasm.hash || one.hash !== two.hash) throw new Failure(`${name}: the meshes differ`);
      const rate = ({ seconds }) => `${(one.quads / seconds / 1e6).toFixed(1)} M/s`;
      const cells = [
        name,
        rate(one),
        rate(two),
        (one.seconds / two.seconds).toFixed(2),
        rate(wasm),
        (wasm.seconds / one.seconds).toFixed(2),
        one.peakBytes === null ? 'unknown' : (one.peakBytes / one.quads).toFixed(0),
      ];
      console.log(`| ${cells.join(' | ')} |`);
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});
