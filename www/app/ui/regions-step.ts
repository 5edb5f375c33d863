/** Step 3: where the mesh is finer. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { repeat } from 'lit-html/directives/repeat.js';
import { complaintNote, iconButton, numberField, segmented } from './controls.js';
import { icon } from './icons.js';
import { filePicker } from './input-step.js';
import type { Page } from './page.js';
import type { Guide } from '../model/guide.js';
import { LIMITS } from '../model/settings.js';
import type { Region, Shape, Target, Vec3 } from '../model/settings.js';
import { fault, SHAPES } from '../model/shape.js';
import { counted, rounded, significant } from '../model/text.js';

export function regionsStep(page: Page): TemplateResult {
  const { workbench } = page;
  const { regions, guides } = workbench.settings.value;
  return html`
    <div class="adders" role="group" aria-label="Add a region">
      ${SHAPES.map(
        ({ kind, label }) => html`<button class="button" type="button" ?disabled=${!workbench.input.value} aria-label="Add ${label.toLowerCase()}"
          @click=${() => workbench.addRegion(kind)}>${icon(kind)}<span>${label}</span></button>`,
      )}
    </div>
    ${workbench.takesGuides.value ? filePicker('Near a surface…', (file) => page.openGuide(file)) : nothing}
    ${complaintNote(workbench.trouble.guide.value)}
    ${regions.length + guides.length === 0
      ? html`<p class="hint">Add a region and drag its handles in the view. It lands where you last clicked on the model.</p>`
      : html`<ol class="regions">
          ${repeat(regions, ({ id }) => id, (region, index) => regionItem(page, region, index))}
          ${repeat(guides, ({ id }) => id, (guide, index) => guideItem(page, guide, regions.length + index))}
        </ol>`}`;
}

function regionItem(page: Page, region: Region, index: number): TemplateResult {
  const { workbench } = page;
  const isOpen = workbench.selected.value === region.id;
  const name = `${SHAPES.find(({ kind }) => kind === region.shape.kind)?.label ?? ''} ${index + 1}`;
  return html`<li class=${isOpen ? 'open' : ''} data-region=${index}>
    <div class="region-head">
      ${head(page, region, index, html`${icon(region.shape.kind)}<span>${name}</span>`)}
      ${iconButton({ icon: 'copy', label: `Duplicate ${name}`, press: () => workbench.duplicateRegion(region.id) })}
      ${iconButton({ icon: 'bin', label: `Delete ${name}`, press: () => workbench.deleteRegion(region.id) })}
    </div>
    ${isOpen ? editor(page, region) : nothing}
  </li>`;
}

function guideItem(page: Page, guide: Guide, index: number): TemplateResult {
  const { workbench } = page;
  const isOpen = workbench.selected.value === guide.id;
  return html`<li class=${isOpen ? 'open' : ''} data-region=${index}>
    <div class="region-head">
      ${head(page, guide, index, html`${icon('file')}<span title=${guide.name}>${guide.name}</span>`)}
      ${iconButton({ icon: 'bin', label: `Delete ${guide.name}`, press: () => workbench.deleteGuide(guide.id) })}
    </div>
    ${isOpen ? guideEditor(page, guide) : nothing}
  </li>`;
}

/** What opens a region: its name, and what it asks for or that it meets nothing. */
function head({ workbench }: Page, { id, target }: Pick<Region, 'id' | 'target'>, index: number, name: TemplateResult): TemplateResult {
  const isOpen = workbench.selected.value === id;
  const isIdle = workbench.isEstimated.value && (workbench.estimate.value?.idleRegions.includes(index) ?? false);
  return html`<button class="region-name" type="button" aria-expanded=${isOpen} @click=${() => (workbench.selected.value = isOpen ? null : id)}>
    ${name}
    ${isIdle ? html`<small class="idle" title="It overlaps no part of the model, so it refines nothing">meets nothing</small>` : html`<small>${describe(target)}</small>`}
  </button>`;
}

function describe(target: Target): string {
  return target.by === 'size' ? `edges ≤ ${significant(target.size, 3)}` : counted(target.level, 'level');
}

function editor(page: Page, { id, shape, target }: Region): TemplateResult {
  const { workbench } = page;
  const reshape = (change: Partial<Shape>): void => workbench.editRegion(id, { shape: { ...shape, ...change } as Shape });
  const problem = fault(shape);
  return html`<div class="region-editor">
    ${shapeFields(shape, reshape)}
    ${problem ? html`<p class="fault" role="alert">${problem}</p>` : nothing}
    ${targetFields(page, 'Inside', target, (target) => workbench.editRegion(id, { target }))}
  </div>`;
}

function guideEditor(page: Page, { id, at, distance, target }: Guide): TemplateResult {
  const { workbench } = page;
  return html`<div class="region-editor">
    ${segmented(
      'Refine near',
      [{ value: 'surface', label: 'Surface' }, { value: 'points', label: 'Its points' }],
      at,
      (at) => workbench.editGuide(id, { at }),
    )}
    ${numberField({ label: 'Up to this distance, 0: what it passes', value: distance, min: 0, unit: 'model units', change: (distance) => workbench.editGuide(id, { distance }) })}
    ${targetFields(page, 'There', target, (target) => workbench.editGuide(id, { target }))}
  </div>`;
}

/** How fine cells are to be somewhere. */
function targetFields({ workbench }: Page, where: string, target: Target, change: (target: Target) => void): TemplateResult {
  return html`
    ${segmented(
      'Region sized by',
      [{ value: 'size', label: 'Edge length' }, { value: 'level', label: 'Level' }],
      target.by,
      (by) => change(by === 'size' ? { by, size: rounded(workbench.usualEdge() / 4) } : { by, level: 3 }),
    )}
    ${target.by === 'size'
      ? numberField({ label: `${where}, no edge longer than`, value: target.size, min: 0, open: true, unit: 'model units', change: (size) => change({ by: 'size', size }) })
      : numberField({ label: `${where}, refine the input this many times`, value: target.level, ...(workbench.makesHexes.value ? LIMITS.hexLevels : LIMITS.levels), whole: true, step: 1, change: (level) => change({ by: 'level', level }) })}`;
}

function shapeFields(shape: Shape, change: (change: Partial<Shape>) => void): TemplateResult {
  const radius = (value: number): TemplateResult => numberField({ label: 'Radius', value, min: 0, open: true, change: (radius) => change({ radius }) });
  switch (shape.kind) {
    case 'box':
      return html`${triple('Minimum', shape.min, (min) => change({ min }))}${triple('Maximum', shape.max, (max) => change({ max }))}
        ${shape.rotation ? html`<button class="text-button" type="button" @click=${() => change({ rotation: [0, 0, 0, 1] })}>Turn upright</button>` : nothing}`;
    case 'sphere':
      return html`${triple('Centre', shape.center, (center) => change({ center }))}${radius(shape.radius)}`;
    case 'cylinder':
      return html`${triple('From', shape.from, (from) => change({ from }))}${triple('To', shape.to, (to) => change({ to }))}${radius(shape.radius)}`;
  }
}

/** Three coordinates in a row. */
function triple(label: string, value: Vec3, change: (value: Vec3) => void): TemplateResult {
  const at = (axis: number) => (x: number): void => change(value.map((old, i) => (i === axis ? x : old)) as Vec3);
  return html`<fieldset class="triple"><legend>${label}</legend>
    ${value.map((x, axis) => numberField({ label: `${label} ${'xyz'[axis]}`, inline: 'xyz'[axis] ?? '', value: x, change: at(axis) }))}
  </fieldset>`;
}
