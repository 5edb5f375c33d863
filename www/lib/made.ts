// What a mesher has made: conforming meshes as arrays.

import type { Engine, InputRecord } from './engine.js';
import { InputError } from './errors.js';
import type { CallOptions, HexFormat, OutputFormat } from './options.js';
import type { HexArraysMade, HexData, HexedSolidData, MadeData, MadeHexData, QuadArrays, QuadData, SolidArrays } from './protocol.js';
import type { AddedHexes, HexMetric, HexQuality, HexStage, MeshQuality, Metric } from './results.js';
import type { SecondOrder, SolidReport, SolidResult } from './solid-results.js';

/** Where a mesh was made, and from what. */
export interface Origin {
  engine: Engine;
  input: InputRecord;
  /** The input if it is there for this mesh alone. */
  own: { dispose(): void } | null;
}

/** A mesh that a mesher has made. */
abstract class Made {
  /** @internal */
  protected readonly origin: Origin;
  /** x, y, z of each node. */
  readonly nodes: Float64Array;
  /** A fingerprint of nodes and cells: the same for the same input and options on every platform. */
  readonly hash: string;
  /** What is wrong with the mesh, in words: empty for every mesh of a sound input. */
  readonly defects: readonly string[];

  /** @internal */
  constructor(origin: Origin, data: MadeData) {
    this.origin = origin;
    this.nodes = data.nodes;
    this.hash = data.hash;
    this.defects = data.defects;
  }

  /** Frees what the worker keeps for it: an input that was loaded for it alone. The mesh itself stays good. */
  dispose(): void {
    this.origin.own?.dispose();
  }

  /** The same as `dispose`, for `using`. */
  [Symbol.dispose](): void {
    this.dispose();
  }

  /** @internal */
  protected refuseDetached(): void {
    if (this.nodes.length > 0) return;
    throw new InputError('mesh-detached', 'The arrays of the mesh were transferred elsewhere; transfer copies.');
  }
}

/** A conforming mesh of quads. */
export class QuadMesh extends Made {
  /** The four nodes of each quad, in order around it. */
  readonly quads: Uint32Array;
  /** The refinement level of each quad. */
  readonly level: Uint8Array;
  /** The input face that each quad is part of. */
  readonly parent: Uint32Array;
  /** Elements that are larger than asked for, because `maxLevels` was reached. */
  readonly capped: number;
  /** How well shaped the quads are. */
  readonly quality: MeshQuality;

  /** @internal */
  constructor(origin: Origin, data: QuadData) {
    super(origin, data);
    this.quads = data.quads;
    this.level = data.level;
    this.parent = data.parent;
    this.capped = data.capped;
    this.quality = data.quality;
  }

