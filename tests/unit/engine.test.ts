import { describe, expect, it } from 'vitest';

import { Engine } from '../../www/lib/engine.js';
import type { InputRecord } from '../../www/lib/engine.js';
import { CancelledError, HexmillError } from '../../www/lib/errors.js';
import { fakePlatform, settle } from './fake-platform.js';
import type { FakeWorker } from './fake-platform.js';

const record: InputRecord = { id: 7, source: { want: 'surface', from: { format: 'obj', content: 'v 0 0 0' } } };

async function startEngine({ pool = 0, reserve = false } = {}) {
  const { platform, workers } = fakePlatform();
  const engine = new Engine({ platform, workerUrl: undefined, name: 'mesher', module: 'http://localhost/mesher.wasm', pool, reserve });
  await engine.start();
  const worker = (index: number): FakeWorker => {
    const found = workers[index];
    if (!found) throw new Error(`worker ${index} was not started`);
    return found;
  };
  const estimate = (signal?: AbortSignal) =>
    engine.run(async (desk) => desk.call('estimate', { input: await desk.input(record), options: {} }), { signal });
  return { engine, workers, worker, estimate };
}

describe('the queue', () => {
  it('makes one call at a time, in order', async () => {
    const { engine, worker } = await startEngine();
    const first = engine.run((desk) => desk.call('finish', {}));
    const second = engine.run((desk) => desk.call('finish', {}));
    await settle();
    expect(worker(0).calls).toHaveLength(1);
    worker(0).answer('one');
    await settle();
    expect(worker(0).calls).toHaveLength(2);
    worker(0).answer('two');
    expect(await first).toBe('one');
    expect(await second).toBe('two');
  });

  it('goes on after a refusal', async () => {
    const { engine, worker } = await startEngine();
    const refused = engine.run((desk) => desk.call('finish', {}));
    const next = engine.run((desk) => desk.call('finish', {}));
    await settle();
    const failure = { kind: 'input', code: 'obj-empty', message: 'nothing in it', line: 3 } as const;
    worker(0).say({ type: 'failed', id: 1, failure });
    await expect(refused).rejects.toMatchObject({ name: 'InputError', code: 'obj-empty', line: 3 });
    await settle();
    worker(0).answer('well');
    expect(await next).toBe('well');
  });

  it('lets Node exit while it has nothing to do', async () => {
    const { engine, worker } = await startEngine();
    expect(worker(0).busy).toBe(false);
    const call = engine.run((desk) => desk.call('finish', {}));
    await settle();
    expect(worker(0).busy).toBe(true);
    worker(0).answer(null);
    await call;
    await settle();
    expect(worker(0).busy).toBe(false);
  });
});

