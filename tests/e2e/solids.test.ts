// Solids on the page: dropped, their features seen, filled with hexes, looked into, cancelled, exported.

import { mkdirSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { solidCases } from '../fixtures/cases.js';
import { Workbench } from './workbench.js';

const HOUSE = solidCases().find(({ name }) => name === 'a house')?.obj ?? '';
/** A slab with a needle that no cell of its mesh is as thin as. */
const NEEDLE = slabWithNeedle(0.02, 1);
/** Milliseconds within which the page is free again after a cancel. */
const PROMPT = 200;
/** The share of the view that lines take at least. */
const LINES = 0.002;
const PICTURES = new URL('../../target/e2e/', import.meta.url).pathname;

let bench: Workbench;
beforeAll(async () => {
  mkdirSync(PICTURES, { recursive: true });
  bench = await Workbench.open();
  await bench.page.locator('.threads').waitFor();
});
afterAll(() => bench?.close());

const found = async (what: string): Promise<number> => Number(await bench.page.locator(`[data-found=${what}]`).getAttribute('data-count'));
const seen = (name: string): Promise<Buffer> => bench.page.screenshot({ path: `${PICTURES}${name}.png` });

test('a dropped solid shows its features, and follows the angle', async () => {
  const { page } = bench;
  await bench.open('house.obj', HOUSE);
  const bare = await bench.picture();
  await bench.choice('Make', 'Hexes in it').check();
  await page.locator('[data-solid]').waitFor();
  expect([await found('surfaces'), await found('curves'), await found('corners')]).toEqual([7, 15, 10]);
  expect(await page.locator('.legend .chip').allInnerTexts()).toEqual(['Convex', 'Concave', 'Corner']);
  expect(await bench.difference(bare, await bench.picture())).toBeGreaterThan(LINES);
  const all = await bench.picture();
  await seen('features');
  // Of 70 degrees: the roof is smooth, and so are its eaves.
  await page.getByLabel('Feature angle').fill('65');
  await page.locator('[data-found=curves][data-count="12"]').waitFor();
  expect(await found('surfaces')).toBe(4);
  expect(await bench.difference(all, await bench.picture())).toBeGreaterThan(LINES);
  await page.getByLabel('Feature angle').fill('30');
});

test('a region that meets nothing of the solid says so', async () => {
  const { page } = bench;
  const region = page.locator('[data-region="0"]');
  await bench.fill('Edges about as long as, model units', '0.3');
  await page.getByRole('button', { name: 'Add sphere' }).click();
  await region.getByText('edges ≤').waitFor();
  await bench.fill('Centre x', '1000');
  await region.getByText('meets nothing').waitFor();
  await region.getByRole('button', { name: /^Delete/ }).click();
});

test('it is filled with hexes that show every feature', async () => {
  const { page } = bench;
  await bench.fill('Edges about as long as, model units', '0.3');
  const told = await bench.estimate();
  const before = await bench.picture();
  await bench.mesh();
  const hexes = await bench.figure('hexes');
  expect(told).toBeGreaterThan(hexes / 8);
  expect(told).toBeLessThan(8 * hexes);
  expect(await page.locator('[data-valid]').getAttribute('data-valid')).toBe('true');
  expect(await page.locator('[data-lost]').getAttribute('data-lost')).toBe('0');
  expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.02);
  const plain = await bench.picture();
  await bench.choice('Colour cells by', 'Distance').check();
  await page.locator('.histogram').waitFor();
  expect(await bench.difference(plain, await bench.picture())).toBeGreaterThan(0.1);
  expect(await page.locator('.legend').innerText()).toContain('Distance to the input');
  await bench.choice('Cut across', 'Y').check();
  await seen('distance');
  await bench.choice('Cut across', 'Off').check();
  await bench.choice('Colour cells by', 'Plain').check();
});

test('cancelling answers at once and keeps the earlier mesh', async () => {
  const { page } = bench;
  const hexes = await bench.figure('hexes');
  await bench.fill('Edges about as long as, model units', '0.02');
  await bench.estimate();
  await page.locator('#mesh').click();
  const took = await bench.cancel();
  expect(took).toBeLessThan(PROMPT);
  expect(await bench.figure('hexes')).toBe(hexes);
});

test('an exported file holds the same hexes', async () => {
  const hash = await bench.page.locator('.hash code').innerText();
  const download = await bench.export('VTU, ParaView');
  expect(download.suggestedFilename()).toBe('house.vtu');
  await bench.open('again.vtu', await readFile(await download.path()));
  await bench.page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
  expect(await bench.page.locator('.hash code').innerText()).toBe(hash);
});

