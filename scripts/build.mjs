// Builds everything that is published: the modules, the npm package (dist/) and the page (site/).
//
//     npm run build

import { buildPackage } from './build-package.mjs';
import { buildWasm } from './build-wasm.mjs';
import { setup } from './setup.mjs';
import { isMain, main, must, root } from './shell.mjs';

/** Builds all three and resolves to a line about each module. */
export async function build(run = {}) {
  const lines = await buildWasm(undefined, run);
  await buildPackage(run);
  await must('node', ['node_modules/vite/bin/vite.js', 'build'], { cwd: root, ...run });
  return lines;
}

if (isMain(import.meta.url)) {
  await main(async () => {
    await setup({ browser: false });
    for (const line of await build()) console.log(line);
    console.log('dist/ holds the package, site/ the page');
  });
}
