/** Starts the page: a mesher in its workers, a view on the canvas, the panels around it. */

import { effect } from '@preact/signals-core';
import { html, render } from 'lit-html';
import { createMesher } from 'hexmill';
import '@fontsource-variable/inter/wght.css';
import './style/tokens.css';
import './style/layout.css';
import './style/sliders.css';
import './style/controls.css';
import './style/panels.css';
import './style/inspector.css';
import './style/overlay.css';
import { exportStep } from './ui/export-step.js';
import { listen } from './ui/gestures.js';
import { inputStep } from './ui/input-step.js';
import { inspector } from './ui/inspector.js';
import { meshStep } from './ui/mesh-step.js';
import { Page } from './ui/page.js';
import { regionsStep } from './ui/regions-step.js';
import { frame, header, inspectorHead, tabs, unfolders, veil } from './ui/shell.js';
import { sizeStep } from './ui/size-step.js';
import { status } from './ui/status.js';
import { legend, toolbar } from './ui/toolbar.js';
import { viewTrouble, welcome } from './ui/welcome.js';

const PARTS: Readonly<Record<string, (page: Page) => unknown>> = {
  header,
  'step-input': inputStep,
  'step-size': sizeStep,
  'step-regions': regionsStep,
  'step-mesh': meshStep,
  'step-export': exportStep,
  unfold: unfolders,
  centre: (page) => html`${welcome(page)}${viewTrouble(page, () => void page.viewport.start(part('view')))}`,
  legend,
  toolbar,
  'inspector-head': inspectorHead,
  'inspector-body': inspector,
  tabs,
  status,
  veil,
};

/** CSS pixels of toolbar and legend with the space around them. */
const TOOLBAR = 84;

function part(id: string): HTMLElement {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no element #${id}`);
  return found;
}

/** What style sheets see of the state. */
function reflect(page: Page): void {
  const { dataset } = document.documentElement;
  dataset['sheet'] = page.sheet.value ?? 'none';
  dataset['model'] = String(page.workbench.input.value !== null);
  dataset['steps'] = page.stepsFolded.value ? 'folded' : 'open';
  dataset['inspector'] = page.inspectorFolded.value ? 'folded' : 'open';
}

/** How far the columns and the toolbar reach over the view. On a phone the columns lie below it. */
function measure(page: Page): void {
  const view = part('view').getBoundingClientRect();
  const reach = [...document.querySelectorAll('.steps, .inspector')].map((column) => {
    const { left, right, width, top } = column.getBoundingClientRect();
    if (width === 0 || top >= view.bottom) return 0;
    return left - view.left < view.right - right ? right - view.left : view.right - left;
  });
  const { height } = part('below').getBoundingClientRect();
  const covered: [number, number] = [Math.max(0, ...reach), height === 0 ? 0 : TOOLBAR];
  if (String(covered) !== String(page.viewport.covered.value)) page.viewport.covered.value = covered;
}

render(frame, part('app'));
const page = new Page(createMesher());
for (const [id, content] of Object.entries(PARTS)) {
  const host = part(id);
  effect(() => void render(content(page), host));
}
effect(() => {
  reflect(page);
  measure(page);
});
new ResizeObserver(() => measure(page)).observe(part('app'));
listen(page);
void page.viewport.start(part('view'));
page.openLink();
window.hexmill = page;
