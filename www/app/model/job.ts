/** What is made of an input: the quads or hexes, and what can be told of them before. */

import { HexedSolid, HexMesh, QuadMesh } from 'hexmill';
import type { AddedHexes, CallOptions, HexFormat, Mesher, OutputFormat, RefinedHexes, Region, SolidPlan, Surface } from 'hexmill';
import type { Example } from './examples.js';
import { trianglesOf } from './guide.js';
import { toHexOptions, toOptions, toSolidOptions } from './settings.js';
import type { Job, Settings } from './settings.js';
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
export type Cells = QuadMesh | RefinedHexes | HexedSolid;

export function isHexes(mesh: Cells): mesh is RefinedHexes | HexedSolid {
  return !(mesh instanceof QuadMesh);
}

/** Whether the mesh fills a solid; else it is a refined one, with levels. */
export function isSolid(mesh: Cells): mesh is HexedSolid {
  return mesh instanceof HexedSolid;
}

/** What kind of cells the mesh has. */
export type CellKind = 'quads' | 'hexes' | 'second order';

export function kindOf(mesh: Cells): CellKind {
  if (isSolid(mesh) && mesh.secondOrder) return 'second order';
  return isHexes(mesh) ? 'hexes' : 'quads';
}

/** What kind of cells a job makes. */
export function wantedKind(job: Job, settings: Settings): CellKind {
  if (job === 'solid' && settings.solid.secondOrder !== null) return 'second order';
  return job === 'quads' ? 'quads' : 'hexes';
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

/** The model whose groups a mesh that was made of `input` has; null for that of a solid, which has groups of its own. */
export function groupsOf(mesh: Cells, input: Input): Surface | HexMesh | null {
  if (isSolid(mesh)) return null;
  return isHexes(mesh) ? input.hexes : input.surface;
}

/** What `loadFile` gives, as an input. */
export function inputOf(name: string, example: Example | null, model: Surface | HexMesh): Input {
  return model instanceof HexMesh ? { name, example, surface: null, hexes: model } : { name, example, surface: model, hexes: null };
}

/** What is made of `input`: hexes are refined. */
export function jobOf(input: Input, settings: Settings): Job {
  return input.hexes ? 'hexes' : settings.job;
}

/** What can be told before the work. */
export interface Forecast {
  readonly noun: 'quad' | 'hex';
  readonly cells: number;
  readonly exact: boolean;
  /** Memory. */
  readonly bytes: number;
  /** Null where there are none. */
  readonly levels: number | null;
  /** What the method adds to what was asked for. */
  readonly added: AddedHexes | null;
  /** The solid that will be filled. */
  readonly solid: SolidPlan | null;
  /** The regions that meet nothing of the input, by place. */
  readonly idleRegions: readonly number[];
}

/** A mesh, and the plan of the solid that it fills. */
export interface Made {
  readonly mesh: Cells;
  readonly plan: SolidPlan | null;
}

/** Makes meshes, and keeps the box of hexes that was last made around a surface and the solid that was last found in one. */
export class Maker {
  readonly #mesher: Promise<Mesher>;
  #box: { surface: Surface; spacing: number; margin: number; hexes: HexMesh } | null = null;
  #plan: ({ surface: Surface; plan: SolidPlan } & Pick<Settings, 'regions' | 'solid'>) | null = null;

  constructor(mesher: Promise<Mesher>) {
    this.#mesher = mesher;
  }

  async foretell(input: Input, settings: Settings, signal: AbortSignal): Promise<Forecast> {
    const mesher = await this.#mesher;
    const job = jobOf(input, settings);
    if (job === 'quads') {
      const { quads, bytes, levels, exact, idleRegions } = await mesher.estimateQuads(surfaceOf(input), { ...toOptions(settings), signal });
      return { noun: 'quad', cells: quads, exact, bytes, levels, added: null, solid: null, idleRegions };
    }
    if (job === 'solid') {
      const solid = await this.#solid(input, settings, signal);
      return { noun: 'hex', cells: solid.hexes ?? 0, exact: false, bytes: solid.bytes ?? 0, levels: null, added: null, solid, idleRegions: solid.idleRegions };
    }
    const hexes = await this.#hexes(input, settings, { signal });
    const plan = await mesher.planHexes(hexes, { ...toHexOptions(settings, atSurface(input, settings)), signal });
    return { noun: 'hex', cells: plan.hexes, exact: true, bytes: plan.bytes, levels: plan.stages.length, added: plan.added, solid: null, idleRegions: plan.idleRegions };
  }

  async make(input: Input, settings: Settings, options: CallOptions): Promise<Made> {
    const mesher = await this.#mesher;
    const job = jobOf(input, settings);
    if (job === 'quads') return { mesh: await mesher.refineQuads(surfaceOf(input), { ...toOptions(settings), ...options }), plan: null };
    if (job === 'solid') {
      const mesh = await mesher.meshSolid(surfaceOf(input), { ...toSolidOptions(settings), ...options });
      return { mesh, plan: await this.#solid(input, settings, options.signal) };
    }
    const hexes = await this.#hexes(input, settings, options);
    return { mesh: await mesher.refineHexes(hexes, { ...toHexOptions(settings, atSurface(input, settings)), ...options }), plan: null };
  }

  async #solid(input: Input, settings: Settings, signal: AbortSignal | undefined): Promise<SolidPlan> {
    const surface = surfaceOf(input);
    const { regions, solid } = settings;
    const last = this.#plan;
    if (last && last.surface === surface && last.solid === solid && last.regions === regions) return last.plan;
    const plan = await (await this.#mesher).planSolid(surface, { ...toSolidOptions(settings), signal });
    this.#plan = { surface, solid, regions, plan };
    return plan;
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

/** The region of all that the input's surface passes, if it is to be refined. */
function atSurface({ surface }: Input, { hexes: { atSurface: level } }: Settings): Region[] {
  if (!surface || level === 0) return [];
  return [{ kind: 'surface', ...trianglesOf(surface), distance: 0, level }];
}
