/** What the inspector looks at: a quality measure, a range of it, one cell, and the colours of all. */

import { batch, computed, effect, signal } from '@preact/signals-core';
import type { ReadonlySignal } from '@preact/signals-core';
import type { HexMetric, Metric } from 'hexmill';
import { complaint } from './complaint.js';
import { isHexes, isSolid } from './job.js';
import type { Cells } from './job.js';
import type { Colour } from './link.js';
import { countBetween, histogramOf, isAcceptable, metricInfo, metricsOf, summaryOf, worstCells } from './metrics.js';
import type { MetricInfo, MetricName } from './metrics.js';
import { diagonal } from './shape.js';
import type { Workbench } from './workbench.js';

export interface Range {
  readonly low: number;
  readonly high: number;
}

/** Worst cells listed. */
const WORST = 100;
/** Bars of the histogram. */
const BINS = 48;

export class Inspection {
  readonly colour = signal<Colour>('plain');
  readonly metric = signal<MetricName>('scaledJacobian');
  /** The measure of each cell of the result; null until it is there. */
  readonly values = signal<Float32Array | null>(null);
  /** The brushed range; null: all. */
  readonly brush = signal<Range | null>(null);
  /** The cell that is looked at. */
  readonly cell = signal<number | null>(null);

  /** What can be measured of the result's cells. */
  readonly metrics: ReadonlySignal<readonly MetricInfo[]>;
  readonly info = computed(() => metricInfo(this.metrics.value, this.metric.value));
  readonly histogram = computed(() => (this.values.value ? histogramOf(this.values.value, this.info.value, BINS) : null));
  readonly worst = computed<readonly number[]>(() => (this.values.value ? worstCells(this.values.value, this.info.value, WORST) : []));
  /** Where `cell` stands among the worst, from 0; null if it is none of them. */
  readonly rank = computed(() => {
    const rank = this.cell.value === null ? -1 : this.worst.value.indexOf(this.cell.value);
    return rank < 0 ? null : rank;
  });
  readonly acceptable = computed(() => {
    let kept = 0;
    for (const value of this.values.value ?? []) if (isAcceptable(this.info.value, value)) kept += 1;
    return kept;
  });
  /** Cells that have a value. */
  readonly measured = computed(() => this.values.value?.reduce((sum, value) => sum + (Number.isNaN(value) ? 0 : 1), 0) ?? 0);
  readonly summary = computed(() => (this.values.value ? summaryOf(this.values.value) : null));
  readonly brushed = computed(() => {
    const range = this.brush.value;
    return range && this.values.value ? countBetween(this.values.value, range.low, range.high) : null;
  });

  constructor(workbench: Workbench) {
    this.metrics = computed(() => {
      const mesh = workbench.result.value?.mesh;
      if (!mesh) return metricsOf(false);
      const bounds = isSolid(mesh) ? workbench.bounds.value : null;
      return metricsOf(isHexes(mesh), bounds && diagonal(bounds));
    });
    effect(() => {
      const mesh = workbench.result.value?.mesh ?? null;
      const { metric } = this.info.value;
      batch(() => {
        this.values.value = null;
        this.brush.value = null;
        this.cell.value = null;
      });
      if (!mesh) return;
      measure(mesh, metric).then(
        (values) => {
          if (workbench.result.peek()?.mesh === mesh && this.info.peek().metric === metric) this.values.value = values;
        },
        (error: unknown) => workbench.log.add('error', `No ${this.info.peek().label.toLowerCase()}: ${complaint(error).text}`),
      );
    });
  }

  /** What cells are coloured by. */
  readonly shown = computed<Colour | 'distance'>(() => (this.colour.value === 'quality' && this.info.value.metric === 'distance' ? 'distance' : this.colour.value));

  /** Colours cells, and looks at the measure that they are coloured by. */
  show(colour: Colour | 'distance'): void {
    if (colour === 'distance') return this.choose('distance');
    if (colour === 'quality' && this.metric.value === 'distance') return this.choose('scaledJacobian');
    this.colour.value = colour;
  }

  /** Looks at another metric and colours the cells by it. */
  choose(metric: MetricName): void {
    batch(() => {
      this.metric.value = metric;
      this.colour.value = 'quality';
    });
  }

  /** Brushes a range and shows it in the mesh; null ends it. */
  select(range: Range | null): void {
    batch(() => {
      this.brush.value = range;
      if (range) this.colour.value = 'quality';
    });
  }

  /** Shows the cells of a range, in whatever colour they have; null: all. */
  filter(range: Range | null): void {
    this.brush.value = range;
  }

  /** The next of the worst cells (or, with -1, the one before). */
  step(by: 1 | -1): number | null {
    const list = this.worst.value;
    if (list.length === 0) return null;
    const rank = this.rank.value;
    const next = rank === null ? 0 : (rank + by + list.length) % list.length;
    this.cell.value = list[next] ?? null;
    return this.cell.value;
  }
}

/** `metric` is one of the mesh's own: see `metricsOf`. */
function measure(mesh: Cells, metric: MetricName): Promise<Float32Array> {
  if (metric === 'distance' && isSolid(mesh)) return mesh.distances();
  return isHexes(mesh) ? mesh.qualityOf(metric as HexMetric) : mesh.qualityOf(metric as Metric);
}
