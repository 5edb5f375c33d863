/** A histogram with a brush: drag across it, or move the two handles below with the keyboard. */

import { html, nothing, svg } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { live } from 'lit-html/directives/live.js';
import type { Range } from '../model/inspection.js';
import type { Histogram } from '../model/metrics.js';

export interface HistogramView {
  readonly label: string;
  readonly histogram: Histogram;
  readonly brush: Range | null;
  readonly colour: (value: number) => string;
  readonly text: (value: number) => string;
  /** The bound of what is acceptable, marked by a line. */
  readonly bound: number;
  /** A value to mark: that of the cell looked at. */
  readonly marked: number | null;
  readonly select: (range: Range | null) => void;
}

const WIDTH = 240;
const HEIGHT = 72;
const HANDLE_STEPS = 200;

export function histogram(view: HistogramView): TemplateResult {
  const { min, max, counts } = view.histogram;
  const span = max - min || 1;
  const x = (value: number): number => (WIDTH * (value - min)) / span;
  const width = WIDTH / counts.length;
  const most = Math.max(1, ...counts);
  const range = view.brush ?? { low: min, high: max };
  const bar = (n: number, i: number): unknown => {
    const middle = min + ((i + 0.5) * span) / counts.length;
    const isIn = middle >= range.low && middle <= range.high;
    const height = n === 0 ? 0 : Math.max(1.5, HEIGHT * Math.sqrt(n / most));
    return svg`<rect class=${isIn ? '' : 'out'} x=${i * width + 0.5} width=${Math.max(0.5, width - 1)} y=${HEIGHT - height} height=${height} fill=${view.colour(middle)} />`;
  };
  return html`<div class="histogram">
    <svg viewBox="0 -4 ${WIDTH} ${HEIGHT + 4}" preserveAspectRatio="none" role="img" aria-label=${view.label}
      @pointerdown=${(event: PointerEvent) => drag(event, view)}>
      ${counts.map(bar)}
      ${view.bound > min && view.bound < max ? svg`<line class="bound" x1=${x(view.bound)} x2=${x(view.bound)} y1="-4" y2=${HEIGHT} />` : nothing}
      ${view.marked === null ? nothing : svg`<path class="marked" d=${`M${x(view.marked)} ${HEIGHT}V-4`} />`}
    </svg>
    <div class="brush">
      ${handle('Least value shown', range.low, view, (low) => ({ low: Math.min(low, range.high), high: range.high }))}
      ${handle('Greatest value shown', range.high, view, (high) => ({ low: range.low, high: Math.max(high, range.low) }))}
    </div>
    <div class="ends"><span>${view.text(min)}</span><span>${view.text(max)}</span></div>
  </div>`;
}

function handle(label: string, value: number, view: HistogramView, moved: (value: number) => Range): TemplateResult {
  const { min, max } = view.histogram;
  const span = max - min || 1;
  const at = (place: string): number => min + (Number(place) / HANDLE_STEPS) * span;
  return html`<input type="range" aria-label=${label} aria-valuetext=${view.text(value)} min="0" max=${HANDLE_STEPS}
    .value=${live(String(Math.round((HANDLE_STEPS * (value - min)) / span)))}
    @input=${(event: Event) => view.select(whole(moved(at((event.target as HTMLInputElement).value)), view.histogram))} />`;
}

/** The whole range is no brush. */
function whole(range: Range, { min, max }: Histogram): Range | null {
  return range.low <= min && range.high >= max ? null : range;
}

/** Brushes from where the pointer went down to where it goes; a click without a move ends the brush. */
function drag(down: PointerEvent, view: HistogramView): void {
  const area = down.currentTarget as SVGElement;
  const { left, width } = area.getBoundingClientRect();
  const { min, max } = view.histogram;
  const value = (event: PointerEvent): number => min + Math.min(1, Math.max(0, (event.clientX - left) / width)) * (max - min);
  const from = value(down);
  const move = (event: PointerEvent): void => {
    const to = value(event);
    view.select({ low: Math.min(from, to), high: Math.max(from, to) });
  };
  const up = (event: PointerEvent): void => {
    area.removeEventListener('pointermove', move);
    if (Math.abs(event.clientX - down.clientX) < CLICK) view.select(null);
  };
  area.setPointerCapture(down.pointerId);
  area.addEventListener('pointermove', move);
  area.addEventListener('pointerup', up, { once: true });
  down.preventDefault();
}

/** A pointer that moves less, in CSS pixels, has clicked. */
const CLICK = 3;
