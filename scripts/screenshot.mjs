// Takes the pictures of the page that ship with the project, from the page itself: those in the README, of quads, of
// hexes and of a solid, and a small one of each example, on light and on dark ground.
//
//     npm run screenshot      (the page has to be built: npm run build; then build it again)

import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { launchBrowser } from './browser.mjs';
import { Failure, main, root } from './shell.mjs';
import { serveFolder } from './static-server.mjs';

const SITE = join(root, 'site');
const PICTURE = join(root, 'docs', 'screenshot.png');
const HEXES = join(root, 'docs', 'hexes.png');
const SOLID = join(root, 'docs', 'solid.png');
const THUMBNAILS = join(root, 'www', 'app', 'thumbnails');

/** A pawn with its head and its foot refined: coarse enough that transitions are seen. */
const LINK = '#example=pawn&levels=1&region=sphere:1.7468,-1.36,0.52,0.09:level=3&region=box:1.55,-1.5,0,1.95,-1,0.1:level=2&colour=level';

/** A box of hexes around Spot, refined at its surface and cut open along its middle. */
const HEX_LINK = '#example=spot&job=hexes&spacing=0.2&margin=0.3&at-surface=2&method=two&section=1,0,0,0';

/** A milled part filled with hexes, cut open and coloured by quality. */
const SOLID_LINK = '#example=milled&job=solid&edge-length=0.4&colour=quality&section=0,-1,0,-5';

/** Presses of an arrow key from the corner that the page starts with to the model's better side. */
const TURN = { spot: 15, bunny: 6 };

/** What is cut out of the view for a thumbnail, and its size, in pixels. */
const CUT = { x: 80, y: 42, width: 940, height: 588 };
const THUMBNAIL = { width: 256, height: 160 };

/** Pixels above and below a model that is cut out. */
const MARGIN = 60;

/** Milliseconds that a step may take on a machine that draws in software. */
const PATIENCE = 120_000;

/** Milliseconds; longer than the camera flies and a message stays. */
const REST = 1500;

await main(async () => {
  if (!existsSync(SITE)) throw new Failure('There is no site/ to look at: npm run build');
  const server = await serveFolder(SITE);
  const browser = await launchBrowser();
  try {
    await takePicture(browser, `${server.url}${LINK}`, PICTURE, 0);
    await takePicture(browser, `${server.url}${HEX_LINK}`, HEXES, 0);
    await takePicture(browser, `${server.url}${SOLID_LINK}`, SOLID, 0);
    mkdirSync(THUMBNAILS, { recursive: true });
    for (const scheme of ['light', 'dark']) await takeThumbnails(browser, server.url, scheme);
  } finally {
    await browser.close();
    await server.close();
  }
  console.log('docs/screenshot.png, docs/hexes.png, docs/solid.png and www/app/thumbnails/ hold the pictures');
});

async function open(browser, address, viewport, colorScheme) {
  const page = await browser.newPage({ viewport, colorScheme });
  page.setDefaultTimeout(PATIENCE);
  await page.goto(address);
  await page.locator('#status .line').waitFor();
  return page;
}

async function turn(page, presses) {
  await page.locator('#view canvas').focus();
  for (let press = 0; press < presses; press++) await page.keyboard.press('ArrowRight');
}

async function takePicture(browser, address, path, presses) {
  const page = await open(browser, address, { width: 1440, height: 900 }, 'light');
  await page.getByRole('toolbar', { name: 'View' }).waitFor();
  await page.locator('#mesh:enabled').click();
  await page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
  await turn(page, presses);
  await page.getByRole('button', { name: 'See all (F)' }).click();
  await page.waitForTimeout(REST);
  await page.screenshot({ path });
  await page.close();
}

async function takeThumbnails(browser, url, scheme) {
  const page = await open(browser, url, { width: 1100, height: 700 }, scheme);
  const examples = await page.locator('.examples [data-example]').evaluateAll((all) => all.map(({ dataset }) => dataset.example));
  await page.evaluate(() => {
    window.hexmill.stepsFolded.value = true;
    window.hexmill.inspectorFolded.value = true;
  });
  for (const example of examples) {
    await page.evaluate((id) => window.hexmill.openExample(id), example);
    await page.waitForFunction((id) => window.hexmill.workbench.input.value?.example?.id === id, example);
    await turn(page, TURN[example] ?? 0);
    await page.evaluate((margin) => {
      window.hexmill.viewport.covered.value = [0, margin];
      window.hexmill.viewport.frameAll();
    }, MARGIN);
    await page.waitForTimeout(REST);
    const picture = await page.evaluate(thumbnail, { cut: CUT, size: THUMBNAIL });
    writeFileSync(join(THUMBNAILS, `${example}-${scheme}.webp`), Buffer.from(picture, 'base64'));
  }
  await page.close();
}

/** Runs in the page: a part of the view, made small, as the Base64 of a WebP file. */
async function thumbnail({ cut, size }) {
  const view = await createImageBitmap(await window.hexmill.viewport.screenshot());
  const paper = new OffscreenCanvas(size.width, size.height);
  const pen = paper.getContext('2d');
  pen.imageSmoothingQuality = 'high';
  pen.drawImage(view, cut.x, cut.y, cut.width, cut.height, 0, 0, size.width, size.height);
  const bytes = new Uint8Array(await (await paper.convertToBlob({ type: 'image/webp', quality: 0.85 })).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
}
