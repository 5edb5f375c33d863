// What goes wrong is said beside what caused it; the rest goes on.

import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { afterEach, describe, expect, test } from 'vitest';
import { withLittleMemory } from '../fixtures/small-memory.js';
import { model, Workbench } from './workbench.js';
import type { Setup } from './workbench.js';

let bench: Workbench | undefined;
afterEach(async () => {
  await bench?.close();
  bench = undefined;
});
const open = async (setup?: Setup): Promise<Workbench> => (bench = await Workbench.open(setup));

describe('a bad file', () => {
  test.each([
    ['a corner that is not there', 'v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 1 2 9\n', /line 5/, /9/],
    ['a coordinate that is no number', 'v 0 0 0\nv 1 zero 0\n', /line 2/, /zero/],
  ])('with %s names its line, and the model stays', async (_, content, line, word) => {
    const { page } = await open();
    await bench?.open('helmet.obj', model('helmet.obj'));
    const before = await bench?.picture();
    await bench?.drop('bad.obj', content);
    const complaint = page.locator('[data-section=input] .complaint');
    await complaint.waitFor();
    expect(await complaint.innerText()).toMatch(/bad\.obj/);
    expect(await complaint.innerText()).toMatch(line);
    expect(await complaint.innerText()).toMatch(word);
    expect(await page.locator('.file-name').innerText()).toBe('helmet.obj');
    expect(await bench?.difference(before as Buffer, (await bench.picture()) as Buffer)).toBeLessThan(0.001);

    await bench?.open('pawn.obj', model('pawn.obj'));
    expect(await complaint.count()).toBe(0);
  });

  test('of no known kind is refused in words', async () => {
    const { page } = await open();
    await bench?.drop('photo.jpg', new Uint8Array([255, 216, 255, 224, 0, 16]));
    const complaint = page.locator('[data-section=input] .complaint');
    await complaint.waitFor();
    expect(await complaint.innerText()).toMatch(/photo\.jpg/);
    expect(await complaint.innerText()).toMatch(/JPEG/);
    expect(await complaint.innerText()).toMatch(/\.obj/);
  });

  test('of a known kind under another name is read', async () => {
    const { page } = await open();
    await bench?.open('helmet.dat', model('helmet.obj'));
    expect(await bench?.fact('Faces')).toMatch(/58/);
    expect(await page.locator('.complaint').count()).toBe(0);
  });

  test('is complained of in sight, wherever the column is scrolled to', async () => {
    const { page } = await open({ link: '#example=pawn', context: { viewport: { width: 1024, height: 600 } } });
    await page.locator('.file-name').waitFor();
    await page.getByRole('button', { name: 'Add box' }).click();
    await page.locator('.steps .scroll').evaluate((column) => column.scrollTo(0, column.scrollHeight));
    await bench?.drop('bad.obj', 'v 0 0 0\nf 1 2 3\n');
    const complaint = page.locator('[data-section=input] .complaint');
    await complaint.waitFor();
    await bench?.settle();
    const [box, column] = [await complaint.boundingBox(), await page.locator('.steps .scroll').boundingBox()];
    if (!box || !column) throw new Error('nothing to see');
    expect(box.y).toBeGreaterThanOrEqual(column.y - 1);
    expect(box.y + box.height).toBeLessThanOrEqual(column.y + column.height + 1);
  });
});

test('a field with no number in it says so and changes nothing', async () => {
  const { page } = await open({ link: '#example=pawn&edge-length=0.05' });
  await page.locator('.file-name').waitFor();
  const field = page.getByLabel('No edge longer than, model units');
  await field.fill('fine');
  await field.press('Enter');
  expect(await page.locator('.field .fault').filter({ hasText: 'number' }).count()).toBe(1);
  await field.press('Tab');
  expect(await field.inputValue()).toBe('0.05');
});

test('too many quads are foretold and refused before the work, with what to do', async () => {
  const { page } = await open({ link: '#example=car&levels=6&max-quads=10000' });
  await page.locator('.file-name').waitFor();
  await expect.poll(() => page.locator('.estimate .fault').innerText()).toMatch(/6\.45\sM quads.*your limit of 10\sk/);
  await page.locator('#mesh').click();
  const complaint = page.locator('#step-mesh .complaint');
  await complaint.waitFor();
  expect(await complaint.innerText()).toMatch(/quads/);
});

