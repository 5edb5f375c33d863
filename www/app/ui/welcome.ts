/** The middle of the page while there is no model, or no picture of one. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { icon } from './icons.js';
import { filePicker } from './input-step.js';
import type { Page } from './page.js';
import { EXAMPLES } from '../model/examples.js';
import { READABLE } from '../model/formats.js';

/** The addresses of the examples' pictures, by example and scheme: see scripts/screenshot.mjs. */
const THUMBNAILS = Object.fromEntries(
  Object.entries(import.meta.glob<string>('../thumbnails/*.webp', { query: '?url', import: 'default', eager: true })).map(
    ([path, url]) => [path.slice(path.lastIndexOf('/') + 1, -'.webp'.length), url],
  ),
);

export function welcome(page: Page): TemplateResult | typeof nothing {
  const { workbench } = page;
  const engine = workbench.trouble.engine.value;
  if (engine) {
    return message('The mesher did not start', html`<p>${engine.text}</p><p>Reload the page; if that does not help, try a current Firefox, Chrome or Safari.</p>`);
  }
  if (workbench.input.value || workbench.running.value) return nothing;
  return html`<div class="welcome">
    <h1><span class="with-mouse">Drop a mesh here</span><span class="with-finger">Open a mesh</span></h1>
    <p>A surface becomes a conforming mesh of quads, of hexes around it, or of hexes that fill the solid in it; hexes are refined and looked into. Everything happens in this page: no file leaves your machine.</p>
    <div class="row centred">${filePicker('Choose a file…', (file) => page.openFile(file))}</div>
    <p class="formats">${READABLE.map(({ extension }) => `.${extension}`).join('   ')}</p>
    <h2>Or start from an example</h2>
    <ul class="examples">
      ${EXAMPLES.map(
        ({ id, label, faces, by, licence }) => html`<li><button type="button" title=${`${by}. ${licence}.`} data-example=${id} @click=${() => page.openExample(id)}>
          <img src=${THUMBNAILS[`${id}-${page.theme.scheme.value}`] ?? nothing} alt="" width="256" height="160" />
          <b>${label}</b><small>${faces}</small></button></li>`,
      )}
    </ul>
  </div>`;
}

/** Why there is no picture, with a way to get one again. */
export function viewTrouble(page: Page, restart: () => void): TemplateResult | typeof nothing {
  const trouble = page.viewport.trouble.value;
  if (!trouble) return nothing;
  return message(
    'No 3D view',
    html`<p>${trouble}</p><p>Meshing, checks and export work without it.</p>
      <button class="button" type="button" @click=${restart}>Try again</button>`,
  );
}

function message(title: string, content: TemplateResult): TemplateResult {
  return html`<div class="message" role="alert">${icon('warn')}<div><h2>${title}</h2>${content}</div></div>`;
}
