// The built package in Node, with its real modules and worker threads.

import { createMesher } from 'hexmill';
import type { Mesher, Progress, QuadOptions } from 'hexmill';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { cases } from '../fixtures/cases.js';

const SQUARE = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n';

/** Enough work for seconds, so that there is something to cancel. */
const MUCH: QuadOptions = { levels: 12, maxQuads: 2 ** 30 };

describe.each([1, 2, 4])('on %i threads', (threads) => {
  let mesher: Mesher;
  beforeAll(async () => {
    mesher = await createMesher({ threads });
  });
  afterAll(() => mesher.terminate());

  it('uses that many', () => expect(mesher.threads).toBe(threads));

  it.each(cases())('makes the mesh of the fixture: $name', async ({ obj, options, quads, nodes, hash }) => {
    const mesh = await mesher.refineQuads(obj, options);
    expect({ quads: mesh.quads.length / 4, nodes: mesh.nodes.length / 3, hash: mesh.hash }).toEqual({ quads, nodes, hash });
    expect(mesh.level).toHaveLength(quads);
    expect(mesh.parent).toHaveLength(quads);
    expect(mesh.quads.every((node) => node < nodes)).toBe(true);
  });

  it('loads a surface once for several meshes', async () => {
    using surface = await mesher.load(SQUARE, { name: 'square.obj' });
    expect(surface.info).toMatchObject({
      nodes: 4,
      faces: 1,
      quads: 1,
      triangles: 0,
      boundaryEdges: 4,
      components: 1,
      euler: 1,
      longestEdge: 1,
      bounds: { min: [0, 0, 0], max: [1, 1, 0] },
      defects: [],
    });
    expect([...surface.corners]).toEqual([0, 1, 2, 3]);
    const estimate = await mesher.estimateQuads(surface, { levels: 3 });
    expect(estimate).toMatchObject({ quads: 64, nodes: 81, exact: true });
    const mesh = await mesher.refineQuads(surface, { levels: 3 });
    expect(mesh.quads).toHaveLength(4 * 64);
    expect(mesh.quality.scaledJacobian).toMatchObject({ min: 1, max: 1, mean: 1, percentile1: 1 });
    expect(mesh.quality.aspect.histogram.counts.reduce((sum, count) => sum + count)).toBe(64);
    expect(mesh.defects).toEqual([]);
    const angles = await mesh.qualityOf('minAngle');
    expect(angles).toHaveLength(64);
    for (const angle of angles) expect(angle).toBeCloseTo(90, 4);
  });

  it('takes bytes, blobs and arrays', async () => {
    const bytes = new TextEncoder().encode(SQUARE);
    const arrays = {
      nodes: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0),
      corners: Uint32Array.of(0, 1, 2, 3),
    };
    const inputs = [SQUARE, bytes, bytes.slice().buffer, new Blob([bytes]), arrays];
    const hashes = [];
    for (const input of inputs) hashes.push((await mesher.refineQuads(input, { levels: 2 })).hash);
    expect(new Set(hashes).size).toBe(1);
    expect(arrays.nodes).toHaveLength(12);
  });

  it('exports and reads back the same mesh', async () => {
    const mesh = await mesher.refineQuads(SQUARE, { levels: 2 });
    const file = await mesh.export('obj');
    const again = await mesher.load(file, { format: 'obj' });
    expect(again.nodes).toEqual(mesh.nodes);
    expect(again.corners).toEqual(mesh.quads);
  });

  it.each(['vtu', 'vtk', 'msh', 'inp', 'medit'] as const)('exports %s and reads it back', async (format) => {
    const mesh = await mesher.refineQuads(SQUARE, { levels: 2 });
    using again = await mesher.load(await mesh.export(format), { format });
    expect(again.nodes).toEqual(mesh.nodes);
    expect(again.corners).toEqual(mesh.quads);
  });

  it('exports GLB', async () => {
    const mesh = await mesher.refineQuads(SQUARE, { levels: 2 });
    const file = await mesh.export('glb');
    expect(new TextDecoder().decode(file.subarray(0, 4))).toBe('glTF');
    expect(new DataView(file.buffer).getUint32(8, true)).toBe(file.length);
  });

  it('asks a size function once a level', async () => {
    const asked: number[] = [];
    const mesh = await mesher.refineQuads(SQUARE, {
      sizeFunction: async (centers, longest) => {
        asked.push(longest.length);
        expect(centers).toHaveLength(3 * longest.length);
        return longest.map((_, i) => ((centers[3 * i] ?? 1) < 0.6 ? 0.26 : 2));
      },
    });
    expect(asked.length).toBeGreaterThan(1);
    const left = Array.from(mesh.quads, (node) => mesh.nodes[3 * node] ?? 0);
    expect(mesh.defects).toEqual([]);
    expect(Math.max(...left)).toBe(1);
    expect(mesh.quads.length / 4).toBeGreaterThan(4);
  });

  it('refuses a size function of the wrong length', async () => {
    const call = mesher.refineQuads(SQUARE, { sizeFunction: () => new Float64Array(3) });
    await expect(call).rejects.toMatchObject({ name: 'OptionsError', code: 'size-function-length' });
  });

  it('passes on what a size function throws', async () => {
    const call = mesher.refineQuads(SQUARE, {
      sizeFunction: () => {
        throw new RangeError('mine');
      },
    });
    await expect(call).rejects.toThrow(new RangeError('mine'));
  });

  it.each([
    ['v 0 0 0\nv 1 0 0\nf 1 2\n', {}, { name: 'InputError', line: 3 }],
    [SQUARE, { edgeLenght: 1 }, { name: 'OptionsError', code: 'option-unknown' }],
    [SQUARE, { levels: 'many' }, { name: 'OptionsError', code: 'options-invalid' }],
    [SQUARE, { levels: 40 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    [SQUARE, { levels: 12, maxQuads: 1000 }, { name: 'LimitError', code: 'too-many-quads' }],
    [SQUARE, { regions: [{ kind: 'blob', level: 1 }] }, { name: 'OptionsError', code: 'options-invalid' }],
    [null, {}, { name: 'InputError', code: 'input-unknown' }],
  ])('refuses %j with %j', async (input, options, error) => {
    await expect(mesher.refineQuads(input as string, options as QuadOptions)).rejects.toMatchObject(error);
  });

  it('refuses arrays that do not fit together', async () => {
    const nodes = Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0);
    const refuse = (arrays: object, code: string) =>
      expect(mesher.load({ nodes, corners: Uint32Array.of(0, 1, 2, 3), ...arrays })).rejects.toMatchObject({ code });
    await refuse({ corners: Uint32Array.of(0, 1, 2, 9) }, 'array-index-out-of-range');
    await refuse({ corners: Uint32Array.of(0, 1, 2) }, 'array-length');
    await refuse({ nodes: Float64Array.of(0, 0) }, 'array-length');
    await refuse({ nodes: nodes.map((x) => x / 0) }, 'array-not-finite');
    await refuse({ offsets: Uint32Array.of(0, 2, 4) }, 'array-offsets');
  });

  it('tells progress that never falls within a stage', async () => {
    const told: Progress[] = [];
    await mesher.refineQuads(SQUARE, { levels: 10, onProgress: (progress) => void told.push(progress) });
    expect(told.length).toBeGreaterThan(0);
    for (const [i, { stage, fraction }] of told.entries()) {
      const before = told[i - 1];
      if (before?.stage === stage) expect(fraction).toBeGreaterThanOrEqual(before.fraction);
      expect(fraction).toBeGreaterThanOrEqual(0);
      expect(fraction).toBeLessThanOrEqual(1);
    }
  });

  it('cancels within 200 ms, and the surface survives', async () => {
    const surface = await mesher.load(SQUARE);
    const before = await mesher.refineQuads(surface, { levels: 2 });
    const abort = new AbortController();
    const stuck = mesher.refineQuads(surface, { ...MUCH, signal: abort.signal });
    let aborted = 0;
    setTimeout(() => {
      aborted = performance.now();
      abort.abort();
    }, 200);
    await expect(stuck).rejects.toMatchObject({ name: 'AbortError', code: 'cancelled' });
    expect(performance.now() - aborted).toBeLessThan(200);
    const after = await mesher.refineQuads(surface, { levels: 2 });
    expect(after.hash).toBe(before.hash);
    expect(await before.export('obj')).toEqual(await after.export('obj'));
  });
});

