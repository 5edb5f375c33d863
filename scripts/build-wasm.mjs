// Builds the WebAssembly modules into www/wasm/ (not under version control):
//
//     www/wasm/mesher/          mesher.js mesher.wasm                   the mesher of surfaces on one thread
//     www/wasm/mesher-threads/  mesher-threads.js mesher-threads.wasm   the same on a pool of workers
//     www/wasm/hexes/           hexes.js hexes.wasm                     the refinement of hexes on one thread
//     www/wasm/hexes-threads/   hexes-threads.js hexes-threads.wasm     the same on a pool of workers
//     www/wasm/solids/          solids.js solids.wasm                   the mesher of solids on one thread
//     www/wasm/solids-threads/  solids-threads.js solids-threads.wasm   the same on a pool of workers
//     www/wasm/viewer/          viewer.js viewer.wasm                   the WebGL renderer
//
// Each .js has its .d.ts beside it and takes the module's address or bytes as an argument of its
// default export: `await init({ module_or_path: new URL('../wasm/viewer/viewer.wasm', import.meta.url) })`.
//
//     npm run build:wasm [-- FLAVOUR…]
//
// cargo knows which sources changed; what follows is skipped while cargo's output stays the same.

import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';

import { setUpWasmBindgen } from './setup.mjs';
import { Failure, isMain, main, must, output, root } from './shell.mjs';

const TARGET = 'wasm32-unknown-unknown';
const OUT = join(root, 'www', 'wasm');

/** 2 GiB, the most shared memory that every browser gives. */
const MAX_SHARED_MEMORY = 2147483648;

// A panic tells its file and line: with its column each place where one may be would be another, which is 6 KB compressed.
const LOCATIONS = '-Z location-detail=file,line';

// Atomics in std need std built anew; wasm-bindgen reads the exported symbols to give each thread its own storage.
const THREADS_FLAGS = [
  '-C target-feature=+atomics,+bulk-memory,+mutable-globals,+simd128',
  LOCATIONS,
  '-C link-arg=--shared-memory',
  '-C link-arg=--import-memory',
  `-C link-arg=--max-memory=${MAX_SHARED_MEMORY}`,
  ...['__wasm_init_tls', '__tls_size', '__tls_align', '__tls_base'].map((name) => `-C link-arg=--export=${name}`),
].join(' ');

// Without a default path bundlers do not look for the module beside the JavaScript: callers name it. The names of
// functions would be a tenth of what is loaded.
const BINDGEN_FLAGS = [
  ...['--target', 'web', '--omit-default-module-path'],
  ...['--remove-name-section', '--remove-producers-section'],
];

// What the modules may use; wasm-opt would otherwise take only what it finds marked in them.
const BINARYEN_FEATURES = [
  'bulk-memory',
  'bulk-memory-opt',
  'multivalue',
  'mutable-globals',
  'nontrapping-float-to-int',
  'reference-types',
  'sign-ext',
  'simd',
].map((feature) => `--enable-${feature}`);

// Which features a module uses is for linkers to know. Below 1,024 is the end of the stack, which grows down to 0 there:
// what Rust has addresses of lies above it, so that Binaryen may put sums of addresses and constants into loads and stores.
const OPTIMIZED = ['-O3', '--strip-target-features', '--low-memory-unused'];

// What a module is made for: millions of quads a second, or that functions are put into others hardly anywhere but where
// they say so, which keeps the larger modules a tenth smaller, and as fast.
const FAST = { rustc: ['-C', 'opt-level=3'], binaryen: [] };
const SMALL = {
  rustc: ['-C', 'llvm-args=-inline-threshold=8'],
  binaryen: ['--one-caller-inline-max-function-size', '0', '--flexible-inline-max-function-size', '0'],
};

// What a panic tells of where it was names crates and files in them, not the folders of the machine that built the module.
const TRIMMED = ['-Z', 'trim-paths', '--config', 'profile.web.trim-paths="all"'];

// RUSTC_BOOTSTRAP lets the pinned stable toolchain take what begins with -Z.
const withFlags = (flags) => ({ RUSTC_BOOTSTRAP: '1', CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS: flags });

const ON_ONE_THREAD = {
  profile: 'web-mesher',
  optimize: OPTIMIZED,
  cargo: TRIMMED,
  env: withFlags(`-C target-feature=+simd128 ${LOCATIONS}`),
};

const ON_A_POOL = {
  profile: 'web-mesher',
  optimize: [...OPTIMIZED, '--enable-threads'],
  cargo: [...TRIMMED, '-Z', 'build-std=std,panic_abort'],
  env: withFlags(THREADS_FLAGS),
};

