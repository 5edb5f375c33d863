import { expect, test } from 'vitest';
import { Cutting, nearestAxis } from './cutting.js';

function cutting(): Cutting {
  const made = new Cutting();
  made.bounds.value = { min: [0, 0, 0], max: [4, 2, 1] };
  return made;
}

test('a cut across an axis goes through the middle, then stays where the plane was', () => {
  const cut = cutting();
  cut.across('x');
  expect(cut.section.value).toEqual({ normal: [-1, 0, 0], offset: -2 });
  expect(cut.axis.value).toBe('x');
  cut.to(-3);
  expect(cut.range.value).toEqual({ min: -4, max: 0 });
  cut.facing([1, 0, 0]);
  expect(cut.section.value).toEqual({ normal: [1, 0, 0], offset: 3 });
  cut.across('z');
  expect(cut.section.value).toEqual({ normal: [0, 0, -1], offset: -0.5 });
});

test('flipping keeps the plane and shows its other side', () => {
  const cut = cutting();
  cut.facing([0, 0.6, 0.8]);
  const offset = cut.section.value?.offset ?? 0;
  expect(cut.axis.value).toBeNull();
  cut.flip();
  expect(cut.section.value).toEqual({ normal: [0, -0.6, -0.8], offset: -offset });
});

test('the plane never leaves the mesh', () => {
  const cut = cutting();
  cut.across('y');
  cut.to(50);
  expect(cut.section.value?.offset).toBe(0);
  cut.to(-50);
  expect(cut.section.value?.offset).toBe(-2);
});

test('a cell is revealed by a cut through it and by layers put back', () => {
  const cut = cutting();
  cut.peel.value = 3;
  cut.reveal([1, 0.5, 0.25], 1, [0, 1, 0]);
  expect(cut.section.value).toEqual({ normal: [0, 1, 0], offset: 0.5 });
  expect(cut.peel.value).toBe(1);
  cut.reveal([3, 1.5, 0.75], 2, [1, 0, 0]);
  expect(cut.section.value).toEqual({ normal: [0, 1, 0], offset: 1.5 });
});

test('a direction has a nearest axis', () => {
  expect(nearestAxis([0.3, -0.9, 0.2])).toEqual([0, -1, 0]);
  expect(nearestAxis([0, 0, 0])).toEqual([1, 0, 0]);
});
