// One way through the page: drop, size, region, mesh, look, export.

import { readFile } from 'node:fs/promises';
import type { Download } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { model, whole, Workbench } from './workbench.js';

const EDGE_LENGTH = 'No edge longer than, model units';
/** Meshes of fewer quads are counted, not estimated. */
const COUNTED = 60_000;
/** How far an estimate of others may be off: it follows a sample, and leaves out what balance and templates add. */
const ESTIMATE_ERROR = 0.15;

describe.each([
  { name: 'a cross-origin isolated page', isolated: true },
  { name: 'a page that is not isolated', isolated: false },
])('on $name', ({ isolated }) => {
  let bench: Workbench;
  beforeAll(async () => {
    bench = await Workbench.open({ isolated });
  });
  afterAll(() => bench?.close());

  test('the mesher takes the threads it may', async () => {
    await bench.page.locator('.threads').waitFor();
    expect(await bench.page.evaluate(() => crossOriginIsolated)).toBe(isolated);
    const threads = await bench.page.evaluate(() => window.hexmill.workbench.threads.value);
    const cores = await bench.page.evaluate(() => navigator.hardwareConcurrency);
    if (isolated && cores > 1) expect(threads).toBeGreaterThan(1);
    else expect(threads).toBe(1);
  });

  test('a dropped file is read, described and drawn', async () => {
    const before = await bench.picture();
    await bench.open('pawn.obj', model('pawn.obj'));
    expect(await bench.fact('Faces')).toMatch(/588\s*all quads/);
    expect(await bench.fact('Nodes')).toBe('601');
    expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.03);
  });

  test('the estimate foretells the cells of each edge length', async () => {
    const estimates: number[] = [];
    for (const length of ['0.04', '0.01', '0.003']) {
      await bench.fill(EDGE_LENGTH, length);
      const estimate = await bench.estimate();
      await bench.mesh();
      const quads = await bench.figure('quads');
      const isExact = await bench.page.evaluate(() => window.hexmill.workbench.estimate.value?.exact);
      expect(isExact).toBe(quads < COUNTED);
      const error = Math.abs(estimate / quads - 1);
      expect(error, `${estimate} estimated, ${quads} made at ${length}`).toBeLessThanOrEqual(isExact ? 0 : ESTIMATE_ERROR);
      estimates.push(estimate);
    }
    const [coarse = 0, middle = 0, fine = 0] = estimates;
    // Edges four times shorter, and 3.3 times: up to 16 times the cells, in steps of 4 from face to face.
    expect(middle / coarse).toBeGreaterThan(4);
    expect(middle / coarse).toBeLessThan(16.1);
    expect(fine / middle).toBeGreaterThan(4);
    expect(fine / middle).toBeLessThan(16.1);
    await bench.fill(EDGE_LENGTH, '0.02');
  });

  test('a region is added and dragged by its handle', async () => {
    const before = await bench.picture();
    await bench.page.getByRole('button', { name: 'Add sphere' }).click();
    const placed = await bench.picture();
    expect(await bench.difference(before, placed)).toBeGreaterThan(0.005);

    const numbers = (): Promise<string> => bench.page.evaluate(() => JSON.stringify(window.hexmill.workbench.settings.value.regions[0]?.shape));
    const [shape, handle] = [await numbers(), await bench.handle()];
    await bench.dragMouse(handle, { x: 60, y: -40 });
    expect(await numbers()).not.toBe(shape);
    expect(await bench.difference(placed, await bench.picture())).toBeGreaterThan(0.002);
    const moved = await bench.handle(handle.name);
    expect(Math.hypot(moved.x - handle.x, moved.y - handle.y)).toBeGreaterThan(5);
  });

  test('dragging is one step to undo', async () => {
    const numbers = (): Promise<string> => bench.page.evaluate(() => JSON.stringify(window.hexmill.workbench.settings.value.regions[0]?.shape));
    const dragged = await numbers();
    await bench.page.keyboard.press('Control+z');
    expect(await numbers()).not.toBe(dragged);
    await bench.page.keyboard.press('Control+Shift+z');
    expect(await numbers()).toBe(dragged);
  });

  test('the mesh is made, checked and drawn', async () => {
    await bench.fill('Radius', '0.1');
    await bench.fill('Inside, no edge longer than, model units', '0.005');
    const before = await bench.picture();
    await bench.mesh();
    expect(await bench.figure('quads')).toBeGreaterThan(4 * 588);
    expect(await bench.page.locator('[data-valid]').getAttribute('data-valid')).toBe('true');
    expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.01);
  });

  test('the region is finer by what it asks for, and the rest is not', async () => {
    const region = await bench.page.evaluate(() => {
      const [first] = window.hexmill.workbench.settings.value.regions;
      if (first?.shape.kind !== 'sphere' || first.target.by !== 'size') throw new Error('no sphere with a size');
      return { center: first.shape.center, radius: first.shape.radius, size: first.target.size };
    });
    const withRegion = await bench.cellsOf(region);
    expect(withRegion.inside.cells).toBeGreaterThan(0);
    expect(withRegion.inside.longest).toBeLessThanOrEqual(region.size);
    await bench.page.getByRole('button', { name: 'Delete Sphere 1' }).click();
    await bench.mesh();
    const without = await bench.cellsOf(region);
    // Cells up to 0.02 long are split in four twice to become shorter than 0.005.
    expect(without.inside.longest).toBeGreaterThan(2 * region.size);
    expect(withRegion.inside.cells).toBeGreaterThan(4 * without.inside.cells);
    expect(without.farAway.cells).toBeGreaterThan(100);
    expect(withRegion.farAway.cells).toBe(without.farAway.cells);
    expect(withRegion.farAway.longest).toBe(without.farAway.longest);
    await bench.page.keyboard.press('Control+z');
    await bench.mesh();
    expect(await bench.cellsOf(region)).toEqual(withRegion);
  });

  test('what is being written stays while other things change', async () => {
    const { page } = bench;
    await page.getByRole('button', { name: 'Add sphere' }).click();
    const field = page.getByLabel('Centre x', { exact: true });
    await field.fill('0.0625');
    // An estimate is made anew and arrives, and the region is drawn again for it.
    const before = await page.evaluate(() => window.hexmill.workbench.settings.value.gradation);
    await page.evaluate(() => window.hexmill.workbench.edit({ gradation: 1.5 }));
    await bench.estimate();
    await bench.settle();
    expect(await field.inputValue()).toBe('0.0625');
    await field.press('Tab');
    const centre = await page.evaluate(() => {
      const shape = window.hexmill.workbench.settings.value.regions[1]?.shape;
      return shape?.kind === 'sphere' ? shape.center[0] : undefined;
    });
    expect(centre).toBe(0.0625);
    // What is undone is written there again, whatever has the focus.
    await field.focus();
    await page.evaluate(() => window.hexmill.workbench.undo());
    expect(Number(await field.inputValue())).not.toBe(0.0625);
    await page.locator('[data-region="1"]').getByRole('button', { name: /^Delete/ }).click();
    await page.evaluate((gradation) => window.hexmill.workbench.edit({ gradation }), before);
    await bench.mesh();
  });

  test('a region that meets nothing says so', async () => {
    const region = bench.page.locator('[data-region="1"]');
    await bench.page.getByRole('button', { name: 'Add sphere' }).click();
    await region.getByText('edges ≤').waitFor();
    await bench.fill('Centre x', '1000');
    await region.getByText('meets nothing').waitFor();
    await region.getByRole('button', { name: /^Delete/ }).click();
    await bench.mesh();
  });

  test('colours show quality and levels', async () => {
    const plain = await bench.picture();
    await bench.choice('Colour cells by', 'Quality').check();
    const quality = await bench.picture();
    expect(await bench.difference(plain, quality)).toBeGreaterThan(0.02);
    await bench.choice('Colour cells by', 'Level').check();
    expect(await bench.difference(quality, await bench.picture())).toBeGreaterThan(0.02);
    const levels = await bench.page.evaluate(() => {
      const mesh = window.hexmill.workbench.result.value?.mesh;
      return [...new Set(mesh && 'level' in mesh ? mesh.level : [])].sort().map(String);
    });
    expect(levels.length).toBeGreaterThan(1);
    expect(await bench.page.locator('.legend .chip').allInnerTexts()).toEqual(levels);
    expect(await bench.page.locator('.levels li > span:first-child').allInnerTexts()).toEqual(levels);
  });

  test('a brushed range of the histogram is what stays coloured', async () => {
    await bench.choice('Colour cells by', 'Quality').check();
    const all = await bench.picture();
    const bars = await bench.page.locator('.histogram svg').boundingBox();
    if (!bars) throw new Error('no histogram');
    await bench.dragMouse({ x: bars.x + 2, y: bars.y + 30 }, { x: bars.width / 2, y: 0 });
    const shown = whole(await bench.page.locator('.hint', { hasText: 'cells from' }).innerText());
    expect(shown).toBeGreaterThan(0);
    expect(shown).toBeLessThan(await bench.figure('quads'));
    expect(await bench.difference(all, await bench.picture())).toBeGreaterThan(0.01);
    await bench.page.getByRole('button', { name: 'Show all' }).click();
    expect(await bench.difference(all, await bench.picture())).toBeLessThan(0.001);
  });

  test('the worst cell is flown to', async () => {
    const all = await bench.picture();
    await bench.page.getByRole('button', { name: 'Next of the worst cells' }).click();
    const cell = bench.page.locator('[data-cell]');
    const worst = Number(await cell.locator('dd').first().innerText());
    expect(worst).toBeCloseTo(Number(await bench.page.locator('.stats dd').first().innerText()), 3);
    expect(await bench.difference(all, await bench.picture())).toBeGreaterThan(0.05);
  });

  test('exported files hold the same mesh', async () => {
    const [quads, nodes] = [await bench.figure('quads'), await bench.figure('nodes')];
    const obj = await text(await bench.export('OBJ, Wavefront'));
    expect(obj.match(/^v /gm)).toHaveLength(nodes);
    expect(obj.match(/^f( \S+){4}$/gm)).toHaveLength(quads);

    const vtu = await bench.export('VTU, ParaView');
    expect(vtu.suggestedFilename()).toBe('pawn.vtu');
    const xml = await bytes(vtu);
    const head = new TextDecoder('latin1').decode(xml);
    expect(head).toContain(`NumberOfPoints="${nodes}"`);
    expect(head).toContain(`NumberOfCells="${quads}"`);
    await bench.open('again.vtu', xml);
    expect(whole(await bench.fact('Faces'))).toBe(quads);
    expect(whole(await bench.fact('Nodes'))).toBe(nodes);
    expect(await bench.fact('Surface')).toMatch(/open edges/);
  });

  test('nothing went wrong unseen', () => expect(bench.uncaught).toEqual([]));
});

async function bytes(download: Download): Promise<Uint8Array> {
  return new Uint8Array(await readFile(await download.path()));
}

async function text(download: Download): Promise<string> {
  return readFile(await download.path(), 'utf8');
}
