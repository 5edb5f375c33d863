/** The right column: what the mesh is like. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import type { AddedHexes, QualitySummary } from 'hexmill';
import { iconButton, segmented, select } from './controls.js';
import { cutPanel } from './cut-panel.js';
import { distancePanel, featurePanel, secondOrderPanel } from './solid-panels.js';
import { histogram } from './histogram.js';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { levelColour, mapColour, qualityPlace } from '../model/colouring.js';
import { cellCount, cornersOf, isHexes, isSolid, nounOf } from '../model/job.js';
import type { Cells } from '../model/job.js';
import { isAcceptable, levelCounts } from '../model/metrics.js';
import { count, duration, fixed, percent } from '../model/text.js';
import type { Result } from '../model/workbench.js';

export function inspector(page: Page): TemplateResult {
  const result = page.workbench.result.value;
  if (!result) {
    return html`<div class="nothing">${icon('chart')}<p>Counts, checks and quality appear here once there is a mesh.</p></div>`;
  }
  return html`
    ${figures(result)}
    ${isHexes(result.mesh) ? cutPanel(page) : nothing}
    ${isSolid(result.mesh) ? html`${featurePanel(page, result.mesh)}${distancePanel(page, result.mesh, result.settings)}${secondOrderPanel(page, result.mesh, result.settings)}` : nothing}
    ${certificate(page, result)}
    <section aria-labelledby="colour-title">
      <h2 id="colour-title">Colour</h2>
      ${segmented(
        'Colour cells by',
        [
          { value: 'plain', label: 'Plain' },
          { value: 'quality', label: 'Quality' },
          isSolid(result.mesh) ? { value: 'distance', label: 'Distance' } : { value: 'level', label: 'Level' },
        ],
        page.inspection.shown.value,
        (colour) => page.inspection.show(colour),
      )}
    </section>
    ${quality(page, result)} ${cell(page, result)} ${levels(page, result)}`;
}

function figures({ mesh, milliseconds }: Result): TemplateResult {
  return html`<section class="figures" aria-label="Counts">
    <p><b data-figure=${PLURAL[nounOf(mesh)]}>${count(cellCount(mesh))}</b><span>${PLURAL[nounOf(mesh)]}</span></p>
    <p><b data-figure="nodes">${count(mesh.nodes.length / 3)}</b><span>nodes</span></p>
    <p class="aside">made in ${duration(milliseconds)}</p>
    ${'added' in mesh ? additions(mesh.added) : nothing}
  </section>`;
}

const PLURAL = { quad: 'quads', hex: 'hexes' } as const;

/** Why more was refined than asked for. */
const ADDED: readonly (readonly [keyof AddedHexes, string])[] = [
  ['base', 'for families or blocks of eight'],
  ['families', 'to complete families of eight'],
  ['balance', 'to grade levels by one'],
  ['method', 'for the method’s templates'],
  ['conflicts', 'where fine and coarse cannot be parted'],
  ['repairs', 'at transitions that stay inside out'],
];

function additions(added: AddedHexes): TemplateResult | typeof nothing {
  const reasons = ADDED.filter(([reason]) => added[reason] > 0);
  if (reasons.length === 0) return nothing;
  return html`<dl class="facts additions" title="Cells that were refined though no size asked for it">
    ${reasons.map(([reason, why]) => html`<dt>${why}</dt><dd data-added=${reason}>+${count(added[reason])}</dd>`)}
  </dl>`;
}

/** What `mesh.defects` empty says, each by itself. */
const CERTIFIED = {
  quad: ['Conforming: no hanging nodes', 'No repeated or unused nodes', 'Neighbours agree in orientation'],
  hex: ['Conforming: no hanging nodes', 'No repeated or unused nodes', 'Every Jacobian positive, inside too'],
} as const;
const DEFECTS_SHOWN = 6;

function certificate(page: Page, { mesh }: Result): TemplateResult {
  const { defects } = mesh;
  const more = defects.length - DEFECTS_SHOWN;
  return html`<section aria-labelledby="checks-title" data-valid=${String(defects.length === 0)}>
    <h2 id="checks-title">Checks</h2>
    <ul class="checks">
      ${defects.length === 0
        ? CERTIFIED[nounOf(mesh)].map((text) => html`<li class="good">${icon('check')}${text}</li>`)
        : defects.slice(0, DEFECTS_SHOWN).map((text) => html`<li class="bad">${icon('warn')}${text}</li>`)}
      ${more > 0 ? html`<li>and ${count(more)} more, in the log</li>` : nothing}
      ${'capped' in mesh && mesh.capped > 0 ? html`<li class="note">${icon('warn')}${count(mesh.capped)} cells are larger than asked for: the deepest level was reached.</li>` : nothing}
    </ul>
    <p class="hash"><span title="The same settings give this hash on every machine">Hash</span><code>${mesh.hash}</code>
      ${iconButton({ icon: 'copy', label: 'Copy the hash', press: () => void page.copyHash(mesh.hash) })}</p>
  </section>`;
}

