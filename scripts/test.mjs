// Runs everything that can go wrong, step by step, and ends with one line: N passed, N failed. What is only checked or
// built comes first, in lanes beside each other; tests have the machine for themselves.
//
//     npm test                          all steps
//     npm test -- --only clippy,unit    some of them, with what they need
//     npm test -- --list                their names

import { mkdirSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';

import { setup } from './setup.mjs';
import { Failure, main, root } from './shell.mjs';
import { STEPS } from './steps.mjs';

const LOGS = join(root, 'target', 'test-logs');

/** Lines of a failed step's log that are shown. */
const SHOWN = 120;

await main(async (args) => {
  if (args.includes('--list')) {
    for (const { name } of STEPS) console.log(name);
    return;
  }
  const steps = chosen(args);
  await setup();
  mkdirSync(LOGS, { recursive: true });
  const total = { passed: 0, failed: 0 };
  const broken = new Set();
  const runLane = async (lane) => {
    for (const step of steps.filter((step) => step.lane === lane)) {
      const missing = step.needs?.find((name) => broken.has(name));
      const { passed, failed } = missing ? skipped(step, missing) : await runStep(step);
      total.passed += passed;
      total.failed += failed;
      if (failed > 0) broken.add(step.name);
    }
  };
  const lanes = new Set(steps.map(({ lane }) => lane));
  lanes.delete(undefined);
  await Promise.all([...lanes].map(runLane));
  await runLane(undefined);
  console.log(`${total.passed} passed, ${total.failed} failed`);
  if (total.failed > 0) process.exitCode = 1;
});

/** The steps that the arguments choose, with the steps that they need. */
function chosen(args) {
  const at = args.indexOf('--only');
  if (at < 0) return STEPS;
  const names = (args[at + 1] ?? '').split(',').filter(Boolean);
  const unknown = names.filter((name) => !STEPS.some((step) => step.name === name));
  if (names.length === 0 || unknown.length > 0) {
    throw new Failure(`--only takes steps out of ${STEPS.map((step) => step.name).join(', ')}`);
  }
  const wanted = new Set(names);
  for (const step of STEPS) if (wanted.has(step.name)) step.needs?.forEach((name) => wanted.add(name));
  return STEPS.filter((step) => wanted.has(step.name));
}

function skipped({ name }, missing) {
  console.log(`${name.padEnd(12)} not run, because ${missing} failed`);
  return { passed: 0, failed: 1 };
}

async function runStep({ name, run }) {
  const log = join(LOGS, `${name}.log`);
  rmSync(log, { force: true });
  const start = performance.now();
  const remarks = [];
  let trouble = null;
  let counts = { passed: 0, failed: 1 };
  console.log(`${name.padEnd(12)} starts`);
  try {
    counts = await run({ log, say: (line) => remarks.push(line) });
  } catch (error) {
    trouble = error instanceof Failure ? error.message : error.stack;
  }
  const seconds = ((performance.now() - start) / 1000).toFixed(1);
  const verdict = counts.failed > 0 ? 'FAILED' : 'ok';
  const counted = `${counts.passed} passed, ${counts.failed} failed`;
  console.log(`${name.padEnd(12)} ${verdict.padEnd(6)} ${seconds.padStart(7)} s   ${counted}`);
  for (const line of remarks) console.log(`    ${line}`);
  if (counts.failed > 0) explain(name, log, trouble);
  return counts;
}

function explain(name, log, trouble) {
  const text = readLog(log).trimEnd().split('\n').slice(-SHOWN);
  for (const line of text) console.log(`  | ${line}`);
  if (trouble) console.log(`  ${trouble}`);
  console.log(`  Run it alone: npm test -- --only ${name}`);
  console.log(`  Whole log:    target/test-logs/${name}.log`);
}

function readLog(log) {
  try {
    return readFileSync(log, 'utf8');
  } catch {
    return '';
  }
}
