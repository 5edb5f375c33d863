// A mesh of 400 thousand cells: lighter while the camera moves, the same picture once it rests.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { Workbench } from './workbench.js';

/** Milliseconds that a few frames may take where they are drawn in software. */
const PATIENCE = 240_000;

let bench: Workbench;
beforeAll(async () => {
  bench = await Workbench.open({ link: '#example=car&levels=4' });
  await bench.page.getByRole('toolbar', { name: 'View' }).waitFor();
  await bench.mesh();
});
afterAll(() => bench?.close());

test('it moves at half the resolution and rests at the whole', async () => {
  expect(await bench.figure('quads')).toBe(4 ** 4 * 1575);
  const canvas = bench.page.locator('#view canvas');
  const width = (): Promise<number> => canvas.evaluate((element) => (element as HTMLCanvasElement).width);
  /** Presses a key, and tells how wide the canvas is while the camera moves. */
  const press = (key: string): Promise<number> =>
    canvas.evaluate((element, pressed) => {
      element.dispatchEvent(new KeyboardEvent('keydown', { key: pressed, bubbles: true }));
      return (element as HTMLCanvasElement).width;
    }, key);
  const [whole, before] = [await width(), await bench.picture()];
  expect(await press('ArrowLeft')).toBe(Math.round(whole / 2));
  await expect.poll(width).toBe(whole);
  expect(await bench.difference(before, await bench.picture())).toBeGreaterThan(0.02);
  expect(await press('ArrowRight')).toBe(Math.round(whole / 2));
  await expect.poll(width).toBe(whole);
  expect(await bench.difference(before, await bench.picture())).toBeLessThan(0.001);
}, PATIENCE);
