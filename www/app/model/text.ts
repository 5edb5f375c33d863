/** Numbers as people read them. */

const MINUS = '−';
const THIN_SPACE = '\u2009';

/** A whole number with grouped digits: 18,432. */
export function count(value: number): string {
  return Math.round(value).toLocaleString('en-US');
}

/** "1 face", "2 faces". */
export function counted(value: number, one: string, many = `${one}s`): string {
  return `${count(value)} ${value === 1 ? one : many}`;
}

/** A rough count for estimates: 940, 18.4 k, 1.25 M. */
export function roughCount(value: number): string {
  for (const [unit, size] of [['G', 1e9], ['M', 1e6], ['k', 1e4]] as const) {
    const divisor = unit === 'k' ? 1e3 : size;
    if (value >= size) return `${significant(value / divisor, 3)}${THIN_SPACE}${unit}`;
  }
  return count(value);
}

/** At most `digits` significant digits, without an exponent where that stays short. */
export function significant(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return value > 0 ? '∞' : value < 0 ? `${MINUS}∞` : 'undefined';
  return editable(value, digits).replace('-', MINUS);
}

/** As {@link significant}, with an ASCII minus and in a form that {@link parseNumber} reads back. */
export function editable(value: number, digits = 6): string {
  if (value === 0) return '0';
  const rounded = Number(value.toPrecision(digits));
  const size = Math.abs(rounded);
  if (size >= 1e-4 && size < 1e9) return String(rounded);
  return rounded.toExponential().replace('e+', 'e');
}

/** A fixed number of decimals, for columns of figures: 0.30, −0.05. */
export function fixed(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return significant(value);
  return value.toFixed(decimals).replace('-', MINUS);
}

/** Bytes in the unit that fits. */
export function bytes(value: number): string {
  const units = ['B', 'kB', 'MB', 'GB', 'TB'];
  const power = value < 1 ? 0 : Math.min(units.length - 1, Math.floor(Math.log10(value) / 3));
  return `${significant(value / 1000 ** power, power === 0 ? 4 : 3)}${THIN_SPACE}${units[power]}`;
}

/** The stages of the work, as what is being done. */
const DOING: Readonly<Record<string, string>> = {
  refine: 'refining',
  balance: 'balancing levels',
  templates: 'joining levels',
  close: 'closing families',
  pillow: 'making layers',
  opening: 'opening layers',
  untangling: 'untangling transitions',
  smoothing: 'smoothing transitions',
  solid: 'finding the solid',
  project: 'projecting curves',
  sample: 'dividing curves',
  pack: 'placing nodes',
  pair: 'pairing triangles',
  tidy: 'tidying quads',
  smooth: 'smoothing quads',
  sweep: 'sweeping quads',
  shell: 'laying quads',
  background: 'laying out cells',
  input: 'matching cells',
  core: 'choosing cells inside',
  correspondence: 'matching corners and curves',
  sheets: 'adding layers at the boundary',
  fitting: 'moving nodes to the boundary',
  distance: 'measuring distances',
  finishing: 'smoothing cells',
  'second order': 'adding nodes',
};

/** What is being done in a stage of the work. */
export function doing(stage: string): string {
  return DOING[stage] ?? stage;
}

/** A duration in the unit that fits. */
export function duration(milliseconds: number): string {
  if (milliseconds < 1000) return `${Math.round(milliseconds)}${THIN_SPACE}ms`;
  if (milliseconds < 60_000) return `${significant(milliseconds / 1000, 3)}${THIN_SPACE}s`;
  const seconds = Math.round(milliseconds / 1000);
  return `${Math.floor(seconds / 60)}${THIN_SPACE}min ${seconds % 60}${THIN_SPACE}s`;
}

/** A share of a whole: 98.2 %, and never 100 % or 0 % of anything less or more. */
export function percent(part: number, whole: number): string {
  if (whole === 0 || part === whole) return `100${THIN_SPACE}%`;
  if (part === 0) return `0${THIN_SPACE}%`;
  const share = Math.min(99.9, Math.max(0.1, (100 * part) / whole));
  return `${share.toFixed(1)}${THIN_SPACE}%`;
}

/** Reads a number a person typed; a decimal comma is a point. Null if it is none. */
export function parseNumber(text: string): number | null {
  const plain = text.trim().replace(MINUS, '-').replace(/^([^.,]*),([^.,]*)$/, '$1.$2');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return null;
  const value = Number(plain);
  return Number.isFinite(value) ? value : null;
}

/** `value` to two significant digits, a length a person would have typed. */
export function rounded(value: number): number {
  return Number(value.toPrecision(2));
}
