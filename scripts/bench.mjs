// Refinement natively (one thread and two) and in wasm (one thread), side by side in one run. Each figure is the best of
// some refinements in a process of its own.
//
//     npm run bench
//
// Prints a Markdown table: millions of quads a second, ratios, and what a native process on one thread holds at most
// for each quad, with the pages that its allocator keeps from run to run.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { buildWasm } from './build-wasm.mjs';
import { setup } from './setup.mjs';
import { Failure, main, root } from './shell.mjs';

/** So many runs in a process; the first ones bring memory and, in wasm, the fast compiler's code. */
const RUNS = 8;

/** So many processes of each kind, in turn, so that what else the machine does meets all of them alike. */
const ROUNDS = 3;

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

/** Runs a program that prints what it measured as JSON. */
const measured = (program, args, env = {}) =>
  JSON.parse(execFileSync(program, args.map(String), { env: { ...process.env, ...env } }));

/**
 * The allocator keeps the pages of what is freed, from run to run, as WebAssembly's memory does; otherwise what is
 * measured is now and then the system, taking pages back and clearing them again.
 */
const KEEPS_PAGES = { MIMALLOC_PURGE_DELAY: '-1' };

const native = (path, options, threads) =>
  measured(
    join(root, 'target', 'release', 'examples', 'throughput'),
    [path, JSON.stringify(options), threads, RUNS],
    KEEPS_PAGES,
  );

const inWasm = (path, options) =>
  measured(process.execPath, [join(root, 'scripts', 'bench-wasm.mjs'), path, JSON.stringify(options), RUNS]);

/** For each kind the quickest of its processes. */
function bestOfRounds(kinds) {
  const rounds = Array.from({ length: ROUNDS }, () => kinds.map((run) => run()));
  const quickest = (a, b) => (b.seconds < a.seconds ? b : a);
  return kinds.map((_, kind) => rounds.map((round) => round[kind]).reduce(quickest));
}

await main(async () => {
  await setup({ browser: false });
  execFileSync('cargo', ['build', '--release', '--example', 'throughput'], { cwd: root, stdio: 'inherit' });
  await buildWasm(['mesher']);
  const folder = mkdtempSync(join(tmpdir(), 'hexmill-bench-'));
  try {
    const path = join(folder, 'sheet.obj');
    writeFileSync(path, sheet());
    console.log('| case | native, 1 thread | native, 2 threads | speed-up | wasm, 1 thread | native / wasm | bytes a quad |');
    console.log('|---|---|---|---|---|---|---|');
    for (const { name, options } of CASES) {
      const kinds = [() => native(path, options, 1), () => native(path, options, 2), () => inWasm(path, options)];
      const [one, two, wasm] = bestOfRounds(kinds);
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
