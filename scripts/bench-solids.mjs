// Solids of about 50,000 hexes, start to finish: natively on one thread and on two, and on the page.
//
//     npm run bench:solids -- [FOLDER [NAME...]]      (the page has to be built: npm run build)
//
// Takes the OBJ files of FOLDER, those that ship where there is none, whose names begin with one of SIDES, and with a NAME if
// there are any. Prints a Markdown table. Native figures are the least of some runs, in turns, and the most memory of those on
// one thread; the page is timed once, in a headless Chromium, from the click on Mesh until it says that it is done.

import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';

import { launchBrowser } from './browser.mjs';
import { Failure, main, root } from './shell.mjs';
import { serveFolder } from './static-server.mjs';

const SITE = join(root, 'site');
const SHIPPED = join(root, 'examples', 'models', 'solids');
const PROGRAM = join(root, 'target', 'release', 'hexmill');

/** The longest side over the edge length, by how a file's name begins. */
const SIDES = {
  B0: 64,
  component8: 43,
  '3holes': 72,
  fandisk: 65,
  mambo_s34: 44,
  part: 73,
  Angled: 59,
  nist_ctc_01: 106,
  nist_ftc_11: 96,
  spot: 65,
  bunny: 56,
  MFCAD: 32,
  nist_ctc_05: 36,
  nist_ctc_04: 25,
};

/** So many runs on one thread and on two. */
const RUNS = 3;

/** Milliseconds that the page may take. */
const PATIENCE = 600_000;

/** The length of the longest side of a file's bounding box. */
function longestSide(obj) {
  const min = [Infinity, Infinity, Infinity];
  const max = min.map((x) => -x);
  for (const [, ...place] of obj.matchAll(/^v\s+(\S+)\s+(\S+)\s+(\S+)/gm)) {
    place.forEach((text, axis) => {
      min[axis] = Math.min(min[axis], Number(text));
      max[axis] = Math.max(max[axis], Number(text));
    });
  }
  return Math.max(...max.map((x, axis) => x - min[axis]));
}

/** What the command line makes of a solid, and how long it takes. */
function native(path, edgeLength, threads, folder) {
  const report = join(folder, 'report.json');
  const args = ['hex', path, '-o', join(folder, 'solid.vtu'), '--edge-length', edgeLength, '--threads', threads, '--report', report];
  execFileSync(PROGRAM, args.map(String), { stdio: 'ignore' });
  const { seconds, peakMemoryBytes, mesh } = JSON.parse(readFileSync(report, 'utf8'));
  return { seconds, bytes: peakMemoryBytes, hexes: mesh.hexes, hash: mesh.hash };
}

/** Drops a file on the page and fills it with hexes: how many there are, and seconds from the click on Mesh. */
async function onPage(browser, url, name, obj, edgeLength) {
  const page = await (await browser.newContext({ viewport: { width: 1440, height: 900 } })).newPage();
  page.setDefaultTimeout(PATIENCE);
  await page.goto(url);
  await page.locator('.threads').waitFor();
  const dropped = await page.evaluateHandle(
    ([file, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], file));
      return transfer;
    },
    [name, obj],
  );
  await page.dispatchEvent('#app', 'drop', { dataTransfer: dropped });
  await page.locator('.file-name', { hasText: name }).waitFor();
  await page.getByRole('radiogroup', { name: 'Make', exact: true }).getByRole('radio', { name: 'Hexes in it', exact: true }).check();
  await page.locator('[data-solid]').waitFor();
  const field = page.getByLabel('Edges about as long as, model units', { exact: true });
  await field.fill(String(edgeLength));
  await field.press('Tab');
  await page.waitForFunction(() => window.hexmill.workbench.isEstimated.value);
  const seconds = await page.evaluate(async () => {
    // While it works there is another button in its place.
    const button = () => document.querySelector('#mesh');
    const started = performance.now();
    const meshed = new Promise((resolve) => {
      const observer = new MutationObserver(() => button()?.textContent.includes('Meshed') && resolve(observer.disconnect()));
      observer.observe(document.body, { subtree: true, childList: true, characterData: true });
    });
    button().click();
    await meshed;
    return (performance.now() - started) / 1000;
  });
  const told = await page.locator('[data-figure=hexes]').innerText();
  const hexes = Number(/[\d,]+/.exec(told)?.[0].replaceAll(',', ''));
  await page.context().close();
  return { seconds, hexes };
}

const row = (cells) => console.log(`| ${cells.join(' | ')} |`);
const least = (runs) => Math.min(...runs.map(({ seconds }) => seconds));

async function bench(path, name, sides, folder, browser, url) {
  const obj = readFileSync(path, 'utf8');
  const edgeLength = longestSide(obj) / sides;
  const runs = Array.from({ length: RUNS }, () => [1, 2].map((threads) => native(path, edgeLength, threads, folder)));
  const [one, two] = [0, 1].map((threads) => runs.map((run) => run[threads]));
  const { hexes, hash } = one[0];
  if ([...one, ...two].some((run) => run.hash !== hash)) throw new Failure(`${name}: the meshes differ`);
  const web = await onPage(browser, url, `${name}.obj`, obj, edgeLength);
  if (web.hexes !== hexes) throw new Failure(`${name}: ${web.hexes} hexes on the page, ${hexes} natively`);
  const seconds = [least(one), least(two)];
  const bytes = Math.max(...one.map((run) => run.bytes)) / hexes;
  const times = [...seconds, web.seconds].map((time) => `${time.toFixed(1)} s`);
  row([name, sides, hexes.toLocaleString('en'), times[0], times[1], (seconds[0] / seconds[1]).toFixed(2), times[2], Math.round(bytes).toLocaleString('en')]);
}

await main(async ([given, ...names]) => {
  if (!existsSync(SITE)) throw new Failure('There is no site/ to time: npm run build');
  const models = given === undefined ? SHIPPED : resolve(given);
  const files = readdirSync(models).filter((file) => file.endsWith('.obj'));
  const wanted = (name) => names.length === 0 || names.some((beginning) => name.startsWith(beginning));
  execFileSync('cargo', ['build', '--release', '--bin', 'hexmill'], { cwd: root, stdio: 'inherit' });
  const folder = mkdtempSync(join(tmpdir(), 'hexmill-bench-'));
  const server = await serveFolder(SITE);
  const browser = await launchBrowser();
  try {
    row(['solid', 'longest side / L', 'hexes', 'one thread', 'two threads', 'ratio', 'page', 'bytes a hex']);
    row(Array(8).fill('---'));
    for (const [name, sides] of Object.entries(SIDES).filter(([solid]) => wanted(solid))) {
      const file = files.find((candidate) => candidate.startsWith(name));
      if (file) await bench(join(models, file), name, sides, folder, browser, server.url);
    }
  } finally {
    await browser.close();
    await server.close();
    rmSync(folder, { recursive: true });
  }
});
