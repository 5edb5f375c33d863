import { expect, test } from 'vitest';
import { countBetween, histogramOf, isAcceptable, levelCounts, metricInfo, metricsOf, summaryOf, worstCells } from './metrics.js';
import type { MetricInfo, MetricName } from './metrics.js';
import { mapColour, qualityPlace } from './colouring.js';

const of = (metric: MetricName): MetricInfo => metricInfo(metricsOf(false), metric);

test('worst cells come worst first, equal ones in the order of the mesh', () => {
  const values = Float32Array.of(0.9, 0.2, 0.5, 0.2, 1, -1);
  expect(worstCells(values, of('scaledJacobian'), 3)).toEqual([5, 1, 3]);
  expect(worstCells(values, of('aspect'), 2)).toEqual([4, 0]);
  expect(worstCells(values, of('minAngle'), 10)).toEqual([5, 1, 3, 2, 0, 4]);
});

test('worst cells agree with a full sort', () => {
  let state = 1;
  const values = Float32Array.from({ length: 5000 }, () => (state = (state * 48271) % 2147483647) / 2147483647);
  const sorted = Array.from(values.keys()).sort((a, b) => (values[a] ?? 0) - (values[b] ?? 0) || a - b);
  expect(worstCells(values, of('scaledJacobian'), 100)).toEqual(sorted.slice(0, 100));
});

test('counts', () => {
  expect(countBetween(Float32Array.of(0, 0.5, 1, Number.NaN), 0.5, 1)).toBe(2);
  expect(levelCounts(Uint8Array.of(1, 3, 3))).toEqual([0, 1, 0, 2]);
});

test('distances are measured of solids alone, by their size; cells inside have none', () => {
  expect(metricsOf(true).map(({ metric }) => metric)).not.toContain('distance');
  const info = metricInfo(metricsOf(true, 50), 'distance');
  expect([isAcceptable(info, 0.09), isAcceptable(info, 0.11)]).toEqual([true, false]);
  expect(info.decimals).toBe(3);
  const values = Float32Array.of(Number.NaN, 0.5, 0.25, Number.NaN, 0);
  expect(worstCells(values, info, 9)).toEqual([1, 2, 4]);
  expect(summaryOf(values)).toEqual({ min: 0, max: 0.5, mean: 0.25, percentile1: 0 });
  expect(histogramOf(values, info, 2)).toEqual({ min: 0, max: 0.5, counts: [1, 2] });
});

test('the bad end of every measure has the same colour', () => {
  expect(mapColour('quality', qualityPlace(of('scaledJacobian'), -1))).toBe('rgb(140 10 40)');
  expect(mapColour('quality', qualityPlace(of('maxAngle'), 180))).toBe('rgb(140 10 40)');
  expect(mapColour('quality', qualityPlace(of('aspect'), 1))).toBe('rgb(74 144 200)');
  expect(mapColour('levels', 0.5)).toBe('rgb(131 114 209)');
});

test('histograms count every value, over a range that holds the usual ones', () => {
  const jacobian = histogramOf(Float32Array.of(0, 0.26, 0.5, 1), of('scaledJacobian'), 4);
  expect(jacobian).toEqual({ min: 0, max: 1, counts: [1, 1, 1, 1] });
  expect(histogramOf(Float32Array.of(-1, 1), of('scaledJacobian'), 2)).toEqual({ min: -1, max: 1, counts: [1, 1] });
  expect(histogramOf(Float32Array.of(1, 3), of('aspect'), 2)).toEqual({ min: 1, max: 3, counts: [1, 1] });
  expect(histogramOf(Float32Array.of(1, 1), of('aspect'), 2).counts).toEqual([2, 0]);
});
