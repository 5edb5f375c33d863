/**
 * Settings as text: the page's link and the command line that makes the same mesh.
 *
 * A link is `#example=spot&edge-length=0.05&region=sphere:0,0,0,1:h=0.01`: the command line's options by
 * name, without their dashes. Only what differs from the defaults is written. For hexes it begins with
 * `#example=spot&job=hexes&spacing=0.2&margin=0.3&at-surface=2`, for a solid with
 * `#example=plate&job=solid&edge-length=2`; at the end stands how the mesh is looked at, such as
 * `section=0,-1,0,0.25`: the normal and the offset of the plane that cuts it open.
 */

import { parseCut } from './cutting.js';
import type { Cut } from './cutting.js';
import { DEFAULTS, LIMITS, region } from './settings.js';
import type { HexSettings, Job, Region, Settings, Shape, SolidSettings, Target } from './settings.js';
import { fault } from './shape.js';
import { editable, parseNumber } from './text.js';

/** What a link asks for. */
export interface Linked {
  readonly example: string;
  readonly settings: GivenSettings;
  readonly cut: Cut;
  readonly colour: Colour;
}

/** Settings of which some are left to what suits the model. */
export type GivenSettings = Partial<Omit<Settings, 'hexes' | 'solid'>> & { readonly hexes?: Partial<HexSettings>; readonly solid?: Partial<SolidSettings> };

export type Colour = 'plain' | 'level' | 'quality';

/** `[name, value]` of an option; a switch has the value ''. */
export type Entry = [string, string];

/** The methods of hexes by what they are called. */
export const METHODS: readonly { method: HexSettings['method']; label: string; note: string }[] = [
  { method: 'auto', label: 'Auto', note: 'Method II' },
  { method: 'one', label: 'I', note: 'Method I: layer templates. The best shapes; more cells are refined' },
  { method: 'two', label: 'II', note: 'Method II: a pillow and one template. Hardly more cells than asked for' },
  { method: 'three', label: '3', note: '3-refinement: each level cuts edges in three' },
];

/** The backgrounds of solids by what they are called. */
export const BACKGROUNDS: readonly { background: SolidSettings['background']; label: string; note: string }[] = [
  { background: 'auto', label: 'Auto', note: 'What suits the solid' },
  { background: 'swept', label: 'Swept', note: 'Quads of an outline, in layers' },
  { background: 'grid', label: 'Grid', note: 'A grid with lines in planar faces' },
  { background: 'shell', label: 'Shell', note: 'A layer between two sides' },
  { background: 'octree', label: 'Octree', note: 'A grid, refined' },
];

/** The hexes of solids by their nodes. */
export const HEX_KINDS: readonly { hex: SolidSettings['secondOrder']; nodes: string; note: string }[] = [
  { hex: null, nodes: '8', note: 'Linear hexes: a node at each corner' },
  { hex: 'hex20', nodes: '20', note: 'Second order: nodes on edges too, those of the boundary on the solid' },
  { hex: 'hex27', nodes: '27', note: 'Second order: nodes on edges, on faces and inside, those of the boundary on the solid' },
];

/** Each option of quads that differs from the defaults. */
function quadOptions(settings: Settings): Entry[] {
  const list: Entry[] = [
    settings.by === 'length' ? ['edge-length', editable(settings.edgeLength)] : ['levels', String(settings.levels)],
  ];
  if (settings.curvature !== null) list.push(['curvature', editable(settings.curvature)]);
  if (settings.gradation !== DEFAULTS.gradation) list.push(['gradation', editable(settings.gradation)]);
  if (settings.keepCoarse) list.push(['keep-coarse', '']);
  if (settings.maxLevels !== DEFAULTS.maxLevels) list.push(['max-levels', String(settings.maxLevels)]);
  if (settings.maxQuads !== DEFAULTS.maxQuads) list.push(['max-quads', String(settings.maxQuads)]);
  return list.concat(regionOptions(settings));
}

function regionOptions({ regions }: Settings): Entry[] {
  return regions.map((r): Entry => ['region', formatRegion(r)]);
}

/** Surfaces in files, beside the input. */
function guideOptions({ guides }: Settings): Entry[] {
  return guides.map(({ name, at, distance, target }) => ['region', quoted(`${at}:${name},${editable(distance)}:${formatTarget(target)}`)]);
}

