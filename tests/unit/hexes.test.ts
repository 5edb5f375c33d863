// Hexes in the built package in Node, with its real modules and worker threads.

import { createMesher, HexMesh, MOST_HEXES, Surface } from 'hexmill';
import type { GridOptions, HexArrays, HexOptions, Mesher, Progress, SizeFunction } from 'hexmill';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { hexCases } from '../fixtures/cases.js';
import { refineHexCase } from '../package/fixtures/hex-case.js';

/** Two unit cubes side by side. */
const TWO: HexArrays = {
  nodes: Float64Array.from(Array.from({ length: 12 }, (_, n) => [n % 3, Math.floor(n / 3) % 2, Math.floor(n / 6)]).flat()),
  hexes: Uint32Array.of(0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10),
};

/** The same as MEDIT, with a reference a cube. */
const TAGGED = `MeshVersionFormatted 2
Dimension 3
Vertices
12
${Array.from({ length: 12 }, (_, n) => `${TWO.nodes.slice(3 * n, 3 * n + 3).join(' ')} 0`).join('\n')}
Hexahedra
2
1 2 5 4 7 8 11 10 3
2 3 6 5 8 9 12 11 7
Quadrilaterals
3
1 4 10 7 5
3 6 12 9 9
2 5 11 8 4
End
`;

const SQUARE = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n';

/** A ball whose transitions take long to smooth, in a grid of {@link MANY}. */
const MUCH: HexOptions = { method: 'two', regions: [{ kind: 'sphere', center: [5, 5, 5], radius: 3, level: 3 }] };
const MANY = { min: [0, 0, 0], max: [10, 10, 10] } as const;

/** A cancelled call has to leave the processor to the next within this time, in milliseconds. */
const PROMPT = 200;

/** Times that are measured again, since other programs may hold up a machine: the best counts. */
const ATTEMPTS = 3;

const FORMATS = ['vtu', 'vtk', 'msh', 'inp', 'medit'] as const;

