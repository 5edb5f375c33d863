/** What is made of an input: the quads or hexes, and what can be told of them before. */

import { HexMesh, RefinedHexes } from 'hexmill';
import type { CallOptions, HexFormat, Mesher, OutputFormat, AddedHexes, QuadMesh, Region, Surface } from 'hexmill';
import type { Example } from './examples.js';
import { toHexOptions, toOptions } from './settings.js';
import type { Settings } from './settings.js';
import { counted } from './text.js';

/** The model that is loaded. */
export interface Input {
  readonly name: string;
  readonly example: Example | null;
  /** Null if it is hexes. */
  readonly surface: Surface | null;
  readonly hexes: HexMesh | null;
}

/** A mesh that was made. */
export type Cells = QuadMesh | RefinedHexes;

export function isHexes(mesh: Cells): mesh is RefinedHexes {
  return mesh instanceof RefinedHexes;
}

/** Nodes of each cell of `mesh`, cell after cell, and how many each has. */
export function cornersOf(mesh: Cells): { corners: Uint32Array; each: number } {
  return isHexes(mesh) ? { corners: mesh.hexes, each: 8 } : { corners: mesh.quads, each: 4 };
}

export function cellCount(mesh: Cells): number {
  const { corners, each } = cornersOf(mesh);
  return corners.length / each;
}

export function nounOf(mesh: Cells): 'quad' | 'hex' {
  return isHexes(mesh) ? 'hex' : 'quad';
}

/** "1 quad", "24 hexes". */
export function countedCells(mesh: Cells): string {
  const noun = nounOf(mesh);
  return counted(cellCount(mesh), noun, noun === 'hex' ? 'hexes' : 'quads');
}

export function exported(mesh: Cells, format: OutputFormat, signal: AbortSignal): Promise<Uint8Array> {
  // The page offers hexes no format that holds none.
  return isHexes(mesh) ? mesh.export(format as HexFormat, { signal }) : mesh.export(format, { signal });
}

/** What `loadFile` gives, as an input. */
export function inputOf(name: string, example: Example | null, model: Surface | HexMesh): Input {
  return model instanceof HexMesh ? { name, example, surface: null, hexes: model } : { name, example, surface: model, hexes: null };
}

/** Whether hexes are made of `input`. */
export function makesHexes(input: Input, settings: Settings): boolean {
  return input.hexes !== null || settings.job === 'hexes';
}

/** What can be told before the work. */
export interface Forecast {
  readonly noun: 'quad' | 'hex';
  readonly cells: number;
  readonly exact: boolean;
  /** Memory. */
  readonly bytes: number;
  readonly levels: number;
  /** What the method adds to what was asked for. */
  readonly added: AddedHexes | null;
}

/** Makes meshes, and keeps the box of hexes that was last made around a surface. */
export class Maker {
  readonly #mesher: Promise<Mesher>;
  #box: { surface: Surface; spacing: number; margin: number; hexes: HexMesh } | null = null;

  constructor(mesher: Promise<Mesher>) {
    this.#mesher = mesher;
  }

  async foretell(input: Input, settings: Settings, signal: AbortSignal): Promise<Forecast> {
    const mesher = await this.#mesher;
    if (!makesHexes(input, settings)) {
      const { quads, bytes, levels, exact } = await mesher.estimateQuads(surfaceOf(input), { ...toOptions(settings), signal });
      return { noun: 'quad', cells: quads, exact, bytes, levels, added: null };
    }
    const hexes = await this.#hexes(input, settings, { signal });
    const plan = await mesher.planHexes(hexes, { ...toHexOptions(settings, atSurface(input, settings)), signal });
    return { noun: 'hex', cells: plan.hexes, exact: true, bytes: plan.bytes, levels: plan.stages.length, added: plan.added };
  }

  async make(input: Input, settings: Settings, options: CallOptions): Promise<Cells> {
    const mesher = await this.#mesher;
    if (!makesHexes(input, settings)) return mesher.refineQuads(surfaceOf(input), { ...toOptions(settings), ...options });
    const hexes = await this.#hexes(input, settings, options);
    return mesher.refineHexes(hexes, { ...toHexOptions(settings, atSurface(input, settings)), ...options });
  }

  /** The hexes that are refined: the input's, or a box of them around its surface. */
  async #hexes(input: Input, { hexes: { spacing, margin, maxHexes } }: Settings, { signal }: CallOptions): Promise<HexMesh> {
    if (input.hexes) return input.hexes;
    const surface = surfaceOf(input);
    const box = this.#box;
    if (box && box.surface === surface && box.spacing === spacing && box.margin === margin) return box.hexes;
    const hexes = await (await this.#mesher).makeGrid(surface, { spacing, margin, maxHexes, signal });
    // Freed in the workers once no mesh needs it: another call may still be at work on it.
    this.#box = { surface, spacing, margin, hexes };
    return hexes;
  }
}

function surfaceOf({ surface }: Input): Surface {
  if (!surface) throw new TypeError('the input is no surface');
  return surface;
}

const triangulated = new WeakMap<Surface, Pick<Extract<Region, { kind: 'surface' }>, 'positions' | 'triangles'>>();

/** The region of all that the input's surface passes, if it is to be refined. */
function atSurface({ surface }: Input, { hexes: { atSurface: level } }: Settings): Region[] {
  if (!surface || level === 0) return [];
  const known = triangulated.get(surface) ?? triangulate(surface);
  triangulated.set(surface, known);
  return [{ kind: 'surface', ...known, distance: 0, level }];
}

/** The faces as fans of triangles: where a surface passes hardly depends on how its faces are cut. */
function triangulate({ nodes, offsets, corners }: Surface): { positions: [number, number, number][]; triangles: [number, number, number][] } {
  const positions: [number, number, number][] = [];
  for (let i = 0; i < nodes.length; i += 3) positions.push([nodes[i] ?? 0, nodes[i + 1] ?? 0, nodes[i + 2] ?? 0]);
  const triangles: [number, number, number][] = [];
  for (let face = 0; face + 1 < offsets.length; face += 1) {
    const [first = 0, end = 0] = offsets.subarray(face, face + 2);
    for (let k = first + 1; k + 1 < end; k += 1) triangles.push([corners[first] ?? 0, corners[k] ?? 0, corners[k + 1] ?? 0]);
  }
  return { positions, triangles };
}
