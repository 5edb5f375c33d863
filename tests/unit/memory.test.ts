// What refinement of hexes and filling of solids take of WebAssembly's memory, held against the figures by which meshes are
// refused.

import { readFileSync } from 'node:fs';

import { MOST_HEXES, MOST_HEXES_OF_SOLIDS } from 'hexmill';
import type { HexOptions } from 'hexmill';
import { expect, it } from 'vitest';

import type * as Hexes from '../../www/wasm/hexes/hexes.js';
import type * as Solids from '../../www/wasm/solids/solids.js';
import { solidCases } from '../fixtures/cases.js';

/** Memory for a mesh and the work on it, as in src/web/memory.rs. */
const MESH_MEMORY = 1_650_000_000;

const WASM = new URL('../../www/wasm/', import.meta.url);

Object.assign(globalThis, { hexmillWorker: { panicked: () => {}, progressed: () => {} } });

/** A fresh instance of a module: memory never shrinks. */
async function instance<B extends typeof Hexes | typeof Solids>(module: string, name: string): Promise<[bindings: B, memory: WebAssembly.Memory]> {
  const bindings: B = await import(/* @vite-ignore */ `${new URL(`${module}/${module}.js`, WASM)}?${encodeURIComponent(name)}`);
  const { memory } = await bindings.default({ module_or_path: readFileSync(new URL(`${module}/${module}.wasm`, WASM)) });
  return [bindings, memory];
}

const ball = (level: number): HexOptions => ({ regions: [{ kind: 'sphere', center: [6, 6, 6], radius: 3, level }] });

it.each<[name: string, options: HexOptions]>([
  ['everything', { levels: 2 }],
  ['Method I', { method: 'one', ...ball(2) }],
  ['Method II', { method: 'two', ...ball(2) }],
  ['3-refinement', { method: 'three', ...ball(1) }],
])('a hex of a result takes no more than is reckoned with: %s', async (name, options) => {
  const [bindings, memory] = await instance<typeof Hexes>('hexes', name);
  const before = memory.buffer.byteLength;
  using grid = bindings.HexMesh.grid({ min: [0, 0, 0], max: [12, 12, 12], spacing: 1 });
  using refined = bindings.refineHexes(grid, options);
  const hexes = refined.level().length;
  using mesh = refined.arrays();
  mesh.defects();
  const bytes = (memory.buffer.byteLength - before) / hexes;
  expect(bytes).toBeLessThan(MESH_MEMORY / MOST_HEXES);
  // Not so little that what would fit twice is refused.
  expect(bytes).toBeGreaterThan(MESH_MEMORY / MOST_HEXES / 2);
});

it('nor does a hex that fills a solid', async () => {
  const [bindings, memory] = await instance<typeof Solids>('solids', 'house');
  const house = solidCases().find(({ name }) => name === 'a house')?.obj;
  const before = memory.buffer.byteLength;
  using surface = bindings.Surface.read(new TextEncoder().encode(house), 'obj');
  using hexed = bindings.meshSolid(surface, { edgeLength: 0.08 });
  using mesh = hexed.arrays();
  mesh.defects();
  const bytes = (memory.buffer.byteLength - before) / (mesh.hexes().length / 8);
  expect(bytes).toBeLessThan(MESH_MEMORY / MOST_HEXES_OF_SOLIDS);
  expect(bytes).toBeGreaterThan(MESH_MEMORY / MOST_HEXES_OF_SOLIDS / 3);
});
