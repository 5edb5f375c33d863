// The built package in Node, with its real modules and worker threads.

import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

import { createMesher, MOST_QUADS, MOST_THREADS } from 'hexmill';
import type { Mesher, MesherOptions, OutputFormat, Progress, QuadOptions } from 'hexmill';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';

import { cases } from '../fixtures/cases.js';
import { withLittleMemory } from '../fixtures/small-memory.js';

const SQUARE = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n';

/** Ten squares in a row. */
const ROW = [
  ...Array.from({ length: 11 }, (_, x) => `v ${x} 0 0\nv ${x} 1 0`),
  ...Array.from({ length: 10 }, (_, x) => `f ${2 * x + 1} ${2 * x + 3} ${2 * x + 4} ${2 * x + 2}`),
].join('\n');

/** Enough work on ten squares for seconds, so that there is something to cancel: 10.5 million quads, nearly all that memory holds. */
const MUCH: QuadOptions = { levels: 10 };

/** A cancelled call has to leave the processor to the next within this time, in milliseconds. */
const PROMPT = 200;

/** Times that are measured again, since other programs may hold up a machine: the best counts. */
const ATTEMPTS = 3;

/** The share of one processor that all threads of this process use in the next `milliseconds`. */
async function busyShare(milliseconds: number): Promise<number> {
  const [used, start] = [process.cpuUsage(), performance.now()];
  await new Promise((later) => setTimeout(later, milliseconds));
  const { user, system } = process.cpuUsage(used);
  return (user + system) / 1000 / (performance.now() - start);
}

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

  it.each(cases().flatMap(({ files, ...given }) => Object.entries(files ?? {}).map(([format, digest]) => ({ ...given, format, digest }))))(
    'writes the file of the fixture to the last byte: $name as $format',
    async ({ obj, options, format, digest }) => {
      const mesh = await mesher.refineQuads(obj, options);
      const file = await mesh.export(format as OutputFormat);
      expect(createHash('sha256').update(file).digest('hex')).toBe(digest);
    },
  );

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
    expect(estimate).toMatchObject({ quads: 64, nodes: 81, exact: true, idleRegions: [] });
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
    [SQUARE, { levels: 11, maxQuads: 1000 }, { name: 'LimitError', code: 'too-many-quads' }],
    [SQUARE, { levels: 12 }, { name: 'LimitError', code: 'memory-exceeded' }],
    [SQUARE, { levels: 12, maxQuads: 2 ** 30 }, { name: 'LimitError', code: 'memory-exceeded' }],
    [SQUARE, { levels: 12, maxQuads: 2 ** 31 }, { name: 'OptionsError', code: 'option-out-of-range' }],
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

  it('says what would not fit, what fits, and what to do, before the work', async () => {
    const start = performance.now();
    const tooMuch: QuadOptions = { levels: 13, maxLevels: 13 };
    const refusal: Error = await mesher.refineQuads(ROW, tooMuch).then(
      () => expect.unreachable(),
      (error) => error,
    );
    expect(performance.now() - start).toBeLessThan(5000);
    const quads = Number(/about (\d+) quads/.exec(refusal.message)?.[1]);
    expect(quads / (10 * 4 ** 13)).toBeCloseTo(1, 1);
    const { bytes } = await mesher.estimateQuads(ROW, tooMuch);
    expect(refusal.message).toContain(`take ${(bytes / 1e9).toFixed(1)} GB`);
    expect(refusal.message).toContain(`which hold ${MOST_QUADS} quads`);
    expect(refusal.message).toMatch(/more than the 1\.\d GB.*larger edge length, fewer levels/);
  });

  it('recognizes files that have no name', async () => {
    const mesh = await mesher.refineQuads(SQUARE, { levels: 2 });
    for (const format of ['obj', 'vtu', 'vtk', 'msh', 'inp', 'medit'] as const) {
      using again = await mesher.load(await mesh.export(format), { name: 'mesh.dat' });
      expect(again.corners, format).toEqual(mesh.quads);
      expect(again.info.hash, format).toBe(mesh.hash);
    }
    const refused = mesher.load(new Uint8Array([0x89, 0x50, 0x4e, 0x47, 13, 10]), { name: 'picture.xyz' });
    await expect(refused).rejects.toMatchObject({ code: 'format-unknown', message: expect.stringMatching(/PNG.*\.obj, \.stl, \.vtu/) });
  });

  it('gives a hash to surfaces of several kinds of faces', async () => {
    const load = async (obj: string) => (await mesher.load(obj)).info.hash;
    const mixed = await load('v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 2 5 3\n');
    expect(mixed).toMatch(/^[0-9a-f]{32}$/);
    expect(await load('v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 4 2 5 3\n')).not.toBe(mixed);
  });

  it('estimates while it meshes', async () => {
    using row = await mesher.load(ROW);
    await mesher.estimateQuads(row);
    const abort = new AbortController();
    let isMeshing = true;
    const meshing = mesher.refineQuads(row, { ...MUCH, signal: abort.signal }).finally(() => (isMeshing = false));
    meshing.catch(() => {});
    expect(await mesher.estimateQuads(row, { levels: 3 })).toMatchObject({ quads: 10 * 64, exact: true });
    expect(isMeshing).toBe(true);
    abort.abort();
    await expect(meshing).rejects.toMatchObject({ name: 'AbortError' });
  });

  it('cancels within 200 ms: the work stops, the next call is answered, the surface survives', async () => {
    using row = await mesher.load(ROW);
    const before = await mesher.refineQuads(row, { levels: 2 });
    const delays: number[] = [];
    for (let attempt = 0; attempt < ATTEMPTS; attempt++) {
      const abort = new AbortController();
      let told = 0;
      const stuck = mesher.refineQuads(row, { ...MUCH, signal: abort.signal, onProgress: () => void (told += 1) });
      let aborted = 0;
      setTimeout(() => {
        aborted = performance.now();
        abort.abort();
      }, 200);
      await expect(stuck).rejects.toMatchObject({ name: 'AbortError', code: 'cancelled' });
      expect(performance.now() - aborted).toBeLessThan(PROMPT);
      const toldBefore = told;
      const after = await mesher.refineQuads(row, { levels: 2 });
      delays.push(performance.now() - aborted);
      expect(after.hash).toBe(before.hash);
      expect(told).toBe(toldBefore);
    }
    expect(Math.min(...delays), `milliseconds from abort to the next answer: ${delays}`).toBeLessThan(PROMPT);
    expect(await before.export('obj')).toEqual(await (await mesher.refineQuads(row, { levels: 2 })).export('obj'));
  });

  it('leaves the processor idle once cancelled', async () => {
    using row = await mesher.load(ROW);
    const abort = new AbortController();
    const stuck = mesher.refineQuads(row, { ...MUCH, signal: abort.signal });
    setTimeout(() => abort.abort(), 200);
    await expect(stuck).rejects.toMatchObject({ name: 'AbortError' });
    // The whole takes four seconds or more of the processor. Fresh workers are started and compiled for part of a
    // second, longer on a busy machine, so the process has to come to rest within two seconds.
    const shares: number[] = [];
    while (shares.length < 8 && !shares.some((share) => share < 0.25)) shares.push(await busyShare(250));
    expect(Math.min(...shares), `of one processor in use, each quarter of a second: ${shares}`).toBeLessThan(0.25);
  });
});

