import { expect, test } from 'vitest';
import { debounced, Latest } from './latest.js';

const after = (ms: number): Promise<void> => new Promise((done) => setTimeout(done, ms));

test('only the latest request counts, and the others are aborted', async () => {
  const latest = new Latest();
  const aborted: number[] = [];
  const request = (n: number): Promise<number | null> =>
    latest.run(async (signal) => {
      signal.addEventListener('abort', () => aborted.push(n));
      await after(5);
      return n;
    });
  expect(await Promise.all([request(1), request(2), request(3)])).toEqual([null, null, 3]);
  expect(aborted).toEqual([1, 2]);
});

test('errors of overtaken requests are dropped, others are thrown', async () => {
  const latest = new Latest();
  const overtaken = latest.run(() => Promise.reject(new Error('old')));
  const current = latest.run(() => Promise.reject(new Error('new')));
  expect(await overtaken).toBeNull();
  await expect(current).rejects.toThrow('new');
});

test('cancelling gives null at once', async () => {
  const latest = new Latest();
  const request = latest.run(() => after(5).then(() => 1));
  latest.cancel();
  expect(await request).toBeNull();
});

test('debounced calls come once', async () => {
  let calls = 0;
  const call = debounced(() => (calls += 1), 5);
  call();
  call();
  await after(15);
  expect(calls).toBe(1);
  call();
  call.cancel();
  await after(15);
  expect(calls).toBe(1);
});
