/** The frame of the page: full-bleed view, columns that fold, sheets on a phone, one line below. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { iconButton } from './controls.js';
import { icon, mark } from './icons.js';
import type { IconName } from './icons.js';
import type { Page, Section, Sheet } from './page.js';

/** The page's parts, each rendered by itself into the element of its id. */
export const frame = html`
  <main class="overlay">
    <div class="view" id="view"></div>
    <div class="steps" id="steps">
      <header id="header"></header>
      <div class="scroll">
        ${section('input', 'Input')} ${section('size', 'Size')} ${section('regions', 'Regions')}
      </div>
      <div class="make"><div id="step-mesh"></div><div id="step-export"></div></div>
    </div>
    <div class="middle">
      <div id="unfold"></div>
      <div class="centre" id="centre"></div>
      <div class="below" id="below"><div id="legend"></div><div id="toolbar"></div></div>
    </div>
    <aside class="inspector" id="inspector" aria-label="Inspector">
      <header id="inspector-head"></header>
      <div class="scroll" id="inspector-body"></div>
    </aside>
    <nav class="tabs" id="tabs" aria-label="Panels"></nav>
    <footer class="status" id="status"></footer>
  </main>
  <div class="drop-veil" id="veil"></div>`;

function section(name: Section, title: string): TemplateResult {
  return html`<section class="step" data-section=${name} aria-labelledby="title-${name}">
    <h2 id="title-${name}">${title}</h2>
    <div id="step-${name}"></div>
  </section>`;
}

export function header(page: Page): TemplateResult {
  const { workbench, theme } = page;
  const isDark = theme.scheme.value === 'dark';
  return html`
    <a class="brand" href="./" aria-label="hexmill, start again">${mark}<span>hexmill</span></a>
    <span class="spring"></span>
    ${iconButton({ icon: 'undo', label: 'Undo (Ctrl+Z)', disabled: !workbench.canUndo.value, press: () => workbench.undo() })}
    ${iconButton({ icon: 'redo', label: 'Redo (Ctrl+Shift+Z)', disabled: !workbench.canRedo.value, press: () => workbench.redo() })}
    ${iconButton({ icon: isDark ? 'sun' : 'moon', label: isDark ? 'Light' : 'Dark', press: () => theme.flip() })}
    <span class="wide-only">${iconButton({ icon: 'fold', label: 'Fold this column away', press: () => (page.stepsFolded.value = true) })}</span>`;
}

export function inspectorHead(page: Page): TemplateResult {
  return html`<h1>${page.workbench.result.value ? 'Result' : 'Inspector'}</h1><span class="spring"></span>
    <span class="wide-only mirrored">${iconButton({ icon: 'fold', label: 'Fold the inspector away', press: () => (page.inspectorFolded.value = true) })}</span>`;
}

/** The buttons that bring folded columns back. */
export function unfolders(page: Page): TemplateResult {
  return html`
    ${page.stepsFolded.value ? html`<span class="unfold-steps">${iconButton({ icon: 'fold', label: 'Show the steps', press: () => (page.stepsFolded.value = false) })}</span>` : nothing}
    ${page.inspectorFolded.value ? html`<span class="unfold-inspector mirrored">${iconButton({ icon: 'fold', label: 'Show the inspector', press: () => (page.inspectorFolded.value = false) })}</span>` : nothing}`;
}

const TABS: readonly { sheet: Exclude<Sheet, null>; label: string; icon: IconName }[] = [
  { sheet: 'input', label: 'Input', icon: 'file' },
  { sheet: 'size', label: 'Size', icon: 'size' },
  { sheet: 'regions', label: 'Regions', icon: 'box' },
  { sheet: 'inspect', label: 'Result', icon: 'chart' },
];

/** A phone's way to the panels. */
export function tabs(page: Page): TemplateResult {
  return html`${TABS.map(({ sheet, label, icon: name }) => {
    const isOpen = page.sheet.value === sheet;
    return html`<button type="button" aria-pressed=${isOpen} @click=${() => (page.sheet.value = isOpen ? null : sheet)}>${icon(name)}<span>${label}</span></button>`;
  })}`;
}

export function veil(page: Page): TemplateResult | typeof nothing {
  return page.dropping.value ? html`<p>${icon('open')}Drop to open</p>` : nothing;
}