test('more than memory holds is foretold and refused before the work, with what fits', async () => {
  const { page } = await open({ link: '#example=car&levels=8' });
  await page.locator('.file-name').waitFor();
  await expect.poll(() => page.locator('.estimate .fault').innerText()).toMatch(/more than this page can hold, 11\sM/);
  await page.locator('#mesh').click();
  const complaint = page.locator('#step-mesh .complaint');
  await complaint.waitFor();
  expect(await complaint.getAttribute('data-code')).toBe('memory-exceeded');
  expect(await complaint.innerText()).toMatch(/11000000/);
});

test('memory that runs out all the same is said in plain words, and nothing is lost', async () => {
  const little = withLittleMemory(readFileSync(new URL('../../www/wasm/mesher/mesher.wasm', import.meta.url)), 512);
  const body = Buffer.from(little);
  const prepare = (fresh: Page): Promise<unknown> =>
    fresh.route('**/mesher*.wasm', (route) => route.fulfill({ body, contentType: 'application/wasm' }));
  const { page } = await open({ isolated: false, link: '#example=pawn&levels=1', prepare });
  await page.locator('.file-name').waitFor();
  await bench?.mesh();
  const quads = await bench?.figure('quads');
  await bench?.fill('Refine everything this many times', '5');
  await page.locator('#mesh').click();
  const complaint = page.locator('#step-mesh .complaint');
  await complaint.waitFor();
  expect(await complaint.getAttribute('data-code')).toBe('out-of-memory');
  expect(await complaint.innerText()).toMatch(/Memory ran out: ask for fewer cells.*Nothing that was loaded is lost/);
  expect(await page.locator('.file-name').innerText()).toBe('pawn.obj');
  expect(await bench?.figure('quads')).toBe(quads);
  const download = await bench?.export('OBJ, Wavefront');
  expect(download?.suggestedFilename()).toBe('pawn.obj');
  await bench?.fill('Refine everything this many times', '2');
  await bench?.mesh();
  expect(await bench?.figure('quads')).toBe(16 * 588);
  expect(await complaint.count()).toBe(0);
});

test('without WebGL the page says so, meshes and exports', async () => {
  const { page } = await open({ flags: ['--disable-3d-apis'] });
  const message = page.getByRole('alert').filter({ hasText: 'No 3D view' });
  await message.waitFor();
  expect(await message.innerText()).toMatch(/WebGL/);
  await bench?.drop('pawn.obj', model('pawn.obj'));
  await page.locator('.file-name').waitFor();
  await page.locator('#mesh').click();
  await page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
  expect(await bench?.figure('quads')).toBeGreaterThan(588);
  const download = await bench?.export('OBJ, Wavefront');
  expect(download?.suggestedFilename()).toBe('pawn.obj');
  expect(bench?.uncaught).toEqual([]);
});

test('without its WebAssembly the page says so', async () => {
  const { page } = await open({ prepare: (fresh) => fresh.route('**/mesher*.wasm', (route) => route.abort()) });
  const message = page.getByRole('alert').filter({ hasText: 'The mesher did not start' });
  await message.waitFor();
  expect((await message.innerText()).length).toBeGreaterThan(60);
});

test('a lost WebGL context is said, comes back, and harms no mesh', async () => {
  const { page } = await open({ link: '#example=pawn&levels=1' });
  await page.getByRole('toolbar', { name: 'View' }).waitFor();
  const before = await bench?.picture();
  await page.evaluate(() => {
    const context = document.querySelector<HTMLCanvasElement>('#view canvas')?.getContext('webgl2');
    const lose = context?.getExtension('WEBGL_lose_context');
    lose?.loseContext();
    setTimeout(() => lose?.restoreContext(), 1500);
  });
  const message = page.getByRole('alert').filter({ hasText: '3D view' });
  await message.waitFor();
  await page.locator('#mesh').click();
  await page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
  await message.waitFor({ state: 'detached', timeout: 20_000 });
  await bench?.choice('Show', 'Input').check();
  expect(await bench?.difference(before as Buffer, (await bench.picture()) as Buffer)).toBeLessThan(0.01);
});
