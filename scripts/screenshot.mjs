// Takes the picture of the page that the README shows, from the page itself.
//
//     npm run screenshot      (the page has to be built: npm run build)

import { existsSync } from 'node:fs';
import { join } from 'node:path';

import { launchBrowser } from './browser.mjs';
import { Failure, main, root } from './shell.mjs';
import { serveFolder } from './static-server.mjs';

const SITE = join(root, 'site');
const PICTURE = join(root, 'docs', 'screenshot.png');

/** Spot with its muzzle and a horn refined. */
const LINK = '#example=spot&edge-length=0.06&region=sphere:0,0.62,-0.52,0.28:h=0.008&region=cylinder:0.1,0.75,-0.1,0.32,1.05,-0.02,0.14:level=4';

/** Milliseconds that a step may take on a machine that draws in software. */
const PATIENCE = 120_000;

await main(async () => {
  if (!existsSync(SITE)) throw new Failure('There is no site/ to look at: npm run build');
  const server = await serveFolder(SITE);
  const browser = await launchBrowser();
  try {
    const page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
    page.setDefaultTimeout(PATIENCE);
    await page.goto(`${server.url}${LINK}`);
    await page.getByRole('toolbar', { name: 'View' }).waitFor();
    await page.locator('#mesh:enabled').click();
    await page.locator('#mesh', { hasText: 'Meshed' }).waitFor();
    await page.getByRole('radiogroup', { name: 'Colour cells by' }).getByRole('radio', { name: 'Level' }).check();
    await page.getByRole('button', { name: 'See all (F)' }).click();
    // The camera flies, and the status line tells the mesh.
    await page.waitForTimeout(1500);
    await page.screenshot({ path: PICTURE });
  } finally {
    await browser.close();
    await server.close();
  }
  console.log('docs/screenshot.png');
});
