// Running programs: the few helpers that the other scripts share.

import { spawn, spawnSync } from 'node:child_process';
import { accessSync, constants, createWriteStream, mkdirSync } from 'node:fs';
import { delimiter, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

/** The repository. */
export const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');

/** A plain message for a person; scripts print it without a stack. */
export class Failure extends Error {}

/** The path of a program on PATH or in one of `places`, or null. */
export function which(program, places = []) {
  const folders = (process.env.PATH ?? '').split(delimiter).filter(Boolean);
  for (const path of [...folders.map((folder) => join(folder, program)), ...places]) {
    try {
      accessSync(path, constants.X_OK);
      return path;
    } catch {
      // Not here.
    }
  }
  return null;
}

/** What a program prints on standard output, trimmed; null if it is missing or fails. */
export function output(program, args, options = {}) {
  const done = spawnSync(program, args, { cwd: root, encoding: 'utf8', ...options });
  return done.status === 0 ? done.stdout.trim() : null;
}

/**
 * Runs a program to its end.
 *
 * With `log` (a file) its output goes there, else to this terminal. Resolves to
 * `{ code, text }`, `text` being what was logged; throws a `Failure` if the program cannot start.
 */
export function execute(program, args, { env = {}, cwd = root, log = null } = {}) {
  return new Promise((resolveRun, reject) => {
    const child = spawn(program, args, {
      cwd,
      env: { ...process.env, ...env },
      stdio: log ? ['ignore', 'pipe', 'pipe'] : ['ignore', 'inherit', 'inherit'],
    });
    const chunks = [];
    if (log) {
      mkdirSync(dirname(log), { recursive: true });
      const file = createWriteStream(log, { flags: 'a' });
      for (const stream of [child.stdout, child.stderr]) {
        stream.on('data', (chunk) => {
          chunks.push(chunk);
          file.write(chunk);
        });
      }
      child.on('close', () => file.end());
    }
    child.on('error', (error) => reject(new Failure(`${program} could not be started: ${error.message}`)));
    child.on('close', (code, signal) => {
      resolveRun({ code: code ?? (signal ? 1 : 0), text: Buffer.concat(chunks).toString('utf8') });
    });
  });
}

/** Runs a program to its end and throws a `Failure` if it fails. */
export async function must(program, args, options = {}) {
  const { code, text } = await execute(program, args, options);
  if (code !== 0) {
    throw new Failure(`failed (exit code ${code}): ${program} ${args.join(' ')}`);
  }
  return text;
}

/** True if `moduleUrl` is the script that node was started with. */
export function isMain(moduleUrl) {
  return process.argv[1] !== undefined && resolve(process.argv[1]) === fileURLToPath(moduleUrl);
}

/** Runs a script's main function: a `Failure` is printed plainly, all else with its stack. */
export async function main(run) {
  try {
    await run(process.argv.slice(2));
  } catch (error) {
    console.error(error instanceof Failure ? `\n${error.message}` : error);
    process.exitCode = 1;
  }
}
