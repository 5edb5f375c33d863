// A long run is cancelled: at once, in words, and without harm to what was there.

import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { model, Workbench } from './workbench.js';

/** Milliseconds within which the page must be free again. */
const PROMPT = 200;
/** Milliseconds within which a small mesh is there, new workers included, on a busy machine. */
const SOON = 5_000;
const LEVELS = 'Refine everything this many times';

describe.each([{ isolated: true }, { isolated: false }])('isolated: $isolated', ({ isolated }) => {
  let bench: Workbench;
  beforeAll(async () => {
    bench = await Workbench.open({ isolated });
    await bench.open('car.obj', model('car.obj'));
    await bench.mesh();
  });
  afterAll(() => bench?.close());

  test('cancelling answers at once, says so, and keeps the earlier mesh', async () => {
    const quads = await bench.figure('quads');
    const before = await bench.picture();
    await bench.choice('Sized by', 'Levels').check();
    await bench.fill(LEVELS, '6');
    await bench.page.locator('#mesh').click();
    await bench.page.locator('#cancel').waitFor();
    await expect.poll(() => bench.page.evaluate(() => window.hexmill.workbench.running.value?.stage), { timeout: 20_000 }).toBeTruthy();

    const took = await bench.page.evaluate(async () => {
      const started = performance.now();
      document.querySelector<HTMLButtonElement>('#cancel')?.click();
      await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
      return document.querySelector('#cancel') ? Number.POSITIVE_INFINITY : performance.now() - started;
    });
    expect(took).toBeLessThan(PROMPT);
    expect((await bench.log()).at(-1)).toMatch(/^Cancelled meshing after/);
    expect(await bench.figure('quads')).toBe(quads);
    await bench.page.getByRole('button', { name: 'Close the log' }).click();
    expect(await bench.difference(before, await bench.picture())).toBeLessThan(0.001);
  });

  test('the processor is free soon after, and the next mesh is made', async () => {
    await bench.fill(LEVELS, '1');
    await bench.mesh();
    const took = await bench.page.evaluate(() => window.hexmill.workbench.result.value?.milliseconds);
    expect(took).toBeLessThan(SOON);
    expect(await bench.figure('quads')).toBe(4 * 1575);
  });

  test('the latest request wins', async () => {
    await bench.fill(LEVELS, '5');
    await bench.page.keyboard.press('Control+Enter');
    await bench.page.locator('#cancel').waitFor();
    await bench.fill(LEVELS, '2');
    await bench.page.keyboard.press('Control+Enter');
    await bench.page.locator('#mesh', { hasText: 'Meshed' }).waitFor({ timeout: 30_000 });
    expect(await bench.figure('quads')).toBe(16 * 1575);
  });

  test('nothing went wrong unseen', () => expect(bench.uncaught).toEqual([]));
});
