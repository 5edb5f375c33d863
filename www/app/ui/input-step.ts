/** Step 1: the model. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { complaintNote, segmented, select } from './controls.js';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { EXAMPLES } from '../model/examples.js';
import { ACCEPT } from '../model/formats.js';
import { count, counted, significant } from '../model/text.js';
import type { Input } from '../model/job.js';
import type { HexMesh, Surface, SurfaceInfo } from 'hexmill';

export function inputStep(page: Page): TemplateResult {
  const input = page.workbench.input.value;
  return html`
    ${input ? inputSummary(input) : html`<p class="hint">Drop a mesh anywhere on the page, choose a file, or start from an example. Files stay on your machine.</p>`}
    ${input?.surface ? job(page) : nothing}
    ${complaintNote(page.workbench.trouble.input.value)}
    <div class="row">
      ${filePicker(input ? 'Open another…' : 'Choose a file…', (file) => page.openFile(file))}
      ${select(
        'Example',
        [{ value: '', label: 'Example' }, ...EXAMPLES.map(({ id, label }) => ({ value: id, label }))],
        '',
        (id) => id && page.openExample(id),
      )}
    </div>`;
}

/** What is made of a surface. */
function job({ workbench }: Page): TemplateResult {
  return segmented(
    'Make',
    [
      { value: 'quads', label: 'Quads on it', note: 'Quads on the surface' },
      { value: 'hexes', label: 'Hexes around it', note: 'Hexes in a box around the surface' },
      { value: 'solid', label: 'Hexes in it', note: 'Hexes that fill the solid inside the surface, which has to be closed' },
    ],
    workbench.settings.value.job,
    (choice) => workbench.choose(choice),
  );
}

/** The button that opens the file dialog. */
export function filePicker(label: string, open: (file: File) => void): TemplateResult {
  const chosen = (event: Event): void => {
    const picker = event.target as HTMLInputElement;
    const [file] = picker.files ?? [];
    if (file) open(file);
    picker.value = '';
  };
  return html`<label class="button">
    <input class="hidden" type="file" accept=${ACCEPT} @change=${chosen} />
    ${icon('open')}<span>${label}</span>
  </label>`;
}

function inputSummary({ name, example, surface, hexes }: Input): TemplateResult {
  const defects = (surface ?? hexes)?.info.defects ?? [];
  return html`
    <p class="file-name" title=${name}>${icon('file')}<span>${name}</span></p>
    ${surface ? surfaceFacts(surface) : hexes ? hexFacts(hexes) : nothing}
    ${defects.length > 0 ? defectList(defects) : nothing}
    ${example
      ? html`<p class="credit">${example.by}. ${example.licence}. <a href=${example.source} target="_blank" rel="noopener">Source</a></p>`
      : nothing}`;
}

function surfaceFacts({ info }: Surface): TemplateResult {
  return html`<dl class="facts">
    <dt>Faces</dt><dd>${count(info.faces)}<small>${kinds(info)}</small></dd>
    <dt>Nodes</dt><dd>${count(info.nodes)}</dd>
    ${extents(info)}
    <dt>Surface</dt><dd>${closure(info)}<small>${pieces(info.components)}</small></dd>
  </dl>`;
}

function hexFacts({ info }: HexMesh): TemplateResult {
  return html`<dl class="facts">
    <dt>Hexes</dt><dd>${count(info.hexes)}</dd>
    <dt>Nodes</dt><dd>${count(info.nodes)}</dd>
    ${extents(info)}
    <dt>Boundary</dt><dd>${counted(info.boundaryFaces, 'face')}<small>${pieces(info.components)}</small></dd>
  </dl>`;
}

function extents({ bounds, meanEdge, longestEdge }: Pick<SurfaceInfo, 'bounds' | 'meanEdge' | 'longestEdge'>): TemplateResult {
  const size = bounds.max.map((high, axis) => significant(high - (bounds.min[axis] ?? 0), 3));
  return html`<dt>Size</dt><dd>${size.join(' × ')}</dd>
    <dt>Edges</dt><dd>${significant(meanEdge, 3)} mean<small>${significant(longestEdge, 3)} longest</small></dd>`;
}

const DEFECTS_SHOWN = 3;

function defectList(defects: readonly string[]): TemplateResult {
  const more = defects.length - DEFECTS_SHOWN;
  return html`<div class="notice">${icon('warn')}
    <ul>${defects.slice(0, DEFECTS_SHOWN).map((text) => html`<li>${text}</li>`)}${more > 0 ? html`<li>and ${count(more)} more, in the log</li>` : nothing}</ul>
  </div>`;
}

function kinds(info: SurfaceInfo): string {
  const parts: [number, string][] = [[info.triangles, 'triangle'], [info.quads, 'quad'], [info.polygons, 'polygon']];
  const present = parts.filter(([n]) => n > 0);
  if (present.length === 1) return `all ${present[0]?.[1] ?? ''}s`;
  return present.map(([n, name]) => counted(n, name)).join(', ');
}

function closure(info: SurfaceInfo): string {
  return info.boundaryEdges === 0 ? 'Closed' : `${count(info.boundaryEdges)} open edges`;
}

function pieces(components: number): string {
  return components === 1 ? 'one piece' : `${count(components)} pieces`;
}