const FLAVOURS = [
  { name: 'mesher', ...FAST, features: 'quads', ...ON_ONE_THREAD },
  { name: 'mesher-threads', ...FAST, features: 'quads,threads', ...ON_A_POOL },
  { name: 'hexes', ...SMALL, features: 'hexes', ...ON_ONE_THREAD },
  { name: 'hexes-threads', ...SMALL, features: 'hexes,threads', ...ON_A_POOL },
  { name: 'solids', ...SMALL, features: 'solids', ...ON_ONE_THREAD },
  { name: 'solids-threads', ...SMALL, features: 'solids,threads', ...ON_A_POOL },
  { name: 'viewer', features: 'viewer' },
];

/**
 * Builds the named flavours (all by default), two at a time, and resolves to a line about each. `run` are options
 * of `execute`, such as a log.
 */
export async function buildWasm(names = FLAVOURS.map((flavour) => flavour.name), run = {}) {
  const unknown = names.filter((name) => !FLAVOURS.some((flavour) => flavour.name === name));
  if (unknown.length > 0) {
    throw new Failure(`No such flavour: ${unknown.join(', ')}. There are ${FLAVOURS.map((f) => f.name).join(', ')}.`);
  }
  await setUpWasmBindgen();
  const waiting = FLAVOURS.filter((flavour) => names.includes(flavour.name));
  const lines = [];
  const work = async () => {
    for (let flavour = waiting.shift(); flavour; flavour = waiting.shift()) lines.push(await buildFlavour(flavour, run));
  };
  // Linking with full LTO keeps one core busy for most of a build.
  await Promise.all([work(), work()]);
  return lines.sort();
}

async function buildFlavour(flavour, run) {
  const compiled = await compile(flavour, run);
  const folder = join(OUT, flavour.name);
  const stamp = join(folder, '.stamp');
  const flags = JSON.stringify([flavour, BINDGEN_FLAGS, BINARYEN_FEATURES]);
  const recipe = [compiled, flags, output('wasm-bindgen', ['--version'])];
  const hash = recipe.reduce((sum, part) => sum.update(part), createHash('sha256')).digest('hex');
  if (!existsSync(stamp) || readFileSync(stamp, 'utf8') !== hash) {
    rmSync(folder, { recursive: true, force: true });
    mkdirSync(folder, { recursive: true });
    await bind(flavour, folder, run);
    writeFileSync(stamp, hash);
  }
  const wasm = readFileSync(join(folder, `${flavour.name}.wasm`));
  const kilobytes = (bytes) => `${(bytes / 1000).toFixed(0)} KB`;
  return `${flavour.name}.wasm: ${kilobytes(wasm.length)}, gzip ${kilobytes(gzipSync(wasm, { level: 9 }).length)}`;
}

/** What cargo makes of the flavour: the bytes of the module. A target folder each, so that flags never clash. */
async function compile({ name, features, profile = 'web', cargo = [], rustc = [], env = {} }, run) {
  const targetFolder = targetFolderOf(name);
  const args = ['rustc', '--lib', '--crate-type', 'cdylib', '--target', TARGET, '--profile', profile];
  const selection = ['--no-default-features', '--features', features, '--target-dir', targetFolder];
  await must('cargo', [...args, ...selection, ...cargo, '--', ...rustc], { ...run, env });
  return readFileSync(compiledPath(name, profile));
}

function targetFolderOf(name) {
  return join(root, 'target', 'wasm', name);
}

function compiledPath(name, profile) {
  return join(targetFolderOf(name), TARGET, profile, 'hexmill.wasm');
}

/** Makes the JavaScript side with wasm-bindgen and optimizes the module with Binaryen. */
async function bind({ name, profile = 'web', optimize, binaryen: flags }, folder, run) {
  const how = [...BINDGEN_FLAGS, '--out-dir', folder, '--out-name', name];
  await must('wasm-bindgen', [compiledPath(name, profile), ...how], run);
  rmSync(join(folder, `${name}_bg.wasm.d.ts`));
  const bound = join(folder, `${name}_bg.wasm`);
  const wasm = join(folder, `${name}.wasm`);
  if (optimize) {
    const wasmOpt = join(root, 'node_modules', '.bin', 'wasm-opt');
    await must(wasmOpt, [bound, '-o', wasm, ...BINARYEN_FEATURES, ...optimize, ...flags], run);
    rmSync(bound);
  } else {
    renameSync(bound, wasm);
  }
}

if (isMain(import.meta.url)) {
  await main(async (names) => {
    for (const line of await buildWasm(names.length > 0 ? names : undefined)) console.log(line);
  });
}
