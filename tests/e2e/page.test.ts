// The page as such: its link, its reach by keyboard, a phone, its weight.

import { readdirSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { afterEach, expect, test } from 'vitest';
import { Workbench } from './workbench.js';
import type { Setup } from './workbench.js';

let bench: Workbench | undefined;
afterEach(async () => {
  await bench?.close();
  bench = undefined;
});
const open = async (setup?: Setup): Promise<Workbench> => (bench = await Workbench.open(setup));

test('a link makes the same mesh again', async () => {
  const link = '#example=rook&edge-length=0.03&gradation=1.5&region=sphere:2.95,-1.74,0.6,0.1:h=0.01&region=box:2.9,-1.8,0,3,-1.7,0.1:level=2';
  const hash = async (from: string): Promise<string> => {
    const { page } = await open({ link: from });
    await page.getByRole('toolbar', { name: 'View' }).waitFor();
    await bench?.mesh();
    const text = await page.locator('.hash code').innerText();
    const address = new URL(page.url()).hash;
    await bench?.close();
    expect(address).toBe(link);
    return text;
  };
  const first = await hash(link);
  expect(first).toMatch(/^[0-9a-f]{32}$/);
  expect(await hash(link)).toBe(first);
});

test('an address of no example says which there are', async () => {
  const { page } = await open({ link: '#example=teapot' });
  await expect.poll(() => page.locator('#status .text').innerText()).toMatch(/teapot.*spot/);
});

test('everything is reached by keyboard and has a name', async () => {
  const { page } = await open({ link: '#example=pawn&levels=1' });
  await page.locator('#mesh:enabled').waitFor();
  await page.keyboard.press('Control+Enter');
  await page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
  await page.getByRole('button', { name: 'Add box' }).focus();
  await page.keyboard.press('Enter');
  await page.getByRole('button', { name: 'Delete Box 1' }).waitFor();

  const controls = page.locator('button, select, input, canvas, [tabindex="0"]');
  const nameless = await controls.evaluateAll((all) =>
    all
      .filter((element) => (element as HTMLElement).offsetParent !== null)
      .filter((element) => {
        const labelled = element.getAttribute('aria-label') || element.getAttribute('title') || element.textContent?.trim();
        return !labelled && !(element instanceof HTMLInputElement && element.labels?.length);
      })
      .map((element) => element.outerHTML.slice(0, 120)),
  );
  expect(nameless).toEqual([]);

  const reached = new Set<string>();
  for (let i = 0; i < 80; i += 1) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent?.trim() ?? ''));
  }
  for (const name of ['Undo (Ctrl+Z)', 'Add sphere', 'Delete Box 1', 'Export format', 'Next of the worst cells', 'See all (F)']) {
    expect([...reached]).toContain(name);
  }
});

test('a phone shows one sheet at a time above the model', async () => {
  const { page } = await open({ link: '#example=pawn&levels=1', context: { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true } });
  await page.locator('#mesh:enabled').waitFor();
  expect(await page.getByLabel('Add sphere').isVisible()).toBe(false);
  await page.locator('#tabs').getByRole('button', { name: 'Regions' }).tap();
  await page.getByLabel('Add sphere').tap();
  expect(await page.evaluate(() => window.hexmill.workbench.settings.value.regions.length)).toBe(1);
  await page.locator('#tabs').getByRole('button', { name: 'Size' }).tap();
  expect(await page.getByLabel('Add sphere').isVisible()).toBe(false);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(390);
  const canvas = await page.locator('#view canvas').boundingBox();
  expect(canvas?.height).toBeGreaterThan(200);
});

/** Bytes, gzipped: what the page is allowed to weigh in JavaScript. */
const PAGE_BUDGET = 60_000;

test('the page is light', () => {
  const assets = new URL('../../site/assets/', import.meta.url);
  const scripts = readdirSync(assets).filter((name) => name.endsWith('.js') && !/worker|^mesher|^hexes/.test(name));
  const weights = scripts.map((name) => [name, gzipSync(readFileSync(new URL(name, assets)), { level: 9 }).length] as const);
  expect(weights.length).toBeGreaterThan(0);
  expect(weights.reduce((sum, [, weight]) => sum + weight, 0), JSON.stringify(weights)).toBeLessThan(PAGE_BUDGET);
});
