/** What became of a solid in its mesh: its features, and how far the mesh is from it. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import type { HexedSolid, SurfaceDistances, Vector } from 'hexmill';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { lostOf } from '../model/features.js';
import type { Lost } from '../model/features.js';
import type { Settings, SolidSettings, Vec3 } from '../model/settings.js';
import { diagonal } from '../model/shape.js';
import { count, counted, significant } from '../model/text.js';

/** Lost features listed. */
const SHOWN = 8;
/** What is shown around a lost feature, in parts of its size. */
const AROUND = 1;
/** What is shown around a node, in edges. */
const EDGES_AROUND = 3;

export function featurePanel(page: Page, mesh: HexedSolid): TemplateResult {
  const { features, euler, solidEuler } = mesh.result;
  const lost = lostOf(mesh);
  const kinds = [['Surfaces', features.surfaces], ['Curves', features.curves], ['Corners', features.corners]] as const;
  const isAlike = euler === solidEuler;
  return html`<section aria-labelledby="features-title" data-lost=${lost.length}>
    <h2 id="features-title">Features</h2>
    <dl class="stats">
      ${kinds.map(([name, { found, captured }]) => html`<div class=${captured < found ? 'bad' : ''}><dt>${name}</dt><dd>${count(captured)}<small> of ${count(found)}</small></dd></div>`)}
    </dl>
    ${lost.length === 0
      ? verdict(true, 'The mesh shows every feature')
      : html`<ol class="lost">${lost.slice(0, SHOWN).map((one) => item(page, one))}</ol>
          ${lost.length > SHOWN ? html`<p class="hint">and ${counted(lost.length - SHOWN, 'smaller one')}</p>` : nothing}`}
    ${isAlike
      ? nothing
      : verdict(false, `Of another kind than the solid: Euler number ${significant(euler)}, not ${significant(solidEuler)}. Lower the edge length.`)}
  </section>`;
}

const NAMES = { curve: 'Curve', surface: 'Surface', body: 'Body' } as const;

function item({ viewport }: Page, { what, id, fate, place, size }: Lost): TemplateResult {
  const where = place.map((x) => significant(x, 3)).join(', ');
  return html`<li><button class="text-button" type="button" title="Show it, at ${where}" @click=${() => viewport.showPlace(place as Vec3, AROUND * size)}>
    <i></i><span>${NAMES[what]} ${id + 1}</span><small>${fate}, ${what === 'curve' ? 'length' : 'size'} ${significant(size, 3)} at ${where}</small></button></li>`;
}

/** Nodes beside the corners, if there are any: on the solid, and off it where a hex would be turned inside out. */
export function secondOrderPanel(page: Page, { report: { secondOrder: made } }: HexedSolid, { solid }: Settings): TemplateResult | typeof nothing {
  if (!made) return nothing;
  const { farthest, nodes, onSolid, place, yielded } = made;
  const yields = `${counted(yielded, 'node')} off the solid for the sake of ${yielded === 1 ? 'its' : 'their'} hexes, at most ${significant(farthest, 3)}`;
  return html`<section aria-labelledby="second-order-title" data-second-order=${made.hex}>
    <h2 id="second-order-title">Second order</h2>
    <dl class="facts">
      <dt>Nodes beside the corners</dt><dd>${count(nodes)}</dd>
      <dt>On the solid</dt><dd>${count(onSolid)}</dd>
    </dl>
    ${yielded === 0 ? verdict(true, 'All on the boundary are on the solid') : verdict(false, place ? showing(page, yields, place, solid) : yields)}
  </section>`;
}

/** Distances that are less than this part of the diagonal are none: there they are rounded off. */
const NONE = 1e-12;

/** Both ways: the mesh may be near the solid and yet miss a part of it. */
export function distancePanel(page: Page, { result }: HexedSolid, { solid }: Settings): TemplateResult {
  const { workbench } = page;
  const { meshToSurface, surfaceToMesh } = result.distance;
  const bounds = workbench.bounds.value;
  const length = (bounds && diagonal(bounds)) || 1;
  const rows = [['From the mesh, at most', meshToSurface.max], ['To the mesh, at most', surfaceToMesh.max], ['On average', Math.max(meshToSurface.mean, surfaceToMesh.mean)]] as const;
  const text = (value: number): TemplateResult =>
    value < NONE * length ? html`none` : html`${significant(value, 3)}<small title="Of the model’s diagonal">${significant((100 * value) / length, 2)} %</small>`;
  return html`<section aria-labelledby="distance-title">
    <h2 id="distance-title">Distance to the input</h2>
    <dl class="facts">${rows.map(([name, value]) => html`<dt>${name}</dt><dd>${text(value)}</dd>`)}</dl>
    ${result.maxDistance === null ? nothing : asked(page, result.distance, result.maxDistance, solid)}
  </section>`;
}

/** Whether a mesh is as near as was asked for. */
function asked(page: Page, { meshToSurface, surfaceToMesh }: SurfaceDistances, limit: number, solid: SolidSettings): TemplateResult {
  const { max, farthest } = meshToSurface.max > surfaceToMesh.max ? meshToSurface : surfaceToMesh;
  const text = `the ${significant(limit, 3)} asked for`;
  return max <= limit ? verdict(true, `Within ${text}`) : verdict(false, showing(page, `Farther than ${text}`, farthest, solid));
}

/** What was found of a mesh, and whether that is good. */
function verdict(isGood: boolean, text: string | TemplateResult): TemplateResult {
  return html`<ul class="checks" data-good=${isGood}><li class=${isGood ? 'good' : 'bad'}>${icon(isGood ? 'check' : 'warn')}${text}</li></ul>`;
}

/** A text that shows its place. */
function showing({ viewport }: Page, text: string, place: Vector, { edgeLength }: SolidSettings): TemplateResult {
  return html`<button class="text-button" type="button" title="Show the farthest" @click=${() => viewport.showPlace(place as Vec3, EDGES_AROUND * edgeLength)}>${text}</button>`;
}
