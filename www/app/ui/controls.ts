/** Small form controls: labelled, keyboard reachable, with plain messages. */

import { html, nothing } from 'lit-html';
import type { TemplateResult } from 'lit-html';
import { live } from 'lit-html/directives/live.js';
import { icon } from './icons.js';
import { written } from './written.js';
import type { IconName } from './icons.js';
import type { Complaint } from '../model/complaint.js';
import { LIMITS } from '../model/settings.js';
import { editable, parseNumber, significant } from '../model/text.js';

export interface NumberField {
  readonly label: string;
  /** Shown before the figure in place of a label above it. */
  readonly inline?: string;
  readonly value: number;
  readonly unit?: string;
  readonly min?: number;
  readonly max?: number;
  /** The value must be greater than `min`, not equal to it. */
  readonly open?: boolean;
  readonly whole?: boolean;
  /** What an arrow key adds; else one unit of the second significant digit. */
  readonly step?: number;
  readonly disabled?: boolean;
  readonly change: (value: number) => void;
}

/** A field for one number; arrow keys step it, ten steps with Shift. What is no number says so and changes nothing. */
export function numberField(field: NumberField): TemplateResult {
  const commit = (input: HTMLInputElement, value: number | null): void => {
    const problem = value === null ? 'Write a number, such as 0.25.' : outOfRange(field, value);
    say(input, problem);
    if (problem === null && value !== null && value !== field.value) field.change(value);
  };
  const key = (event: KeyboardEvent): void => {
    const input = event.target as HTMLInputElement;
    const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (direction === undefined) return;
    event.preventDefault();
    const from = parseNumber(input.value) ?? field.value;
    const step = field.step ?? (from === 0 ? 0.1 : 10 ** (Math.floor(Math.log10(Math.abs(from))) - 1));
    const next = Number((from + direction * step * (event.shiftKey ? 10 : 1)).toPrecision(12));
    if (outOfRange(field, next) === null) commit(input, next);
  };
  return html`<label class="field ${field.inline ? 'inline' : ''}">
    <span class=${field.inline ? 'prefix' : 'label'} aria-hidden="true">${field.inline ?? field.label}</span>
    <span class="entry">
      <input type="text" inputmode="decimal" autocomplete="off" spellcheck="false" aria-label=${field.unit ? `${field.label}, ${field.unit}` : field.label}
        .value=${written(editable(field.value))} ?disabled=${field.disabled ?? false} @keydown=${key}
        @change=${(event: Event) => commit(event.target as HTMLInputElement, parseNumber((event.target as HTMLInputElement).value))}
        @blur=${(event: Event) => restore(event.target as HTMLInputElement, field.value)} />
      ${field.unit ? html`<span class="unit" aria-hidden="true">${field.unit}</span>` : nothing}
    </span>
    <span class="fault" role="alert"></span>
  </label>`;
}

function outOfRange({ min, max, open, whole }: NumberField, value: number): string | null {
  if (whole && !Number.isInteger(value)) return 'Write a whole number.';
  if (min !== undefined && (open ? value <= min : value < min)) return `Must be ${open ? 'greater than' : 'at least'} ${editable(min)}.`;
  return max !== undefined && value > max ? `Must be at most ${editable(max, 9)}.` : null;
}

function say(input: HTMLInputElement, problem: string | null): void {
  input.setAttribute('aria-invalid', String(problem !== null));
  const place = input.closest('.field')?.querySelector('.fault');
  if (place) place.textContent = problem ?? '';
}

/** A field left with something wrong in it shows its value again; the message goes. */
function restore(input: HTMLInputElement, value: number): void {
  if (input.getAttribute('aria-invalid') !== 'true') return;
  input.value = editable(value);
  input.setAttribute('aria-invalid', 'false');
}

export interface Slider {
  readonly label: string;
  readonly value: number;
  readonly min: number;
  readonly max: number;
  /** Equal steps are equal ratios. */
  readonly logarithmic?: boolean;
  /** Significant digits of the values it gives. */
  readonly digits?: number;
  readonly step?: number;
  readonly text: (value: number) => string;
  readonly change: (value: number) => void;
}

const SLIDER_STEPS = 400;

