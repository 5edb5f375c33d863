/** Step 5: take the mesh away, as a file, a link or a command. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { complaintNote, iconButton, select } from './controls.js';
import type { Page } from './page.js';

export function exportStep(page: Page): TemplateResult {
  const { workbench } = page;
  const input = workbench.input.value;
  const hasResult = workbench.result.value !== null;
  return html`
    <div class="row export">
      ${select(
        'Export format',
        page.formats.value.map(({ format, label, extension, note }) => ({ value: format, label: `${extension.toUpperCase()}, ${label}`, note })),
        page.exportFormat.value,
        (format) => (page.chosenFormat.value = format),
      )}
      <button class="button" id="export" type="button" ?disabled=${!hasResult} @click=${() => void page.download()}>Export</button>
      ${iconButton({ icon: 'link', label: 'Copy a link that opens this example with these settings', disabled: !input?.example, press: () => void page.copyLink() })}
      ${iconButton({ icon: 'terminal', label: 'Copy the command that makes this mesh from a terminal', disabled: !input, press: () => void page.copyCommand() })}
    </div>
    ${hasResult && !workbench.isCurrent.value ? html`<p class="hint">Settings have changed since this mesh was made.</p>` : nothing}
    ${complaintNote(workbench.trouble.output.value)}`;
}