it('rejects what is pending on termination', async () => {
  const mesher = await createMesher({ threads: 2 });
  const pending = mesher.refineQuads(ROW, MUCH);
  setTimeout(() => mesher.terminate(), 50);
  await expect(pending).rejects.toMatchObject({ name: 'HexmillError', code: 'terminated' });
  await expect(mesher.load(SQUARE)).rejects.toMatchObject({ code: 'terminated' });
});

it('loses nothing when memory runs out all the same', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'hexmill-'));
  const wasm = readFileSync(new URL('../../dist/wasm/mesher/mesher.wasm', import.meta.url));
  writeFileSync(join(folder, 'small.wasm'), withLittleMemory(wasm, 1024));
  using mesher = await createMesher({ threads: 1, wasmUrl: pathToFileURL(join(folder, 'small.wasm')) });
  const surface = await mesher.load(ROW);
  const before = await mesher.refineQuads(surface, { levels: 3 });
  const call = mesher.refineQuads(surface, { levels: 10 });
  await expect(call).rejects.toMatchObject({ name: 'InternalError', code: 'out-of-memory', message: expect.stringContaining('larger edge length') });
  expect((await mesher.refineQuads(surface, { levels: 3 })).hash).toBe(before.hash);
  expect((await before.export('obj')).length).toBeGreaterThan(1000);
  rmSync(folder, { recursive: true });
});

it('says where it looked for the module', async () => {
  const call = createMesher({ threads: 1, wasmUrl: new URL('file:///nowhere/mesher.wasm') });
  await expect(call).rejects.toMatchObject({ code: 'module-not-loaded', message: expect.stringContaining('nowhere') });
});

it.each([0, -1, 1.5, Number.NaN, 1e9, MOST_THREADS + 1, '2'])('refuses %s threads', async (threads) => {
  const call = createMesher({ threads } as MesherOptions);
  const message = expect.stringMatching(`threads is ${threads}; give a whole number from 1 to ${MOST_THREADS}`);
  await expect(call).rejects.toMatchObject({ name: 'OptionsError', code: 'threads-invalid', message });
});

it('refuses misspelt options', async () => {
  const refusal = (meant: string) => ({ code: 'option-unknown', message: expect.stringContaining(`Did you mean ${meant}?`) });
  await expect(createMesher({ thread: 2 } as MesherOptions)).rejects.toMatchObject(refusal('threads'));
  using mesher = await createMesher({ threads: 1 });
  await expect(mesher.load(SQUARE, { nam: 'a.obj' } as object)).rejects.toMatchObject(refusal('name'));
  await expect(mesher.refineQuads(SQUARE, { onprogress: () => {} } as object)).rejects.toMatchObject(refusal('onProgress'));
});