export function slider({ label, value, min, max, logarithmic = false, digits = 2, step, text, change }: Slider): TemplateResult {
  const part = logarithmic ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);
  const place = Math.min(1, Math.max(0, part));
  const at = (t: number): number => {
    const raw = logarithmic ? min * (max / min) ** t : min + t * (max - min);
    return step === undefined ? Number(raw.toPrecision(digits)) : Number((Math.round(raw / step) * step).toPrecision(9));
  };
  const steps = step === undefined ? SLIDER_STEPS : Math.round((max - min) / step);
  return html`<input class="slider" type="range" aria-label=${label} aria-valuetext=${text(value)} min="0" max=${steps} step="1"
    style="--at:${place}" .value=${live(String(Math.round(place * steps)))}
    @input=${(event: Event) => change(at(Number((event.target as HTMLInputElement).value) / steps))} />`;
}

/** A length of edges, as a figure and as a slider from `min` to `max`. */
export function edgeLength({ label, value, min, max, change }: Pick<Slider, 'label' | 'value' | 'min' | 'max' | 'change'>): TemplateResult {
  return html`
    ${numberField({ label, value, min: 0, open: true, unit: 'model units', change })}
    ${slider({ label: 'Edge length', value, min, max, logarithmic: true, text: (v) => `${significant(v)} model units`, change })}
    <div class="ends" aria-hidden="true"><span>finer</span><span>coarser</span></div>`;
}

/** The turn of the surface that one edge may span, or none. */
export function curvature(value: number | null, change: (value: number | null) => void): TemplateResult {
  const { min, max, usual } = LIMITS.curvature;
  return html`
    ${toggle('Follow curvature', value !== null, (on) => change(on ? usual : null))}
    ${value === null
      ? nothing
      : numberField({ label: 'Turn of the surface along one edge, at most', value, min, max, unit: 'degrees', step: 1, change })}`;
}

export interface Choice<T extends string> {
  readonly value: T;
  readonly label: string;
  /** Shown when the pointer rests on it. */
  readonly note?: string;
  readonly disabled?: boolean;
}

/** One of a few, side by side. */
export function segmented<T extends string>(label: string, choices: readonly Choice<T>[], value: T, change: (value: T) => void): TemplateResult {
  return html`<div class="segmented" role="radiogroup" aria-label=${label}>
    ${choices.map(
      (choice) => html`<label>
        <input type="radio" name=${label} value=${choice.value} .checked=${live(choice.value === value)} ?disabled=${choice.disabled ?? false}
          @change=${() => change(choice.value)} />
        <span>${choice.label}</span>
      </label>`,
    )}
  </div>`;
}

export function select<T extends string>(label: string, choices: readonly Choice<T>[], value: T, change: (value: T) => void): TemplateResult {
  return html`<span class="select">
    <select aria-label=${label} title=${choices.find((choice) => choice.value === value)?.note ?? nothing} .value=${live(value)} @change=${(event: Event) => change((event.target as HTMLSelectElement).value as T)}>
      ${choices.map((choice) => html`<option value=${choice.value} title=${choice.note ?? nothing} ?selected=${choice.value === value}>${choice.label}</option>`)}
    </select>
    ${icon('chevron')}
  </span>`;
}

export function toggle(label: string, checked: boolean, change: (checked: boolean) => void, note?: string): TemplateResult {
  return html`<label class="toggle">
    <input type="checkbox" role="switch" .checked=${live(checked)} @change=${(event: Event) => change((event.target as HTMLInputElement).checked)} />
    <span>${label}${note ? html`<small>${note}</small>` : nothing}</span>
  </label>`;
}

export interface IconButton {
  readonly icon: IconName;
  readonly label: string;
  readonly disabled?: boolean;
  readonly pressed?: boolean;
  readonly press: (event: Event) => void;
}

export function iconButton({ icon: name, label, disabled = false, pressed, press }: IconButton): TemplateResult {
  return html`<button class="icon-button" type="button" title=${label} aria-label=${label} aria-pressed=${pressed ?? nothing}
    ?disabled=${disabled} @click=${press}>${icon(name)}</button>`;
}

/** What went wrong, beside what caused it. */
export function complaintNote(problem: Complaint | null, title?: string): TemplateResult | typeof nothing {
  if (!problem) return nothing;
  const place = problem.line === null ? '' : `line ${problem.line}`;
  const text = place && problem.text.toLowerCase().startsWith(`${place}:`) ? capital(problem.text.slice(place.length + 1).trim()) : problem.text;
  const head = [title, problem.about, place].filter(Boolean).join(' · ');
  return html`<div class="complaint" role="alert" data-code=${problem.code ?? nothing}>
    ${icon('warn')}
    <div>${head ? html`<strong>${head}</strong>` : nothing}<p>${text}</p></div>
  </div>`;
}

function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
