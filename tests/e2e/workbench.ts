// The page as a person meets it: the built site in a headless Chromium.

import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Browser, BrowserContextOptions, Download, Locator, Page } from 'playwright-core';
import type {} from '../../www/app/ui/page.js';
import { launchBrowser } from '../../scripts/browser.mjs';
import { serveFolder } from '../../scripts/static-server.mjs';

const SITE = fileURLToPath(new URL('../../site', import.meta.url));
const MODELS = new URL('../../examples/models/quads/', import.meta.url);

/** The middle of the view at 1440 x 900, clear of the columns and the toolbar. */
const CLEAR = { x: 330, y: 60, width: 780, height: 660 };
/** Milliseconds that an element may take to appear or to react, on a busy machine that draws in software. */
const PATIENCE = 45_000;
/** Channels that differ by less, of 255, look the same. */
const SAME = 12;

export interface Setup {
  /** Served with the headers that shared memory needs. Default true. */
  readonly isolated?: boolean;
  /** More flags for Chromium. */
  readonly flags?: readonly string[];
  /** What the address has after `#`. */
  readonly link?: string;
  readonly context?: BrowserContextOptions;
  /** Called before the page is opened. */
  readonly prepare?: (page: Page) => Promise<unknown>;
}

/** A quad model that ships with the page. */
export function model(file: string): string {
  return readFileSync(new URL(file, MODELS), 'utf8');
}

/** Colours of the view on light ground (src/scene/theme.rs). */
const TONES = {
  cap: { red: 160, green: 200, blue: 238 },
  mark: { red: 232, green: 89, blue: 12 },
} as const;

/** Some cells of a mesh. */
interface Cells {
  cells: number;
  /** The length of their longest edge. */
  longest: number;
}

export class Workbench {
  readonly page: Page;
  /** Errors that the page did not catch. */
  readonly uncaught: string[] = [];
  readonly #browser: Browser;
  readonly #server: { close(): Promise<void> };

  private constructor(page: Page, browser: Browser, server: { close(): Promise<void> }) {
    this.page = page;
    this.#browser = browser;
    this.#server = server;
    page.on('pageerror', (error) => this.uncaught.push(error.message));
  }

