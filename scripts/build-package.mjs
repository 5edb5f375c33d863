// Builds the npm package into dist/: the library for browsers and for Node, its workers, types and modules.
//
//     dist/lib/    index.js node.js and their types; worker.js and node-worker.js, each all in one file
//     dist/wasm/   the modules, where the library looks for them relative to itself
//
//     npm run build:package      (the modules have to be built: npm run build:wasm)

import { cpSync, existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';

import { Failure, isMain, main, must, root } from './shell.mjs';

const DIST = join(root, 'dist');
const MODULES = ['mesher', 'mesher-threads', 'hexes', 'hexes-threads', 'solids', 'solids-threads'].map((name) => `${name}/${name}.wasm`);
const ENTRIES = ['index', 'node', 'worker', 'node-worker'];

/** Bundles the library, writes its types, and copies the modules. */
export async function buildPackage(run = {}) {
  const { rolldown } = await import('rolldown');
  for (const module of MODULES) {
    if (!existsSync(join(root, 'www', 'wasm', module))) {
      throw new Failure(`www/wasm/${module} is missing: npm run build:wasm`);
    }
  }
  rmSync(DIST, { recursive: true, force: true });
  for (const entry of ENTRIES) await bundle(rolldown, entry);
  await writeTypes(run);
  for (const module of MODULES) {
    mkdirSync(dirname(join(DIST, 'wasm', module)), { recursive: true });
    cpSync(join(root, 'www', 'wasm', module), join(DIST, 'wasm', module));
  }
}

/** One file an entry: a worker that is a single file starts from any address. */
async function bundle(rolldown, entry) {
  const build = await rolldown({
    input: join(root, 'www', 'lib', `${entry}.ts`),
    platform: entry.startsWith('node') ? 'node' : 'browser',
  });
  await build.write({ file: join(DIST, 'lib', `${entry}.js`), format: 'esm', codeSplitting: false });
  await build.close();
}

async function writeTypes(run) {
  await must(join(root, 'node_modules', '.bin', 'tsc'), ['-p', 'tsconfig.package.json'], run);
  // The workers are addresses, not modules to import from.
  for (const worker of ['worker', 'node-worker']) writeFileSync(join(DIST, 'lib', `${worker}.d.ts`), 'export {};\n');
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await buildPackage();
    console.log('dist/ holds the package');
  });
}
