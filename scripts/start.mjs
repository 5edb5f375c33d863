// Sets up what is missing, builds the modules, and serves the page, which follows changes of its TypeScript.
//
//     npm start [-- --port 5173]

import { buildWasm } from './build-wasm.mjs';
import { setup } from './setup.mjs';
import { main, must } from './shell.mjs';

await main(async (args) => {
  await setup({ browser: false });
  console.log('building the WebAssembly modules (minutes at first, seconds later)');
  await buildWasm();
  await must('node', ['node_modules/vite/bin/vite.js', ...args]);
});
