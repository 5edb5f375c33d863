// What the workers hold for the caller: a worker for meshes, one for estimates, and surfaces until they are freed.

import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { describe, expect, it } from 'vitest';

import { CancelledError } from '../../www/lib/errors.js';
import { startMesher } from '../../www/lib/start.js';
import type { Surface } from '../../www/lib/loaded.js';
import { fakePlatform, settle } from './fake-platform.js';
import type { FakeWorker } from './fake-platform.js';

const ESTIMATE = { quads: 4, nodes: 9, bytes: 440, levels: 1, exact: true, idleRegions: [] };
const SURFACE = { kind: 'surface' };
const MESH = { nodes: new Float64Array(12), quads: new Uint32Array(4), level: new Uint8Array(1), parent: new Uint32Array(1) };

async function start(platformOptions: { sharesMemory?: boolean } = {}) {
  const { platform, workers } = fakePlatform(platformOptions);
  const mesher = await startMesher(platform, { threads: 2 });
  const worker = (index: number): FakeWorker => {
    const found = workers[index];
    if (!found) throw new Error(`worker ${index} was not started`);
    return found;
  };
  const load = async (): Promise<Surface> => {
    const loading = mesher.load('v 0 0 0');
    await settle();
    worker(0).answer(SURFACE);
    return loading;
  };
  return { mesher, workers, worker, load };
}

const names = (worker: FakeWorker): string[] => worker.calls.map((call) => call.name);

describe('an estimate', () => {
  it('neither waits for a mesh nor disturbs it', async () => {
    const { mesher, worker, load, workers } = await start();
    const surface = await load();
    const meshing = mesher.refineQuads(surface, { levels: 2 });
    await settle();
    const estimating = mesher.estimateQuads(surface, { levels: 3 });
    await settle();
    expect(workers).toHaveLength(2);
    worker(1).answer({});
    await settle();
    expect(names(worker(1))).toEqual(['reload', 'estimate']);
    worker(1).answer(ESTIMATE);
    expect(await estimating).toEqual(ESTIMATE);
    expect(names(worker(0))).toEqual(['load', 'refine']);
    worker(0).answer(MESH);
    await meshing;
  });

  it('that is aborted leaves the workers of meshes alone, and its own where it ends soon', async () => {
    const { mesher, worker, load, workers } = await start();
    const surface = await load();
    const abort = new AbortController();
    const estimating = mesher.estimateQuads(surface, { levels: 3, signal: abort.signal });
    await settle();
    worker(1).answer({});
    await settle();
    abort.abort();
    await expect(estimating).rejects.toBeInstanceOf(CancelledError);
    const next = mesher.estimateQuads(surface, { levels: 4 });
    await new Promise((later) => setTimeout(later, 150));
    worker(1).answer('too late');
    await settle();
    expect(names(worker(1))).toEqual(['reload', 'estimate', 'estimate']);
    worker(1).answer(ESTIMATE);
    expect(await next).toEqual(ESTIMATE);
    expect(workers.map(({ terminated }) => terminated)).toEqual([false, false]);
  });

  it('sees the flag to stop where memory is shared', async () => {
    const { mesher, worker, load } = await start({ sharesMemory: true });
    const surface = await load();
    const abort = new AbortController();
    const estimating = mesher.estimateQuads(surface, { levels: 3, signal: abort.signal });
    await settle();
    // Three workers mesh: the one that takes the calls and two threads.
    worker(3).answer({});
    await settle();
    abort.abort();
    await expect(estimating).rejects.toBeInstanceOf(CancelledError);
    expect(worker(3).isAsked).toBe(true);
    expect(worker(0).isAsked).toBe(false);
  });

  it('of a file keeps nothing of it', async () => {
    const { mesher, worker } = await start();
    const estimating = mesher.estimateQuads('v 0 0 0');
    await settle();
    worker(1).answer({});
    await settle();
    worker(1).answer(ESTIMATE);
    await estimating;
    expect(worker(1).dropped).toHaveLength(1);
    expect(worker(0).calls).toHaveLength(0);
  });

  it('is done where meshes are if there can be no other worker', async () => {
    const { platform, workers } = fakePlatform();
    const mesher = await startMesher(platform, { threads: 1 });
    const spawn = platform.spawn;
    platform.spawn = (url, events) => {
      const handle = spawn(url, events);
      handle.post = () => workers.at(-1)?.die('out of workers');
      return handle;
    };
    const estimating = mesher.estimateQuads('v 0 0 0');
    await settle();
    workers[0]?.answer({});
    await settle();
    workers[0]?.answer(ESTIMATE);
    expect(await estimating).toEqual(ESTIMATE);
  });
});

