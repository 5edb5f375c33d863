// Hexes on the page: dropped, made in a box around a surface, refined, looked into, cancelled, exported.

import { readFile } from 'node:fs/promises';
import { readFileSync } from 'node:fs';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { whole, Workbench } from './workbench.js';

const SOLID = readFileSync(new URL('../fixtures/gmsh_solid.vtk', import.meta.url));
/** Milliseconds within which the page is free again after a cancel. */
const PROMPT = 200;
/** The share of the view that a cap takes at least when a box is cut in its middle, and at most when nothing is cut. */
const CAP = { cut: 0.1, whole: 0.001 };

describe.each([{ isolated: true }, { isolated: false }])('isolated: $isolated', ({ isolated }) => {
  let bench: Workbench;
  beforeAll(async () => {
    bench = await Workbench.open({ isolated });
    await bench.page.locator('.threads').waitFor();
  });
  afterAll(() => bench?.close());

  /** What the mesher's threads have no part in is looked at once. */
  const look = test.runIf(isolated);
  const cap = async (): Promise<number> => bench.shareOf(await bench.picture(), 'cap');
  const offset = (): Promise<number | undefined> => bench.page.evaluate(() => window.hexmill.cutting.section.value?.offset);

  test('a dropped hex mesh is described, measured and drawn', async () => {
    const before = await bench.picture();
    await bench.open('solid.vtk', SOLID);
    await bench.page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
    const hexes = await bench.figure('hexes');
    expect(whole(await bench.fact('Hexes'))).toBe(hexes);
    expect(await bench.page.locator('[data-valid]').getAttribute('data-valid')).toBe('true');
    expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.03);
    expect(await cap()).toBeLessThan(CAP.whole);
  });

  test('dropped hexes are refined near a surface of another file, and near its points', async () => {
    const { page } = bench;
    const plain = await bench.figure('hexes');
    // A square across the middle of the mesh.
    const square = await page.evaluate(() => {
      const { min, max } = window.hexmill.workbench.bounds.value ?? { min: [0, 0, 0], max: [0, 0, 0] };
      const corners = [[min[0], min[1]], [max[0], min[1]], [max[0], max[1]], [min[0], max[1]]];
      return corners.map(([x, y]) => `v ${x} ${y} ${(min[2] + max[2]) / 2}`).join('\n');
    });
    const region = page.locator('[data-region="0"]');
    await page.locator('[data-section=regions] input[type=file]').setInputFiles({
      name: 'square.obj',
      mimeType: 'model/obj',
      buffer: Buffer.from(`${square}\nf 1 2 3 4\n`),
    });
    await region.getByText('square.obj').waitFor();
    await bench.fill('There, refine the input this many times', '1');
    const told = await bench.estimate();
    await bench.mesh();
    const near = await bench.figure('hexes');
    expect(near).toBe(told);
    expect(near).toBeGreaterThan(plain);
    expect(await page.locator('[data-valid]').getAttribute('data-valid')).toBe('true');
    // The corners of the square lie at the sides of the mesh, with little of it around them.
    await bench.choice('Refine near', 'Its points').check();
    await bench.fill('There, refine the input this many times', '2');
    expect(await bench.estimate()).not.toBe(near);
    await bench.fill('Up to this distance, 0: what it passes, model units', '1000');
    expect(await bench.estimate()).toBeGreaterThan(near);
    await region.getByRole('button', { name: 'Delete square.obj' }).click();
    await bench.mesh();
    expect(await bench.figure('hexes')).toBe(plain);
  });

  test('a file that is dropped on the regions is refined at, and one that holds hexes is refused there', async () => {
    const { page } = bench;
    const picker = page.locator('[data-section=regions] input[type=file]');
    await picker.setInputFiles({ name: 'again.vtk', mimeType: 'model/vtk', buffer: SOLID });
    await page.locator('[data-section=regions] .complaint').waitFor();
    expect(await page.locator('.file-name').innerText()).toContain('solid.vtk');
    const far = ['v 1e6 0 0', 'v 1000001 0 0', 'v 1e6 1 0', 'f 1 2 3', ''].join('\n');
    await bench.drop('far.obj', far, '[data-section=regions]');
    await page.locator('[data-region="0"]').getByText('meets nothing').waitFor();
    expect(await page.locator('.file-name').innerText()).toContain('solid.vtk');
    await page.getByRole('button', { name: 'Delete far.obj' }).click();
    expect(await page.locator('[data-section=regions] .complaint').count()).toBe(0);
  });

  test('a box of hexes around a surface is refined in a region by Method II', async () => {
    const { page } = bench;
    await page.evaluate(() => window.hexmill.openExample('spot'));
    await page.locator('.file-name', { hasText: 'spot.obj' }).waitFor();
    await bench.choice('Make', 'Hexes around it').check();
    await bench.fill('Grid spacing', '0.4');
    await bench.fill('Margin', '0.2');
    await page.getByLabel('At the surface, refine').fill('0');
    await bench.choice('Method', 'II').check();
    await page.getByRole('button', { name: 'Add sphere' }).click();
    await bench.choice('Region sized by', 'Level').check();
    await bench.fill('Inside, refine the input this many times', '2');
    await bench.fill('Radius', '0.3');
    const told = await bench.estimate();
    const before = await bench.picture();
    await bench.mesh();
    const hexes = await bench.figure('hexes');
    // What was told before is what was made.
    expect(hexes).toBe(told);
    expect(await page.locator('[data-valid]').getAttribute('data-valid')).toBe('true');
    expect(await page.locator('.levels li > span:first-child').allInnerTexts()).toEqual(['1', '2']);
    expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.1);
  });

  look('the box is cut open between whole cells, and the cap has its own tone', async () => {
    const { page } = bench;
    expect(await cap()).toBeGreaterThan(CAP.cut);
    await bench.choice('Cut across', 'Off').check();
    expect(await cap()).toBeLessThan(CAP.whole);
    await bench.choice('Cut across', 'X').check();
    await page.getByRole('button', { name: 'Look along X' }).click();
    const middle = await bench.picture();
    await page.getByLabel('Depth of the cut').fill('320');
    expect(await bench.difference(middle, await bench.picture())).toBeGreaterThan(0.01);
    await page.getByRole('button', { name: 'Show the other side' }).click();
    expect(await cap()).toBeLessThan(CAP.whole);
    await page.getByRole('button', { name: 'Show the other side' }).click();
  });

  look('the plane is dragged by its handle', async () => {
    await bench.page.getByRole('button', { name: 'Look from a corner' }).click();
    await bench.settle();
    const [before, picture, handle] = [await offset(), await bench.picture(), await bench.handle('section')];
    await bench.dragMouse(handle, { x: 50, y: -40 });
    expect(await offset()).not.toBe(before);
    expect(await bench.difference(picture, await bench.picture())).toBeGreaterThan(0.01);
  });

  look('the plane turns to face the view', async () => {
    const { page } = bench;
    await page.getByRole('button', { name: 'Look along Z' }).click();
    await page.getByRole('button', { name: 'Look from a corner' }).click();
    await bench.settle();
    const before = await bench.picture();
    await page.getByRole('button', { name: 'Cut facing the view' }).click();
    const normal = await page.evaluate(() => window.hexmill.cutting.section.value?.normal);
    // From a corner the view goes along no axis, and neither does the plane's normal.
    expect(normal?.filter((along) => Math.abs(along) > 0.2)).toHaveLength(3);
    expect(await bench.choice('Cut across', 'Free').isChecked()).toBe(true);
    expect(await cap()).toBeGreaterThan(CAP.cut);
    expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.05);
  });

  look('colours show the quality and the levels of hexes', async () => {
    const plain = await bench.picture();
    await bench.choice('Colour cells by', 'Quality').check();
    const quality = await bench.picture();
    expect(await bench.difference(plain, quality)).toBeGreaterThan(0.05);
    await bench.choice('Colour cells by', 'Level').check();
    const levels = await bench.picture();
    expect(await bench.difference(plain, levels)).toBeGreaterThan(0.05);
    expect(await bench.difference(quality, levels)).toBeGreaterThan(0.05);
    await bench.choice('Colour cells by', 'Plain').check();
    expect(await bench.difference(plain, await bench.picture())).toBeLessThan(0.001);
  });

  look('peeling and a bound on quality show what lies inside', async () => {
    await bench.choice('Cut across', 'Off').check();
    await bench.page.getByLabel('Layers peeled off').fill('1');
    expect(await cap()).toBeGreaterThan(CAP.cut);
    await bench.page.getByLabel('Layers peeled off').fill('0');
    const all = await bench.picture();
    await bench.page.getByLabel('Cells shown by scaled jacobian').fill('300');
    expect(await bench.difference(all, await bench.picture())).toBeGreaterThan(0.1);
    await bench.page.getByRole('button', { name: 'Show all' }).click();
    expect(await bench.difference(all, await bench.picture())).toBeLessThan(0.001);
  });

  look('the worst cell is found, cut free and framed', async () => {
    const { page } = bench;
    await page.getByRole('button', { name: 'Next of the worst cells' }).click();
    const worst = Number(await page.locator('[data-cell] dd').first().innerText());
    expect(worst).toBeCloseTo(Number(await page.locator('.stats dd').first().innerText()), 3);
    expect(await page.evaluate(() => window.hexmill.cutting.section.value)).not.toBeNull();
    const mark = await bench.shareOf(await bench.picture(), 'mark');
    expect(mark).toBeGreaterThan(0.001);
    await page.getByRole('button', { name: 'See all (F)' }).click();
    expect(await bench.shareOf(await bench.picture(), 'mark')).toBeLessThan(mark);
  });

  test('cancelling answers at once and keeps the earlier mesh', async () => {
    const { page } = bench;
    const hexes = await bench.figure('hexes');
    await page.getByLabel('At the surface, refine').fill('4');
    await page.locator('#mesh').click();
    const took = await bench.cancel();
    expect(took).toBeLessThan(PROMPT);
    expect(await bench.figure('hexes')).toBe(hexes);
    await page.getByLabel('At the surface, refine').fill('0');
    await bench.mesh();
    expect(await bench.figure('hexes')).toBe(hexes);
  });

  test('an exported file holds the same hexes', async () => {
    const [hexes, nodes, hash] = [await bench.figure('hexes'), await bench.figure('nodes'), await bench.page.locator('.hash code').innerText()];
    expect(await bench.page.getByLabel('Export format').locator('option').allInnerTexts()).not.toContain('OBJ, Wavefront');
    const download = await bench.export('VTU, ParaView');
    expect(download.suggestedFilename()).toBe('spot.vtu');
    await bench.open('again.vtu', await readFile(await download.path()));
    await bench.page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
    expect(whole(await bench.fact('Hexes'))).toBe(hexes);
    expect(whole(await bench.fact('Nodes'))).toBe(nodes);
    expect(await bench.page.locator('.hash code').innerText()).toBe(hash);
  });

  test('nothing went wrong unseen', () => expect(bench.uncaught).toEqual([]));
});

test('a link makes the same hexes again and cuts them so', async () => {
  const link = '#example=rook&job=hexes&spacing=0.4&margin=0.2&at-surface=1&method=one&section=0,-1,0,1.6&peel=1&colour=level';
  const bench = await Workbench.open({ link });
  await bench.page.getByRole('toolbar', { name: 'View' }).waitFor();
  await bench.mesh();
  expect(new URL(bench.page.url()).hash).toBe(link);
  expect(await bench.page.locator('.hash code').innerText()).toMatch(/^[0-9a-f]{32}$/);
  expect(await bench.choice('Cut across', 'Y').isChecked()).toBe(true);
  expect(await bench.page.getByLabel('Layers peeled off').inputValue()).toBe('1');
  expect(await bench.page.locator('.legend').count()).toBe(1);
  await bench.close();
});
