/** The features of a solid: as lines and points of the view, in words, and what a mesh does not show of them. */

import type { HexedSolid, LostFeature, SolidPlan, SolidSurface } from 'hexmill';
import type { ViewFeature } from '../view.js';
import type { Vec3 } from './settings.js';
import { count, counted, significant } from './text.js';

/** What the lines of each kind stand for; `style/tokens.css` and `src/scene/theme.rs` have their colours. */
export const KINDS: readonly { kind: ViewFeature['kind']; label: string }[] = [
  { kind: 'convex', label: 'Convex' },
  { kind: 'concave', label: 'Concave' },
  { kind: 'corner', label: 'Corner' },
];

/** All features of a solid. */
export function featuresOf({ curves, corners }: SolidPlan): ViewFeature[] {
  const lines = curves.map(({ points, interiorAngle }): ViewFeature => ({ kind: interiorAngle < 180 ? 'convex' : 'concave', points: points as Vec3[] }));
  return [...lines, ...corners.map((point): ViewFeature => ({ kind: 'corner', points: [point as Vec3] }))];
}

/** A feature that a mesh does not show. */
export interface Lost extends LostFeature {
  readonly what: 'curve' | 'surface' | 'body';
  /** What became of it. */
  readonly fate: string;
}

/** What a mesh does not show of its solid, the largest first. */
export function lostOf({ result }: Pick<HexedSolid, 'result'>): Lost[] {
  const { contracted, suppressed, lostSurfaces } = result.features;
  const kinds: [LostFeature[], Lost['what'], string][] = [
    [result.lostBodies, 'body', 'too thin'],
    [suppressed, 'curve', 'not shown'],
    [lostSurfaces, 'surface', 'no face'],
    [result.crossings, 'surface', 'overlaps'],
    [contracted, 'curve', 'shrunk to a corner'],
  ];
  return kinds.flatMap(([list, what, fate]) => list.map((lost) => ({ ...lost, what, fate }))).sort((a, b) => b.size - a.size);
}

/** What is lost as lines and points: curves along their way, surfaces by their middle. */
export function lostFeatures(lost: readonly Lost[], plan: SolidPlan | null): ViewFeature[] {
  return lost.map(({ what, id, place }): ViewFeature => {
    const curve = what === 'curve' ? plan?.curves[id] : undefined;
    return { kind: 'lost', points: (curve?.points ?? [place]) as Vec3[] };
  });
}

/** "12 planar, 3 cylindrical". */
export function classesOf(surfaces: readonly SolidSurface[]): string {
  const kinds = ['planar', 'cylindrical', 'general'] as const;
  const counts = kinds.map((kind) => [surfaces.filter((surface) => surface.class.kind === kind).length, kind] as const);
  return counts.filter(([n]) => n > 0).map(([n, kind]) => `${count(n)} ${kind}`).join(', ');
}

/** What was mended in the surface, in words. */
export function mended({ found }: SolidPlan): string[] {
  const welded = found.weldedPoints + found.closePoints;
  const dropped = found.degenerateTriangles + found.duplicateTriangles + found.wallTriangles;
  const holes = found.filledHoles.map(({ at, edges }) => `a hole of ${counted(edges, 'edge')} filled at ${at.map((x) => significant(x, 3)).join(', ')}`);
  const counts: [number, string][] = [
    [welded, `${counted(welded, 'point')} welded to others`],
    [dropped, `${counted(dropped, 'triangle')} dropped that bound nothing`],
    [found.turnedTriangles, `${counted(found.turnedTriangles, 'triangle')} turned around`],
    [found.flippedTriangles, `${counted(found.flippedTriangles, 'triangle')} without height flipped`],
    [found.splitPoints, `${counted(found.splitPoints, 'point')} parted where parts touched`],
  ];
  return [...counts.filter(([n]) => n > 0).map(([, text]) => text), ...holes];
}
