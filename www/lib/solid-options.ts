import { refuseUnknown } from './known.js';
import { defined, refuseUnknownKeys } from './options.js';
import type { CallOptions, Region } from './options.js';

/**
 * The most hexes that fill a solid, and the default of `maxHexes`: what 2 GiB of memory hold the work on, which is all
 * that browsers share between threads. The command line goes further.
 */
export const MOST_HEXES_OF_SOLIDS = 2_000_000;

/**
 * What hexes are cut out of to fill a solid.
 *
 * - `swept`: quads that follow the solid's outline, in layers: for parts that are extruded.
 * - `grid`: a grid along the solid's own axes with lines in its planar faces.
 * - `shell`: a layer between the two sides of a thin shell, however curved.
 * - `octree`: a grid, refined where the solid has details.
 * - `auto`: what suits the solid, another one if that does not show it.
 */
export type Background = 'auto' | 'swept' | 'grid' | 'shell' | 'octree';

/** A kind of hex of the second order: with a node on each edge, or on each edge, on each face and inside. */
export type SecondOrderHex = 'hex20' | 'hex27';

/** What the hexes that fill a solid are to be like. Lengths are in model units. */
export interface SolidOptions {
  /** How long the edges of the hexes are to be, about. */
  edgeLength: number;
  /** Where they are to be shorter. Levels count from the edge length, of an octree from twice that. */
  regions?: readonly Region[] | undefined;
  /** What they are cut out of. Default `auto`. */
  background?: Background | undefined;
  /** Turn of the surface's normal that one edge may span, in degrees. By default edges are made no shorter for that. */
  curvature?: number | undefined;
  /** How far mesh and surface may be from each other: where they are further, hexes become smaller, there or everywhere. */
  maxDistance?: number | undefined;
  /** How many levels finer than asked for hexes may become where something would be missed. Default 2, at most 4. */
  maxLevels?: number | undefined;
  /** Faces that meet at more than this, in degrees, are parts of different surfaces. Default 35. */
  featureAngle?: number | undefined;
  /** Hexes of the second order, with nodes on edges and faces that are on the solid. By default hexes are linear. */
  secondOrder?: SecondOrderHex | undefined;
  /** Refuse a mesh of more hexes than this. Default, and the most there can be, {@link MOST_HEXES_OF_SOLIDS}. */
  maxHexes?: number | undefined;
}

/** Options of `meshSolid`. */
export interface MeshSolidOptions extends SolidOptions, CallOptions {}

/**
 * Options of `planSolid`. Without an edge length features are told that are noise to every mesh, and no number of hexes is.
 */
export interface PlanSolidOptions extends Omit<SolidOptions, 'edgeLength'>, CallOptions {
  edgeLength?: number | undefined;
}

/** Every option of solids by name: the compiler holds this to be complete. */
const SOLID_OPTIONS: Readonly<Record<keyof SolidOptions, true>> = {
  edgeLength: true,
  regions: true,
  background: true,
  curvature: true,
  maxDistance: true,
  maxLevels: true,
  featureAngle: true,
  secondOrder: true,
  maxHexes: true,
};

/**
 * `options` as the mesher takes them: plain data, without entries that are undefined. `besides` names what else the
 * caller could have given.
 *
 * @throws {@link OptionsError} if a key is unknown, as misspelt ones are.
 */
export function plainSolidOptions<O extends SolidOptions | PlanSolidOptions>(options: O, besides: readonly string[] = []): O {
  refuseUnknown(options, [...Object.keys(SOLID_OPTIONS), ...besides], 'option');
  refuseUnknownKeys(options.regions);
  return defined(options);
}
