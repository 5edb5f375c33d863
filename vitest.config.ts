import { fileURLToPath } from 'node:url';
import { defineConfig } from 'vitest/config';

// Tests of the library run what is published.
const hexmill = fileURLToPath(new URL('./dist/lib/node.js', import.meta.url));

// Three suites that `npm test` runs one after the other: they need more and more to be built.
export default defineConfig({
  test: {
    projects: [
      {
        resolve: { alias: { hexmill } },
        test: {
          name: 'unit',
          include: ['tests/unit/**/*.test.ts', 'www/**/*.test.ts'],
          environment: 'node',
          testTimeout: 30_000,
        },
      },
      {
        test: {
          name: 'package',
          include: ['tests/package/**/*.test.ts'],
          environment: 'node',
          testTimeout: 180_000,
          hookTimeout: 180_000,
          fileParallelism: false,
        },
      },
      {
        test: {
          name: 'e2e',
          include: ['tests/e2e/**/*.test.ts'],
          environment: 'node',
          testTimeout: 240_000,
          hookTimeout: 240_000,
          fileParallelism: false,
        },
      },
    ],
  },
});
