/** Quality measures of quads and hexes: names, units, and what is acceptable. */

import type { HexMetric, Metric, QualitySummary } from 'hexmill';

export type MetricName = Metric | Exclude<HexMetric, 'volume'> | 'distance';

export interface MetricInfo {
  readonly metric: MetricName;
  readonly label: string;
  /** Shown after figures. */
  readonly unit: '' | '°';
  readonly decimals: number;
  /** Whether small values are the bad ones. */
  readonly worst: 'low' | 'high';
  /** The value of a square or cube. */
  readonly ideal: number;
  /** The bound that acceptable cells keep. */
  readonly acceptable: number;
  /** What colours span. */
  readonly range: readonly [number, number];
  readonly says: string;
}

/**
 * Acceptable ranges: the Verdict library's reference manual (Sandia, SAND2007-1751) for the scaled Jacobian and
 * the angles; for the aspect ratio the Cubit manual's 1 to 4.
 */
const OF_QUADS: readonly MetricInfo[] = [
  {
    metric: 'scaledJacobian', label: 'Scaled Jacobian', unit: '', decimals: 3, worst: 'low', ideal: 1, acceptable: 0.3, range: [0, 1],
    says: 'Least corner Jacobian over the lengths of its edges. 1 is a rectangle, 0 or less is degenerate.',
  },
  {
    metric: 'minAngle', label: 'Minimum angle', unit: '°', decimals: 1, worst: 'low', ideal: 90, acceptable: 45, range: [0, 90],
    says: 'Least angle at a corner.',
  },
  {
    metric: 'maxAngle', label: 'Maximum angle', unit: '°', decimals: 1, worst: 'high', ideal: 90, acceptable: 135, range: [90, 180],
    says: 'Greatest angle at a corner.',
  },
  {
    metric: 'aspect', label: 'Aspect ratio', unit: '', decimals: 2, worst: 'high', ideal: 1, acceptable: 4, range: [1, 8],
    says: 'Longest edge over shortest edge.',
  },
];

/** Acceptable ranges: as above; of a hex's scaled Jacobian the manual's own, which is narrower than that of quads. */
const OF_HEXES: readonly MetricInfo[] = [
  {
    metric: 'scaledJacobian', label: 'Scaled Jacobian', unit: '', decimals: 3, worst: 'low', ideal: 1, acceptable: 0.5, range: [0, 1],
    says: 'Least corner Jacobian over the lengths of its edges. 1 is a box, 0 or less is degenerate.',
  },
  {
    metric: 'aspect', label: 'Aspect ratio', unit: '', decimals: 2, worst: 'high', ideal: 1, acceptable: 4, range: [1, 8],
    says: 'Longest edge over shortest edge.',
  },
];

/** Distances that are acceptable, as a part of the model's diagonal: what parts of machines are held to. */
const NEAR = 0.002;

/** The distance of cells at the boundary from what was given, in model units, for a model of this diagonal. */
function distance(diagonal: number): MetricInfo {
  const acceptable = NEAR * diagonal;
  return {
    metric: 'distance', label: 'Distance to the input', unit: '', decimals: Math.min(12, Math.max(0, 2 - Math.floor(Math.log10(acceptable)))),
    worst: 'high', ideal: 0, acceptable, range: [0, 2 * acceptable],
    says: `Of cells at the boundary, in model units; the bound is ${100 * NEAR} % of the model’s diagonal.`,
  };
}

/** What is measured of quads, of hexes, and of hexes that fill a solid of some diagonal. */
export function metricsOf(hexes: boolean, diagonal: number | null = null): readonly MetricInfo[] {
  if (!hexes) return OF_QUADS;
  return diagonal ? [...OF_HEXES, distance(diagonal)] : OF_HEXES;
}

/** What is known of `metric`; of the first of `metrics` if it is none of them. */
export function metricInfo(metrics: readonly MetricInfo[], metric: MetricName): MetricInfo {
  const [first] = metrics;
  const found = metrics.find((info) => info.metric === metric) ?? first;
  if (!found) throw new RangeError(`no metric ${metric}`);
  return found;
}

/** Whether `value` is within what is acceptable. */
export function isAcceptable(info: MetricInfo, value: number): boolean {
  return info.worst === 'low' ? value >= info.acceptable : value <= info.acceptable;
}

export interface Histogram {
  readonly min: number;
  readonly max: number;
  readonly counts: readonly number[];
}

/** Counts of `values` in `bins` equal steps over the metric's usual range, widened to hold all of them. */
export function histogramOf(values: Float32Array, info: MetricInfo, bins: number): Histogram {
  let [min, max] = [info.range[0], info.worst === 'low' ? info.range[1] : info.range[0] + 1e-6 * info.range[1]];
  for (const value of values) {
    if (value < min) min = value;
    if (value > max) max = value;
  }
  const counts = new Array<number>(bins).fill(0);
  for (const value of values) {
    const bin = Math.min(bins - 1, Math.floor((bins * (value - min)) / (max - min)));
    if (bin >= 0) counts[bin] = (counts[bin] ?? 0) + 1;
  }
  return { min, max, counts };
}

/** The distribution of the values that are numbers. */
export function summaryOf(values: Float32Array): Pick<QualitySummary, 'min' | 'max' | 'mean' | 'percentile1'> {
  const numbers = values.filter((value) => !Number.isNaN(value)).sort();
  const at = (share: number): number => numbers[Math.floor(share * (numbers.length - 1))] ?? Number.NaN;
  const mean = numbers.reduce((sum, value) => sum + value, 0) / numbers.length;
  return { min: at(0), max: at(1), mean, percentile1: at(0.01) };
}

/** How many of `values` lie from `low` to `high`. */
export function countBetween(values: Float32Array, low: number, high: number): number {
  let found = 0;
  for (const value of values) if (value >= low && value <= high) found += 1;
  return found;
}

/** The `wanted` worst cells, worst first; of equal ones the first in the mesh. Those without a value are none of them. */
export function worstCells(values: Float32Array, info: MetricInfo, wanted: number): number[] {
  const sign = info.worst === 'low' ? 1 : -1;
  const cells: number[] = [];
  const badness = (cell: number): number => sign * (values[cell] ?? Number.NaN);
  let bound = Number.POSITIVE_INFINITY;
  for (let cell = 0; cell < values.length; cell += 1) {
    const value = badness(cell);
    if (Number.isNaN(value) || (cells.length === wanted && !(value < bound))) continue;
    let place = cells.length;
    while (place > 0 && badness(cells[place - 1] ?? 0) > value) place -= 1;
    cells.splice(place, 0, cell);
    if (cells.length > wanted) cells.pop();
    bound = badness(cells.at(-1) ?? 0);
  }
  return cells;
}

/** How many cells each level has, from level 0; none of a mesh without levels. */
export function levelCounts(level: Uint8Array): number[] {
  const counts: number[] = [];
  for (const l of level) counts[l] = (counts[l] ?? 0) + 1;
  return Array.from(counts, (n) => n ?? 0);
}
