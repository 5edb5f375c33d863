import { readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';
import { bytes, count, doing, duration, editable, parseNumber, percent, roughCount, significant } from './text.js';

describe('numbers for people', () => {
  test.each([
    [0, '0'],
    [18432, '18,432'],
  ])('count %d', (value, text) => expect(count(value)).toBe(text));

  test.each([
    [999, '999'],
    [9_999, '9,999'],
    [18_432, '18.4\u2009k'],
    [1_250_000, '1.25\u2009M'],
    [3.2e9, '3.2\u2009G'],
  ])('rough count %d', (value, text) => expect(roughCount(value)).toBe(text));

  test.each([
    [0.1 + 0.2, '0.3'],
    [-0.0432, '−0.0432'],
    [1.5e-7, '1.5e−7'],
    [6.02e23, '6.02e23'],
    [Number.POSITIVE_INFINITY, '∞'],
  ])('significant %d', (value, text) => expect(significant(value)).toBe(text));

  test.each([
    [0, '0\u2009B'],
    [999, '999\u2009B'],
    [10_540_800, '10.5\u2009MB'],
  ])('bytes %d', (value, text) => expect(bytes(value)).toBe(text));

  test.each([
    [12.4, '12\u2009ms'],
    [1284, '1.28\u2009s'],
    [95_000, '1\u2009min 35\u2009s'],
  ])('duration %d', (value, text) => expect(duration(value)).toBe(text));

  test.each([
    [9_999, 10_000, '99.9\u2009%'],
    [10_000, 10_000, '100\u2009%'],
    [1, 1_000_000, '0.1\u2009%'],
    [0, 10, '0\u2009%'],
  ])('percent %d of %d', (part, whole, text) => expect(percent(part, whole)).toBe(text));
});

describe('numbers from people', () => {
  test.each([
    ['0.25', 0.25],
    [' 0,25 ', 0.25],
    ['1e-3', 1e-3],
    ['−2', -2],
    ['.5', 0.5],
    ['5.', 5],
    ['', null],
    ['0x10', null],
    ['1,000.5', null],
    ['1e999', null],
    ['fine', null],
  ])('%j', (text, value) => expect(parseNumber(text)).toBe(value));

  test('what is shown for editing reads back', () => {
    for (const value of [0, 1, -0.1234564, 1e-9, 123456, 7.5e12, 1e9]) {
      expect(parseNumber(editable(value))).toBeCloseTo(value, 6);
    }
  });
});

test('each stage of the core is told in words of its own', () => {
  const core = fileURLToPath(new URL('../../../src/', import.meta.url));
  const files = readdirSync(core, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.rs'));
  const sources = files.map((file) => readFileSync(core + file, 'utf8'));
  const stages = sources.flatMap((text) => [...text.matchAll(/: Stage = Stage\("([^"]+)"\)/g)].map(([, name]) => name as string));
  expect(stages.length).toBeGreaterThan(20);
  expect(stages.filter((stage) => doing(stage) === stage)).toEqual([]);
  const words = [...new Set(stages)].map(doing);
  expect(new Set(words).size).toBe(words.length);
});
