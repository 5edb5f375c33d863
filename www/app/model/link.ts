/**
 * Settings as text: the page's link and the command line that makes the same mesh.
 *
 * A link is `#example=spot&edge-length=0.05&region=sphere:0,0,0,1:h=0.01`: the command line's options by
 * name, without their dashes. Only what differs from the defaults is written.
 */

import { DEFAULTS, LIMITS, region } from './settings.js';
import type { Region, Settings, Shape, Target } from './settings.js';
import { fault } from './shape.js';
import { editable, parseNumber } from './text.js';

/** What a link asks for. */
export interface Linked {
  readonly example: string;
  readonly settings: Partial<Settings>;
}

/** `[name, value]` of each option that differs from the defaults; a switch has the value ''. */
function options(settings: Settings): [string, string][] {
  const list: [string, string][] = [
    settings.by === 'length' ? ['edge-length', editable(settings.edgeLength)] : ['levels', String(settings.levels)],
  ];
  if (settings.curvature !== null) list.push(['curvature', editable(settings.curvature)]);
  if (settings.gradation !== DEFAULTS.gradation) list.push(['gradation', editable(settings.gradation)]);
  if (settings.keepCoarse) list.push(['keep-coarse', '']);
  if (settings.maxLevels !== DEFAULTS.maxLevels) list.push(['max-levels', String(settings.maxLevels)]);
  if (settings.maxQuads !== DEFAULTS.maxQuads) list.push(['max-quads', String(settings.maxQuads)]);
  return list.concat(settings.regions.map((r): [string, string] => ['region', formatRegion(r)]));
}

/** The link's part after `#`. */
export function formatLink(example: string, settings: Settings): string {
  return [`example=${example}`, ...options(settings).map(([name, value]) => (value ? `${name}=${value}` : name))].join('&');
}

/** The command that makes the same mesh from a terminal. */
export function formatCommand(input: string, output: string, settings: Settings): string {
  const words = options(settings).map(([name, value]) => (value ? `--${name} ${value}` : `--${name}`));
  return ['hexmill refine', quoted(input), '-o', quoted(output), ...words].join(' ');
}

/** Reads a link's part after `#`; null if it names no example. What it says wrongly is left at its default. */
export function parseLink(hash: string): Linked | null {
  const entries = new URLSearchParams(hash.replace(/^#/, ''));
  const example = entries.get('example');
  if (!example) return null;
  const settings: { -readonly [K in keyof Settings]?: Settings[K] } = {};
  const number = (name: string, low: number, high: number): number | null => {
    const value = parseNumber(entries.get(name) ?? '');
    return value === null || value < low || value > high ? null : value;
  };
  const edgeLength = number('edge-length', Number.MIN_VALUE, Number.MAX_VALUE);
  if (edgeLength !== null) Object.assign(settings, { by: 'length', edgeLength });
  const levels = number('levels', LIMITS.levels.min, LIMITS.levels.max);
  if (levels !== null) Object.assign(settings, { by: 'levels', levels: Math.round(levels) });
  settings.curvature = number('curvature', LIMITS.curvature.min, LIMITS.curvature.max);
  settings.gradation = number('gradation', LIMITS.gradation.min, LIMITS.gradation.max) ?? DEFAULTS.gradation;
  settings.keepCoarse = entries.has('keep-coarse');
  settings.maxLevels = number('max-levels', LIMITS.levels.min, LIMITS.levels.max) ?? DEFAULTS.maxLevels;
  settings.maxQuads = number('max-quads', LIMITS.maxQuads.min, LIMITS.maxQuads.max) ?? DEFAULTS.maxQuads;
  settings.regions = entries.getAll('region').flatMap((text) => parseRegion(text) ?? []);
  return { example, settings };
}

/** `sphere:0,0,0,1:h=0.1`, as the command line takes it. */
export function formatRegion({ shape, target }: Region): string {
  const goal = target.by === 'size' ? `h=${editable(target.size)}` : `level=${target.level}`;
  return `${shape.kind}:${numbers(shape).map((x) => editable(x)).join(',')}:${goal}`;
}

function numbers(shape: Shape): number[] {
  switch (shape.kind) {
    case 'box':
      return [...shape.min, ...shape.max, ...(shape.rotation ?? [])];
    case 'sphere':
      return [...shape.center, shape.radius];
    case 'cylinder':
      return [...shape.from, ...shape.to, shape.radius];
  }
}

/** Reads {@link formatRegion}'s text; null if it is no region. */
export function parseRegion(text: string): Region | null {
  const [kind = '', figures = '', ...rest] = text.split(':');
  const named = new Map(rest.map((part) => part.split('=', 2) as [string, string]));
  const values = figures.split(',').map(parseNumber);
  if (values.includes(null)) return null;
  const shape = shapeOf(kind, values as number[]);
  const target = targetOf(named);
  return shape && target && !fault(shape) ? region(shape, target) : null;
}

function shapeOf(kind: string, v: number[]): Shape | null {
  const [a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0] = v;
  if (kind === 'sphere' && v.length === 4) return { kind, center: [a, b, c], radius: d };
  if (kind === 'cylinder' && v.length === 7) return { kind, from: [a, b, c], to: [d, e, f], radius: g };
  if (kind !== 'box' || (v.length !== 6 && v.length !== 10)) return null;
  const [x = 0, y = 0, z = 0, w = 1] = v.slice(6);
  const turn = v.length === 10 ? { rotation: [x, y, z, w] as [number, number, number, number] } : {};
  return { kind, min: [a, b, c], max: [d, e, f], ...turn };
}

function targetOf(named: Map<string, string>): Target | null {
  const size = parseNumber(named.get('h') ?? '');
  if (size !== null && size > 0) return { by: 'size', size };
  const level = parseNumber(named.get('level') ?? '');
  return level !== null && level >= 0 ? { by: 'level', level: Math.round(level) } : null;
}

function quoted(name: string): string {
  return /^[\w./-]+$/.test(name) ? name : `'${name.replaceAll("'", String.raw`'\''`)}'`;
}
