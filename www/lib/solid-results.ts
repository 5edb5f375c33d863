import type { Bounds, Vector } from './options.js';
import type { Background, SecondOrderHex } from './solid-options.js';

/** What is known of a solid before it is meshed. Lengths are in model units. */
export interface SolidPlan {
  /** What was found in the surface, and what was mended. */
  found: FoundSolid;
  bounds: Bounds;
  volume: number;
  area: number;
  /** Points where curves end. */
  corners: Vector[];
  curves: SolidCurve[];
  surfaces: SolidSurface[];
  /** About how many hexes the mesh will have; null without an edge length. */
  hexes: number | null;
  /** Peak memory of the work, about; null without an edge length. */
  bytes: number | null;
  /** The regions that overlap no part of the solid, by their places in `regions`; none without an edge length. They refine nothing. */
  idleRegions: number[];
}

/** A line that the mesh keeps: where surfaces meet, or a crease within one. */
export interface SolidCurve {
  /** From start to end; a closed curve comes back to its first point. */
  points: Vector[];
  /** The corners at its start and end, by their places in `corners`; null for a closed curve that has none. */
  corners: [number, number] | null;
  /** The surfaces left and right of it seen from outside, by their places in `surfaces`. */
  surfaces: [number, number];
  /** Degrees from surface to surface inside the solid; less than 180 is convex. */
  interiorAngle: number;
  length: number;
  isStraight: boolean;
}

/** A part of the solid's boundary between curves. */
export interface SolidSurface {
  /** Its shape; the normal is outward, and which way the axis of an extruded surface points is arbitrary. */
  class: { kind: 'planar'; normal: Vector } | { kind: 'cylindrical'; axis: Vector } | { kind: 'general' };
  area: number;
  /** The curves that bound it or end in it, by their places in `curves`. */
  curves: number[];
  bounds: Bounds;
  /** Which of the disjoint bodies it belongs to. */
  body: number;
}

/** What was found in a surface that bounds a solid, and what was mended. */
export interface FoundSolid {
  /** Points that were welded to others with the same coordinates. */
  weldedPoints: number;
  /** Points that were welded to others nearer than a millionth of the diagonal. */
  closePoints: number;
  /** Triangles that were dropped because they had a point twice. */
  degenerateTriangles: number;
  /** Triangles that were dropped because others were the same. */
  duplicateTriangles: number;
  /** Triangles that were dropped in pairs that lay on each other: walls without thickness. */
  wallTriangles: number;
  /** Holes that were filled: the middle of each, and the edges of its rim. */
  filledHoles: { at: Vector; edges: number }[];
  /** Triangles that were turned around. */
  turnedTriangles: number;
  /** Triangles without height whose longest edge was flipped. */
  flippedTriangles: number;
  /** Points at which several parts touched, and were parted. */
  splitPoints: number;
  /** Edges of the file's polylines and creases that are none of the surface. */
  unmatchedEdges: number;
  /** Feature edges that were taken for noise. */
  noiseEdges: number;
  points: number;
  triangles: number;
  /** Disjoint bodies. */
  bodies: number;
  /** Voids within bodies. */
  voids: number;
  corners: number;
  curves: number;
  surfaces: number;
  /** Euler characteristic of the boundary. */
  euler: number;
  /**
   * For each surface the names of the input's groups that all of it is in, with its object behind `object:` and its material behind
   * `material:`; empty if the input has no groups.
   */
  surfaceGroups: string[][];
}

/** What was done to fill a solid with hexes, and what came of it. */
export interface SolidReport {
  solid: FoundSolid;
  /** What was done to each of its bodies. */
  bodies: BodyReport[];
  /** What came of all of them. */
  result: SolidResult;
  /** What came of the second order, if it was asked for. */
  secondOrder?: SecondOrderReport;
}

/** What makes linear hexes hexes of the second order. Each has a positive Jacobian all over, by Bernstein's bound. */
export interface SecondOrder {
  hex: SecondOrderHex;
  /** x, y, z of each node beside the corners. The first of them has the number after those of the mesh's `nodes`. */
  nodes: Float64Array;
  /** The 20 or 27 nodes of each hex in the order of VTK_QUADRATIC_HEXAHEDRON or VTK_TRIQUADRATIC_HEXAHEDRON. */
  hexes: Uint32Array;
}

/** What came of the second order. */
export interface SecondOrderReport {
  hex: SecondOrderHex;
  /** Nodes beside the corners, those of them on the solid, and those that had to stay off it for the sake of their hexes. */
  nodes: number;
  onSolid: number;
  yielded: number;
  /** How far the farthest of these is from the solid, and where. */
  farthest: number;
  place: Vector | null;
}

