/** Step 2 for hexes: the box around a surface, how fine they are, and how fine and coarse ones are joined. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { numberField, segmented, slider } from './controls.js';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { METHODS } from '../model/link.js';
import { LIMITS } from '../model/settings.js';
import { diagonal, grown } from '../model/shape.js';
import { count, counted, significant } from '../model/text.js';

/** The slider of spacings spans these parts of the model's diagonal. */
const FINEST = 1 / 60;
const COARSEST = 1 / 4;

export function hexSizeStep(page: Page): TemplateResult {
  const { workbench } = page;
  return html`
    ${workbench.input.value?.surface ? box(page) : everywhere(page)}
    ${method(page)}
    <details class="more" ?open=${page.moreSize.value} @toggle=${(event: Event) => (page.moreSize.value = (event.target as HTMLDetailsElement).open)}>
      <summary>${icon('chevron')}Growth and limits</summary>
      ${further(page)}
    </details>`;
}

/** The coarse box, and how fine it becomes at the surface. */
function box({ workbench }: Page): TemplateResult {
  const bounds = workbench.bounds.value;
  const length = (bounds && diagonal(bounds)) || 1;
  const { spacing, margin, atSurface } = workbench.settings.value.hexes;
  const change = (value: number): void => workbench.editHexes({ spacing: value });
  return html`
    <div class="pair even">
      ${numberField({ label: 'Grid spacing', value: spacing, min: 0, open: true, change })}
      ${numberField({ label: 'Margin', value: margin, min: 0, change: (value) => workbench.editHexes({ margin: value }) })}
    </div>
    ${slider({
      label: 'Spacing of the grid', value: spacing, min: length * FINEST, max: length * COARSEST, logarithmic: true,
      text: (v) => `${significant(v)} model units`, change,
    })}
    <div class="ends"><span>finer</span><span>${bounds ? boxSize(grown(bounds, { spacing, margin }), spacing) : ''}</span><span>coarser</span></div>
    ${levels('At the surface, refine', atSurface, (value) => workbench.editHexes({ atSurface: value }))}`;
}

function boxSize({ min, max }: { min: readonly number[]; max: readonly number[] }, spacing: number): string {
  const counts = max.map((high, axis) => Math.round((high - (min[axis] ?? 0)) / spacing));
  return `${counts.map(count).join(' × ')} cubes`;
}

function levels(label: string, value: number, change: (levels: number) => void): TemplateResult {
  const times = (n: number): string => (n === 0 ? 'not' : n === 1 ? 'once' : `${n} times`);
  return html`<div class="labelled"><span>${label}</span><output>${times(value)}</output></div>
    ${slider({ label, value: Math.min(value, MOST_SHOWN), min: 0, max: MOST_SHOWN, step: 1, text: times, change })}`;
}

/** Levels that the slider reaches. */
const MOST_SHOWN = 5;

/** How fine hexes from a file are to be. */
function everywhere({ workbench }: Page): TemplateResult {
  const { by, edgeLength, levels: value } = workbench.settings.value.hexes;
  return html`
    ${segmented(
      'Sized by',
      [{ value: 'length', label: 'Edge length' }, { value: 'levels', label: 'Levels' }],
      by,
      (choice) => workbench.editHexes({ by: choice }),
    )}
    ${by === 'length'
      ? numberField({ label: 'No edge longer than', value: edgeLength, min: 0, open: true, unit: 'model units', change: (v) => workbench.editHexes({ edgeLength: v }) })
      : html`${numberField({ label: 'Refine everything this many times', value, ...LIMITS.hexLevels, whole: true, step: 1, change: (v) => workbench.editHexes({ levels: v }) })}
          ${slider({ label: 'Levels', value: Math.min(value, 4), min: 0, max: 4, step: 1, text: (v) => counted(v, 'level'), change: (v) => workbench.editHexes({ levels: v }) })}
          <p class="hint">Each level splits a hex into eight.</p>`}`;
}

function method({ workbench }: Page): TemplateResult {
  const { method: value } = workbench.settings.value.hexes;
  const says = METHODS.find((known) => known.method === value)?.note;
  return html`
    <div class="labelled"><span>Join fine and coarse by</span></div>
    ${segmented('Method', METHODS.map(({ method: id, label, note }) => ({ value: id, label, note })), value, (id) => workbench.editHexes({ method: id }))}
    ${says ? html`<p class="hint">${says}.</p>` : nothing}`;
}

function further({ workbench }: Page): TemplateResult {
  const { gradation, hexes } = workbench.settings.value;
  return html`
    ${numberField({ label: 'Growth from one cell to the next, at most', value: gradation, ...LIMITS.gradation, unit: 'times', step: 0.05, change: (v) => workbench.edit({ gradation: v }) })}
    <div class="pair">
      ${numberField({ label: 'Deepest level', value: hexes.maxLevels, ...LIMITS.hexLevels, whole: true, step: 1, change: (v) => workbench.editHexes({ maxLevels: v }) })}
      ${numberField({ label: 'Most hexes', value: hexes.maxHexes, ...LIMITS.maxHexes, whole: true, step: 100_000, change: (v) => workbench.editHexes({ maxHexes: v }) })}
    </div>`;
}
