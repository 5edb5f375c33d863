/** The page's icons: 16 by 16, drawn in strokes. */

import { html, svg } from 'lit-html';
import type { TemplateResult } from 'lit-html';

const PATHS = {
  undo: 'M5.5 3 2.5 6l3 3M2.5 6h7a4 4 0 0 1 0 8H6',
  redo: 'm10.5 3 3 3-3 3M13.5 6h-7a4 4 0 0 0 0 8H10',
  sun: 'M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6ZM8 1v1M8 14v1M1 8h1M14 8h1M3 3l.8.8M12.2 12.2l.8.8M3 13l.8-.8M12.2 3.8 13 3',
  moon: 'M13.5 9.6A6 6 0 1 1 6.4 2.5a5 5 0 0 0 7.1 7.1Z',
  fold: 'M3 2.5h10a1 1 0 0 1 1 1v9a1 1 0 0 1-1 1H3a1 1 0 0 1-1-1v-9a1 1 0 0 1 1-1ZM6 2.5v11',
  file: 'M9 1.5H4a1 1 0 0 0-1 1v11a1 1 0 0 0 1 1h8a1 1 0 0 0 1-1v-8ZM9 1.5v4h4',
  open: 'M2 12.5v-9a1 1 0 0 1 1-1h3l1.5 2H13a1 1 0 0 1 1 1v7a1 1 0 0 1-1 1H3a1 1 0 0 1-1-1Z',
  chevron: 'm6 3.5 4.5 4.5L6 12.5',
  left: 'm10 3.5-4.5 4.5 4.5 4.5',
  box: 'm8 1.8 5.5 3v6.4L8 14.2l-5.5-3V4.8ZM8 8v6.2M8 8l5.5-3.2M8 8 2.5 4.8',
  sphere: 'M8 1.8a6.2 6.2 0 1 0 0 12.4A6.2 6.2 0 0 0 8 1.8ZM1.8 8c0 3.2 12.4 3.2 12.4 0M8 1.8c-3.2 0-3.2 12.4 0 12.4',
  cylinder: 'M8 1.8c2.8 0 4.8.9 4.8 2s-2 2-4.8 2-4.8-.9-4.8-2 2-2 4.8-2ZM3.2 3.8v8.4c0 1.1 2 2 4.8 2s4.8-.9 4.8-2V3.8',
  copy: 'M6 5.5h7a1 1 0 0 1 1 1v7a1 1 0 0 1-1 1H6a1 1 0 0 1-1-1v-7a1 1 0 0 1 1-1ZM11 5.5v-3a1 1 0 0 0-1-1H3a1 1 0 0 0-1 1v7a1 1 0 0 0 1 1h2',
  bin: 'M2.5 4.5h11M6 4.5v-2h4v2M4 4.5l.6 9h6.8l.6-9M6.7 7v4M9.3 7v4',
  flip: 'M8 1.5v13M5.5 4 2 12h3.5ZM10.5 4 14 12h-3.5Z',
  cut: 'M2.5 5.2 8 2l5.5 3.2v5.6L8 14l-5.5-3.2ZM8 2v12M8 8.2l5.5-3',
  check: 'm3 8.5 3.3 3.3L13 4.5',
  warn: 'M8 2 1.5 13.5h13ZM8 6.5v3.3M8 11.6v.3',
  close: 'm4 4 8 8M12 4l-8 8',
  frame: 'M2 5.5v-3h3M11 2.5h3v3M14 10.5v3h-3M5 13.5H2v-3',
  edges: 'M2.5 2.5h11v11h-11ZM8 2.5v11M2.5 8h11',
  perspective: 'M5 3h6l3 10H2ZM3.6 7.6h8.8M8 3v10',
  camera: 'M2 5h2.5l1-1.5h5l1 1.5H14v8H2ZM8 6.5a2.3 2.3 0 1 0 0 4.6 2.3 2.3 0 0 0 0-4.6Z',
  download: 'M8 2v8.5M4.5 7.5 8 11l3.5-3.5M2.5 13.5h11',
  link: 'M6.8 9.2a2.6 2.6 0 0 0 3.7 0l2.7-2.7a2.6 2.6 0 0 0-3.7-3.7l-.9.9M9.2 6.8a2.6 2.6 0 0 0-3.7 0L2.8 9.5a2.6 2.6 0 0 0 3.7 3.7l.9-.9',
  terminal: 'm3 4.5 3.5 3.5L3 11.5M8 12h5',
  log: 'M2.5 4h11M2.5 8h11M2.5 12h7',
  size: 'M1.8 10.5v-5h12.4v5ZM4.9 10.5V8M8 10.5V7M11.1 10.5V8',
  chart: 'M2.5 13.5v-4h2.6v4ZM6.7 13.5v-11h2.6v11ZM10.9 13.5V6h2.6v7.5Z',
  target: 'M8 3.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9ZM8 1v3M8 12v3M1 8h3M12 8h3',
  more: 'M3.5 8h.01M8 8h.01M12.5 8h.01',
} as const;

export type IconName = keyof typeof PATHS;

export function icon(name: IconName): TemplateResult {
  return html`<svg class="icon" viewBox="0 0 16 16" aria-hidden="true">${svg`<path d=${PATHS[name]} />`}</svg>`;
}

/** The project's mark: a hexagon split into quads. */
export const mark = html`<svg class="mark" viewBox="0 0 24 24" aria-hidden="true">
  ${svg`<path class="fill" d="M12 12 12 2 20.7 7v10Z" /><path class="fill soft" d="M12 12 20.7 17 12 22 3.3 17Z" />
  <path class="line" d="M12 2 20.7 7v10L12 22 3.3 17V7ZM12 12V2M12 12l8.7 5M12 12 3.3 17M16.35 4.5v10M7.65 14.5 16.35 19.5M7.65 19.5 16.35 14.5M12 7l8.7 5" />`}
</svg>`;
