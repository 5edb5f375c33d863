// Sets up what the project needs, and does nothing where it is there already:
// the pinned Rust toolchain, the wasm-bindgen command line, the npm packages, and for tests a Chromium.
//
//     npm run setup

import { createHash } from 'node:crypto';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

import { findChromedriver, findChromium } from './browser.mjs';
import { Failure, execute, isMain, main, must, output, root, which } from './shell.mjs';

/** What the packages that build and test the page run on. */
const NODE = 'Node 20.19 or newer of 20, or 22.12 or newer';
const TOOLS = join(root, '.tools');

/** The wasm-bindgen version that Cargo.toml pins; the command line has to be the very same. */
const WASM_BINDGEN = readFileSync(join(root, 'Cargo.toml'), 'utf8').match(
  /^wasm-bindgen = \{ version = "=([\d.]+)"/m,
)[1];

/** Everything; `browser` says whether tests are going to be run. */
export async function setup({ browser = true } = {}) {
  checkNode();
  await setUpRust();
  await setUpWasmBindgen();
  await setUpPackages();
  if (browser) await setUpBrowser();
}

function checkNode() {
  const [major = 0, minor = 0] = process.versions.node.split('.').map(Number);
  const oldestMinor = new Map([[20, 19], [22, 12]]).get(major) ?? (major > 22 ? 0 : Infinity);
  if (minor < oldestMinor) throw new Failure(`${NODE} is needed; this is Node ${process.versions.node}.`);
}

/** The toolchain that rust-toolchain.toml names, with its WebAssembly target and the sources of std. */
export async function setUpRust() {
  if (!which('cargo')) {
    throw new Failure('Rust is missing: install rustup from https://rustup.rs and run this again.');
  }
  if (rustIsComplete()) return;
  if (!which('rustup')) {
    throw new Failure(
      'This Rust lacks the wasm32-unknown-unknown target or the sources of its standard library. ' +
        'Install rustup from https://rustup.rs, which brings both, or add them with your own package manager.',
    );
  }
  const channel = process.env.RUSTUP_TOOLCHAIN ?? pinnedChannel();
  if (output('rustup', ['run', channel, 'rustc', '--version']) === null) {
    say(`installing Rust ${channel}`);
    await must('rustup', ['toolchain', 'install', channel, '--profile', 'minimal', '--no-self-update']);
  }
  say('adding the WebAssembly target, the sources of std, rustfmt and clippy');
  await must('rustup', ['target', 'add', '--toolchain', channel, 'wasm32-unknown-unknown']);
  await must('rustup', ['component', 'add', '--toolchain', channel, 'rust-src', 'rustfmt', 'clippy']);
}

function pinnedChannel() {
  return readFileSync(join(root, 'rust-toolchain.toml'), 'utf8').match(/^channel = "(.+)"/m)[1];
}

function rustIsComplete() {
  const sysroot = output('rustc', ['--print', 'sysroot']);
  return (
    sysroot !== null &&
    existsSync(join(sysroot, 'lib/rustlib/wasm32-unknown-unknown/lib')) &&
    existsSync(join(sysroot, 'lib/rustlib/src/rust/library')) &&
    output('cargo', ['fmt', '--version']) !== null &&
    output('cargo', ['clippy', '--version']) !== null
  );
}

/** Puts wasm-bindgen of the pinned version on this process's PATH, installing it into .tools/ if need be. */
export async function setUpWasmBindgen() {
  const own = join(TOOLS, 'bin');
  process.env.PATH = `${own}:${process.env.PATH}`;
  const found = output('wasm-bindgen', ['--version']);
  if (found === `wasm-bindgen ${WASM_BINDGEN}` && which('wasm-bindgen-test-runner')) return;
  say(`installing wasm-bindgen ${WASM_BINDGEN} into .tools/ (a minute or two, once)`);
  // Not optimized it is there two minutes sooner, writes the same bytes, and takes a second more for a module.
  await must('cargo', ['install', 'wasm-bindgen-cli', '--version', WASM_BINDGEN, '--root', TOOLS, '--force'], {
    env: { CARGO_TARGET_DIR: join(root, 'target', 'tools'), CARGO_PROFILE_RELEASE_OPT_LEVEL: '0' },
  });
}

/** `npm ci` when package-lock.json is not the one that was installed last. */
export async function setUpPackages() {
  const lock = createHash('sha256').update(readFileSync(join(root, 'package-lock.json'))).digest('hex');
  const stamp = join(root, 'node_modules', '.hexmill-lock');
  if (existsSync(stamp) && readFileSync(stamp, 'utf8') === lock) return;
  say('installing the npm packages');
  await must('npm', ['ci', '--no-fund', '--no-audit']);
  writeFileSync(stamp, lock);
}

/** Chromium and chromedriver, from the system's packages where this may install them. */
export async function setUpBrowser() {
  const missing = () => [
    ...(findChromium() ? [] : ['chromium']),
    ...(findChromedriver() ? [] : ['chromium-driver']),
  ];
  if (missing().length === 0) return;
  if (which('apt-get') && process.getuid?.() === 0) {
    say(`installing ${missing().join(' and ')}`);
    const env = { DEBIAN_FRONTEND: 'noninteractive' };
    const patience = ['-o', 'DPkg::Lock::Timeout=300'];
    await execute('apt-get', [...patience, 'update'], { env });
    await execute('apt-get', [...patience, 'install', '-y', '--no-install-recommends', ...missing()], { env });
  }
  if (missing().length > 0) {
    throw new Failure(
      `The browser tests need Chromium and its driver; missing: ${missing().join(', ')}.\n` +
        'Debian: apt-get install chromium chromium-driver. macOS: brew install --cask chromium chromedriver.\n' +
        'Or name them in the environment: CHROMIUM=/path/to/chromium CHROMEDRIVER=/path/to/chromedriver.',
    );
  }
}

function say(what) {
  console.log(`setup: ${what}`);
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await setup();
    console.log('setup: everything is there');
  });
}
