import type { HexedSolid, SolidPlan } from 'hexmill';
import { describe, expect, test } from 'vitest';
import { classesOf, featuresOf, lostFeatures, lostOf, mended } from './features.js';

const CURVE = { corners: null, surfaces: [0, 1], length: 2, isStraight: true } satisfies Partial<SolidPlan['curves'][number]>;
const UNMENDED = { weldedPoints: 0, closePoints: 0, degenerateTriangles: 0, duplicateTriangles: 0, wallTriangles: 0, filledHoles: [], turnedTriangles: 0, flippedTriangles: 0, splitPoints: 0 };
const PLAN = {
  found: UNMENDED,
  corners: [[0, 0, 0]],
  curves: [
    { ...CURVE, points: [[0, 0, 0], [1, 0, 0]], interiorAngle: 90 },
    { ...CURVE, points: [[0, 0, 0], [0, 1, 0]], interiorAngle: 270 },
  ],
  surfaces: [{ class: { kind: 'general' } }, { class: { kind: 'planar', normal: [0, 0, 1] } }, { class: { kind: 'planar', normal: [1, 0, 0] } }],
} as unknown as SolidPlan;

const meshWith = (features: Partial<HexedSolid['result']['features']>, more: Partial<HexedSolid['result']> = {}): Pick<HexedSolid, 'result'> =>
  ({ result: { lostBodies: [], crossings: [], ...more, features: { contracted: [], suppressed: [], lostSurfaces: [], ...features } } }) as unknown as HexedSolid;

describe('features of a solid', () => {
  test('are lines by how the solid bends, and points', () => {
    expect(featuresOf(PLAN)).toEqual([
      { kind: 'convex', points: [[0, 0, 0], [1, 0, 0]] },
      { kind: 'concave', points: [[0, 0, 0], [0, 1, 0]] },
      { kind: 'corner', points: [[0, 0, 0]] },
    ]);
  });

  test('are counted by class', () => expect(classesOf(PLAN.surfaces)).toBe('2 planar, 1 general'));

  test('what was mended is said, nothing else', () => {
    expect(mended(PLAN)).toEqual([]);
    const found = { ...UNMENDED, weldedPoints: 2, closePoints: 1, wallTriangles: 1, filledHoles: [{ at: [0.5, 1, 2], edges: 3 }] };
    expect(mended({ ...PLAN, found } as unknown as SolidPlan)).toEqual([
      '3 points welded to others',
      '1 triangle dropped that bound nothing',
      'a hole of 3 edges filled at 0.5, 1, 2',
    ]);
  });
});

describe('lost features', () => {
  const mesh = meshWith({
    contracted: [{ id: 0, place: [0.5, 0, 0], size: 1 }],
    suppressed: [{ id: 1, place: [0, 0.5, 0], size: 2 }],
    lostSurfaces: [{ id: 2, place: [3, 0, 0], size: 5 }],
  });

  test('are listed with what became of them, the largest first', () => {
    expect(lostOf(mesh).map(({ what, id, fate }) => `${what} ${id} ${fate}`)).toEqual(['surface 2 no face', 'curve 1 not shown', 'curve 0 shrunk to a corner']);
    expect(lostOf(meshWith({}))).toEqual([]);
    const [thin, crossing] = [{ id: 3, place: [9, 0, 0], size: 2 }, { id: 4, place: [8, 0, 0], size: 1 }] as const;
    const others = lostOf(meshWith({}, { lostBodies: [thin as never], crossings: [crossing as never] }));
    expect(others.map(({ what, id, fate }) => `${what} ${id} ${fate}`)).toEqual(['body 3 too thin', 'surface 4 overlaps']);
  });

  test('are drawn along their way, or where they are', () => {
    const [surface, curve] = lostFeatures(lostOf(mesh), PLAN);
    expect(surface).toEqual({ kind: 'lost', points: [[3, 0, 0]] });
    expect(curve).toEqual({ kind: 'lost', points: [[0, 0, 0], [0, 1, 0]] });
    expect(lostFeatures(lostOf(mesh), null)[1]).toEqual({ kind: 'lost', points: [[0, 0.5, 0]] });
  });
});
