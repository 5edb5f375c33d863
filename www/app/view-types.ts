// What a view is asked for and what it tells.

/** A mesh to draw: three coordinates a node, and the nodes of all faces, face after face. */
export type DrawMesh = {
  nodes: Float64Array;
  /** Where each face's corners start in `corners`, and the end of the last; null: all faces are quads. */
  offsets: Uint32Array | null;
  corners: Uint32Array;
};

/** A hex mesh to draw: three coordinates a node, eight nodes a hex. */
export type DrawHexes = { nodes: Float64Array; hexes: Uint32Array };

/** Cells of a hex mesh whose middle `m` lies beyond, `normal . m > offset`, are hidden. World coordinates, a unit normal. */
export type Section = { normal: Vector; offset: number };

export type ColourMap = 'viridis' | 'quality' | 'levels';

/** How faces, or cells of a hex mesh, are coloured: all alike, or by one value each. NaN: no value (grey). */
export type Colouring =
  | { kind: 'plain' }
  | { kind: 'scalar'; values: Float32Array; range: [number, number]; map: ColourMap };

export type Vector = [number, number, number];

/** A region in world coordinates; a box may be turned about its middle by a unit quaternion x, y, z, w. */
export type ViewRegion =
  | { kind: 'box'; min: Vector; max: Vector; rotation?: [number, number, number, number] }
  | { kind: 'sphere'; center: Vector; radius: number }
  | { kind: 'cylinder'; from: Vector; to: Vector; radius: number };

/** A curve of a solid, a corner (one point), or one of these that a mesh does not show. World coordinates. */
export type ViewFeature = { kind: 'convex' | 'concave' | 'corner' | 'lost'; points: Vector[] };

export type Style = {
  edges: boolean;
  /** In CSS pixels. */
  edgeWidth: number;
  background: 'light' | 'dark';
  projection: 'perspective' | 'orthographic';
  /** What is up: z as in CAD, y as in modelling. A change looks from the front, right and above again. */
  up: 'y' | 'z';
  /** CSS pixels at both sides, and at the upper and lower end, that panels cover: what is framed stays clear of them. */
  covered: [number, number];
};

export type Direction = '+x' | '-x' | '+y' | '-y' | '+z' | '-z' | 'iso';
export type FaceHit = { face: number; point: Vector };
export type DragPhase = 'drag' | 'end';

export interface View {
  /**
   * Shows a mesh, or none. The camera frames it unless `keepCamera`. The arrays must not change later.
   * @throws {ViewError} The mesh is broken, or larger than the graphics driver allows.
   */
  setMesh(mesh: DrawMesh | null, options?: { keepCamera?: boolean }): void;
  /** The same for a hex mesh, of which all is shown until it is cut. */
  setHexes(mesh: DrawHexes, options?: { keepCamera?: boolean }): void;
  /** Cuts the hex mesh open by a plane with a handle to drag, or not. */
  setSection(section: Section | null): void;
  onSectionDrag(callback: (section: Section, phase: DragPhase) => void): void;
  /** Hides so many layers of cells of the hex mesh, from the boundary inwards. */
  setPeel(layers: number): void;
  /** How many layers the hex mesh has. */
  layers(): number;
  /** How many layers lie over a cell of the hex mesh. */
  depthOf(cell: number): number;
  /** Hides cells of the hex mesh whose value, one a cell, is out of range; null: none. */
  setFilter(filter: { values: Float32Array; range: [number, number] } | null): void;
  /** Outlines a cell of the hex mesh over all else, or none. */
  mark(cell: number | null): void;
  /** Draws the features of a solid as lines and points, faint where something stands before them. */
  setFeatures(features: ViewFeature[]): void;
  /** Draws the edges of a box, or none. */
  setBox(box: { min: Vector; max: Vector } | null): void;
  /** The direction in which the camera looks. */
  forward(): Vector;
  setColouring(colouring: Colouring): void;
  setStyle(style: Partial<Style>): void;
  /** Draws regions as translucent solids, the selected one with handles to drag. */
  setRegions(regions: ViewRegion[], selected: number | null): void;
  onRegionDrag(callback: (index: number, region: ViewRegion, phase: DragPhase) => void): void;
  /** Called when a click meets a region (its index) or none (null). */
  onRegionPick(callback: (index: number | null) => void): void;
  /** Called when a click meets a face, or a cell of a hex mesh, or none. A click that selects a region is not reported. */
  onPick(callback: (hit: FaceHit | null) => void): void;
  frameAll(): void;
  /** Flies to a face, or to a cell of the hex mesh. */
  frameFace(face: number): void;
  /** Flies to a box. */
  frameBox(box: { min: Vector; max: Vector }): void;
  /** Turns the camera to look along an axis: '-z' is the view from above. */
  lookAlong(axis: Direction): void;
  /** The handles of the selected region, in CSS pixels from the canvas's upper left corner. */
  handlePositions(): { name: string; x: number; y: number }[];
  /** What is seen now, as a PNG. */
  screenshot(): Promise<Blob>;
  /** Called with a message in plain words when drawing is no longer possible. */
  onLost(callback: (message: string) => void): void;
  /** Called when drawing is possible again. */
  onRestored(callback: () => void): void;
  /** `frameMs`: what the last frame cost the page. `gpuBytes`: what the mesh takes on the graphics device. */
  stats(): { frameMs: number; faces: number; nodes: number; gpuBytes: number };
  dispose(): void;
}

/** Why there is no view, in plain words. */
export class ViewError extends Error {
  override readonly name = 'ViewError';
}

/** What an error says. */
export function messageOf(cause: unknown): string {
  return cause instanceof Error ? cause.message : String(cause);
}