/** Each option of refinement of hexes that differs from the defaults. */
function hexOptions(settings: Settings): Entry[] {
  const { hexes, gradation } = settings;
  const usual = DEFAULTS.hexes;
  const list: Entry[] = [];
  if (hexes.method !== usual.method) list.push(['method', hexes.method]);
  if (hexes.by === 'length') list.push(['edge-length', editable(hexes.edgeLength)]);
  else if (hexes.levels > 0) list.push(['levels', String(hexes.levels)]);
  if (gradation !== DEFAULTS.gradation) list.push(['gradation', editable(gradation)]);
  if (hexes.maxLevels !== usual.maxLevels) list.push(['max-levels', String(hexes.maxLevels)]);
  if (hexes.maxHexes !== usual.maxHexes) list.push(['max-hexes', String(hexes.maxHexes)]);
  return list.concat(regionOptions(settings));
}

function boxOptions({ spacing, margin }: HexSettings): Entry[] {
  return [['spacing', editable(spacing)], ['margin', editable(margin)]];
}

/** Each option of a solid that differs from the defaults. */
function solidOptions(settings: Settings): Entry[] {
  const { solid } = settings;
  const usual = DEFAULTS.solid;
  const list: Entry[] = [['edge-length', editable(solid.edgeLength)]];
  if (solid.featureAngle !== usual.featureAngle) list.push(['feature-angle', editable(solid.featureAngle)]);
  if (solid.background !== usual.background) list.push(['background', solid.background]);
  if (solid.curvature !== null) list.push(['curvature', editable(solid.curvature)]);
  if (solid.maxDistance !== null) list.push(['max-distance', editable(solid.maxDistance)]);
  if (solid.maxLevels !== usual.maxLevels) list.push(['max-levels', String(solid.maxLevels)]);
  if (solid.maxHexes !== usual.maxHexes) list.push(['max-hexes', String(solid.maxHexes)]);
  if (solid.secondOrder !== null) list.push(['second-order', solid.secondOrder]);
  return list.concat(regionOptions(settings));
}

function options(settings: Settings): Entry[] {
  if (settings.job === 'quads') return quadOptions(settings);
  if (settings.job === 'solid') return [['job', 'solid'], ...solidOptions(settings)];
  const { hexes } = settings;
  return [['job', 'hexes'], ...boxOptions(hexes), ['at-surface', String(hexes.atSurface)], ...hexOptions(settings)];
}

/** The link's part after `#`; `view` says how the mesh is looked at. */
export function formatLink(example: string, settings: Settings, view: readonly Entry[] = []): string {
  return [`example=${example}`, ...[...options(settings), ...view].map(([name, value]) => (value ? `${name}=${value}` : name))].join('&');
}

/** The command that makes the same mesh from a terminal. `input` holds hexes or a surface. */
export function formatCommand(input: { name: string; holdsHexes: boolean }, output: string, settings: Settings): string {
  const command = (verb: string, from: string, to: string, list: Entry[]): string =>
    [`hexmill ${verb}`, quoted(from), '-o', quoted(to), ...list.map(([name, value]) => (value ? `--${name} ${value}` : `--${name}`))].join(' ');
  const { name, holdsHexes } = input;
  if (holdsHexes) return command('refine', name, output, [...hexOptions(settings), ...guideOptions(settings)]);
  if (settings.job === 'quads') return command('refine', name, output, quadOptions(settings));
  if (settings.job === 'solid') return command('hex', name, output, solidOptions(settings));
  const { hexes } = settings;
  const surface: Entry[] = hexes.atSurface > 0 ? [['region', quoted(`surface:${name},0:level=${hexes.atSurface}`)]] : [];
  return `${command('grid', name, BOX, boxOptions(hexes))} && ${command('refine', BOX, output, [...hexOptions(settings), ...surface])}`;
}

/** The file between the two commands that make hexes around a surface. */
const BOX = 'box.vtu';

