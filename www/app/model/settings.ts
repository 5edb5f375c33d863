/** What the page asks of the mesher: everything that undo, the link and the command line carry. */

import { MOST_HEXES, MOST_HEXES_OF_SOLIDS, MOST_QUADS } from 'hexmill';
import type { Background, HexOptions, Method, QuadOptions, Region as RegionOption, SecondOrderHex, SolidOptions } from 'hexmill';
import type { ViewRegion } from '../view.js';
import { regionOf } from './guide.js';
import type { Guide } from './guide.js';

export type Vec3 = [number, number, number];
export type Shape = ViewRegion;
export type ShapeKind = Shape['kind'];

/** How fine a region is to be: no edge longer than `size` (model units), or refined `level` times. */
export type Target = { by: 'size'; size: number } | { by: 'level'; level: number };

/** A refinement region. `id` names it in the page; it is in no file and no link. */
export interface Region {
  readonly id: number;
  readonly shape: Shape;
  readonly target: Target;
}

/** What is made of a surface: quads on it, hexes in a box around it, or hexes that fill the solid in it. */
export type Job = 'quads' | 'hexes' | 'solid';

/** What is asked of hexes alone. Lengths in model units. */
export interface HexSettings {
  /** The edge length of the cubes of the box, and how far it reaches beyond the surface. */
  readonly spacing: number;
  readonly margin: number;
  /** How many times cells that the surface passes are refined; 0: not. */
  readonly atSurface: number;
  readonly method: Method;
  readonly by: Settings['by'];
  readonly edgeLength: number;
  readonly levels: number;
  readonly maxLevels: number;
  readonly maxHexes: number;
}

/** What is asked of hexes that fill a solid. */
export interface SolidSettings {
  /** Model units. */
  readonly edgeLength: number;
  /** Degrees between faces of different surfaces. */
  readonly featureAngle: number;
  readonly background: Background;
  /** Degrees of the normal's turn that one edge may span; null: curvature is not looked at. */
  readonly curvature: number | null;
  /** How far the mesh may be from the surface, in model units; null: as far as the edge length makes it. */
  readonly maxDistance: number | null;
  /** Levels that hexes may be finer where something would be missed. */
  readonly maxLevels: number;
  readonly maxHexes: number;
  /** Hexes of the second order; null: linear ones. */
  readonly secondOrder: SecondOrderHex | null;
}

export interface Settings {
  readonly job: Job;
  readonly hexes: HexSettings;
  readonly solid: SolidSettings;
  /** What sizes the whole mesh: a length, or a number of refinements. The other value is kept for switching back. */
  readonly by: 'length' | 'levels';
  /** Model units. */
  readonly edgeLength: number;
  readonly levels: number;
  /** Degrees of the normal's turn that one edge may span; null: curvature is not looked at. */
  readonly curvature: number | null;
  readonly gradation: number;
  readonly keepCoarse: boolean;
  readonly maxLevels: number;
  readonly maxQuads: number;
  readonly regions: readonly Region[];
  /** Surfaces that hexes of a file are refined at, after the regions in the mesher's order. In no link: they are files. */
  readonly guides: readonly Guide[];
}

export const LIMITS = {
  levels: { min: 0, max: 12 },
  curvature: { min: 1, max: 90, usual: 15 },
  gradation: { min: 1.05, max: 2 },
  maxQuads: { min: 1_000, max: MOST_QUADS },
  hexLevels: { min: 0, max: 8 },
  maxHexes: { min: 1_000, max: MOST_HEXES },
  featureAngle: { min: 5, max: 90 },
  solidLevels: { min: 0, max: 4 },
  maxHexesOfSolids: { min: 1_000, max: MOST_HEXES_OF_SOLIDS },
} as const;

export const DEFAULTS: Settings = {
  job: 'quads',
  hexes: {
    spacing: 1,
    margin: 1,
    atSurface: 2,
    method: 'auto',
    by: 'levels',
    edgeLength: 1,
    levels: 0,
    maxLevels: 8,
    maxHexes: MOST_HEXES,
  },
  solid: {
    edgeLength: 1,
    featureAngle: 35,
    background: 'auto',
    curvature: null,
    maxDistance: null,
    maxLevels: 2,
    maxHexes: MOST_HEXES_OF_SOLIDS,
    secondOrder: null,
  },
  by: 'length',
  edgeLength: 1,
  levels: 1,
  curvature: null,
  gradation: 2,
  keepCoarse: false,
  maxLevels: 12,
  maxQuads: MOST_QUADS,
  regions: [],
  guides: [],
};

let lastId = 0;

/** An id that nothing else of this page has. */
export function newId(): number {
  lastId += 1;
  return lastId;
}

export function region(shape: Shape, target: Target): Region {
  return { id: newId(), shape, target };
}

/** The mesher's options for `settings`. */
export function toOptions(settings: Settings): QuadOptions {
  return {
    ...(settings.by === 'length' ? { edgeLength: settings.edgeLength } : { levels: settings.levels }),
    ...(settings.curvature === null ? {} : { curvature: settings.curvature }),
    regions: settings.regions.map(toRegionOption),
    gradation: settings.gradation,
    keepCoarse: settings.keepCoarse,
    maxLevels: settings.maxLevels,
    maxQuads: settings.maxQuads,
  };
}

/** The options of hexes for `settings`, with what else there is to refine at. */
export function toHexOptions({ hexes, regions, guides, gradation }: Settings, more: readonly RegionOption[] = []): HexOptions {
  return {
    ...(hexes.by === 'length' ? { edgeLength: hexes.edgeLength } : { levels: hexes.levels }),
    method: hexes.method,
    regions: [...regions.map(toRegionOption), ...guides.map(regionOf), ...more],
    gradation,
    maxLevels: hexes.maxLevels,
    maxHexes: hexes.maxHexes,
  };
}

/** The options of hexes that fill a solid for `settings`. */
export function toSolidOptions({ solid, regions }: Settings): SolidOptions {
  const { curvature, maxDistance, secondOrder, ...rest } = solid;
  const given = { curvature: curvature ?? undefined, maxDistance: maxDistance ?? undefined, secondOrder: secondOrder ?? undefined };
  return { ...rest, ...given, regions: regions.map(toRegionOption) };
}

function toRegionOption({ shape, target }: Region): RegionOption {
  return target.by === 'size' ? { ...shape, size: target.size } : { ...shape, level: target.level };
}
