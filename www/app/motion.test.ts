import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { LIGHT_FROM, Motion } from './motion.js';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function watched(): { motion: Motion; told: boolean[] } {
  const told: boolean[] = [];
  return { motion: new Motion((isMoving) => told.push(isMoving)), told };
}

test('a large mesh is drawn lighter until the camera rests', () => {
  const { motion, told } = watched();
  for (let frame = 0; frame < 20; frame += 1) {
    motion.moved(LIGHT_FROM + 1);
    vi.advanceTimersByTime(50);
  }
  expect(told).toEqual([true]);
  vi.advanceTimersByTime(1000);
  expect(told).toEqual([true, false]);
});

test('a small mesh is always drawn in full', () => {
  const { motion, told } = watched();
  motion.moved(LIGHT_FROM);
  vi.advanceTimersByTime(1000);
  expect(told).toEqual([]);
});

test('rest ends it at once, and once', () => {
  const { motion, told } = watched();
  motion.moved(10 * LIGHT_FROM);
  motion.rest();
  vi.advanceTimersByTime(1000);
  expect(told).toEqual([true, false]);
});
