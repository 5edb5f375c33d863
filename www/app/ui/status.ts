/** The line below: what happens now; the log on demand. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { iconButton } from './controls.js';
import { icon } from './icons.js';
import type { Page } from './page.js';
import { counted, doing } from '../model/text.js';

export function status(page: Page): TemplateResult {
  const { workbench } = page;
  const running = workbench.running.value;
  const last = workbench.log.entries.value.at(-1);
  const text = running ? `${capital(running.what)}${running.stage ? `: ${doing(running.stage)}` : '…'}` : page.said.value || last?.text || '';
  const threads = workbench.threads.value;
  return html`
    ${page.logOpen.value ? log(page) : nothing}
    <div class="line">
      <span class="state ${running ? 'busy' : (last?.kind ?? '')}" aria-hidden="true"></span>
      <span class="text" role="status" aria-live="polite">${text}</span>
      ${running && running.fraction !== null ? html`<progress max="1" aria-hidden="true" .value=${running.fraction}></progress>` : nothing}
      ${running && running.what !== 'meshing' ? html`<button class="text-button" type="button" @click=${() => workbench.cancel()}>Cancel</button>` : nothing}
      <span class="spring"></span>
      ${threads === null ? nothing : html`<span class="threads" title=${threadNote(threads)}>${counted(threads, 'thread')}</span>`}
      <button class="text-button" type="button" aria-expanded=${page.logOpen.value} aria-controls="log" @click=${() => (page.logOpen.value = !page.logOpen.value)}>
        ${icon('log')}Log</button>
    </div>`;
}

function threadNote(threads: number): string {
  return threads > 1
    ? 'The mesher works on this many threads.'
    : crossOriginIsolated
      ? 'The mesher works on one thread.'
      : 'One thread: the server does not isolate this page (COOP and COEP headers), so there is no shared memory.';
}

function log(page: Page): TemplateResult {
  const entries = page.workbench.log.entries.value;
  return html`<div class="log" id="log" role="log" aria-label="Log" tabindex="0">
    <div class="log-head"><h2>Log</h2>${iconButton({ icon: 'close', label: 'Close the log', press: () => (page.logOpen.value = false) })}</div>
    <ol>${entries.map((entry) => html`<li class=${entry.kind}><time>${entry.at.toLocaleTimeString('en-GB')}</time><span>${entry.text}</span></li>`)}</ol>
  </div>`;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
