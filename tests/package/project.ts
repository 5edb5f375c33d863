// A scratch project that uses the packed package as its users do.

import { execFile } from 'node:child_process';
import { cpSync, mkdirSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';

import { cases, hexCases, solidCases } from '../fixtures/cases.js';

const run = promisify(execFile);

/** The repository. */
export const ROOT = fileURLToPath(new URL('../..', import.meta.url));

/** The file with the cases that every surrounding has to reproduce, in a scratch project. */
export const CASES = 'cases.json';

/** The scratch project's folder, and the tarball that is installed in it. */
export interface Project {
  folder: string;
  tarball: string;
}

/** Packs the package and installs it, with the fixtures, into a folder of its own. */
export async function installPacked(name: string): Promise<Project> {
  const folder = join(ROOT, 'target', 'package-test', name);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  await run('npm', ['pack', '--pack-destination', folder], { cwd: ROOT });
  const packed = readdirSync(folder).find((file) => file.endsWith('.tgz'));
  if (!packed) throw new Error('npm pack made no tarball');
  cpSync(join(ROOT, 'tests', 'package', 'fixtures'), folder, { recursive: true });
  writeFileSync(join(folder, 'package.json'), '{ "name": "scratch", "private": true, "type": "module" }\n');
  writeFileSync(join(folder, CASES), JSON.stringify({ quads: cases(), hexes: hexCases(), solids: solidCases() }));
  // The package has no dependencies: there is nothing to download.
  await run('npm', ['install', '--offline', '--no-audit', '--no-fund', `./${packed}`], { cwd: folder });
  return { folder, tarball: join(folder, packed) };
}

/** Runs a tool of the repository's node_modules; returns what it prints. */
export async function tool(script: string, args: string[], cwd: string): Promise<string> {
  const { stdout } = await run('node', [join(ROOT, 'node_modules', script), ...args], { cwd });
  return stdout;
}

/** Runs a program of the scratch project in Node; returns what it prints. */
export async function node(args: string[], cwd: string): Promise<string> {
  const { stdout } = await run('node', args, { cwd, timeout: 60_000 });
  return stdout;
}