/** What was done to fill one body. */
export interface BodyReport {
  /** The middle of its box. */
  place: Vector;
  /** The background that was chosen, and what it captures of the body's planar faces, from 0 to 1. */
  choice: { kind: Background; gridCapture: number; sweptCapture: number | null; worstQuad: number | null };
  /** The candidates for the direction of a sweep, the best first. */
  directions: { direction: Vector; area: number; surfaceCapture: number; volumeCapture: number; score: number }[];
  /** What came of each attempt. */
  attempts: SolidAttempt[];
  /** Further attempts for which there was no background: what kind, of how many hexes at most, and why there is none. */
  refused: { background: Background; shift: Vector; holdsWalls: boolean; edgeLength: number; limit: number; code: string; reason: string }[];
  /** Which attempt was kept; null for a body that is too thin for any hex, and not in the mesh. */
  kept: number | null;
}

/** How the hexes of a background that stand for a body were chosen. */
export interface CoreReport {
  /** Hexes of the background. */
  background: number;
  /** Of these, at what is thinner than a hex. */
  thin: number;
  /** Of these, what the cut decided on. */
  undecided: number;
  /** Hexes of the core. */
  cells: number;
  /** Changes that made its boundary a manifold, and rounds of these. */
  flips: number;
  rounds: number;
  /** Terraces of its boundary that were moved by a hex to save creases. */
  terraces: number;
  /** Hexes removed because they hung together with no body, and added because they were closed in. */
  crumbs: number;
  bubbles: number;
  /** Euler characteristic of the core's boundary and of the solid's. */
  euler: number;
  solidEuler: number;
  /** The core's volume over the solid's. */
  volumeRatio: number;
}

/** What came of one attempt. What was not done, since the attempt was worse than one before, is left out or null. */
export interface SolidAttempt {
  background: Background;
  /** How far the lines of a grid were moved, as a share of an edge along each axis. */
  shift: Vector;
  /** Was there a line of a grid, or a layer of a sweep, on both sides of what is thinner than cells? */
  holdsWalls: boolean;
  /** How long edges were to be: shorter than asked for where the `maxDistance` that was asked for takes that. */
  edgeLength: number;
  /** Hexes of the background by level, from the coarsest. */
  levels: number[];
  /** Whether what is thinner than cells was made as thick as one. */
  keepThin: boolean;
  /** The hexes of the background that stand for the body. */
  core: CoreReport;
  /** Whether some part of the body is farther from the core than cells are large: looked for where features were lost. */
  lacksPart: boolean;
  features: FeatureReport | null;
  /**
   * Layers of hexes that were put under the boundary where cells would be flat or thin there, and how many were left out
   * because their hexes could not be pushed open.
   */
  sheets?: { sheets: number; wedges: number; collars: number; hexes: number; takenBack: number; pinched: number };
  /** How the nodes came to the solid: those that are not there, and the farthest of them. */
  fit?: { sweeps: number; off: number; farthest: number; place: Vector | null; drawnIn: number };
  hexes?: number;
  /** The least scaled Jacobian. */
  worst?: number;
  /** The mean scaled Jacobian. */
  mean?: number;
  distance?: SurfaceDistances;
}

/** What a mesh shows of its solid, and how near it is. */
export interface SolidResult {
  /** Euler characteristic of the mesh's boundary. */
  euler: number;
  /** That of the solid's boundary: where they differ the mesh has other holes than the solid. */
  solidEuler: number;
  /** Bodies that are too thin for any hex, and not in the mesh. */
  lostBodies: LostFeature[];
  /** Surfaces of which faces of the mesh go through others, with a place of each: hexes there reach into each other. */
  crossings: LostFeature[];
  features: FeatureReport;
  hexes: number;
  /** The least scaled Jacobian. */
  worst: number;
  /** The mean scaled Jacobian. */
  mean: number;
  distance: SurfaceDistances;
  /** The `maxDistance` that was asked for; where the greatest of `distance` is more, there was no such mesh among those tried. */
  maxDistance: number | null;
}

/** Between a mesh's boundary and a surface, both ways. */
export interface SurfaceDistances {
  meshToSurface: DistanceSummary;
  surfaceToMesh: DistanceSummary;
}

/** What became of the solid's features. */
export interface FeatureReport {
  corners: Captured;
  curves: Captured;
  surfaces: Captured;
  /** Curves that shrank to a corner. */
  contracted: LostFeature[];
  /** Curves that nothing stands for. */
  suppressed: LostFeature[];
  /** Surfaces that no face stands for. */
  lostSurfaces: LostFeature[];
}

/** How many features of a kind the solid has, and how many of them the mesh shows. */
export interface Captured {
  found: number;
  captured: number;
}

/** A feature, or a body, that the mesh does not show. */
export interface LostFeature {
  /** Its place in `curves` or `surfaces` of the plan for the same options. */
  id: number;
  /** The middle of it. */
  place: Vector;
  /** The length of a curve, the root of a surface's area, or the diagonal of a body. */
  size: number;
}

/** How far samples of one surface are from another. */
export interface DistanceSummary {
  max: number;
  mean: number;
  rms: number;
  /** Where the farthest is. */
  farthest: Vector;
  samples: number;
}