it('rejects what is pending on termination', async () => {
  const mesher = await createMesher({ threads: 2 });
  const pending = mesher.refineQuads(SQUARE, MUCH);
  setTimeout(() => mesher.terminate(), 50);
  await expect(pending).rejects.toMatchObject({ name: 'HexmillError', code: 'terminated' });
  await expect(mesher.load(SQUARE)).rejects.toMatchObject({ code: 'terminated' });
});

it('survives running out of memory', async () => {
  const mesher = await createMesher({ threads: 1 });
  const call = mesher.refineQuads(SQUARE, { levels: 15, maxLevels: 15, maxQuads: 2 ** 30 });
  await expect(call).rejects.toMatchObject({ name: 'InternalError' });
  expect((await mesher.refineQuads(SQUARE, { levels: 1 })).quads).toHaveLength(16);
  mesher.terminate();
}, 120_000);

it('says where it looked for the module', async () => {
  const call = createMesher({ threads: 1, wasmUrl: new URL('file:///nowhere/mesher.wasm') });
  await expect(call).rejects.toMatchObject({ code: 'module-not-loaded', message: expect.stringContaining('nowhere') });
});

it('refuses a number of threads that is none', async () => {
  await expect(createMesher({ threads: 0 })).rejects.toMatchObject({ name: 'OptionsError', code: 'threads-invalid' });
});