test('hexes of the second order are exported with all their nodes', async () => {
  const { page } = bench;
  await bench.open('house.obj', HOUSE);
  await bench.choice('Make', 'Hexes in it').check();
  await bench.fill('Edges about as long as, model units', '0.5');
  await page.locator('summary', { hasText: 'Background, nodes and limits' }).click();
  await bench.choice('Nodes of a hex', '27').check();
  await bench.estimate();
  await bench.mesh();
  const hexes = await bench.figure('hexes');
  expect(await page.locator('[data-second-order]').getAttribute('data-second-order')).toBe('hex27');
  expect(await page.getByLabel('Export format').locator('option').allInnerTexts()).toEqual(['VTU, ParaView', 'VTK, legacy', 'MSH, Gmsh', 'INP, Abaqus']);
  await seen('second-order');
  const text = await readFile(await (await bench.export('INP, Abaqus')).path(), 'utf8');
  const elements = /\*ELEMENT, TYPE=C3D27[^\n]*\n([^*]*)/i.exec(text)?.[1] ?? '';
  expect(elements.split(/[\s,]+/).filter(Boolean)).toHaveLength(28 * hexes);
});

test('what the mesh does not show is listed and drawn', async () => {
  const { page } = bench;
  await bench.open('needle.obj', NEEDLE);
  await bench.choice('Make', 'Hexes in it').check();
  await bench.fill('Edges about as long as, model units', '0.8');
  await bench.estimate();
  await bench.mesh();
  expect(Number(await page.locator('[data-lost]').getAttribute('data-lost'))).toBeGreaterThan(0);
  const picture = await bench.picture();
  await seen('lost');
  await page.locator('.lost button').first().click();
  expect(await bench.difference(picture, await bench.picture())).toBeGreaterThan(0.1);
});

test('whether a mesh is as near as was asked for is told', async () => {
  const { page } = bench;
  const near = page.locator('[aria-labelledby=distance-title] [data-good]');
  expect(await near.count()).toBe(0);
  const further = page.locator('details', { hasText: 'Background, nodes and limits' });
  await further.evaluate((details) => details.setAttribute('open', ''));
  await page.getByLabel('Hold to a distance').check();
  await bench.fill('Levels to spare', '0');
  for (const [limit, isNear] of [['0.01', 'false'], ['3', 'true']] as const) {
    await bench.fill('From the surface, at most, model units', limit);
    await bench.estimate();
    await bench.mesh();
    expect(await near.getAttribute('data-good')).toBe(isNear);
    expect(await near.innerText()).toContain(`${limit} asked for`);
    if (isNear === 'true') continue;
    await near.scrollIntoViewIfNeeded();
    await seen('too-far');
    // What was lost before may have been at the same place.
    await page.getByRole('button', { name: 'See all' }).click();
    const picture = await bench.picture();
    await near.locator('button').click();
    expect(await bench.difference(picture, await bench.picture())).toBeGreaterThan(0.1);
  }
});

test('an open surface is refused with its place', async () => {
  await bench.open('open.obj', HOUSE.replace(/^f .*\n/m, ''));
  await bench.choice('Make', 'Hexes in it').check();
  await bench.page.locator('.estimate .fault', { hasText: /open: 5 edges/ }).waitFor();
});

test('nothing went wrong unseen', () => expect(bench.uncaught).toEqual([]));

/** A slab of 4 by 4 by 1 with a thin column in the middle of its top, as OBJ. */
function slabWithNeedle(width: number, height: number): string {
  const square = (r: number, z: number): number[][] => [[2 - r, 2 - r, z], [2 + r, 2 - r, z], [2 + r, 2 + r, z], [2 - r, 2 + r, z]];
  const points = [...square(2, 0), ...square(2, 1), ...square(width / 2, 1), ...square(width / 2, 1 + height)];
  const around = [0, 4, 8].flatMap((o) => [0, 1, 2, 3].map((k) => [k, (k + 1) % 4, ((k + 1) % 4) + 4, k + 4].map((node) => o + node + 1)));
  const faces = [[4, 3, 2, 1], [13, 14, 15, 16], ...around];
  return [...points.map((p) => `v ${p.join(' ')}`), ...faces.map((f) => `f ${f.join(' ')}`), ''].join('\n');
}
