/** Surfaces of other files that hexes are refined at. */

import type { Region, Surface } from 'hexmill';
import type { Target } from './settings.js';

/** A surface and how fine hexes are to be near it. */
export interface Guide {
  /** As of a region: it names the guide in the page alone. */
  readonly id: number;
  /** The file's name. */
  readonly name: string;
  readonly surface: Surface;
  /** What hexes are near to: all of the surface, or its points. */
  readonly at: 'surface' | 'points';
  /** How near, in model units; 0: what it passes. */
  readonly distance: number;
  readonly target: Target;
}

/** How a new guide refines. */
export const USUAL: Pick<Guide, 'at' | 'distance' | 'target'> = { at: 'surface', distance: 0, target: { by: 'level', level: 2 } };

/** What of a surface's shape a region takes. */
type Triangles = Pick<Extract<Region, { kind: 'surface' }>, 'positions' | 'triangles'>;

const triangulated = new WeakMap<Surface, Triangles>();

/** A surface in triangles, as fans of its faces: where it passes hardly depends on how they are cut. */
export function trianglesOf(surface: Surface): Triangles {
  const known = triangulated.get(surface) ?? triangulate(surface);
  triangulated.set(surface, known);
  return known;
}

function triangulate({ nodes, offsets, corners }: Surface): Triangles {
  const positions: [number, number, number][] = [];
  for (let i = 0; i < nodes.length; i += 3) positions.push([nodes[i] ?? 0, nodes[i + 1] ?? 0, nodes[i + 2] ?? 0]);
  const triangles: [number, number, number][] = [];
  for (let face = 0; face + 1 < offsets.length; face += 1) {
    const [first = 0, end = 0] = offsets.subarray(face, face + 2);
    for (let k = first + 1; k + 1 < end; k += 1) triangles.push([corners[first] ?? 0, corners[k] ?? 0, corners[k + 1] ?? 0]);
  }
  return { positions, triangles };
}

/** The region of a guide, as the mesher takes it. */
export function regionOf({ surface, at, distance, target }: Guide): Region {
  const goal = target.by === 'size' ? { size: target.size } : { level: target.level };
  const { positions, triangles } = trianglesOf(surface);
  if (at === 'points') return { kind: 'points', points: positions, radius: distance, ...goal };
  return { kind: 'surface', positions, triangles, distance, ...goal };
}
