/** Over the view: what it shows and from where; the legend of its colours. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { iconButton, segmented } from './controls.js';
import type { Page } from './page.js';
import { levelColour, mapGradient } from '../model/colouring.js';
import { KINDS, lostOf } from '../model/features.js';
import { isSolid } from '../model/job.js';
import { levelCounts } from '../model/metrics.js';
import { fixed, significant } from '../model/text.js';
import type { Axis } from './viewport.js';

const DIRECTIONS: readonly { axis: Axis; label: string; says: string }[] = [
  { axis: '+x', label: 'X', says: 'Look along X' },
  { axis: '+y', label: 'Y', says: 'Look along Y' },
  { axis: '+z', label: 'Z', says: 'Look along Z' },
];

export function toolbar(page: Page): TemplateResult | typeof nothing {
  const { workbench, viewport, cutting } = page;
  if (!workbench.input.value || !viewport.ready.value) return nothing;
  return html`<div class="toolbar" role="toolbar" aria-label="View">
    ${workbench.result.value
      ? segmented('Show', [{ value: 'input', label: 'Input' }, { value: 'mesh', label: 'Mesh' }], workbench.shows.value, (shows) => (workbench.shows.value = shows))
      : nothing}
    <span class="group">
      ${iconButton({ icon: 'frame', label: 'See all (F)', press: () => viewport.frameAll() })}
      ${iconButton({ icon: 'box', label: 'Look from a corner', press: () => viewport.look('iso') })}
      ${DIRECTIONS.map(({ axis, label, says }) => html`<button class="icon-button letter" type="button" title=${says} aria-label=${says} @click=${() => viewport.look(axis)}>${label}</button>`)}
    </span>
    <span class="group">
      ${cutting.bounds.value ? iconButton({ icon: 'cut', label: 'Cut open', pressed: cutting.section.value !== null, press: () => (cutting.section.value ? cutting.none() : viewport.cutOpen()) }) : nothing}
      ${iconButton({ icon: 'edges', label: 'Edges', pressed: viewport.edges.value, press: () => (viewport.edges.value = !viewport.edges.value) })}
      ${iconButton({
        icon: 'perspective', label: 'Perspective', pressed: viewport.projection.value === 'perspective',
        press: () => (viewport.projection.value = viewport.projection.value === 'perspective' ? 'orthographic' : 'perspective'),
      })}
      <button class="icon-button letter" type="button" title="What is up: Z as in CAD, Y as in modelling" aria-label=${`Up is ${viewport.up.value.toUpperCase()}`}
        @click=${() => (viewport.up.value = viewport.up.value === 'z' ? 'y' : 'z')}>${viewport.up.value.toUpperCase()}↑</button>
      ${iconButton({ icon: 'camera', label: 'Save a picture', press: () => void page.screenshot() })}
    </span>
  </div>`;
}

/** What the colours mean. */
export function legend({ workbench, inspection, viewport }: Page): TemplateResult | typeof nothing {
  const mesh = workbench.result.value?.mesh;
  const colour = inspection.colour.value;
  if (!viewport.ready.value) return nothing;
  if (workbench.shows.value === 'input') return workbench.solid.value ? featureLegend(KINDS) : nothing;
  if (!mesh) return nothing;
  if (colour === 'plain') return isSolid(mesh) && lostOf(mesh).length > 0 ? featureLegend([{ kind: 'lost', label: 'Not in the mesh' }]) : nothing;
  if (colour === 'level') {
    if (isSolid(mesh)) return nothing;
    const levels = levelCounts(mesh.level).flatMap((cells, level) => (cells > 0 ? [level] : []));
    return html`<div class="legend" aria-label="Colours by level"><span>Level</span>
      ${levels.map((level) => html`<span class="chip"><i style="background:${levelColour(mesh, level)}"></i>${level}</span>`)}
    </div>`;
  }
  const info = inspection.info.value;
  const [low, high] = info.worst === 'low' ? info.range : [info.range[1], info.range[0]];
  const text = (value: number): string => `${info.metric === 'distance' ? significant(value, 2) : fixed(value, info.unit ? 0 : 1)}${info.unit}`;
  return html`<div class="legend" aria-label="Colours by ${info.label}"><span>${info.label}</span><span>${text(low)}</span>
    <i class="ramp" style="background:${mapGradient('quality')}"></i><span>${text(high)}</span></div>`;
}

/** What the lines on a solid stand for. */
function featureLegend(kinds: typeof KINDS): TemplateResult {
  return html`<div class="legend" aria-label="Features"><span>Features</span>
    ${kinds.map(({ kind, label }) => html`<span class="chip"><i class=${kind === 'corner' ? 'dot' : ''} style="background:var(--feature-${kind})"></i>${label}</span>`)}
  </div>`;
}
