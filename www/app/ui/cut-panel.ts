/** In the inspector: what is cut away of hexes to look inside. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { iconButton, segmented, slider } from './controls.js';
import type { Page } from './page.js';
import { fixed, significant } from '../model/text.js';

export function cutPanel(page: Page): TemplateResult {
  const { cutting, viewport } = page;
  const section = cutting.section.value;
  return html`<section aria-labelledby="cut-title">
    <div class="title-row">
      <h2 id="cut-title">Look inside</h2>
      <span class="stepper">
        ${iconButton({ icon: 'target', label: 'Cut facing the view', press: () => cutting.facing(viewport.toEye()) })}
        ${iconButton({ icon: 'flip', label: 'Show the other side', disabled: section === null, press: () => cutting.flip() })}
      </span>
    </div>
    ${segmented(
      'Cut across',
      [{ value: 'none', label: 'Off' }, { value: 'x', label: 'X' }, { value: 'y', label: 'Y' }, { value: 'z', label: 'Z' }, ...(section && !cutting.axis.value ? [{ value: 'free', label: 'Free' } as const] : [])],
      section ? (cutting.axis.value ?? 'free') : 'none',
      (choice) => {
        if (choice === 'none') cutting.none();
        else if (choice !== 'free') cutting.across(choice);
      },
    )}
    ${section ? position(page, section.offset) : nothing}
    ${peel(page)} ${filter(page)}
  </section>`;
}

function position({ cutting }: Page, offset: number): TemplateResult {
  const { min, max } = cutting.range.value;
  // The slider hides more of the mesh from left to right.
  const [value, text] = [max - offset, (hidden: number): string => `${significant(hidden, 3)} hidden`];
  return html`<div class="labelled"><span>Hidden</span><output>${significant(value, 3)} of ${significant(max - min, 3)}</output></div>
    ${slider({ label: 'Depth of the cut', value, min: 0, max: max - min || 1, digits: 6, text, change: (hidden) => cutting.to(max - hidden) })}`;
}

function peel({ cutting }: Page): TemplateResult | typeof nothing {
  const most = cutting.layers.value - 1;
  if (most < 1) return nothing;
  const value = Math.min(cutting.peel.value, most);
  const text = (layers: number): string => (layers === 0 ? 'nothing' : layers === 1 ? '1 layer' : `${layers} layers`);
  return html`<div class="labelled"><span>Peel off</span><output>${text(value)}</output></div>
    ${slider({ label: 'Layers peeled off', value, min: 0, max: most, step: 1, text, change: (layers) => (cutting.peel.value = layers) })}`;
}

/** Hides good cells: the lower end of the histogram's brush, or its upper end where large values are bad. */
function filter({ inspection }: Page): TemplateResult | typeof nothing {
  const bars = inspection.histogram.value;
  if (!bars) return nothing;
  const { min, max } = bars;
  const { label, decimals, worst } = inspection.info.value;
  const brush = inspection.brush.value ?? { low: min, high: max };
  const isLow = worst === 'low';
  const value = isLow ? brush.high : brush.low;
  const says = (bound: number): string => (inspection.brush.value === null && bound === value ? 'all' : `${isLow ? 'up to' : 'from'} ${fixed(bound, decimals)}`);
  const change = (bound: number): void => {
    const range = isLow ? { low: min, high: bound } : { low: bound, high: max };
    inspection.filter(range.low <= min && range.high >= max ? null : range);
  };
  return html`<div class="labelled"><span>${label}</span><output>${says(value)}</output></div>
    ${slider({ label: `Cells shown by ${label.toLowerCase()}`, value, min, max, digits: 4, text: says, change })}`;
}
