import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';
import type { Plugin } from 'vite';

// Shared memory, and so the pool of workers, needs a cross-origin isolated page.
const headers = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

/** What stands before a tag or an expression on a line of its own in a template is a space to a browser, and as well told by one. */
const templates: Plugin = {
  name: 'one-space-before-tags',
  apply: 'build',
  enforce: 'post',
  transform: (code, id) => (/\/www\/app\/ui\/[^?]*\.ts/.test(id) ? { code: code.replace(/\n\s+(?=<|\$\{)/g, ' '), map: null } : null),
};

export default defineConfig({
  // Relative addresses: the built page works in any folder of any site.
  base: './',
  resolve: { alias: { hexmill: fileURLToPath(new URL('./www/lib/index.ts', import.meta.url)) } },
  server: { headers },
  preview: { headers },
  plugins: [templates],
  worker: { format: 'es' },
  build: { outDir: 'site', target: 'es2022', assetsInlineLimit: 0 },
});