  /** A measure of each quad, for colouring. */
  qualityOf(metric: Metric, options: CallOptions = {}): Promise<Float32Array> {
    return this.origin.engine.run((desk) => desk.call('quality', { mesh: this.#arrays(), metric }), options);
  }

  /**
   * The mesh as a file, with the tags that the surface's file gave to its faces.
   *
   * @throws {@link OptionsError} if there is no such format.
   */
  export(format: OutputFormat, options: CallOptions = {}): Promise<Uint8Array> {
    return this.origin.engine.run(async (desk) => {
      const input = await desk.input(this.origin.input);
      return desk.call('export', { input, mesh: this.#arrays(), format });
    }, options);
  }

  #arrays(): QuadArrays {
    this.refuseDetached();
    const { nodes, quads, level, parent } = this;
    return { nodes, quads, level, parent };
  }
}

/** A conforming mesh of hexes. Each has a positive Jacobian, at its corners and inside. */
abstract class MadeHexes extends Made {
  /** The eight nodes of each hex in the order of VTK_HEXAHEDRON. */
  readonly hexes: Uint32Array;
  /** How well shaped the hexes are. */
  readonly quality: HexQuality;

  /** @internal */
  constructor(origin: Origin, data: MadeHexData) {
    super(origin, data);
    this.hexes = data.hexes;
    this.quality = data.quality;
  }

  /** A measure of each hex, for colouring. */
  qualityOf(metric: HexMetric, options: CallOptions = {}): Promise<Float32Array> {
    this.refuseDetached();
    const { nodes, hexes } = this;
    return this.origin.engine.run((desk) => desk.call('hexQuality', { mesh: { nodes, hexes }, metric }), options);
  }
}

/** A conforming mesh of hexes that were refined. Each has a positive Jacobian, at its corners and inside. */
export class RefinedHexes extends MadeHexes {
  /** The refinement level of each hex; a transition hex has that of the coarse hex that it is part of. */
  readonly level: Uint8Array;
  /** The input hex that each hex is part of. */
  readonly parent: Uint32Array;
  /**
   * The faces that are in groups of the input's, two numbers for each: 6 times its hex and its number there, and
   * the group's place in `info.groups` of the input. The faces of a hex are those between its nodes 0 3 2 1, 4 5 6 7,
   * 0 1 5 4, 1 2 6 5, 2 3 7 6 and 0 4 7 3.
   */
  readonly groupedFaces: Uint32Array;
  /** Elements that were refined beyond those asked for, and why. */
  readonly added: AddedHexes;
  /** Elements that are larger than asked for, because `maxLevels` was reached. */
  readonly capped: number;
  /** What each stage did, coarse to fine. */
  readonly stages: readonly HexStage[];
  /** Hexes of the input that were numbered inside out, and were turned. */
  readonly turned: number;

  /** @internal */
  constructor(origin: Origin, data: HexData) {
    super(origin, data);
    this.level = data.level;
    this.parent = data.parent;
    this.groupedFaces = data.groupedFaces;
    this.added = data.added;
    this.capped = data.capped;
    this.stages = data.stages;
    this.turned = data.turned;
  }

  /**
   * The mesh as a file, with the tags that the input's file gave to its hexes and to their faces.
   *
   * @throws {@link OptionsError} if there is no such format, or it holds no hexes.
   */
  export(format: HexFormat, options: CallOptions = {}): Promise<Uint8Array> {
    return this.origin.engine.run(async (desk) => {
      const input = await desk.input(this.origin.input);
      return desk.call('exportHexes', { input, mesh: this.#arrays(), format });
    }, options);
  }

  #arrays(): HexArraysMade {
    this.refuseDetached();
    const { nodes, hexes, level, parent, groupedFaces } = this;
    return { nodes, hexes, level, parent, groupedFaces };
  }
}

/** A conforming mesh of hexes that fill a solid. Each has a positive Jacobian, at its corners and inside. */
export class HexedSolid extends MadeHexes {
  /**
   * All boundary faces, two numbers for each: 6 times its hex and its number there (see `groupedFaces` of
   * {@link RefinedHexes}), and the surface of the solid that it stands for, by its place in `surfaces` of the plan. Files
   * have them as groups: `surface-1` for the first, and where the input has groups that all of a surface is in, those too (`report.solid.surfaceGroups`).
   */
  readonly groupedFaces: Uint32Array;
  /** The body of each hex, where the solid has several; else empty. Files have them as groups: `body-1` for the first. */
  readonly bodies: Uint32Array;
  /** What makes them hexes of the second order, if those were asked for. */
  readonly secondOrder: SecondOrder | null;
  /** What was done and what came of it, stage by stage. */
  readonly report: SolidReport;

  /** @internal */
  constructor(origin: Origin, data: HexedSolidData) {
    super(origin, data);
    this.groupedFaces = data.groupedFaces;
    this.bodies = data.bodies;
    const hex = data.secondOrder.length === 20 * (data.hexes.length / 8) ? 'hex20' : 'hex27';
    this.secondOrder = data.secondOrder.length > 0 ? { hex, nodes: data.middleNodes, hexes: data.secondOrder } : null;
    this.report = data.report;
  }

  /** What the mesh shows of the solid, and how near it is. */
  get result(): SolidResult {
    return this.report.result;
  }

  /** How far each hex is from the surface that was given, at its boundary faces, in model units; NaN for hexes without any. */
  distances(options: CallOptions = {}): Promise<Float32Array> {
    this.refuseDetached();
    const { nodes, hexes } = this;
    return this.origin.engine.run(async (desk) => {
      const input = await desk.input(this.origin.input);
      return desk.call('solidDistances', { input, mesh: { nodes, hexes } });
    }, options);
  }

  /**
   * The mesh as a file, with the solid's surfaces as groups of boundary faces.
   *
   * @throws {@link OptionsError} if there is no such format, or it holds no hexes, or none of the second order where they
   * are.
   */
  export(format: HexFormat, options: CallOptions = {}): Promise<Uint8Array> {
    this.refuseDetached();
    const { nodes, hexes, groupedFaces, bodies, secondOrder } = this;
    const { nodes: middleNodes, hexes: all } = secondOrder ?? { nodes: new Float64Array(), hexes: new Uint32Array() };
    const mesh: SolidArrays = { nodes, hexes, groupedFaces, bodies, middleNodes, secondOrder: all };
    const file = { format, surfaceGroups: this.report.solid.surfaceGroups };
    return this.origin.engine.run((desk) => desk.call('exportSolid', { mesh, file }), options);
  }
}
