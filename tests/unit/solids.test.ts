// Solids in the built package in Node, with its real modules and worker threads.

import { createMesher, HexedSolid, MOST_HEXES_OF_SOLIDS } from 'hexmill';
import type { Mesher, Progress, SolidOptions } from 'hexmill';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { solidCases } from '../fixtures/cases.js';

const CASES = solidCases();
const CUBE = CASES.find(({ name }) => name === 'a cube')?.obj ?? '';
const HOUSE = CASES.find(({ name }) => name === 'a house')?.obj ?? '';

/** The cube as binary STL: two triangles a face. */
const STL = stlOf(CUBE);

/** A cancelled call has to leave the processor to the next within this time, in milliseconds. */
const PROMPT = 200;

/** Times that are measured again, since other programs may hold up a machine: the best counts. */
const ATTEMPTS = 3;

const FORMATS = ['vtu', 'vtk', 'msh', 'inp', 'medit'] as const;

/** So many that making them takes seconds. */
const MUCH: SolidOptions = { edgeLength: 0.015 };

describe.each([1, 2])('solids on %i threads', (threads) => {
  let mesher: Mesher;
  beforeAll(async () => {
    mesher = await createMesher({ threads });
  });
  afterAll(() => mesher.terminate());

  it.each(CASES)('become the mesh of the fixture: $name', async ({ obj, options, hexes, nodes, hash }) => {
    const mesh = await mesher.meshSolid(obj, options);
    expect({ hexes: mesh.hexes.length / 8, nodes: mesh.nodes.length / 3, hash: mesh.hash }).toEqual({ hexes, nodes, hash });
    expect(mesh.defects).toEqual([]);
    expect(mesh.quality).toMatchObject({ notPositive: 0 });
  });

  it('are known by their corners, curves and surfaces before', async () => {
    const plan = await mesher.planSolid(HOUSE, { edgeLength: 0.25 });
    expect(plan.found).toMatchObject({ bodies: 1, voids: 0, corners: 10, curves: 15, surfaces: 7, euler: 2, turnedTriangles: 0 });
    expect(plan.corners).toContainEqual([1, 0, 1.6]);
    expect(plan.volume).toBeCloseTo(1.5 * (2 + 0.6), 12);
    const ridge = plan.curves.find(({ points }) => points.every(([x, , z]) => x === 1 && z === 1.6));
    expect(ridge).toMatchObject({ length: 1.5, isStraight: true, interiorAngle: expect.closeTo(180 - (2 * Math.atan(0.6) * 180) / Math.PI, 9) });
    const [start = -1, end = -1] = ridge?.corners ?? [];
    expect([plan.corners[start], plan.corners[end]]).toEqual([ridge?.points[0], ridge?.points.at(-1)]);
    for (const surface of ridge?.surfaces ?? []) expect(plan.surfaces[surface]?.class).toMatchObject({ kind: 'planar' });
    expect(plan.hexes).toBeGreaterThan(plan.volume / 0.25 ** 3);
    expect(plan.bytes).toBeGreaterThan(plan.hexes ?? 0);
    // The roof's faces meet at 62 degrees.
    expect((await mesher.planSolid(HOUSE, { featureAngle: 70 })).curves).toHaveLength(12);
    expect((await mesher.planSolid(HOUSE)).hexes).toBeNull();
  });

  it('tell the regions that meet nothing of them before', async () => {
    const ball = (x: number) => ({ kind: 'sphere', center: [x, 0.7, 0.5], radius: 0.4, level: 1 }) as const;
    const regions = [ball(5), ball(1), ball(-0.5)];
    expect((await mesher.planSolid(HOUSE, { edgeLength: 0.25, regions })).idleRegions).toEqual([0, 2]);
    expect((await mesher.planSolid(HOUSE, { edgeLength: 0.25 })).idleRegions).toEqual([]);
  });

  it('are the same from text, bytes, STL and a surface that was loaded', async () => {
    using surface = await mesher.load(CUBE);
    const bytes = new TextEncoder().encode(CUBE);
    const hashes: string[] = [];
    for (const input of [CUBE, bytes, bytes.buffer, new Blob([bytes]), STL, surface]) {
      using mesh = await mesher.meshSolid(input, { edgeLength: 0.25 });
      expect(mesh).toBeInstanceOf(HexedSolid);
      hashes.push(mesh.hash);
    }
    expect(new Set(hashes).size).toBe(1);
  });

  it('tell what became of their features, and how far the mesh is from them', async () => {
    const mesh = await mesher.meshSolid(HOUSE, { edgeLength: 0.3 });
    const { features, distance, hexes } = mesh.result;
    expect(hexes).toBe(mesh.hexes.length / 8);
    expect(features).toMatchObject({ corners: { found: 10, captured: 10 }, curves: { found: 15, captured: 15 }, surfaces: { found: 7, captured: 7 }, suppressed: [], lostSurfaces: [] });
    const distances = await mesh.distances();
    expect(distances).toHaveLength(hexes);
    const boundary = new Set(Array.from(mesh.groupedFaces).flatMap((side, i) => (i % 2 === 0 ? [Math.floor(side / 6)] : [])));
    distances.forEach((d: number, hex: number) => expect(Number.isNaN(d)).toBe(!boundary.has(hex)));
    const most = Math.max(...distances.filter((d: number) => !Number.isNaN(d)));
    expect(most).toBeLessThan(1e-3);
    expect(distance.meshToSurface.max).toBeLessThan(1e-3);
    expect(new Set(Array.from(mesh.groupedFaces).filter((_, i) => i % 2 === 1))).toEqual(new Set([0, 1, 2, 3, 4, 5, 6]));
  });

  it('have no group for a body that is too thin for any of them', async () => {
    const points = (size: number, far: number): string => [...Array(8).keys()].map((k) => `v ${[k & 1, (k >> 1) & 1, k >> 2].map((c) => far + size * c).join(' ')}\n`).join('');
    const quads = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [2, 4, 8, 6], [4, 3, 7, 8], [3, 1, 5, 7]];
    const faces = (first: number): string => quads.map((quad) => `f ${quad.map((k) => first + k).join(' ')}\n`).join('');
    const mesh = await mesher.meshSolid(points(2, 0) + faces(0) + points(0.01, 3) + faces(8), { edgeLength: 0.5 });
    expect(mesh.result.lostBodies).toMatchObject([{ id: 1 }]);
    const text = new TextDecoder().decode(await mesh.export('msh'));
    expect([1, 2].map((body) => text.includes(`"body-${body}"`))).toEqual([true, false]);
  });

  it.each(FORMATS)('are written as %s and read back, with their surfaces as groups', async (format) => {
    const mesh = await mesher.meshSolid(CUBE, { edgeLength: 0.5 });
    using again = await mesher.loadHexes(await mesh.export(format), { name: 'mesh.dat' });
    expect(again.info).toMatchObject({ hash: mesh.hash, groupedFaces: 24, droppedFaces: 0 });
    expect(again.info.groups).toHaveLength(6);
  });

  it.each(['vtu', 'msh', 'inp'] as const)('keep the names that the input has for their surfaces: %s', async (format) => {
    const mesh = await mesher.meshSolid(CUBE.replace(/^f/m, 'g inlet\nf'), { edgeLength: 0.5 });
    expect(mesh.report.solid.surfaceGroups).toEqual(Array(6).fill(['inlet']));
    using again = await mesher.loadHexes(await mesh.export(format), { name: 'mesh.dat' });
    const names = again.info.groups.flatMap((group) => group.names);
    expect([...new Set(names)].sort()).toEqual(['inlet', ...[1, 2, 3, 4, 5, 6].map((surface) => `surface-${surface}`)]);
  });

  it.each([
    ['hex20', 20, 'msh'],
    ['hex27', 27, 'vtu'],
  ] as const)('of the second order have nodes on the solid: %s', async (secondOrder, perHex, format) => {
    const mesh = await mesher.meshSolid(CUBE, { edgeLength: 0.5, secondOrder });
    if (!mesh.secondOrder) throw new Error('hexes are linear');
    const { hex, nodes, hexes } = mesh.secondOrder;
    expect(hex).toBe(secondOrder);
    const count = mesh.hexes.length / 8;
    expect(hexes).toHaveLength(perHex * count);
    expect(mesh.report.secondOrder).toMatchObject({ hex, nodes: nodes.length / 3, yielded: 0 });
    // The first of the nodes on edges are between the first two corners.
    const all = [...mesh.nodes, ...nodes];
    const x = (node = -1): number => all[3 * node] ?? Number.NaN;
    for (let h = 0; h < count; h++) {
      const own = hexes.slice(perHex * h, perHex * (h + 1));
      expect([...own.slice(0, 8)]).toEqual([...mesh.hexes.slice(8 * h, 8 * h + 8)]);
      expect(x(own[8])).toBeCloseTo((x(own[0]) + x(own[1])) / 2, 9);
    }
    const file = await mesh.export(format);
    using again = await mesher.loadHexes(file, { name: `mesh.${format}` });
    expect(again.info).toMatchObject({ hash: mesh.hash, linearized: count, unusedNodes: 0, groupedFaces: 24, droppedFaces: 0 });
    await expect(mesh.export('medit')).rejects.toMatchObject({ name: 'OptionsError' });
  });

  it('have a measure each', async () => {
    const mesh = await mesher.meshSolid(CUBE, { edgeLength: 0.5 });
    for (const volume of await mesh.qualityOf('volume')) expect(volume).toBeCloseTo(0.125, 6);
  });

  it.each([
    ['with an open surface', CUBE.replace(/f 4 1 5 8\n/, ''), {}, { name: 'InputError', code: 'surface-open', message: expect.stringMatching(/4 edges/) }],
    ['without volume', 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n', {}, { name: 'InputError' }],
    ['without faces', 'v 0 0 0\n', {}, { name: 'InputError', code: 'surface-empty' }],
    ['that cannot be read', 'f 1 2 3\n', {}, { name: 'InputError', line: 1 }],
    ['with a misspelt option', CUBE, { edgeLenght: 1 }, { name: 'OptionsError', code: 'option-unknown' }],
    ['with an edge length of 0', CUBE, { edgeLength: 0 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    ['with cells larger than it', CUBE, { edgeLength: 50 }, { name: 'OptionsError', code: 'edge-length-too-large' }],
    ['with more levels than there are', CUBE, { maxLevels: 9 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    ['with a distance of 0', CUBE, { maxDistance: 0 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    ['with an angle out of range', CUBE, { featureAngle: 200 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    ['with more hexes than allowed', CUBE, { edgeLength: 0.05, maxHexes: 1000 }, { name: 'LimitError', code: 'too-many-hexes' }],
    ['with more hexes than memory holds', CUBE, { edgeLength: 1e-4 }, { name: 'LimitError', code: 'memory-exceeded' }],
  ])('are refused %s', async (_, obj, options, error) => {
    await expect(mesher.meshSolid(obj, { edgeLength: 0.5, ...options } as SolidOptions)).rejects.toMatchObject(error);
  });

  it('are planned with no options that they cannot have', async () => {
    for (const options of [{ maxLevels: 9 }, { maxDistance: 0 }, { curvature: -1 }, { edgeLength: Number.NaN }]) {
      const planned = mesher.planSolid(CUBE, { edgeLength: 0.5, ...options });
      await expect(planned).rejects.toMatchObject({ name: 'OptionsError', code: 'option-out-of-range' });
    }
  });

  it('that would not fit are refused with what fits', async () => {
    const message = expect.stringMatching(new RegExp(`which hold ${MOST_HEXES_OF_SOLIDS} hexes`));
    await expect(mesher.meshSolid(CUBE, { edgeLength: 1e-4 })).rejects.toMatchObject({ message });
  });

  it('tell progress by stage, which never falls within one', async () => {
    const reached = new Map<string, number>();
    await mesher.meshSolid(CUBE, {
      edgeLength: 0.02,
      onProgress: ({ stage, fraction }: Progress) => {
        expect(fraction).toBeGreaterThanOrEqual(reached.get(stage) ?? 0);
        expect(fraction).toBeLessThanOrEqual(1);
        reached.set(stage, fraction);
      },
    });
    expect(reached.size).toBeGreaterThan(1);
  });

  it('are cancelled within 200 ms, and planned meanwhile', async () => {
    const before = await mesher.meshSolid(CUBE, { edgeLength: 0.25 });
    const delays: number[] = [];
    for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
      const abort = new AbortController();
      const stuck = mesher.meshSolid(CUBE, { ...MUCH, signal: abort.signal });
      stuck.catch(() => {});
      expect((await mesher.planSolid(CUBE, MUCH)).curves).toHaveLength(12);
      await new Promise((later) => setTimeout(later, 300));
      const aborted = performance.now();
      abort.abort();
      await expect(stuck).rejects.toMatchObject({ name: 'AbortError', code: 'cancelled' });
      expect(performance.now() - aborted).toBeLessThan(PROMPT);
      const after = await mesher.meshSolid(CUBE, { edgeLength: 0.5 });
      delays.push(performance.now() - aborted);
      expect(after.hexes).toHaveLength(64);
    }
    expect(Math.min(...delays), `milliseconds from abort to the next answer: ${delays}`).toBeLessThan(PROMPT);
    expect(await before.distances()).toHaveLength(64);
  });
});

/** An OBJ of quads as binary STL. */
function stlOf(obj: string): Uint8Array {
  const points = [...obj.matchAll(/^v (\S+) (\S+) (\S+)$/gm)].map(([, ...xyz]) => xyz.map(Number));
  const quads = [...obj.matchAll(/^f (\d+) (\d+) (\d+) (\d+)$/gm)].map(([, ...nodes]) => nodes.map((node) => Number(node) - 1));
  const triangles = quads.flatMap(([a = 0, b = 0, c = 0, d = 0]) => [[a, b, c], [a, c, d]]);
  const bytes = new DataView(new ArrayBuffer(84 + 50 * triangles.length));
  bytes.setUint32(80, triangles.length, true);
  triangles.forEach((triangle, t) => {
    triangle.forEach((node, k) => points[node]?.forEach((x, axis) => bytes.setFloat32(84 + 50 * t + 12 + 12 * k + 4 * axis, x, true)));
  });
  return new Uint8Array(bytes.buffer);
}