function quality({ inspection }: Page, { mesh }: Result): TemplateResult {
  const info = inspection.info.value;
  // What is measured is one of the mesh's own: see `metricsOf`.
  const summary = (mesh.quality as Readonly<Record<string, QualitySummary>>)[info.metric] ?? inspection.summary.value;
  if (!summary) return html``;
  const text = (value: number): string => `${fixed(value, info.decimals)}${info.unit}`;
  const { brush, brushed, cell, measured, values } = inspection;
  const { min, max, mean, percentile1 } = summary;
  const stats =
    info.worst === 'low'
      ? ([['Minimum', min], ['1st percentile', percentile1], ['Mean', mean]] as const)
      : ([['Maximum', max], ['Mean', mean], ['Minimum', min]] as const);
  const bars = inspection.histogram.value;
  return html`<section aria-labelledby="quality-title">
    <div class="title-row">
      <h2 id="quality-title">Quality</h2>
      ${select('Measure', inspection.metrics.value.map(({ metric, label }) => ({ value: metric, label })), info.metric, (metric) => inspection.choose(metric))}
    </div>
    <dl class="stats">
      ${stats.map(([name, value]) => html`<div class=${isAcceptable(info, value) ? '' : 'bad'}><dt>${name}</dt><dd>${text(value)}</dd></div>`)}
    </dl>
    ${bars && histogram({
      label: `Histogram of ${info.label.toLowerCase()}, ${text(summary.min)} to ${text(summary.max)}`,
      histogram: bars, brush: brush.value, colour: (v) => mapColour('quality', qualityPlace(info, v)), text, bound: info.acceptable,
      marked: cell.value === null ? null : (values.value?.[cell.value] ?? null), select: (range) => inspection.select(range),
    })}
    ${brush.value
      ? html`<p class="hint">${count(brushed.value ?? 0)} cells from ${text(brush.value.low)} to ${text(brush.value.high)}.
          <button class="text-button" type="button" @click=${() => inspection.select(null)}>Show all</button></p>`
      : html`<p class="hint"><b>${percent(inspection.acceptable.value, measured.value)}</b> acceptable (${info.worst === 'low' ? 'at least' : 'at most'} ${text(info.acceptable)}). ${info.says}</p>`}
  </section>`;
}

function cell(page: Page, { mesh }: Result): TemplateResult | typeof nothing {
  const { inspection } = page;
  const { cell, rank, worst, values, info } = inspection;
  if (worst.value.length === 0) return nothing;
  const go = (by: 1 | -1): void => {
    const next = inspection.step(by);
    if (next !== null) page.viewport.show(next);
  };
  const looked = cell.value;
  const value = looked === null ? null : (values.value?.[looked] ?? null);
  return html`<section aria-labelledby="cell-title">
    <div class="title-row">
      <h2 id="cell-title">${looked === null ? 'Worst cells' : rank.value === null ? 'Picked cell' : `Worst cells, ${rank.value + 1} of ${worst.value.length}`}</h2>
      <span class="stepper">
        ${iconButton({ icon: 'left', label: 'Previous of the worst cells', press: () => go(-1) })}
        ${iconButton({ icon: 'chevron', label: 'Next of the worst cells', press: () => go(1) })}
      </span>
    </div>
    ${looked === null || value === null
      ? html`<p class="hint">Step through them, or click a cell in the view.</p>`
      : html`<dl class="facts" data-cell=${looked}>
          <dt>${info.value.label}</dt><dd>${Number.isNaN(value) ? 'none, it lies inside' : `${fixed(value, info.value.decimals)}${info.value.unit}`}</dd>
          <dt>Cell</dt><dd>${count(looked)}${isSolid(mesh) ? nothing : html`<small>level ${mesh.level[looked]}, of input ${isHexes(mesh) ? 'hex' : 'face'} ${count(mesh.parent[looked] ?? 0)}</small>`}</dd>
          <dt>Nodes</dt><dd class="ids">${nodesOf(mesh, looked).map((node) => count(node)).join('  ')}</dd>
        </dl>
        <button class="text-button" type="button" @click=${() => page.viewport.show(looked)}>${icon('target')}Show it</button>`}
  </section>`;
}

function nodesOf(mesh: Cells, cell: number): number[] {
  const { corners, each } = cornersOf(mesh);
  return Array.from(corners.subarray(each * cell, each * (cell + 1)));
}

function levels({ inspection }: Page, { mesh }: Result): TemplateResult | typeof nothing {
  if (isSolid(mesh)) return nothing;
  const counts = levelCounts(mesh.level);
  const most = Math.max(...counts);
  const isColoured = inspection.colour.value === 'level';
  return html`<section aria-labelledby="levels-title">
    <h2 id="levels-title">Levels</h2>
    <ol class="levels" start="0">
      ${counts.map((n, level) =>
        n === 0
          ? nothing
          : html`<li><span>${level}</span>
              <span class="bar" style="--part:${n / most};${isColoured ? `--bar:${levelColour(mesh, level)}` : ''}"></span>
              <span>${count(n)}</span></li>`,
      )}
    </ol>
  </section>`;
}
