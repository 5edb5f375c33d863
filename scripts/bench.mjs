// Refinement natively (one thread and two) and in wasm (one thread), side by side in one run. Each figure is the best of
// some refinements in a process of its own.
//
//     npm run bench
//     npm run bench -- quads|hexes
//
// Prints a Markdown table of quads and one of hexes: millions of cells a second, ratios, and what a native process on one
// thread holds at most for each cell, with the pages that its allocator keeps from run to run. Of hexes the time that
// smoothing takes is told apart.

import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

import { buildWasm } from './build-wasm.mjs';
import { setup } from './setup.mjs';
import { Failure, main, root } from './shell.mjs';

/** So many runs in a process; the first ones bring memory and, in wasm, the fast compiler's code. */
const RUNS = { quads: 8, hexes: 2 };

/** So many processes of each kind, in turn, so that what else the machine does meets all of them alike. */
const ROUNDS = { quads: 3, hexes: 1 };

const ball = (level) => ({ kind: 'sphere', center: [16, 16, 2.5], radius: 10, level });

const QUADS = [
  { name: 'uniform, 1 M quads', options: { levels: 5 } },
  { name: 'uniform, 4 M quads', options: { levels: 6 } },
  { name: 'adaptive, 1.3 M quads', options: { regions: [ball(6)] } },
  { name: 'adaptive, 5 M quads', options: { regions: [ball(7)] } },
];

/** The middle of a grid of 16 x 16 x 16 cubes, refined in a ball. */
const inBall = (method, radius, level) => ({ method, regions: [{ kind: 'sphere', center: [8, 8, 8], radius, level }] });

const HEXES = [
  { name: 'uniform', options: { levels: 3 } },
  { name: 'Method I, a small ball', options: inBall('one', 1.2, 4) },
  { name: 'Method I, a medium one', options: inBall('one', 3, 4) },
  { name: 'Method I, a large one', options: inBall('one', 5.4, 4), inWasm: false },
  { name: 'Method II, a small ball', options: inBall('two', 1.2, 4) },
  { name: 'Method II, a medium one', options: inBall('two', 3.3, 4) },
  { name: 'Method II, a large one', options: inBall('two', 6.1, 4), inWasm: false },
];

/** 16 x 16 x 16 cubes as legacy VTK. */
function cubes() {
  const [side, cells] = [17, 16];
  const lines = ['# vtk DataFile Version 3.0', 'cubes', 'ASCII', 'DATASET UNSTRUCTURED_GRID', `POINTS ${side ** 3} double`];
  for (let z = 0; z < side; z++) for (let y = 0; y < side; y++) for (let x = 0; x < side; x++) lines.push(`${x} ${y} ${z}`);
  lines.push(`CELLS ${cells ** 3} ${9 * cells ** 3}`);
  for (let z = 0; z < cells; z++) {
    for (let y = 0; y < cells; y++) {
      for (let x = 0; x < cells; x++) {
        const bottom = x + side * (y + side * z);
        const [front, top] = [[bottom, bottom + 1, bottom + 1 + side, bottom + side], side * side];
        lines.push(`8 ${[...front, ...front.map((node) => node + top)].join(' ')}`);
      }
    }
  }
  lines.push(`CELL_TYPES ${cells ** 3}`, ...Array(cells ** 3).fill('12'));
  return `${lines.join('\n')}\n`;
}

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

const native = (path, options, threads, runs) =>
  measured(
    join(root, 'target', 'release', 'examples', 'throughput'),
    [path, JSON.stringify(options), threads, runs],
    KEEPS_PAGES,
  );

const wasm = (path, options, runs) =>
  measured(process.execPath, [join(root, 'scripts', 'bench-wasm.mjs'), path, JSON.stringify(options), runs]);

/** For each kind the quickest of its processes. */
function bestOf(rounds, kinds) {
  const results = Array.from({ length: rounds }, () => kinds.map((run) => run()));
  const quickest = (a, b) => (b.seconds < a.seconds ? b : a);
  return kinds.map((_, kind) => results.map((round) => round[kind]).reduce(quickest));
}

/** Natively on one thread and on two, and in WebAssembly unless its memory is too small. */
function sideBySide(path, { name, options, inWasm = true }, table) {
  const runs = RUNS[table];
  const kinds = [() => native(path, options, 1, runs), () => native(path, options, 2, runs)];
  const results = bestOf(ROUNDS[table], inWasm ? [...kinds, () => wasm(path, options, runs)] : kinds);
  if (results.some(({ hash }) => hash !== results[0].hash)) throw new Failure(`${name}: the meshes differ`);
  return results;
}

const millions = (cells, seconds) => (cells / seconds / 1e6).toFixed(cells / seconds < 1e6 ? 2 : 1);
const bytesEach = ({ peakBytes, cells }) => (peakBytes === null ? 'unknown' : (peakBytes / cells).toFixed(0));
const row = (cells) => console.log(`| ${cells.join(' | ')} |`);

function quads(path) {
  row(['case', 'native, 1 thread', 'native, 2 threads', 'speed-up', 'wasm, 1 thread', 'native / wasm', 'bytes a quad']);
  row(Array(7).fill('---'));
  for (const test of QUADS) {
    const [one, two, web] = sideBySide(path, test, 'quads');
    const rate = ({ seconds }) => `${millions(one.cells, seconds)} M/s`;
    row([test.name, rate(one), rate(two), (one.seconds / two.seconds).toFixed(2), rate(web), (web.seconds / one.seconds).toFixed(2), bytesEach(one)]);
  }
}

function hexes(path) {
  row(['case', 'hexes', 'seconds, 1 thread', 'of these smoothing', 'M hexes/s before smoothing', 'speed-up, 2 threads', 'wasm / native', 'bytes a hex']);
  row(Array(8).fill('---'));
  for (const test of HEXES) {
    const [one, two, web] = sideBySide(path, test, 'hexes');
    row([
      test.name,
      one.cells,
      one.seconds.toFixed(2),
      one.smoothing.toFixed(2),
      millions(one.cells, one.seconds - one.smoothing),
      (one.seconds / two.seconds).toFixed(2),
      web ? (web.seconds / one.seconds).toFixed(2) : 'too large',
      bytesEach(one),
    ]);
  }
}

const TABLES = {
  quads: { table: quads, file: 'sheet.obj', text: sheet, module: 'mesher' },
  hexes: { table: hexes, file: 'cubes.vtk', text: cubes, module: 'hexes' },
};

await main(async (names) => {
  const unknown = names.find((name) => !(name in TABLES));
  if (unknown !== undefined) throw new Failure(`${unknown} is no table: give ${Object.keys(TABLES).join(' or ')}, or nothing for both`);
  const tables = (names.length > 0 ? names : Object.keys(TABLES)).map((name) => TABLES[name]);
  await setup({ browser: false });
  execFileSync('cargo', ['build', '--release', '--example', 'throughput'], { cwd: root, stdio: 'inherit' });
  await buildWasm(tables.map(({ module }) => module));
  const folder = mkdtempSync(join(tmpdir(), 'hexmill-bench-'));
  try {
    for (const { table, file, text } of tables) {
      const path = join(folder, file);
      writeFileSync(path, text());
      table(path);
      console.log();
    }
  } finally {
    rmSync(folder, { recursive: true });
  }
});
