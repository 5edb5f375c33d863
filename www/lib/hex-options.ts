import { refuseUnknown } from './known.js';
import { defined, refuseUnknownKeys } from './options.js';
import type { CallOptions, Region, SizeFunction } from './options.js';

/**
 * The most hexes of a mesh, and the default of `maxHexes`: what 2 GiB of memory hold the work on, which is all that
 * browsers share between threads. The command line goes further.
 */
export const MOST_HEXES = 2_750_000;

/**
 * How refined hexes and coarse ones are joined.
 *
 * - `one`: Method I of the paper, layer templates. No hex is ever inverted, and the refined set grows to what they fit.
 * - `two`: Method II, a pillow and one template. The refined set hardly grows; the layer is smoothed.
 * - `three`: 3-refinement, a pillow, then hexes in 27. Any set.
 * - `auto`: Method II, without families where the interface can be grouped two by two without them.
 */
export type Method = 'one' | 'two' | 'three' | 'auto';

/**
 * Whether the refined set may grow beyond what is asked for, so that a method can join it to the coarse hexes. Growth is
 * every hex that is refined although nothing asks for it, whichever the method: also those of the input that Methods I and II
 * refine once, unless `levels` is at least 1. Only the siblings of refined hexes and levels that differ by one are no growth.
 *
 * - `allow`: it grows to what the method needs, and `added` tells how far.
 * - `refuse`: where it would have to grow nothing is done, and the error tells where and how far.
 */
export type Growth = 'allow' | 'refuse';

/** What the hex mesh is to be like. Without any of `edgeLength`, `levels` and `regions` it stays as it is. */
export interface HexOptions {
  /** How refined hexes and coarse ones are joined. Default `auto`. */
  method?: Method | undefined;
  /** Whether more may be refined than is asked for. Default `allow`. */
  growth?: Growth | undefined;
  /** No edge longer than this, anywhere. */
  edgeLength?: number | undefined;
  /** Refine everything at least this many times. */
  levels?: number | undefined;
  /** Where to refine further. */
  regions?: readonly Region[] | undefined;
  /** How much larger an element may be than its neighbour around a region with a size: more than 1, at most 2 (the default). */
  gradation?: number | undefined;
  /** No element is refined beyond this level. Default 8. */
  maxLevels?: number | undefined;
  /** Refuse a mesh of more hexes than this. Default, and the most there can be, {@link MOST_HEXES}. */
  maxHexes?: number | undefined;
}

/** Options of `refineHexes` and `planHexes`. */
export interface RefineHexesOptions extends HexOptions, CallOptions {
  /** A size for each element beside what the other options ask for. */
  sizeFunction?: SizeFunction | undefined;
}

/** What a grid is to be like. Lengths are in model units. */
export interface GridOptions {
  /** The edge length of the hexes. */
  spacing: number;
  /** How far the grid reaches beyond what it is made around, at least. Default 0. */
  margin?: number | undefined;
  /**
   * Shorten the edges, along each axis alike, so that the grid ends where the margin does. Else they are `spacing`
   * exactly, and the grid reaches beyond the margin by less than that, equally on both sides.
   */
  fitted?: boolean | undefined;
  /** Refuse a grid of more hexes than this. By default what memory holds. */
  maxHexes?: number | undefined;
}

/** Every hex option by name: the compiler holds this to be complete. */
const HEX_OPTIONS: Readonly<Record<keyof HexOptions, true>> = {
  method: true,
  growth: true,
  edgeLength: true,
  levels: true,
  regions: true,
  gradation: true,
  maxLevels: true,
  maxHexes: true,
};

const GRID_OPTIONS: Readonly<Record<keyof GridOptions, true>> = { spacing: true, margin: true, fitted: true, maxHexes: true };

/**
 * `options` as the mesher takes them: plain data, without entries that are undefined. `besides` names what else the
 * caller could have given.
 *
 * @throws {@link OptionsError} if a key is unknown, as misspelt ones are.
 */
export function plainHexOptions(options: HexOptions, besides: readonly string[] = []): HexOptions {
  refuseUnknown(options, [...Object.keys(HEX_OPTIONS), ...besides], 'option');
  refuseUnknownKeys(options.regions);
  return defined(options);
}

/** The same for the options of a grid. */
export function plainGrid(options: GridOptions, besides: readonly string[] = []): GridOptions {
  refuseUnknown(options, [...Object.keys(GRID_OPTIONS), ...besides], 'option of a grid');
  return defined(options);
}
