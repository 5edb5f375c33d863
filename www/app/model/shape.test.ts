import { describe, expect, test } from 'vitest';
import { fault, newShape, SHAPES, tidy, translated } from './shape.js';
import type { Shape } from './settings.js';

const bounds = { min: [0, 0, 0], max: [3, 4, 0] } as const;

describe.each(SHAPES)('a new $kind', ({ kind }) => {
  const shape = newShape(kind, [1.23456789, 2, 0], { min: [...bounds.min], max: [...bounds.max] });

  test('is valid, about the point, in short numbers', () => {
    expect(fault(shape)).toBeNull();
    expect(JSON.stringify(shape)).not.toMatch(/\d{7}/);
  });

  test('moves', () => {
    const back = tidy(translated(translated(shape, [1, 2, 3]), [-1, -2, -3]));
    expect(back).toEqual(shape);
  });
});

test('a model without extent still gets a region', () => {
  expect(fault(newShape('sphere', [5, 5, 5], { min: [5, 5, 5], max: [5, 5, 5] }))).toBeNull();
});

test.each<[Shape, RegExp]>([
  [{ kind: 'box', min: [0, 0, 0], max: [1, 0, 1] }, /along y/],
  [{ kind: 'sphere', center: [0, 0, 0], radius: 0 }, /radius/],
  [{ kind: 'sphere', center: [0, 0, 0], radius: Number.NaN }, /radius/],
  [{ kind: 'cylinder', from: [1, 1, 1], to: [1, 1, 1], radius: 1 }, /no length/],
])('%j is refused', (shape, reason) => expect(fault(shape)).toMatch(reason));
