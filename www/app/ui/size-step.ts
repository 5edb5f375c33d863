/** Step 2: how fine the whole mesh is. */

import { html } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { curvature, edgeLength, numberField, segmented, slider, toggle } from './controls.js';
import { hexSizeStep } from './hex-size-step.js';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { solidSizeStep } from './solid-size-step.js';
import { LIMITS } from '../model/settings.js';
import { diagonal } from '../model/shape.js';
import { count, counted } from '../model/text.js';

/** The slider spans these parts of the model's diagonal. */
const FINEST = 1 / 2000;
const COARSEST = 1 / 4;

export function sizeStep(page: Page): TemplateResult {
  const { workbench } = page;
  if (workbench.job.value === 'solid') return solidSizeStep(page);
  if (workbench.job.value === 'hexes') return hexSizeStep(page);
  const settings = workbench.settings.value;
  return html`
    ${segmented(
      'Sized by',
      [{ value: 'length', label: 'Edge length' }, { value: 'levels', label: 'Levels' }],
      settings.by,
      (by) => workbench.edit({ by }),
    )}
    ${settings.by === 'length' ? everywhere(page) : levels(page)}
    ${curvature(settings.curvature, (curvature) => workbench.edit({ curvature }))}
    <details class="more" ?open=${page.moreSize.value} @toggle=${(event: Event) => (page.moreSize.value = (event.target as HTMLDetailsElement).open)}>
      <summary>${icon('chevron')}Growth and limits</summary>
      ${further(page)}
    </details>`;
}

function everywhere({ workbench }: Page): TemplateResult {
  const bounds = workbench.bounds.value;
  const length = (bounds && diagonal(bounds)) || 1;
  const { edgeLength: value } = workbench.settings.value;
  return edgeLength({
    label: 'No edge longer than', value, min: length * FINEST, max: length * COARSEST,
    change: (edgeLength) => workbench.edit({ edgeLength }),
  });
}

function levels({ workbench }: Page): TemplateResult {
  const { levels: value } = workbench.settings.value;
  const change = (levels: number): void => workbench.edit({ levels });
  return html`
    ${numberField({ label: 'Refine everything this many times', value, ...LIMITS.levels, whole: true, step: 1, change })}
    ${slider({ label: 'Levels', value: Math.min(value, 6), min: 0, max: 6, step: 1, text: (v) => counted(v, 'level'), change })}
    <p class="hint">Each level splits a quad into four; the first turns any face into quads.</p>`;
}

function further({ workbench }: Page): TemplateResult {
  const { gradation, keepCoarse, maxLevels, maxQuads } = workbench.settings.value;
  const info = workbench.input.value?.surface?.info;
  const others = info ? info.faces - info.quads : 0;
  return html`
    ${numberField({ label: 'Growth from one cell to the next, at most', value: gradation, ...LIMITS.gradation, unit: 'times', step: 0.05, change: (v) => workbench.edit({ gradation: v }) })}
    <div class="pair">
      ${numberField({ label: 'Deepest level', value: maxLevels, ...LIMITS.levels, whole: true, step: 1, change: (v) => workbench.edit({ maxLevels: v }) })}
      ${numberField({ label: 'Most quads', value: maxQuads, ...LIMITS.maxQuads, whole: true, step: 1_000_000, change: (v) => workbench.edit({ maxQuads: v }) })}
    </div>
    ${toggle(
      'Keep coarse quads', keepCoarse, (on) => workbench.edit({ keepCoarse: on }),
      others === 0 ? 'Quads that nothing asks to refine stay whole.' : `For inputs of quads only; this one has ${count(others)} other faces.`,
    )}`;
}
