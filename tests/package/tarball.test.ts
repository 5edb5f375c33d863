// The packed tarball, used from Node, Vite and webpack, and looked over by the usual checkers.

import { cpSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { gzipSync } from 'node:zlib';

import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { launchBrowser } from '../../scripts/browser.mjs';
import { serveFolder } from '../../scripts/static-server.mjs';
import { cases, hexCases, solidCases } from '../fixtures/cases.js';
import { CASES, installPacked, node, tool } from './project.js';
import type { Project } from './project.js';

/**
 * The most that each module may weigh when compressed, in bytes. Those of hexes and solids are fetched when they are first asked for.
 * That of surfaces is compiled for speed all through: the last tenth of its rate costs a tenth of its size. Those of hexes and of
 * solids hold kernels that look at four hexes side by side, in twice the code and half the time; that of
 * solids also what brings a boundary near to its solid, what shows walls thinner than hexes are long,
 * and the layers of shells.
 */
const BUDGETS = {
  mesher: 490_000,
  'mesher-threads': 505_000,
  hexes: 585_000,
  'hexes-threads': 595_000,
  solids: 990_000,
  'solids-threads': 1_000_000,
};

/** A cancelled call has to leave the processor to the next within this time, in milliseconds. */
const PROMPT = 200;

interface Outcome {
  threads: number;
  hashes: Record<string, string>;
  cancellations: { error: string; after: number; nextAfter: number; cells: number; toldAfter: number; stages: string[] }[];
  faces: number;
  refused: { name: string; line: number };
  ended: string;
}

const expected = { quads: cases(), hexes: hexCases(), solids: solidCases() };

function expectGood(outcome: Outcome, threads: number) {
  expect(outcome).toMatchObject({
    threads,
    hashes: Object.fromEntries([...expected.quads, ...expected.hexes, ...expected.solids].map(({ name, hash }) => [name, hash])),
    faces: 4,
    refused: { name: 'InputError', line: 2 },
    ended: 'terminated',
  });
  for (const { error, after, cells, toldAfter, stages } of outcome.cancellations) {
    expect(error).toBe('AbortError');
    expect(after).toBeLessThan(PROMPT);
    expect(toldAfter).toBe(0);
    expect(stages.length).toBeGreaterThan(0);
    expect([40, 27]).toContain(cells);
  }
  // Of quads, of hexes, then of a solid. Other programs may hold up the machine: the best counts.
  expect(outcome.cancellations).toHaveLength(9);
  for (const first of [0, 3, 6]) {
    const attempts = outcome.cancellations.slice(first, first + 3);
    const delays = attempts.map(({ nextAfter }) => nextAfter);
    expect(Math.min(...delays), `milliseconds from abort to the next answer: ${delays}`).toBeLessThan(PROMPT);
  }
}

let project: Project;
let browser: Browser;

beforeAll(async () => {
  project = await installPacked('tarball');
  browser = await launchBrowser();
});
afterAll(() => browser?.close());

/** Opens a page that offers the scenario, runs it there, and fails on any error that the page reports. */
async function runInPage(url: string, options: object): Promise<Outcome> {
  const page = await browser.newPage();
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('response', (response) => {
    if (response.status() >= 400) errors.push(`${response.status()} ${response.url()}`);
  });
  try {
    await page.goto(url);
    await page.waitForFunction(() => 'scenario' in globalThis, undefined, { timeout: 10_000 });
    const outcome = await page.evaluate(
      ([given, chosen]) => (globalThis as unknown as PageScope).scenario(given, chosen),
      [expected, options] as const,
    );
    return outcome;
  } finally {
    await page.close();
    expect(errors).toEqual([]);
  }
}

interface PageScope {
  scenario(cases: unknown, options: unknown): Promise<Outcome>;
}

describe('in Node', () => {
  it.each([1, 2])('works on %i threads', async (threads) => {
    const printed = await node(['node/main.mjs', CASES, String(threads)], project.folder);
    expectGood(JSON.parse(printed), threads);
  });

  it('does not keep a program from ending', async () => {
    expect(await node(['node/idle.mjs'], project.folder)).toBe('16\n');
  });
});

describe.each([
  { bundler: 'Vite', folder: 'vite', script: 'vite/bin/vite.js', args: ['build'] },
  { bundler: 'webpack', folder: 'webpack', script: '', args: [] },
])('built by $bundler', ({ folder, script, args }) => {
  beforeAll(async () => {
    const cwd = join(project.folder, folder);
    if (script) await tool(script, args, cwd);
    else await buildWithWebpack(cwd);
  });

  it.each([
    { where: 'a cross-origin isolated page', isolated: true, options: { threads: 2 }, threads: 2 },
    { where: 'any other page', isolated: false, options: {}, threads: 1 },
    { where: 'an isolated page that wants one thread', isolated: true, options: { threads: 1 }, threads: 1 },
  ])('works in $where', async ({ isolated, options, threads }) => {
    const server = await serveFolder(join(project.folder, folder, 'dist'), { isolated });
    try {
      expectGood(await runInPage(server.url, options), threads);
    } finally {
      await server.close();
    }
  });
});

it("works in Vite's development server", async () => {
  const { createServer } = await import('vite');
  const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
  const server = await createServer({
    root: join(project.folder, 'vite'),
    logLevel: 'error',
    server: { headers, port: 0, fs: { allow: [project.folder] } },
  });
  await server.listen();
  try {
    const [url = ''] = server.resolvedUrls?.local ?? [];
    expectGood(await runInPage(url, { threads: 2 }), 2);
  } finally {
    await server.close();
  }
});

describe('the tarball', () => {
  it('pleases publint', async () => {
    const { publint } = await import('publint');
    const { messages } = await publint({ pkgDir: join(project.folder, 'node_modules', 'hexmill'), strict: true });
    expect(messages).toEqual([]);
  });

  it('has types that resolve', async () => {
    // Modules and workers are addresses; they have no types to resolve.
    const addresses = [...Object.keys(BUDGETS).map((name) => `${name}.wasm`), 'package.json'];
    const args = [project.tarball, '--profile', 'esm-only', '--exclude-entrypoints', ...addresses];
    await tool('@arethetypeswrong/cli/dist/index.js', args, project.folder);
  });

  it('holds what is exported and stays within its budget', () => {
    const installed = join(project.folder, 'node_modules', 'hexmill');
    for (const [name, budget] of Object.entries(BUDGETS)) {
      const module = readFileSync(join(installed, 'dist', 'wasm', name, `${name}.wasm`));
      expect(gzipSync(module, { level: 9 }).length, name).toBeLessThan(budget);
    }
    const { dependencies, exports } = JSON.parse(readFileSync(join(installed, 'package.json'), 'utf8'));
    expect(dependencies).toBeUndefined();
    const files = Object.values<string | Record<string, string>>(exports).flatMap((entry) => Object.values(entry));
    for (const file of files.filter((path) => path.startsWith('./'))) {
      expect(statSync(join(installed, file)).isFile()).toBe(true);
    }
  });
});

async function buildWithWebpack(folder: string): Promise<void> {
  const { default: webpack } = await import('webpack');
  const { default: config } = await import(/* @vite-ignore */ join(folder, 'webpack.config.mjs'));
  const places = { context: folder, output: { path: join(folder, 'dist') } };
  const stats = await new Promise<import('webpack').Stats | undefined>((resolve, reject) => {
    webpack({ ...config, ...places }, (error, result) => (error ? reject(error) : resolve(result)));
  });
  expect(stats?.toJson({ all: false, errors: true, warnings: true })).toMatchObject({ errors: [], warnings: [] });
  cpSync(join(folder, 'index.html'), join(folder, 'dist', 'index.html'));
}
