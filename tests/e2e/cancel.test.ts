// A long run is cancelled: at once, in words, and without harm to what was there.

import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { model, Workbench } from './workbench.js';

/** Milliseconds within which the page must be free again, and the mesher ready for the next mesh. */
const PROMPT = 200;
/** Times that are measured again, since other programs may hold up a machine: the best counts. */
const ATTEMPTS = 4;
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
    const took = await bench.cancel();
    expect(took).toBeLessThan(PROMPT);
    expect((await bench.log()).at(-1)).toMatch(/^Cancelled meshing after/);
    expect(await bench.figure('quads')).toBe(quads);
    expect(await bench.page.locator('[data-cancelled]').innerText()).toMatch(/^Cancelled after.*The mesh shown is the one from before/);
    await bench.page.getByRole('button', { name: 'Close the log' }).click();
    expect(await bench.difference(before, await bench.picture())).toBeLessThan(0.001);
  });

  test('the work stops: the next mesh is there within 200 ms, and no more progress is told', async () => {
    await bench.fill(LEVELS, '6');
    const tries: { next: number; stages: number }[] = [];
    for (let attempt = 0; attempt < ATTEMPTS; attempt += 1) {
      await bench.page.locator('#mesh').click();
      await bench.page.waitForFunction(() => window.hexmill.workbench.running.value?.stage, undefined, { timeout: 20_000 });
      tries.push(await bench.page.evaluate(cancelAndMeshLittle));
    }
    expect(tries.map(({ stages }) => stages)).toEqual(tries.map(() => 0));
    const delays = tries.map(({ next }) => next);
    expect(Math.min(...delays), `milliseconds from the cancel to the next mesh: ${delays}`).toBeLessThan(PROMPT);
  });

  test('the next mesh is the one asked for', async () => {
    await bench.fill(LEVELS, '1');
    await bench.mesh();
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

/** Runs in the page: cancels what runs, makes a small mesh at once, and listens to what becomes of the cancelled work. */
async function cancelAndMeshLittle(): Promise<{ next: number; stages: number }> {
  const { workbench } = window.hexmill;
  const mesher = await workbench.mesher;
  const surface = workbench.input.value?.surface;
  if (!surface) throw new Error('no model');
  const started = performance.now();
  workbench.cancel();
  const mesh = await mesher.refineQuads(surface, { levels: 1 });
  const next = performance.now() - started;
  if (mesh.quads.length !== 4 * 4 * 1575) throw new Error(`the next mesh has ${mesh.quads.length / 4} quads`);
  let stages = 0;
  const stop = workbench.running.subscribe((running) => {
    if (running) stages += 1;
  });
  await new Promise((later) => setTimeout(later, 300));
  stop();
  return { next, stages };
}
