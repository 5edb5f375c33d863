import type { Surface } from 'hexmill';
import { describe, expect, test } from 'vitest';
import { regionOf, trianglesOf, USUAL } from './guide.js';
import type { Guide } from './guide.js';
import { formatCommand } from './link.js';
import { DEFAULTS, region, toHexOptions } from './settings.js';

/** A quad and a triangle beside it, as a loaded surface has them. */
const surface = {
  nodes: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0),
  offsets: Uint32Array.of(0, 4, 7),
  corners: Uint32Array.of(0, 1, 2, 3, 1, 4, 2),
} as unknown as Surface;
const guide: Guide = { id: 7, name: "the hull's.obj", surface, ...USUAL };

describe('surfaces that hexes are refined at', () => {
  test('are triangles, made once', () => {
    expect(trianglesOf(surface).triangles).toEqual([[0, 1, 2], [0, 2, 3], [1, 4, 2]]);
    expect(trianglesOf(surface).positions).toHaveLength(5);
    expect(trianglesOf(surface)).toBe(trianglesOf(surface));
  });

  test('are regions of all that they pass, or of their points', () => {
    expect(regionOf(guide)).toEqual({ kind: 'surface', ...trianglesOf(surface), distance: 0, level: 2 });
    const points: Guide = { ...guide, at: 'points', distance: 0.5, target: { by: 'size', size: 0.1 } };
    expect(regionOf(points)).toEqual({ kind: 'points', points: trianglesOf(surface).positions, radius: 0.5, size: 0.1 });
  });

  test('come after the regions in what the mesher is asked', () => {
    const sphere = region({ kind: 'sphere', center: [0, 0, 0], radius: 1 }, { by: 'level', level: 1 });
    const kinds = toHexOptions({ ...DEFAULTS, regions: [sphere], guides: [guide] }).regions?.map(({ kind }) => kind);
    expect(kinds).toEqual(['sphere', 'surface']);
  });

  test('are files in the command that makes the same mesh', () => {
    const points: Guide = { ...guide, name: 'face.obj', at: 'points', distance: 0.5 };
    expect(formatCommand({ name: 'sea.vtu', holdsHexes: true }, 'out.vtu', { ...DEFAULTS, guides: [guide, points] })).toBe(
      String.raw`hexmill refine sea.vtu -o out.vtu --region 'surface:the hull'\''s.obj,0:level=2' --region points:face.obj,0.5:level=2`,
    );
  });
});
