// The steps of `npm test`, in order. Each does its work and resolves to the counts of its tests.

import { existsSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';

import { findChromedriver } from './browser.mjs';
import { build } from './build.mjs';
import { Failure, execute, must, root, which } from './shell.mjs';

const WASM = ['--target', 'wasm32-unknown-unknown', '--no-default-features'];
const DENY = ['--', '-D', 'warnings'];

/**
 * A step: its name, its lane if it has one, the steps whose products it needs, and `run({ log, say })`, which logs to the
 * file `log`, resolves to `{ passed, failed }`, and may throw a `Failure`. Steps in lanes test nothing, keep one core busy for
 * most of their time, and need none of another lane: lanes run beside each other, before all else.
 */
export const STEPS = [
  { name: 'fmt', lane: 'check', run: one((options) => must('cargo', ['fmt', '--check'], options)) },
  {
    name: 'clippy',
    lane: 'check',
    run: one((options) => must('cargo', ['clippy', '--all-targets', ...DENY], options)),
  },
  { name: 'clippy-wasm', lane: 'check', run: one(clippyWasm) },
  { name: 'doc', lane: 'check', run: one(documentation) },
  { name: 'build', lane: 'build', run: one(published) },
  { name: 'types', needs: ['build'], run: one(types) },
  { name: 'native', run: native },
  { name: 'doctest', run: (context) => counted('cargo', ['test', '--doc'], context) },
  { name: 'wasm', run: wasm },
  { name: 'unit', needs: ['build'], run: (context) => vitest('unit', context) },
  { name: 'package', needs: ['build'], run: (context) => vitest('package', context) },
  { name: 'e2e', needs: ['build'], run: (context) => vitest('e2e', context) },
];

/** A step without tests of its own counts as one. */
function one(work) {
  return async (context) => {
    await work({ log: context.log }, context);
    return { passed: 1, failed: 0 };
  };
}

async function clippyWasm(options) {
  // Each module's own features, one by one, are those of the build, which takes no warnings either.
  for (const features of ['quads,hexes,solids', 'quads,hexes,solids,threads', 'viewer']) {
    await must('cargo', ['clippy', '--lib', ...WASM, '--features', features, ...DENY], options);
  }
  await must('cargo', ['clippy', '--test', 'wasm', ...WASM, ...DENY], options);
  // What `wasm-pack test` builds.
  const all = ['--bins', '--examples', '--tests'];
  await must('cargo', ['clippy', ...all, '--target', 'wasm32-unknown-unknown', ...DENY], options);
}

async function documentation(options) {
  const strict = { ...options, env: { RUSTDOCFLAGS: '-D warnings' } };
  await must('cargo', ['doc', '--no-deps', '--lib'], strict);
  await must('cargo', ['doc', '--no-deps', '--lib', ...WASM, '--features', 'quads,hexes,solids,threads,viewer'], strict);
}

/** Unit and integration tests, by nextest where it is installed. */
function native(context) {
  const runner = which('cargo-nextest') ? ['nextest', 'run', '--no-fail-fast'] : ['test', '--no-fail-fast'];
  return counted('cargo', [...runner, '--lib', '--bins', '--tests'], context);
}

/** The core in headless Chromium. */
function wasm(context) {
  const env = { CHROMEDRIVER: findChromedriver(), WASM_BINDGEN_TEST_TIMEOUT: '300' };
  return counted('cargo', ['test', '--test', 'wasm', ...WASM], context, env);
}

async function published(options, { say }) {
  for (const line of await build(options)) say(line);
  // That the threads' target features are no stable ones is a warning too, and of no line.
  const warning = readFileSync(options.log, 'utf8').match(/^warning: .*\n *--> src\/.*$/m);
  if (warning) throw new Failure(`A module was built with warnings: ${warning[0]}`);
}

async function types(options) {
  for (const project of ['tsconfig.json', 'tsconfig.node.json']) {
    await must('node', ['node_modules/typescript/bin/tsc', '--noEmit', '-p', project], options);
  }
}

async function vitest(project, { log }) {
  const report = join(root, 'target', 'test-logs', `${project}.json`);
  rmSync(report, { force: true });
  const reporters = ['--reporter=verbose', '--reporter=json', `--outputFile.json=${report}`];
  const args = ['node_modules/vitest/vitest.mjs', 'run', '--project', project, '--passWithNoTests', ...reporters];
  const { code } = await execute('node', args, { log });
  if (!existsSync(report)) {
    if (code === 0) return { passed: 0, failed: 0 };
    throw new Failure('vitest failed before it could run a test');
  }
  const { numPassedTests, numFailedTests, success } = JSON.parse(readFileSync(report, 'utf8'));
  return settle(numPassedTests, numFailedTests, code === 0 && success);
}

/** Runs tests and adds up the counts in what they print. */
async function counted(program, args, { log }, env = {}) {
  const { code, text } = await execute(program, args, { log, env });
  let passed = 0;
  let failed = 0;
  for (const [, yes, no] of text.matchAll(/test result: \w+\. (\d+) passed; (\d+) failed/g)) {
    passed += Number(yes);
    failed += Number(no);
  }
  for (const [, summary] of text.matchAll(/Summary \[.*?\] (.*)/g)) {
    passed += Number(summary.match(/(\d+) passed/)?.[1] ?? 0);
    for (const [, no] of summary.matchAll(/(\d+) (?:failed|timed out)/g)) failed += Number(no);
  }
  return settle(passed, failed, code === 0);
}

/** A run that went wrong without a failed test counts as one failure. */
function settle(passed, failed, well) {
  return { passed, failed: well || failed > 0 ? failed : 1 };
}