  static async open({ isolated = true, flags = [], link = '', context = {}, prepare }: Setup = {}): Promise<Workbench> {
    if (!existsSync(SITE)) throw new Error('There is no site/ to test: run npm run build first.');
    const server = await serveFolder(SITE, { isolated });
    const browser = await launchBrowser({ args: [...flags] });
    const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 }, ...context })).newPage();
    page.setDefaultTimeout(PATIENCE);
    const workbench = new Workbench(page, browser, server);
    await prepare?.(page);
    await page.goto(`${server.url}${link}`);
    await page.locator('#status .line').waitFor();
    return workbench;
  }

  async close(): Promise<void> {
    await this.#browser.close();
    await this.#server.close();
  }

  /** Drops a file on the page, or on a part of it. */
  async drop(name: string, content: string | Uint8Array, place = '#app'): Promise<void> {
    const bytes = Array.from(typeof content === 'string' ? new TextEncoder().encode(content) : content);
    const dropped = await this.page.evaluateHandle(
      ([fileName, data]) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([new Uint8Array(data)], fileName));
        return transfer;
      },
      [name, bytes] as const,
    );
    for (const type of ['dragenter', 'dragover', 'drop']) {
      await this.page.dispatchEvent(place, type, { dataTransfer: dropped });
    }
  }

  /** Drops a file and waits until it is read and drawn. */
  async open(name: string, content: string | Uint8Array): Promise<void> {
    await this.drop(name, content);
    await this.page.locator('.file-name', { hasText: name }).waitFor();
    await this.page.getByRole('toolbar', { name: 'View' }).waitFor();
    await this.settle();
  }

  /** Writes into a field and leaves it. */
  async fill(label: string, value: string): Promise<void> {
    const field = this.page.getByLabel(label, { exact: true });
    await field.fill(value);
    await field.press('Tab');
  }

  /** Meshes and waits for the result. */
  async mesh(): Promise<void> {
    await this.page.locator('#mesh').click();
    await this.page.locator('#mesh', { hasText: 'Meshed' }).waitFor({ timeout: 180_000 });
    await this.settle();
  }

  /** A count of the result. */
  async figure(name: 'quads' | 'hexes' | 'nodes'): Promise<number> {
    return whole(await this.page.locator(`[data-figure=${name}]`).innerText());
  }

  /** The estimate of the settings as they are now. */
  async estimate(): Promise<number> {
    await this.page.waitForFunction(() => window.hexmill.workbench.isEstimated.value);
    return Number(await this.page.locator('.estimate [data-cells]').getAttribute('data-cells'));
  }

  /** Cells of the result with all nodes in a sphere, and those beyond twice its radius. */
  async cellsOf(sphere: { center: readonly number[]; radius: number }): Promise<{ inside: Cells; farAway: Cells }> {
    return this.page.evaluate(({ center, radius }) => {
      const mesh = window.hexmill.workbench.result.value?.mesh;
      if (!mesh || !('quads' in mesh)) throw new Error('no mesh of quads');
      const { nodes, quads } = mesh;
      const inside = { cells: 0, longest: 0 };
      const farAway = { cells: 0, longest: 0 };
      for (let quad = 0; quad < quads.length; quad += 4) {
        const corners = Array.from(quads.subarray(quad, quad + 4), (node) => nodes.subarray(3 * node, 3 * node + 3));
        const distance = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
          Math.hypot((a[0] ?? 0) - (b[0] ?? 0), (a[1] ?? 0) - (b[1] ?? 0), (a[2] ?? 0) - (b[2] ?? 0));
        const away = corners.map((corner) => distance(corner, center));
        const place = Math.max(...away) < radius ? inside : Math.min(...away) > 2 * radius ? farAway : null;
        if (!place) continue;
        place.cells += 1;
        place.longest = Math.max(place.longest, ...corners.map((corner, i) => distance(corner, corners[(i + 1) % 4] ?? corner)));
      }
      return { inside, farAway };
    }, sphere);
  }

  /** A line of the facts about the input, such as "5,856 all triangles". */
  async fact(name: string): Promise<string> {
    return this.page.locator(`[data-section=input] dt:text-is("${name}") + dd`).innerText();
  }

  async export(label: string): Promise<Download> {
    await this.page.getByLabel('Export format').selectOption({ label });
    const [download] = await Promise.all([this.page.waitForEvent('download'), this.page.locator('#export').click()]);
    return download;
  }

  async log(): Promise<string[]> {
    if ((await this.page.locator('#log').count()) === 0) await this.page.getByRole('button', { name: 'Log', exact: true }).click();
    return this.page.locator('#log li span').allInnerTexts();
  }

  /** What the view shows now, as a PNG. */
  async picture(): Promise<Buffer> {
    await this.settle();
    return this.page.screenshot({ clip: CLEAR });
  }

  /** The share of pixels that differ between two pictures. */
  async difference(before: Buffer, after: Buffer): Promise<number> {
    return this.page.evaluate(
      async ([a, b, same]) => {
        const pixels = async (base64: string): Promise<Uint8ClampedArray> => {
          const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
          const image = await createImageBitmap(new Blob([bytes]));
          const paper = new OffscreenCanvas(image.width, image.height).getContext('2d');
          if (!paper) throw new Error('no 2D canvas');
          paper.drawImage(image, 0, 0);
          return paper.getImageData(0, 0, image.width, image.height).data;
        };
        const [first, second] = await Promise.all([pixels(a), pixels(b)]);
        let differing = 0;
        for (let i = 0; i < first.length; i += 4) {
          const gap = (c: number): number => Math.abs((first[i + c] ?? 0) - (second[i + c] ?? 0));
          if (Math.max(gap(0), gap(1), gap(2)) > same) differing += 1;
        }
        return differing / (first.length / 4);
      },
      [before.toString('base64'), after.toString('base64'), SAME] as const,
    );
  }

  /** The share of a picture's pixels that have a tone, whatever light falls on it. */
  async shareOf(picture: Buffer, tone: keyof typeof TONES): Promise<number> {
    return this.page.evaluate(
      async ([base64, { red, green, blue }]) => {
        const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
        const image = await createImageBitmap(new Blob([bytes]));
        const paper = new OffscreenCanvas(image.width, image.height).getContext('2d');
        if (!paper) throw new Error('no 2D canvas');
        paper.drawImage(image, 0, 0);
        const { data } = paper.getImageData(0, 0, image.width, image.height);
        const most = Math.max(red, green, blue);
        let found = 0;
        for (let i = 0; i < data.length; i += 4) {
          const [r = 0, g = 0, b = 0] = data.subarray(i, i + 3);
          const brightest = Math.max(r, g, b, 1);
          const off = Math.max(...[r / brightest - red / most, g / brightest - green / most, b / brightest - blue / most].map(Math.abs));
          if (brightest > 90 && off < 0.04) found += 1;
        }
        return found / (data.length / 4);
      },
      [picture.toString('base64'), TONES[tone]] as const,
    );
  }

  /** Presses Cancel once the work tells a stage: milliseconds until the page has it taken away and drawn. */
  async cancel(): Promise<number> {
    await this.page.waitForFunction(() => window.hexmill.workbench.running.value?.stage, undefined, { timeout: 30_000 });
    return this.page.evaluate(async () => {
      const started = performance.now();
      document.querySelector<HTMLButtonElement>('#cancel')?.click();
      await new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn)));
      return document.querySelector('#cancel') ? Number.POSITIVE_INFINITY : performance.now() - started;
    });
  }

  /** Where a handle of the selected region, or of the plane that cuts hexes, is on the page. */
  async handle(name?: string): Promise<{ name: string; x: number; y: number }> {
    const handles = await this.page.evaluate(() => window.hexmill.viewport.handles());
    const box = await this.page.locator('#view canvas').boundingBox();
    const found = handles.find((handle) => name === undefined || handle.name === name);
    if (!found || !box) throw new Error(`no handle ${name ?? ''} among ${JSON.stringify(handles)}`);
    return { name: found.name, x: box.x + found.x, y: box.y + found.y };
  }

  async dragMouse(from: { x: number; y: number }, by: { x: number; y: number }): Promise<void> {
    const { mouse } = this.page;
    await mouse.move(from.x, from.y);
    await mouse.down();
    for (const part of [0.25, 0.5, 0.75, 1]) await mouse.move(from.x + part * by.x, from.y + part * by.y);
    await mouse.up();
  }

  /** One of the choices of a group, such as "Colour cells by". */
  choice(group: string, name: string): Locator {
    return this.page.getByRole('radiogroup', { name: group, exact: true }).getByRole('radio', { name, exact: true });
  }

  /** Waits for two frames and the end of a camera flight. */
  async settle(): Promise<void> {
    await this.page.waitForTimeout(FLIGHT);
    await this.page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  }
}

/** Milliseconds; longer than the camera flies. */
const FLIGHT = 350;

/** The whole number that a text begins with, with or without separators. */
export function whole(text: string): number {
  return Number(/[\d,]+/.exec(text)?.[0].replaceAll(',', '') ?? Number.NaN);
}
