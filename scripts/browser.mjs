// Chromium and its driver: where they are, and how tests launch them.

import { which, Failure } from './shell.mjs';

const CHROMIUM_NAMES = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable', 'chrome'];
const CHROMIUM_PLACES = [
  '/usr/bin/chromium',
  '/snap/bin/chromium',
  '/opt/google/chrome/chrome',
  '/Applications/Chromium.app/Contents/MacOS/Chromium',
  '/Applications/Google Chrome.app/Contents/MacOS/Google Chrome',
];
const DRIVER_PLACES = ['/usr/bin/chromedriver', '/usr/lib/chromium/chromedriver', '/snap/bin/chromium.chromedriver'];

/**
 * Flags for a headless Chromium in a container. Software rendering gives WebGL 2 without a GPU;
 * the rest keeps the browser from looking for the network.
 */
export const CHROMIUM_FLAGS = [
  '--no-sandbox',
  '--disable-dev-shm-usage',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** The path of a Chromium (or Chrome), or null. `CHROMIUM` in the environment comes first. */
export function findChromium() {
  return find('CHROMIUM', CHROMIUM_NAMES, CHROMIUM_PLACES);
}

/** The path of chromedriver, or null. `CHROMEDRIVER` in the environment comes first. */
export function findChromedriver() {
  return find('CHROMEDRIVER', ['chromedriver'], DRIVER_PLACES);
}

function find(variable, names, places) {
  if (process.env[variable]) return process.env[variable];
  for (const name of names) {
    const path = which(name);
    if (path) return path;
  }
  return which(names[0], places);
}

/**
 * Launches Chromium through playwright-core. `options` are playwright's launch options; its `args`
 * are added to `CHROMIUM_FLAGS`.
 *
 * @param {import('playwright-core').LaunchOptions} [options]
 * @returns {Promise<import('playwright-core').Browser>}
 */
export async function launchBrowser(options = {}) {
  const executablePath = findChromium();
  if (!executablePath) throw new Failure('No Chromium was found: run npm run setup, or name one in CHROMIUM.');
  const { chromium } = await import('playwright-core');
  return chromium.launch({ executablePath, ...options, args: [...CHROMIUM_FLAGS, ...(options.args ?? [])] });
}