/** Reads a link's part after `#`; null if it names no example. What it says wrongly is left at its default. */
export function parseLink(hash: string): Linked | null {
  const entries = new URLSearchParams(hash.replace(/^#/, ''));
  const example = entries.get('example');
  if (!example) return null;
  const number = (name: string, low: number, high: number): number | null => {
    const value = parseNumber(entries.get(name) ?? '');
    return value === null || value < low || value > high ? null : value;
  };
  const regions = entries.getAll('region').flatMap((text) => parseRegion(text) ?? []);
  const gradation = number('gradation', LIMITS.gradation.min, LIMITS.gradation.max) ?? DEFAULTS.gradation;
  const settings = PARSED[JOBS.find((job) => job === entries.get('job')) ?? 'quads'](entries, number);
  const colour = COLOURS.find((known) => known === entries.get('colour')) ?? 'plain';
  return { example, settings: { ...settings, gradation, regions }, cut: parseCut(entries), colour };
}

const COLOURS: readonly Colour[] = ['plain', 'level', 'quality'];

/** A number of the link within bounds; null if there is none. */
type Numbers = (name: string, low: number, high: number) => number | null;

const JOBS: readonly Job[] = ['quads', 'hexes', 'solid'];

/** What a link says of each job. */
const PARSED: Readonly<Record<Job, (entries: URLSearchParams, number: Numbers) => GivenSettings>> = {
  quads: parseQuads,
  hexes: (entries, number) => ({ job: 'hexes', hexes: parseHexes(entries, number) }),
  solid: (entries, number) => ({ job: 'solid', solid: parseSolid(entries, number) }),
};

function parseQuads(entries: URLSearchParams, number: Numbers): GivenSettings {
  const settings: { -readonly [K in keyof GivenSettings]?: GivenSettings[K] } = {};
  const edgeLength = number('edge-length', Number.MIN_VALUE, Number.MAX_VALUE);
  if (edgeLength !== null) Object.assign(settings, { by: 'length', edgeLength });
  const levels = number('levels', LIMITS.levels.min, LIMITS.levels.max);
  if (levels !== null) Object.assign(settings, { by: 'levels', levels: Math.round(levels) });
  settings.curvature = number('curvature', LIMITS.curvature.min, LIMITS.curvature.max);
  settings.keepCoarse = entries.has('keep-coarse');
  settings.maxLevels = number('max-levels', LIMITS.levels.min, LIMITS.levels.max) ?? DEFAULTS.maxLevels;
  settings.maxQuads = number('max-quads', LIMITS.maxQuads.min, LIMITS.maxQuads.max) ?? DEFAULTS.maxQuads;
  return settings;
}

function parseHexes(entries: URLSearchParams, number: Numbers): Partial<HexSettings> {
  const [least, most] = [Number.MIN_VALUE, Number.MAX_VALUE];
  const { min, max } = LIMITS.hexLevels;
  const whole = (value: number | null): number | null => (value === null ? null : Math.round(value));
  const edgeLength = number('edge-length', least, most);
  const given = {
    spacing: number('spacing', least, most),
    margin: number('margin', 0, most),
    atSurface: whole(number('at-surface', min, max)),
    method: METHODS.find(({ method }) => method === entries.get('method'))?.method ?? null,
    by: edgeLength === null ? null : ('length' as const),
    edgeLength,
    levels: whole(number('levels', min, max)),
    maxLevels: whole(number('max-levels', min, max)),
    maxHexes: number('max-hexes', LIMITS.maxHexes.min, LIMITS.maxHexes.max),
  };
  return present(given) as Partial<HexSettings>;
}

function parseSolid(entries: URLSearchParams, number: Numbers): Partial<SolidSettings> {
  const levels = number('max-levels', LIMITS.solidLevels.min, LIMITS.solidLevels.max);
  return present({
    background: BACKGROUNDS.find(({ background }) => background === entries.get('background'))?.background ?? null,
    curvature: number('curvature', LIMITS.curvature.min, LIMITS.curvature.max),
    maxDistance: number('max-distance', Number.MIN_VALUE, Number.MAX_VALUE),
    maxLevels: levels === null ? null : Math.round(levels),
    edgeLength: number('edge-length', Number.MIN_VALUE, Number.MAX_VALUE),
    featureAngle: number('feature-angle', LIMITS.featureAngle.min, LIMITS.featureAngle.max),
    maxHexes: number('max-hexes', LIMITS.maxHexesOfSolids.min, LIMITS.maxHexesOfSolids.max),
    secondOrder: HEX_KINDS.find(({ hex }) => hex === entries.get('second-order'))?.hex ?? null,
  }) as Partial<SolidSettings>;
}

/** The entries that are there. */
function present(given: Readonly<Record<string, unknown>>): object {
  return Object.fromEntries(Object.entries(given).filter(([, value]) => value !== null));
}

/** `sphere:0,0,0,1:h=0.1`, as the command line takes it. */
export function formatRegion({ shape, target }: Region): string {
  return `${shape.kind}:${numbers(shape).map((x) => editable(x)).join(',')}:${formatTarget(target)}`;
}

function formatTarget(target: Target): string {
  return target.by === 'size' ? `h=${editable(target.size)}` : `level=${target.level}`;
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
  return /^[\w.,:=/-]+$/.test(name) ? name : `'${name.replaceAll("'", String.raw`'\''`)}'`;
}
