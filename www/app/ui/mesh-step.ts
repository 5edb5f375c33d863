/** Step 4: make the mesh. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { complaintNote, toggle } from './controls.js';
import type { Page } from './page.js';
import { MOST_HEXES_OF_SOLIDS, MOST_QUADS } from 'hexmill';
import type { Forecast } from '../model/job.js';
import { bytes, counted, doing, duration, roughCount } from '../model/text.js';

const IS_MAC = /Mac|iPhone|iPad/.test(navigator.platform);

export function meshStep(page: Page): TemplateResult {
  const { workbench } = page;
  const isMeshing = workbench.running.value?.what === 'meshing';
  return html`
    ${complaintNote(workbench.trouble.mesh.value)}
    <div class="estimate-row">
      <p class="estimate" aria-live="polite">${estimate(page)}</p>
      ${toggle('Live', workbench.live.value, (on) => (workbench.live.value = on))}
    </div>
    ${isMeshing
      ? progress(page)
      : html`<button class="button primary wide ${workbench.isCurrent.value ? 'settled' : ''}" id="mesh" type="button"
          title=${`Make the mesh. Live: make it again after each change, up to ${roughCount(workbench.liveLimit.value)} ${workbench.makesHexes.value ? 'hexes' : 'quads'}.`}
          ?disabled=${!workbench.input.value || workbench.fault.value !== null} @click=${() => void workbench.mesh()}>
          <span>${workbench.isCurrent.value ? 'Meshed' : workbench.result.value ? 'Mesh again' : 'Mesh'}</span><kbd>${IS_MAC ? '⌘' : 'Ctrl'} ↵</kbd>
        </button>`}
    ${isMeshing || workbench.cancelled.value === null
      ? nothing
      : html`<p class="hint" data-cancelled>Cancelled after ${duration(workbench.cancelled.value)}.${workbench.result.value ? ' The mesh shown is the one from before.' : ''}</p>`}`;
}

function estimate({ workbench }: Page): TemplateResult | string {
  const guess = workbench.estimate.value;
  const trouble = workbench.trouble.estimate.value;
  if (workbench.fault.value) return html`<span class="fault">${workbench.fault.value}</span>`;
  if (trouble) return html`<span class="fault">${trouble.text}</span>`;
  if (!guess) return workbench.input.value ? 'Estimating…' : 'Open a model to begin';
  if (guess.noun === 'hex' && !guess.solid) return hexEstimate(guess);
  const about = guess.exact ? '' : 'about ';
  const { maxQuads, solid } = workbench.settings.value;
  const [cells, limit, most] = guess.solid ? (['hexes', solid.maxHexes, MOST_HEXES_OF_SOLIDS] as const) : (['quads', maxQuads, MOST_QUADS] as const);
  if (guess.cells > limit) {
    const size = `${about}${roughCount(guess.cells)} ${cells}, ${bytes(guess.bytes)}`;
    return html`<span class="fault" data-cells=${guess.cells}>${size}: more than ${limit < most ? 'your limit of' : 'this page can hold,'} ${roughCount(limit)}. Raise the edge length${guess.solid ? '' : ', or use fewer levels'}.</span>`;
  }
  return html`${about}<b data-cells=${guess.cells}>${roughCount(guess.cells)}</b> ${cells}<small>${memory(guess)}</small>`;
}

/** Levels, where there are any, and memory. */
function memory({ levels, bytes: size }: Forecast): string {
  return levels === null ? bytes(size) : `${counted(levels, 'level')}, ${bytes(size)}`;
}

/** What the work will add to what was asked for, and why. */
function hexEstimate(guess: Forecast): TemplateResult {
  const { cells, added } = guess;
  const { base = 0, families = 0, balance = 0, method = 0, conflicts = 0 } = added ?? {};
  const all = [[base, 'families everywhere'], [families, 'whole families'], [balance, 'grading'], [method, 'the method'], [conflicts, 'conflicts']] as const;
  const reasons = all
    .filter(([n]) => n > 0)
    .map(([n, why]) => `${roughCount(n)} for ${why}`);
  return html`<b data-cells=${cells}>${roughCount(cells)}</b> hexes<small>${memory(guess)}</small>
    ${reasons.length > 0 ? html`<small data-added>Refined beyond what is asked: ${reasons.join(', ')}</small>` : nothing}`;
}

function progress({ workbench }: Page): TemplateResult | typeof nothing {
  const running = workbench.running.value;
  if (!running) return nothing;
  const percent = running.fraction === null ? null : Math.round(100 * running.fraction);
  return html`<div class="running">
    <div class="running-text"><span>${running.stage ? doing(running.stage) : 'starting'}</span><span>${percent === null ? '' : `${percent} %`}</span></div>
    <progress aria-label="Progress of this stage" max="1" .value=${running.fraction ?? 0}></progress>
    <button class="button wide" id="cancel" type="button" @click=${() => workbench.cancel()}><span>Cancel</span><kbd>Esc</kbd></button>
  </div>`;
}
