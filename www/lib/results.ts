import type { OutputFormat } from './options.js';

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
  shortestEdge: number;
  meanEdge: number;
  /** A fingerprint of nodes and faces: of quads alone the same as that of a `QuadMesh`. */
  hash: string;
  /** Cells of a VTU or legacy VTK file that it hides, or has of another piece, and that were left out. */
  hidden: number;
  /** Arrays of a VTU or legacy VTK file that are no tags, and were left out. */
  droppedArrays: string[];
  /** What files cannot say of the surface's groups, by format; a format that keeps all of it is left out. */
  losses: Partial<Record<OutputFormat, string[]>>;
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
  /** The regions that overlap no part of the input, by their places among the options'. They refine nothing. */
  idleRegions: number[];
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

/** What is known of a loaded hex mesh. Lengths are in model units. */
export interface HexInfo {
  /** Nodes that some hex uses. */
  nodes: number;
  /** Nodes that no hex uses. */
  unusedNodes: number;
  edges: number;
  faces: number;
  hexes: number;
  bounds: { min: [number, number, number]; max: [number, number, number] };
  longestEdge: number;
  shortestEdge: number;
  meanEdge: number;
  /** Faces of one hex. */
  boundaryFaces: number;
  /** Parts of the boundary that share no node. */
  boundaryComponents: number;
  /** Faces of three hexes or more. */
  nonManifoldFaces: number;
  /** Edges with boundary faces, but not two. */
  nonManifoldEdges: number;
  /** Nodes around which the hexes fill neither a ball nor half of one. */
  nonManifoldNodes: number;
  /** Parts that share no node. */
  components: number;
  /** Euler characteristic: nodes - edges + faces - hexes. */
  euler: number;
  /** Hexes that were numbered inside out, and were turned. */
  turned: number;
  /** Faces that are in groups. */
  groupedFaces: number;
  /** Hexes of the second order in the file, of which the corners were read: the nodes on edges, on faces and inside were left out. */
  linearized: number;
  /** Cells of a VTU or legacy VTK file that it hides, or has of another piece, and that were left out. */
  hidden: number;
  /** Faces in the file that are no faces of the hexes, and were left out. */
  droppedFaces: number;
  /** Arrays of a VTU or legacy VTK file that are no tags, and were left out. */
  droppedArrays: string[];
  /** What files cannot say of the mesh's groups, by format; a format that keeps all of it is left out. */
  losses: Partial<Record<OutputFormat, string[]>>;
  /**
   * The groups of faces: the names of each and their numbers, where the file gave any (a group with a number alone has the
   * name ''), and the one number of formats that have one a face.
   */
  groups: { names: string[]; numbers: (number | null)[]; number: number | null }[];
  /** A fingerprint of nodes and hexes: the same as that of `RefinedHexes`. */
  hash: string;
  /** How well shaped the hexes are; null where there are none. */
  quality: HexQuality | null;
  /** What is wrong with the mesh, in words. */
  defects: string[];
}

/** A measure of a hex: the scaled Jacobian from -1 to 1 (cube), longest over shortest edge, the volume. */
export type HexMetric = 'scaledJacobian' | 'aspect' | 'volume';

/** How the hexes of a mesh fare as a whole. */
export interface HexQuality {
  readonly scaledJacobian: QualitySummary;
  readonly aspect: QualitySummary;
  /** Of each hex. */
  readonly volume: Omit<QualitySummary, 'histogram'>;
  /** Of all hexes together. */
  readonly totalVolume: number;
  /** Hexes whose Jacobian is not positive somewhere. */
  readonly notPositive: number;
  /** Hexes of which that could not be told. */
  readonly undecided: number;
}

/** Elements that are refined beyond those asked for, by the reason. */
export interface AddedHexes {
  /** Hexes of the input that nothing asks for, so that all elements are in families, or some in blocks, of eight. */
  base: number;
  /** To complete families of eight. */
  families: number;
  /** To grade levels by one. */
  balance: number;
  /** For the method's templates. */
  method: number;
  /** At places where refined hexes and coarse ones cannot be separated. */
  conflicts: number;
  /** At transition hexes that could not be untangled. */
  repairs: number;
}

/** What refinement of hexes will do. The figures are exact, unless transition hexes have to be repaired. */
export interface HexPlan {
  /** Hexes before transitions. */
  treeHexes: number;
  /** Hexes of the mesh. */
  hexes: number;
  /** Transition hexes that the stages make; those that are not touched again are hexes of the mesh. */
  transition: number;
  /** Peak memory of the work, about. */
  bytes: number;
  /** What each stage will do, coarse to fine. */
  stages: HexStagePlan[];
  /** Elements that are refined beyond those asked for, by the reason; `repairs` are not known before. */
  added: AddedHexes;
  /** Elements that will be larger than asked for, because `maxLevels` was reached. */
  capped: number;
  /** Hexes of the input that were numbered inside out, and were turned. */
  turned: number;
  /** The regions that overlap no part of the input, by their places in `regions`. They refine nothing. */
  idleRegions: number[];
  /** Nodes of the input that stand where earlier ones do; hexes there that do not share nodes are no neighbours. */
  coincidentNodes: number;
}

/** What one stage of refinement will do. */
export interface HexStagePlan {
  /** Elements that will be divided. */
  refined: number;
  /** Faces between them and coarse elements. */
  interfaceFaces: number;
  /** Transition hexes. */
  transition: number;
  /** Hexes of the mesh after the stage. */
  hexes: number;
}

/** What one stage of refinement did: it divides hexes of one level and joins them to the others. */
export interface HexStage {
  /** Hexes that were divided. */
  refined: number;
  /** Faces between refined and coarse hexes. */
  interfaceFaces: number;
  /** Transition hexes made. */
  transition: number;
  /** Edges at which the refined hexes touch themselves. */
  pinchedEdges: number;
  /** Nodes that a pillow made. */
  copies: number;
}
