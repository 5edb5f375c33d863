/** What is known of a loaded surface. Lengths are in model units. */
export interface SurfaceInfo {
  nodes: number;
  faces: number;
  triangles: number;
  quads: number;
  /** Faces of five nodes and more. */
  polygons: number;
  bounds: { min: [number, number, number]; max: [number, number, number] };
  /** Edges of one face. */
  boundaryEdges: number;
  /** Edges of more than two faces. */
  nonManifoldEdges: number;
  /** Parts that no edge joins. */
  components: number;
  /** Euler characteristic: nodes - edges + faces. */
  euler: number;
  longestEdge: number;
  meanEdge: number;
  /** A fingerprint of nodes and faces: of quads alone the same as that of a `QuadMesh`. */
  hash: string;
  /** What is wrong with the surface, in words; at most the first hundred. */
  defects: string[];
}

/** How large a mesh will be. */
export interface Estimate {
  quads: number;
  nodes: number;
  /** Peak memory of the work. */
  bytes: number;
  /** The deepest level. */
  levels: number;
  /** True if the figures are exact. */
  exact: boolean;
}

/** A measure of a quad: the scaled Jacobian from -1 to 1 (square), angles in degrees, the aspect ratio from 1. */
export type Metric = 'scaledJacobian' | 'minAngle' | 'maxAngle' | 'aspect';

/** The distribution of a measure over a mesh. */
export interface QualitySummary {
  min: number;
  max: number;
  mean: number;
  /** One quad in a hundred is below this. */
  percentile1: number;
  /** Counts of quads in equal steps from `min` to `max`. */
  histogram: { min: number; max: number; counts: number[] };
}

/** The distribution of each measure. */
export type MeshQuality = Readonly<Record<Metric, QualitySummary>>;
