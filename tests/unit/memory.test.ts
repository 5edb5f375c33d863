// What refinement of hexes takes of WebAssembly's memory, held against the figure by which meshes are refused.

import { readFileSync } from 'node:fs';

import { MOST_HEXES } from 'hexmill';
import type { HexOptions } from 'hexmill';
import { expect, it } from 'vitest';

import type * as Hexes from '../../www/wasm/hexes/hexes.js';

/** Memory for a mesh and the work on it, as in src/web/memory.rs. */
const MESH_MEMORY = 1_650_000_000;

const WASM = new URL('../../www/wasm/hexes/', import.meta.url);

Object.assign(globalThis, { hexmillWorker: { panicked: () => {}, progressed: () => {} } });

/** A fresh instance: memory never shrinks. */
async function instance(name: string): Promise<[bindings: typeof Hexes, memory: WebAssembly.Memory]> {
  const bindings: typeof Hexes = await import(/* @vite-ignore */ `${new URL('hexes.js', WASM)}?${name}`);
  const { memory } = await bindings.default({ module_or_path: readFileSync(new URL('hexes.wasm', WASM)) });
  return [bindings, memory];
}

const ball = (level: number): HexOptions => ({ regions: [{ kind: 'sphere', center: [6, 6, 6], radius: 3, level }] });

it.each<[name: string, options: HexOptions]>([
  ['everything', { levels: 2 }],
  ['Method I', { method: 'one', ...ball(2) }],
  ['Method II', { method: 'two', ...ball(2) }],
  ['3-refinement', { method: 'three', ...ball(1) }],
])('a hex of a result takes no more than is reckoned with: %s', async (name, options) => {
  const [bindings, memory] = await instance(encodeURIComponent(name));
  const before = memory.buffer.byteLength;
  using grid = bindings.HexMesh.grid({ min: [0, 0, 0], max: [12, 12, 12], spacing: 1 });
  using refined = bindings.refineHexes(grid, options);
  refined.defects();
  const bytes = (memory.buffer.byteLength - before) / refined.level().length;
  expect(bytes).toBeLessThan(MESH_MEMORY / MOST_HEXES);
  // Not so little that what would fit twice is refused.
  expect(bytes).toBeGreaterThan(MESH_MEMORY / MOST_HEXES / 2);
});
