// What a mesher has loaded: the inputs of refinement.

import type { InputRecord } from './engine.js';
import { InputError } from './errors.js';
import type { HexMeshData, SurfaceData } from './protocol.js';
import type { HexInfo, SurfaceInfo } from './results.js';

/** What is held of an input in a mesher's workers. */
export interface Held {
  mesher: object;
  record: InputRecord;
  /** Frees it in the workers. */
  free(): void;
}

/** A mesh that a mesher has loaded. It is freed when it is disposed of or no longer used. */
abstract class Loaded {
  readonly #held: Held;
  #disposed = false;

  /** @internal */
  constructor(held: Held) {
    this.#held = held;
  }

  /** Frees its memory in the worker. Meshes made from it stay good. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#held.free();
  }

  /** The same as `dispose`, for `using`. */
  [Symbol.dispose](): void {
    this.dispose();
  }

  /** @internal */
  record(mesher: object): InputRecord {
    const what = this instanceof Surface ? 'surface' : 'mesh';
    if (this.#disposed) throw new InputError(`${what}-disposed`, `The ${what} was disposed of; load it again.`);
    if (mesher !== this.#held.mesher) {
      throw new InputError(`${what}-of-another-mesher`, `The ${what} was loaded by another mesher; load it with this one.`);
    }
    return this.#held.record;
  }
}

/** A surface that a mesher has loaded. It is freed when it is disposed of or no longer used. */
export class Surface extends Loaded {
  /** What is known of it. */
  readonly info: SurfaceInfo;
  /** x, y, z of each node. */
  readonly nodes: Float64Array;
  /** Where each face's corners start in `corners`, and the end of the last. */
  readonly offsets: Uint32Array;
  /** The nodes of all faces, face after face. */
  readonly corners: Uint32Array;

  /** @internal */
  constructor(held: Held, data: SurfaceData) {
    super(held);
    this.info = data.info;
    this.nodes = data.nodes;
    this.offsets = data.offsets;
    this.corners = data.corners;
  }
}

/** A mesh of hexes that a mesher has loaded or made. It is freed when it is disposed of or no longer used. */
export class HexMesh extends Loaded {
  /** What is known of it. */
  readonly info: HexInfo;
  /** x, y, z of each node. */
  readonly nodes: Float64Array;
  /**
   * The eight nodes of each hex in the order of VTK_HEXAHEDRON: around one face, seen from inside the hex clockwise,
   * then the nodes opposite these. Hexes that were numbered inside out have been turned.
   */
  readonly hexes: Uint32Array;

  /** @internal */
  constructor(held: Held, data: HexMeshData) {
    super(held);
    this.info = data.info;
    this.nodes = data.nodes;
    this.hexes = data.hexes;
  }
}
