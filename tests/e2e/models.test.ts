// Models that ship, with a sphere three levels deep: dropped on the page, they give the mesh that they give everywhere.

import { afterAll, beforeAll, expect, test } from 'vitest';
import { cases } from '../fixtures/cases.js';
import { Workbench } from './workbench.js';

let bench: Workbench;
beforeAll(async () => {
  bench = await Workbench.open();
});
afterAll(() => bench?.close());

const models = cases().filter(({ model }) => model !== undefined);

test('all models have a case', () => {
  expect(models).toHaveLength(8);
});

test.each(models)('$name', async ({ model = '', obj, options, quads, nodes, hash }) => {
  await bench.open(model.split('/').at(-1) ?? '', obj);
  await bench.page.evaluate((regions) => {
    const { settings } = window.hexmill.workbench;
    const listed = regions.map((region, id) => {
      if (region.kind !== 'sphere' || region.level === undefined) throw new Error('no sphere with a level');
      const [x, y, z] = region.center;
      const shape = { kind: 'sphere' as const, center: [x, y, z] as [number, number, number], radius: region.radius };
      return { id, shape, target: { by: 'level' as const, level: region.level } };
    });
    settings.value = { ...settings.value, by: 'levels', levels: 0, regions: listed };
  }, options.regions ?? []);
  await bench.mesh();
  expect([await bench.figure('quads'), await bench.figure('nodes')]).toEqual([quads, nodes]);
  expect(await bench.page.locator('.hash code').innerText()).toBe(hash);
});