describe('a surface is freed', () => {
  it('when its loading is aborted', async () => {
    const { mesher, worker } = await start();
    const abort = new AbortController();
    const loading = mesher.load('v 0 0 0', { signal: abort.signal });
    await settle();
    abort.abort();
    await expect(loading).rejects.toBeInstanceOf(CancelledError);
    worker(0).answer({});
    await settle();
    expect(worker(0).dropped).toHaveLength(1);
  });

  it('in both workers when it is disposed of', async () => {
    const { mesher, worker, load } = await start();
    const surface = await load();
    const estimating = mesher.estimateQuads(surface);
    await settle();
    worker(1).answer({});
    await settle();
    worker(1).answer(ESTIMATE);
    await estimating;
    surface.dispose();
    surface.dispose();
    expect(worker(0).dropped).toHaveLength(1);
    expect(worker(1).dropped).toHaveLength(1);
  });

  it('with the mesh that it was loaded for', async () => {
    const { mesher, worker } = await start();
    const meshing = mesher.refineQuads('v 0 0 0');
    await settle();
    worker(0).answer(SURFACE);
    await settle();
    worker(0).answer(MESH);
    const mesh = await meshing;
    expect(worker(0).dropped).toHaveLength(0);
    mesh.dispose();
    expect(worker(0).dropped).toHaveLength(1);
    const exporting = mesh.export('obj');
    await settle();
    expect(names(worker(0))).toEqual(['load', 'refine', 'reload']);
    worker(0).answer({});
    await settle();
    worker(0).answer(new Uint8Array(1));
    await exporting;
  });

  it('when nothing refers to it any more', async () => {
    setFlagsFromString('--expose-gc');
    const collect = runInNewContext('gc') as () => void;
    const { worker, load } = await start();
    await load();
    for (let round = 0; round < 50 && worker(0).dropped.length === 0; round++) {
      collect();
      await settle();
    }
    expect(worker(0).dropped).toHaveLength(1);
  });
});

describe('hexes', () => {
  const BOX = { min: [0, 0, 0], max: [1, 1, 1] } as const;

  it('have workers and a module of their own, started with the first', async () => {
    const { mesher, worker, workers } = await start();
    const making = mesher.makeGrid(BOX, { spacing: 1 });
    await settle();
    expect(workers).toHaveLength(2);
    expect(worker(1).received[0]).toMatchObject({ type: 'start', name: 'hexes', module: 'http://localhost/hexes.wasm' });
    worker(1).answer({ kind: 'hexes' });
    const grid = await making;
    const planning = mesher.planHexes(grid, { levels: 1 });
    const refining = mesher.refineHexes(grid, { levels: 1 });
    await settle();
    worker(2).answer(null);
    await settle();
    worker(2).answer({ treeHexes: 8 });
    expect(await planning).toEqual({ treeHexes: 8 });
    worker(1).answer({ hexes: new Uint32Array(8) });
    expect((await refining).hexes).toHaveLength(8);
    grid.dispose();
    expect([names(worker(1)), names(worker(2))]).toEqual([['load', 'refineHexes'], ['reload', 'planHexes']]);
    expect([worker(1).dropped.length, worker(2).dropped.length]).toEqual([1, 1]);
    expect(worker(0).calls).toHaveLength(0);
    mesher.terminate();
    await settle();
    expect(workers.map(({ terminated }) => terminated)).toEqual([true, true, true]);
    await expect(mesher.makeGrid(BOX, { spacing: 1 })).rejects.toMatchObject({ code: 'terminated' });
  });

  it('are asked for anew where their module could not be fetched', async () => {
    const { platform, workers } = fakePlatform();
    const mesher = await startMesher(platform, { threads: 1 });
    const { spawn } = platform;
    platform.spawn = (url, events) => {
      const handle = spawn(url, events);
      handle.post = () => events.onError('no network');
      return handle;
    };
    await expect(mesher.makeGrid(BOX, { spacing: 1 })).rejects.toMatchObject({ name: 'InternalError', code: 'worker-failed' });
    platform.spawn = spawn;
    const making = mesher.makeGrid(BOX, { spacing: 1 });
    await settle();
    workers.at(-1)?.answer({ kind: 'hexes' });
    await making;
  });

  it('are aborted at once while their workers start', async () => {
    const { platform } = fakePlatform();
    const mesher = await startMesher(platform, { threads: 1 });
    const { spawn } = platform;
    platform.spawn = (url, events) => Object.assign(spawn(url, events), { post: () => {} });
    const abort = new AbortController();
    const making = mesher.makeGrid(BOX, { spacing: 1, signal: abort.signal });
    await settle();
    abort.abort();
    await expect(making).rejects.toBeInstanceOf(CancelledError);
  });
});