describe('cancelling', () => {
  it('refuses a call whose signal is aborted already', async () => {
    const { engine, worker } = await startEngine();
    const call = engine.run((desk) => desk.call('finish', {}), { signal: AbortSignal.abort() });
    await expect(call).rejects.toBeInstanceOf(CancelledError);
    expect(worker(0).calls).toHaveLength(0);
  });

  it('takes a waiting call out of the queue', async () => {
    const { engine, worker } = await startEngine();
    const abort = new AbortController();
    const first = engine.run((desk) => desk.call('finish', {}));
    const waiting = engine.run((desk) => desk.call('finish', {}), { signal: abort.signal });
    abort.abort();
    await expect(waiting).rejects.toMatchObject({ name: 'AbortError', code: 'cancelled' });
    await settle();
    worker(0).answer('one');
    expect(await first).toBe('one');
    await settle();
    expect(worker(0).calls).toHaveLength(1);
    expect(worker(0).terminated).toBe(false);
  });

  it('keeps the worker if the call ends soon', async () => {
    const { engine, workers, worker } = await startEngine();
    const abort = new AbortController();
    const call = engine.run((desk) => desk.call('finish', {}), { signal: abort.signal });
    await settle();
    abort.abort();
    await expect(call).rejects.toBeInstanceOf(CancelledError);
    worker(0).answer('too late');
    const next = engine.run((desk) => desk.call('finish', {}));
    await settle();
    worker(0).answer('next');
    expect(await next).toBe('next');
    expect(workers).toHaveLength(1);
  });

  it('replaces the worker if the call does not end, and loads the surface again', async () => {
    const { worker, estimate, workers } = await startEngine();
    const abort = new AbortController();
    const stuck = estimate(abort.signal);
    await settle();
    expect(worker(0).calls.map((call) => call.name)).toEqual(['reload']);
    worker(0).answer({});
    await settle();
    expect(worker(0).calls.map((call) => call.name)).toEqual(['reload', 'estimate']);
    const start = performance.now();
    abort.abort();
    await expect(stuck).rejects.toBeInstanceOf(CancelledError);
    expect(performance.now() - start).toBeLessThan(50);
    const next = estimate();
    while (!worker(0).terminated) await settle();
    expect(performance.now() - start).toBeLessThan(200);
    await settle();
    expect(workers).toHaveLength(2);
    expect(worker(1).calls.map((call) => call.name)).toEqual(['reload']);
    worker(1).answer({});
    await settle();
    worker(1).answer({ quads: 4 });
    expect(await next).toEqual({ quads: 4 });
  });

  it('has a worker in reserve where a call takes long and cannot be asked to stop', async () => {
    const { engine, workers, worker } = await startEngine({ reserve: true });
    const quick = engine.run((desk) => desk.call('finish', {}));
    await settle();
    worker(0).answer('quick');
    await quick;
    expect(workers).toHaveLength(1);
    const abort = new AbortController();
    const stuck = engine.run((desk) => desk.call('finish', {}), { signal: abort.signal });
    await new Promise((later) => setTimeout(later, 80));
    expect(workers).toHaveLength(2);
    expect(worker(1).busy).toBe(false);
    abort.abort();
    await expect(stuck).rejects.toBeInstanceOf(CancelledError);
    const next = engine.run((desk) => desk.call('finish', {}));
    while (!worker(0).terminated) await settle();
    await settle();
    expect(workers).toHaveLength(2);
    expect(worker(1).calls).toHaveLength(1);
    worker(1).answer('next');
    expect(await next).toBe('next');
  });

  it('asks threads that share memory to stop, and keeps them', async () => {
    const { engine, workers, worker } = await startEngine({ pool: 2 });
    const abort = new AbortController();
    const call = engine.run((desk) => desk.call('finish', {}), { signal: abort.signal });
    await settle();
    expect(worker(0).isAsked).toBe(false);
    abort.abort();
    await expect(call).rejects.toBeInstanceOf(CancelledError);
    expect(worker(0).isAsked).toBe(true);
    worker(0).answer('stopped');
    const next = engine.run((desk) => desk.call('finish', {}));
    await settle();
    expect(worker(0).isAsked).toBe(false);
    worker(0).answer('next');
    expect(await next).toBe('next');
    expect(workers).toHaveLength(3);
  });

  it('frees a surface whose loading was cancelled', async () => {
    const { engine, worker } = await startEngine();
    const abort = new AbortController();
    const loading = engine.run((desk) => desk.load(record), { signal: abort.signal });
    await settle();
    abort.abort();
    await expect(loading).rejects.toBeInstanceOf(CancelledError);
    engine.drop(record.id);
    worker(0).answer({});
    await settle();
    expect(worker(0).terminated).toBe(false);
    expect(worker(0).dropped).toEqual([record.id]);
  });

  it('does not wait for a size function that never returns', async () => {
    const { engine, worker } = await startEngine();
    const abort = new AbortController();
    const stuck = engine.run(() => new Promise(() => {}), { signal: abort.signal });
    const next = engine.run((desk) => desk.call('finish', {}));
    await settle();
    abort.abort();
    await expect(stuck).rejects.toBeInstanceOf(CancelledError);
    await settle();
    worker(0).answer('next');
    expect(await next).toBe('next');
  });

  it('tells no progress afterwards', async () => {
    const { engine, worker } = await startEngine();
    const abort = new AbortController();
    const told: number[] = [];
    const onProgress = ({ fraction }: { fraction: number }) => void told.push(fraction);
    const call = engine.run((desk) => desk.call('finish', {}), { signal: abort.signal, onProgress });
    await settle();
    worker(0).say({ type: 'progress', id: 1, stage: 'refine', fraction: 0.5 });
    await settle();
    abort.abort();
    worker(0).say({ type: 'progress', id: 1, stage: 'refine', fraction: 0.6 });
    await expect(call).rejects.toBeInstanceOf(CancelledError);
    await settle();
    expect(told).toEqual([0.5]);
  });
});

describe('trouble', () => {
  it('reports a crash and goes on with a fresh worker', async () => {
    const { engine, workers, worker } = await startEngine();
    const call = engine.run((desk) => desk.call('finish', {}));
    const next = engine.run((desk) => desk.call('finish', {}));
    await settle();
    worker(0).say({ type: 'crashed', failure: { kind: 'internal', code: 'panicked', message: 'index out of bounds' } });
    await expect(call).rejects.toMatchObject({ name: 'InternalError', code: 'panicked' });
    await settle();
    expect(workers).toHaveLength(2);
    expect(worker(0).terminated).toBe(true);
    worker(1).answer('well');
    expect(await next).toBe('well');
  });

  it('fails to start if the worker cannot be loaded', async () => {
    const { platform, workers } = fakePlatform();
    const spawn = platform.spawn;
    platform.spawn = (url, events) => {
      const worker = spawn(url, events);
      worker.post = () => workers[0]?.die('no such script');
      return worker;
    };
    const engine = new Engine({ platform, workerUrl: undefined, name: 'mesher', module: 'mesher.wasm', pool: 0 });
    await expect(engine.start()).rejects.toMatchObject({ code: 'worker-failed' });
  });

  it('rejects everything on termination', async () => {
    const { engine, worker } = await startEngine();
    const running = engine.run((desk) => desk.call('finish', {}));
    const waiting = engine.run((desk) => desk.call('finish', {}));
    await settle();
    engine.terminate(new HexmillError('terminated', 'over'));
    const late = engine.run((desk) => desk.call('finish', {}));
    for (const call of [running, waiting, late]) {
      await expect(call).rejects.toMatchObject({ name: 'HexmillError', code: 'terminated' });
    }
    expect(worker(0).terminated).toBe(true);
  });
});
