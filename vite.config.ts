import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vite';

// Shared memory, and so the pool of workers, needs a cross-origin isolated page.
const headers = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

export default defineConfig({
  // Relative addresses: the built page works in any folder of any site.
  base: './',
  resolve: { alias: { hexmill: fileURLToPath(new URL('./www/lib/index.ts', import.meta.url)) } },
  server: { headers },
  preview: { headers },
  worker: { format: 'es' },
  build: { outDir: 'site', target: 'es2022', assetsInlineLimit: 0 },
});
