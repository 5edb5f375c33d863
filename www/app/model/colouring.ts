/** Colours of cells: what the view is given, and the same colours for bars and legends. */

import type { HexedSolid } from 'hexmill';
import type { Colouring } from '../view.js';
import type { Inspection } from './inspection.js';
import { isHexes, isSolid } from './job.js';
import type { Cells } from './job.js';
import type { MetricInfo } from './metrics.js';

/** What the view is to colour `mesh` by. Quads outside the brushed range have no value and no colour; hexes are hidden. */
export function colouring(mesh: Cells, inspection: Inspection): Colouring {
  const { colour, values, info, brush } = inspection;
  if (colour.value === 'level' && !isSolid(mesh)) {
    const values = Float32Array.from(mesh.level);
    return { kind: 'scalar', values, range: levelRange(mesh), map: 'levels' };
  }
  if (colour.value !== 'quality' || !values.value) return { kind: 'plain' };
  const range = (isHexes(mesh) ? null : brush.value) ?? { low: Number.NEGATIVE_INFINITY, high: Number.POSITIVE_INFINITY };
  const places = values.value.map((v) => (v >= range.low && v <= range.high ? qualityPlace(info.value, v) : Number.NaN));
  return { kind: 'scalar', values: places, range: [0, 1], map: 'quality' };
}

/** Where `value` stands on the quality map, from 0 (bad) to 1 (good), whether small or large values are bad. */
export function qualityPlace({ range: [low, high], worst }: MetricInfo, value: number): number {
  return worst === 'low' ? (value - low) / (high - low) : (high - value) / (high - low);
}

/** A mesh with levels. */
type Levelled = Exclude<Cells, HexedSolid>;

/** The levels that colours span, at least two. Of hexes the first is the least there is: methods one and two refine all. */
export function levelRange(mesh: Levelled): [number, number] {
  const least = isHexes(mesh) ? mesh.level.reduce((low, level) => Math.min(low, level), 255) : 0;
  return [least, mesh.level.reduce((most, level) => Math.max(most, level), least + 1)];
}

/** The colour of a level of the mesh. */
export function levelColour(mesh: Levelled, level: number): string {
  const [low, high] = levelRange(mesh);
  return mapColour('levels', (level - low) / (high - low));
}

type Stop = readonly [place: number, red: number, green: number, blue: number];

/** The view's maps (`src/scene/colour.rs`), for what is drawn beside it. */
const MAPS: Record<'quality' | 'levels', readonly Stop[]> = {
  quality: [
    [0, 140, 10, 40], [0.2, 214, 66, 41], [0.4, 246, 145, 75], [0.6, 252, 212, 130],
    [0.75, 236, 240, 214], [0.88, 150, 200, 226], [1, 74, 144, 200],
  ],
  levels: [
    [0, 226, 232, 238], [0.14, 158, 210, 228], [0.29, 92, 170, 214], [0.43, 104, 124, 214],
    [0.57, 158, 104, 204], [0.71, 212, 96, 170], [0.86, 242, 122, 110], [1, 252, 178, 84],
  ],
};

/** The CSS colour at `place`, 0 to 1, of a map. */
export function mapColour(map: keyof typeof MAPS, place: number): string {
  const stops = MAPS[map];
  const at = Math.min(1, Math.max(0, place));
  const next = Math.max(1, stops.findIndex((stop) => stop[0] >= at));
  const [low, ...from] = stops[next - 1] as Stop;
  const [high, ...to] = stops[next] as Stop;
  const share = (at - low) / (high - low);
  return `rgb(${from.map((x, channel) => Math.round(x + share * ((to[channel] ?? x) - x))).join(' ')})`;
}

/** The map as a CSS gradient from left to right. */
export function mapGradient(map: keyof typeof MAPS): string {
  return `linear-gradient(90deg, ${MAPS[map].map(([place, ...rgb]) => `rgb(${rgb.join(' ')}) ${100 * place}%`).join(', ')})`;
}