describe.each([1, 2, 4])('hexes on %i threads', (threads) => {
  let mesher: Mesher;
  beforeAll(async () => {
    mesher = await createMesher({ threads });
  });
  afterAll(() => mesher.terminate());

  it.each(hexCases())('become the mesh of the fixture: $name', async ({ hexes, nodes, hash, ...given }) => {
    const mesh = await refineHexCase(mesher, given);
    expect({ hexes: mesh.hexes.length / 8, nodes: mesh.nodes.length / 3, hash: mesh.hash }).toEqual({ hexes, nodes, hash });
    expect(mesh.level).toHaveLength(hexes);
    expect(mesh.parent).toHaveLength(hexes);
    expect(mesh.hexes.every((node: number) => node < nodes)).toBe(true);
    expect(mesh.defects).toEqual([]);
    expect(mesh.quality).toMatchObject({ notPositive: 0, undecided: 0 });
    expect(mesh.quality.scaledJacobian.min).toBeGreaterThan(0.2);
  });

  it('are loaded once for several meshes', async () => {
    using mesh = await mesher.loadHexes(TAGGED, { name: 'two.mesh' });
    expect(mesh.info).toMatchObject({
      nodes: 12,
      unusedNodes: 0,
      edges: 20,
      faces: 11,
      hexes: 2,
      boundaryFaces: 10,
      components: 1,
      euler: 1,
      longestEdge: 1,
      shortestEdge: 1,
      meanEdge: 1,
      bounds: { min: [0, 0, 0], max: [2, 1, 1] },
      turned: 0,
      groupedFaces: 3,
      linearized: 0,
      hidden: 0,
      droppedFaces: 0,
      groups: [
        { names: [], number: 4 },
        { names: [], number: 5 },
        { names: [], number: 9 },
      ],
      defects: [],
      quality: { scaledJacobian: { min: 1, max: 1 }, volume: { mean: 1 }, totalVolume: 2, notPositive: 0 },
    });
    expect([...mesh.hexes]).toEqual([...TWO.hexes]);
    expect([...mesh.nodes]).toEqual([...TWO.nodes]);
    const coarse = await mesher.refineHexes(mesh, { levels: 1 });
    const fine = await mesher.refineHexes(mesh, { levels: 2 });
    expect([coarse.hexes.length / 8, fine.hexes.length / 8]).toEqual([16, 128]);
    expect([...new Set(fine.level)]).toEqual([2]);
    expect(Array.from(fine.parent).filter((parent) => parent === 1)).toHaveLength(64);
    expect(fine.quality.totalVolume).toBeCloseTo(2, 12);
    expect((await mesher.refineHexes(mesh)).hash).toBe(mesh.info.hash);
  });

  it('are taken as text, bytes, blobs and arrays', async () => {
    const bytes = new TextEncoder().encode(TAGGED);
    const hashes = [];
    for (const input of [TAGGED, bytes, bytes.slice().buffer, new Blob([bytes]), TWO]) {
      hashes.push((await mesher.refineHexes(input, { levels: 1 })).hash);
    }
    expect(new Set(hashes).size).toBe(1);
    expect(TWO.nodes).toHaveLength(36);
  });

  it.each(FORMATS)('are written as %s and read back, with their tags, whatever the name', async (format) => {
    using mesh = await mesher.loadHexes(TAGGED);
    const refined = await mesher.refineHexes(mesh, { levels: 1 });
    const file = await refined.export(format);
    using again = await mesher.loadHexes(file, { name: 'mesh.dat' });
    expect(again.nodes).toEqual(refined.nodes);
    expect(again.hexes).toEqual(refined.hexes);
    expect(again.info.hash).toBe(refined.hash);
    expect(refined.groupedFaces).toHaveLength(2 * 12);
    expect(again.info).toMatchObject({ groupedFaces: 12, droppedFaces: 0 });
    expect(again.info.groups.map(({ number, names }) => number ?? names[0]).sort()).toEqual([4, 5, 9]);
    const medit = await (await mesher.refineHexes(again)).export('medit');
    const references = new TextDecoder().decode(medit).match(/^(\d+ ){8}(?=[37]$)/gm);
    expect(references).toHaveLength(16);
  });

  it('are shown by their boundary as GLB, and not as OBJ', async () => {
    const mesh = await mesher.refineHexes(TWO);
    expect(new TextDecoder().decode((await mesh.export('glb')).subarray(0, 4))).toBe('glTF');
    await expect(mesh.export('obj' as 'vtk')).rejects.toMatchObject({ name: 'OptionsError', code: 'format-holds-no-hexes' });
  });

  it('are told from surfaces', async () => {
    expect(await mesher.loadFile(TAGGED)).toBeInstanceOf(HexMesh);
    expect(await mesher.loadFile(SQUARE)).toBeInstanceOf(Surface);
    await expect(mesher.load(TAGGED)).rejects.toMatchObject({ name: 'InputError', code: 'surface-expected' });
    await expect(mesher.loadHexes(SQUARE)).rejects.toMatchObject({ name: 'InputError', code: 'hexes-expected' });
  });

  it('are turned where they are inside out, and refused where they are so in part', async () => {
    const mirrored = { ...TWO, hexes: Uint32Array.of(6, 7, 10, 9, 0, 1, 4, 3, ...TWO.hexes.subarray(8)) };
    using mesh = await mesher.loadHexes(mirrored);
    expect(mesh.info).toMatchObject({ turned: 1, defects: [] });
    expect([...mesh.hexes]).toEqual([...TWO.hexes]);
    expect(await mesher.refineHexes(mesh, { levels: 1 })).toMatchObject({ turned: 1, defects: [] });

    // A corner of the first cube pulled through it.
    const dented = { ...TWO, nodes: TWO.nodes.map((x, i) => (i < 3 ? 0.9 : x)) };
    using bad = await mesher.loadHexes(dented);
    expect(bad.info.defects.join()).toMatch(/hex 0 is inside out at/);
    expect(bad.info.quality).toMatchObject({ notPositive: 1 });
    await expect(mesher.refineHexes(bad)).rejects.toMatchObject({ name: 'InputError', code: 'mesh-inverted' });
    await expect(mesher.planHexes(bad)).rejects.toMatchObject({ name: 'InputError', code: 'mesh-inverted' });
  });

  it.each([
    [{ hexes: Uint32Array.of(0, 1, 4, 3, 6, 7, 10, 12) }, 'array-index-out-of-range'],
    [{ hexes: TWO.hexes.slice(1) }, 'array-length'],
    [{ nodes: TWO.nodes.slice(0, 35) }, 'array-length'],
    [{ nodes: TWO.nodes.map((x) => x / 0) }, 'array-not-finite'],
    [{ hexes: [...TWO.hexes] }, 'input-unknown'],
    [{ nodes: Float32Array.from(TWO.nodes) }, 'input-unknown'],
  ])('are refused as arrays that do not fit together: %#', async (arrays, code) => {
    await expect(mesher.loadHexes({ ...TWO, ...arrays } as HexArrays)).rejects.toMatchObject({ name: 'InputError', code });
  });

  it.each([
    ['none', Uint32Array.of(), 'mesh-empty'],
    ['a node twice', Uint32Array.of(0, 1, 4, 3, 6, 7, 10, 10), 'mesh-invalid'],
    ['a hex twice', Uint32Array.of(...TWO.hexes, ...TWO.hexes), 'mesh-invalid'],
  ])('are loaded and not refined where they are no mesh: %s', async (_, hexes, code) => {
    using mesh = await mesher.loadHexes({ ...TWO, hexes });
    if (code === 'mesh-invalid') expect(mesh.info.defects).not.toEqual([]);
    await expect(mesher.refineHexes(mesh, { levels: 1 })).rejects.toMatchObject({ name: 'InputError', code });
  });

  it('make a grid around a surface, a box, and hexes', async () => {
    using square = await mesher.load(SQUARE);
    const options: GridOptions = { spacing: 0.5, margin: 0.5 };
    using around = await mesher.makeGrid(square, options);
    expect(around.info).toMatchObject({ hexes: 4 * 4 * 2, bounds: { min: [-0.5, -0.5, -0.5], max: [1.5, 1.5, 0.5] }, defects: [] });
    const box = { min: [0, 0, 0], max: [1, 1, 0] } as const;
    expect((await mesher.makeGrid(SQUARE, options)).info.hash).toBe(around.info.hash);
    expect((await mesher.makeGrid(box, options)).info.hash).toBe(around.info.hash);
    expect((await mesher.makeGrid(around, { spacing: 1 })).info.hexes).toBe(4);
    const fitted = await mesher.makeGrid(box, { spacing: 0.3, margin: 0.1, fitted: true });
    expect(fitted.info).toMatchObject({ hexes: 16, longestEdge: expect.closeTo(0.3, 12), defects: [] });
  });

  it.each([
    [{}, { name: 'OptionsError', code: 'options-invalid' }],
    [{ spacing: 0 }, { name: 'OptionsError', code: 'spacing-out-of-range' }],
    [{ spacing: 1, margin: -1 }, { name: 'OptionsError', code: 'margin-out-of-range' }],
    [{ spacing: 1, margins: 1 }, { name: 'OptionsError', code: 'option-unknown' }],
    [{ spacing: 1e-20 }, { name: 'LimitError' }],
    [{ spacing: 0.1, maxHexes: 99 }, { name: 'LimitError', code: 'too-many-hexes' }],
    [{ spacing: 1e-3 }, { name: 'LimitError', code: 'memory-exceeded' }],
  ])('refuse a grid of %j', async (options, error) => {
    const box = { min: [0, 0, 0], max: [1, 1, 1] } as const;
    await expect(mesher.makeGrid(box, options as GridOptions)).rejects.toMatchObject(error);
  });

  it('refuse a grid around nothing', async () => {
    const empty = { nodes: new Float64Array(), corners: new Uint32Array(), offsets: Uint32Array.of(0) };
    await expect(mesher.makeGrid(empty, { spacing: 1 })).rejects.toMatchObject({ name: 'InputError', code: 'surface-empty' });
  });

  it.each([
    [{ edgeLenght: 1 }, { name: 'OptionsError', code: 'option-unknown' }],
    [{ method: 'four' }, { name: 'OptionsError', code: 'options-invalid' }],
    [{ curvature: 10 }, { name: 'OptionsError', code: 'option-unknown' }],
    [{ levels: 'many' }, { name: 'OptionsError', code: 'options-invalid' }],
    [{ levels: 9 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    [{ maxLevels: 21 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    [{ gradation: 3 }, { name: 'OptionsError' }],
    [{ levels: 4, maxHexes: 1000 }, { name: 'LimitError', code: 'too-many-hexes' }],
    [{ levels: 8 }, { name: 'LimitError', code: 'memory-exceeded' }],
    [{ levels: 8, maxHexes: 2 ** 28 }, { name: 'LimitError', code: 'memory-exceeded' }],
    [{ levels: 1, maxHexes: 2 ** 29 }, { name: 'OptionsError', code: 'option-out-of-range' }],
    [{ regions: [{ kind: 'sphere', centre: [0, 0, 0], radius: 1, level: 1 }] }, { name: 'OptionsError', code: 'option-unknown' }],
    [{ regions: [{ kind: 'sphere', center: [0, 0, 0], radius: -1, level: 1 }] }, { name: 'OptionsError' }],
  ])('are not refined with %j', async (options, error) => {
    await expect(mesher.refineHexes(TWO, options as HexOptions)).rejects.toMatchObject(error);
    await expect(mesher.planHexes(TWO, options as HexOptions)).rejects.toMatchObject(error);
  });

  it('that would not fit are refused with what fits and what to do', async () => {
    const message = expect.stringMatching(new RegExp(`which hold ${MOST_HEXES} hexes: give a larger edge length, fewer levels`));
    await expect(mesher.refineHexes(TWO, { levels: 8 })).rejects.toMatchObject({ message });
  });

  it('are refined near points and surfaces', async () => {
    using grid = await mesher.makeGrid({ min: [0, 0, 0], max: [4, 4, 4] }, { spacing: 1 });
    const surface = { kind: 'surface', positions: [[0, 0, 1.1], [4, 0, 1.1], [0, 4, 1.1]], triangles: [[0, 1, 2]], distance: 0.1, level: 1 } as const;
    const points = { kind: 'points', points: [[3.5, 3.5, 3.5]], radius: 0.1, level: 2 } as const;
    const mesh = await mesher.refineHexes(grid, { method: 'two', regions: [surface, points] });
    const deepest = Array.from(mesh.parent).filter((_, hex) => mesh.level[hex] === 2);
    expect(new Set(deepest)).toEqual(new Set([63]));
    expect(mesh.defects).toEqual([]);
  });

  it('say before the work what the method adds, and after it what was done', async () => {
    using grid = await mesher.makeGrid({ min: [0, 0, 0], max: [4, 4, 4] }, { spacing: 1 });
    const options: HexOptions = { regions: [{ kind: 'box', min: [1, 1, 1], max: [3, 3, 3], level: 2 }] };
    // The paper's formulas for the middle 4 x 4 x 4 of 8 x 8 x 8.
    for (const [method, hexes] of [['one', 1896], ['two', 1632]] as const) {
      const plan = await mesher.planHexes(grid, { ...options, method });
      expect(plan).toMatchObject({ treeHexes: 8 ** 3 + 7 * 4 ** 3, hexes, stages: [{ refined: 64 }, { refined: 64, interfaceFaces: 96, hexes }] });
      expect(plan.added).toEqual({ base: 56, families: 0, balance: 0, method: 0, conflicts: 0, repairs: 0 });
      expect(plan.transition).toBe(plan.stages.reduce((sum, { transition }) => sum + transition, 0));
      expect(plan.bytes).toBe(hexes * 600);
      expect(plan).toMatchObject({ capped: 0, turned: 0, idleRegions: [], coincidentNodes: 0 });
      const mesh = await mesher.refineHexes(grid, { ...options, method });
      expect(mesh.hexes.length / 8).toBe(hexes);
      expect(mesh.added).toEqual({ base: 56, families: 0, balance: 0, method: 0, conflicts: 0, repairs: 0 });
      expect(mesh.stages).toHaveLength(2);
      expect(mesh.stages[1]).toMatchObject({ refined: 64, interfaceFaces: 96, pinchedEdges: 0 });
    }
    // Two hexes that touch at an edge are whole families for Method II; Method I fills the corners between them.
    const touching: HexOptions = {
      regions: [
        { kind: 'box', min: [1, 1, 1], max: [2, 2, 2], level: 2 },
        { kind: 'box', min: [2, 2, 1], max: [3, 3, 2], level: 2 },
      ],
    };
    const one = await mesher.planHexes(grid, { ...touching, method: 'one' });
    expect(one.added.method).toBeGreaterThan(0);
    const made = await mesher.refineHexes(grid, { ...touching, method: 'one' });
    expect(made.added).toMatchObject(one.added);
  });

  it('refuse to grow where that is wanted, with the place', async () => {
    using grid = await mesher.makeGrid({ min: [0, 0, 0], max: [5, 5, 5] }, { spacing: 1 });
    const options: HexOptions = { growth: 'refuse', regions: [{ kind: 'box', min: [1, 1, 1], max: [4, 4, 4], level: 1 }] };
    const error = { name: 'OptionsError', code: 'growth-refused', message: expect.stringMatching(/^elements of level 0 that nothing asks for \(37\) .* the first around/) };
    await expect(mesher.planHexes(grid, options)).rejects.toMatchObject(error);
    await expect(mesher.refineHexes(grid, options)).rejects.toMatchObject(error);
    expect((await mesher.refineHexes(grid, { ...options, method: 'three' })).added.base).toBe(0);
  });

  it('tell of regions that meet nothing', async () => {
    const away = { kind: 'sphere', center: [90, 0, 0], radius: 1, level: 2 } as const;
    const plan = await mesher.planHexes(TWO, { regions: [away, { kind: 'sphere', center: [0, 0, 0], radius: 0.1, level: 1 }, away] });
    expect(plan.idleRegions).toEqual([0, 2]);
  });

  it('are planned by a size function as they are refined', async () => {
    const sizeFunction: SizeFunction = (centers, longest) => longest.map((_, k) => ((centers[3 * k] ?? 0) < 1 ? 0.3 : 1));
    const options = { method: 'two', sizeFunction } as const;
    const plan = await mesher.planHexes(TWO, options);
    const mesh = await mesher.refineHexes(TWO, options);
    expect(plan.hexes).toBe(mesh.hexes.length / 8);
    expect(plan.stages.length).toBe(2);
  });

  it('ask a size function once a level', async () => {
    const asked: number[] = [];
    const mesh = await mesher.refineHexes(TWO, {
      method: 'two',
      sizeFunction: async (centers, longest) => {
        asked.push(longest.length);
        expect(centers).toHaveLength(3 * longest.length);
        return longest.map((_, hex) => ((centers[3 * hex] ?? 2) < 1 ? 0.26 : 2));
      },
    });
    expect(asked).toEqual([2, 16, 64]);
    expect(mesh.defects).toEqual([]);
    expect([...new Set(mesh.level)].sort()).toEqual([1, 2]);
    expect(Array.from(mesh.level).filter((level) => level === 2)).toHaveLength(64);
    const refused = mesher.refineHexes(TWO, { sizeFunction: () => new Float64Array(3) });
    await expect(refused).rejects.toMatchObject({ name: 'OptionsError', code: 'size-function-length' });
    const zero = mesher.refineHexes(TWO, { sizeFunction: (_, longest) => longest.map(() => Number.NaN) });
    await expect(zero).rejects.toMatchObject({ name: 'OptionsError', code: 'size-function-value' });
    const thrown = mesher.refineHexes(TWO, {
      sizeFunction: () => {
        throw new RangeError('mine');
      },
    });
    await expect(thrown).rejects.toThrow(new RangeError('mine'));
  });

  it('tell how many are coarser than asked for', async () => {
    const ball = { kind: 'sphere', center: [0, 0, 0], radius: 0.1, level: 3 } as const;
    expect((await mesher.refineHexes(TWO, { regions: [ball], maxLevels: 1 })).capped).toBeGreaterThan(0);
    expect((await mesher.refineHexes(TWO, { regions: [ball] })).capped).toBe(0);
  });

  it.each(['scaledJacobian', 'aspect', 'volume'] as const)('have a %s each', async (metric) => {
    const mesh = await mesher.refineHexes(TWO, { levels: 1 });
    const values = await mesh.qualityOf(metric);
    expect([...values]).toEqual(Array.from({ length: 16 }, () => (metric === 'volume' ? 0.125 : 1)));
  });

  it('tell progress that never falls within a stage', async () => {
    const told: Progress[] = [];
    using grid = await mesher.makeGrid(MANY, { spacing: 2.5 });
    await mesher.refineHexes(grid, { ...MUCH, maxLevels: 2, onProgress: (progress) => void told.push(progress) });
    expect(told.length).toBeGreaterThan(0);
    const reached = new Map<string, number>();
    for (const { stage, fraction } of told) {
      expect(fraction).toBeGreaterThanOrEqual(reached.get(stage) ?? 0);
      expect(fraction).toBeLessThanOrEqual(1);
      reached.set(stage, fraction);
    }
  });

  it('are cancelled within 200 ms: the work stops, the next call is answered, the mesh survives', async () => {
    using grid = await mesher.makeGrid(MANY, { spacing: 1 });
    using two = await mesher.loadHexes(TWO);
    const before = await mesher.refineHexes(two, { levels: 1 });
    const delays: number[] = [];
    for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
      const abort = new AbortController();
      let aborted = 0;
      const onProgress = ({ stage }: Progress): void => {
        if (stage === 'smoothing' && aborted === 0) {
          aborted = performance.now();
          abort.abort();
        }
      };
      const stuck = mesher.refineHexes(grid, { ...MUCH, signal: abort.signal, onProgress });
      await expect(stuck).rejects.toMatchObject({ name: 'AbortError', code: 'cancelled' });
      expect(performance.now() - aborted).toBeLessThan(PROMPT);
      const after = await mesher.refineHexes(two, { levels: 1 });
      delays.push(performance.now() - aborted);
      expect(after.hash).toBe(before.hash);
    }
    expect(Math.min(...delays), `milliseconds from abort to the next answer: ${delays}`).toBeLessThan(PROMPT);
    expect((await before.export('vtk')).length).toBeGreaterThan(1000);
  });

  it('are planned while others are refined', async () => {
    using grid = await mesher.makeGrid(MANY, { spacing: 1 });
    await mesher.planHexes(TWO);
    const abort = new AbortController();
    let isMeshing = true;
    const meshing = mesher.refineHexes(grid, { ...MUCH, signal: abort.signal }).finally(() => (isMeshing = false));
    meshing.catch(() => {});
    expect((await mesher.planHexes(grid, { levels: 1 })).treeHexes).toBe(8000);
    expect(isMeshing).toBe(true);
    abort.abort();
    await expect(meshing).rejects.toMatchObject({ name: 'AbortError' });
  });

  it('are not used once disposed of, nor by another mesher', async () => {
    const mesh = await mesher.loadHexes(TWO);
    using other = await createMesher({ threads: 1 });
    await expect(other.refineHexes(mesh)).rejects.toMatchObject({ code: 'mesh-of-another-mesher' });
    mesh.dispose();
    await expect(mesher.refineHexes(mesh)).rejects.toMatchObject({ code: 'mesh-disposed' });
    await expect(mesher.planHexes(mesh)).rejects.toMatchObject({ code: 'mesh-disposed' });
    await expect(mesher.makeGrid(mesh, { spacing: 1 })).rejects.toMatchObject({ code: 'mesh-disposed' });
  });
});
