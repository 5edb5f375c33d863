/** Step 2 for solids: how fine the hexes in them are, and where one surface ends and the next begins. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { curvature, edgeLength, numberField, segmented, slider, toggle } from './controls.js';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { classesOf, mended } from '../model/features.js';
import { BACKGROUNDS, HEX_KINDS } from '../model/link.js';
import { LIMITS } from '../model/settings.js';
import { diagonal } from '../model/shape.js';
import { count, counted, rounded } from '../model/text.js';

/** The slider of edge lengths spans these parts of the model's diagonal. */
const FINEST = 1 / 200;
const COARSEST = 1 / 8;

export function solidSizeStep(page: Page): TemplateResult {
  const { workbench } = page;
  const bounds = workbench.bounds.value;
  const length = (bounds && diagonal(bounds)) || 1;
  const { curvature: turn, edgeLength: value } = workbench.settings.value.solid;
  return html`
    ${edgeLength({ label: 'Edges about as long as', value, min: length * FINEST, max: length * COARSEST, change: (v) => workbench.editSolid({ edgeLength: v }) })}
    ${curvature(turn, (v) => workbench.editSolid({ curvature: v }))}
    ${features(page)}
    <details class="more" ?open=${page.moreSize.value} @toggle=${(event: Event) => (page.moreSize.value = (event.target as HTMLDetailsElement).open)}>
      <summary>${icon('chevron')}Background, nodes and limits</summary>
      ${further(page, length)}
    </details>`;
}

function further({ workbench }: Page, length: number): TemplateResult {
  const { background, maxDistance, maxHexes, maxLevels, secondOrder } = workbench.settings.value.solid;
  const says = BACKGROUNDS.find((known) => known.background === background)?.note;
  const kind = HEX_KINDS.find(({ hex }) => hex === secondOrder);
  return html`
    <div class="labelled"><span>Cut out of</span></div>
    ${segmented('Background', BACKGROUNDS.map(({ background: value, label, note }) => ({ value, label, note })), background, (v) => workbench.editSolid({ background: v }))}
    <p class="hint">${says}.</p>
    <div class="labelled"><span>Nodes of a hex</span></div>
    ${segmented('Nodes of a hex', HEX_KINDS.map(({ nodes: value, note }) => ({ value, label: value, note })), kind?.nodes ?? '8', (v) => workbench.editSolid({ secondOrder: HEX_KINDS.find(({ nodes }) => nodes === v)?.hex ?? null }))}
    <p class="hint">${kind?.note}.</p>
    ${toggle('Hold to a distance', maxDistance !== null, (on) => workbench.editSolid({ maxDistance: on ? rounded(length * USUAL_DISTANCE) : null }))}
    ${maxDistance === null
      ? nothing
      : numberField({ label: 'From the surface, at most', value: maxDistance, min: 0, open: true, unit: 'model units', change: (v) => workbench.editSolid({ maxDistance: v }) })}
    <div class="pair">
      ${numberField({ label: 'Levels to spare', value: maxLevels, ...LIMITS.solidLevels, whole: true, step: 1, change: (v) => workbench.editSolid({ maxLevels: v }) })}
      ${numberField({ label: 'Most hexes', value: maxHexes, ...LIMITS.maxHexesOfSolids, whole: true, step: 100_000, change: (v) => workbench.editSolid({ maxHexes: v }) })}
    </div>`;
}

/** Where a distance is held to, at first, as a part of the model's diagonal. */
const USUAL_DISTANCE = 1 / 500;

/** What keeps its place in the mesh, by the angle of faces. */
function features({ workbench }: Page): TemplateResult {
  const { featureAngle: value } = workbench.settings.value.solid;
  const text = (degrees: number): string => `${degrees}°`;
  return html`<div class="labelled"><span>Features from an angle of</span><output>${text(value)}</output></div>
    ${slider({ label: 'Feature angle', value, ...LIMITS.featureAngle, step: 1, text, change: (featureAngle) => workbench.editSolid({ featureAngle }) })}
    ${found(workbench.solid.value)}`;
}

function found(plan: Page['workbench']['solid']['value']): TemplateResult | typeof nothing {
  if (!plan) return nothing;
  const { corners, curves, surfaces, found: solid } = plan;
  const repairs = mended(plan);
  const parts = [counted(solid.bodies, 'body', 'bodies'), ...(solid.voids > 0 ? [counted(solid.voids, 'void')] : [])];
  return html`<dl class="facts" data-solid>
      <dt>Solid</dt><dd>${parts.join(', ')}</dd>
      <dt>Surfaces</dt><dd data-found="surfaces" data-count=${surfaces.length}>${count(surfaces.length)}<small>${classesOf(surfaces)}</small></dd>
      <dt>Curves</dt><dd data-found="curves" data-count=${curves.length}>${count(curves.length)}${solid.noiseEdges > 0 ? html`<small>${counted(solid.noiseEdges, 'edge')} left out as noise</small>` : nothing}</dd>
      <dt>Corners</dt><dd data-found="corners" data-count=${corners.length}>${count(corners.length)}</dd>
    </dl>
    ${repairs.length > 0 ? html`<div class="notice">${icon('warn')}<ul>${repairs.slice(0, SHOWN).map((text) => html`<li>${text}</li>`)}</ul></div>` : nothing}`;
}

/** Repairs listed. */
const SHOWN = 6;
