// The calls as a worker answers them, over the bindings of src/web/.

import type * as single from '../wasm/mesher/mesher.js';
import type { QuadOptions } from './options.js';
import type { Call, CallName, Calls, Candidates, QuadArrays, QuadData, SurfaceData, SurfaceSource } from './protocol.js';

/** The bindings that both modules of the mesher have. */
export type Bindings = typeof single;

/** What a call gives and which of its buffers may move to the calling thread. */
interface Answer<Result> {
  result: Result;
  transfer: ArrayBufferLike[];
}

type Handlers = { [N in CallName]: (takes: Calls[N]['takes']) => Answer<Calls[N]['gives']> };

/** The surfaces of one worker and the refinement under way, if any. */
export class Meshing {
  readonly #bindings: Bindings;
  readonly #surfaces = new Map<number, single.Surface>();
  #refinement: single.Refinement | null = null;

  constructor(bindings: Bindings) {
    this.#bindings = bindings;
  }

  /** Answers a call; throws what the bindings throw. */
  answer(call: Call): Answer<unknown> {
    if (call.name !== 'advance' && call.name !== 'finish') this.#endRefinement();
    const handler = this.#handlers[call.name] as (takes: Call) => Answer<unknown>;
    return handler(call);
  }

  /** Frees a surface. */
  drop(surface: number): void {
    this.#surfaces.get(surface)?.free();
    this.#surfaces.delete(surface);
  }

  readonly #handlers: Handlers = {
    load: ({ surface, source }) => {
      this.drop(surface);
      const loaded = this.#load(source);
      this.#surfaces.set(surface, loaded);
      const result: SurfaceData = {
        info: loaded.info(),
        nodes: loaded.nodes(),
        offsets: loaded.offsets(),
        corners: loaded.corners(),
      };
      return { result, transfer: [result.nodes.buffer, result.offsets.buffer, result.corners.buffer] };
    },
    estimate: ({ surface, options }) => ({
      result: this.#bindings.estimateQuads(this.#surface(surface), options),
      transfer: [],
    }),
    refine: ({ surface, options }) => this.#quads(this.#bindings.refineQuads(this.#surface(surface), options)),
    begin: ({ surface, options }) => this.#candidates(this.#begin(surface, options)),
    advance: ({ targets }) => {
      const refinement = this.#underWay();
      return refinement.advance(targets) ? this.#candidates(refinement) : { result: null, transfer: [] };
    },
    finish: () => {
      const refinement = this.#underWay();
      this.#refinement = null;
      return this.#quads(refinement.finish());
    },
    export: ({ surface, mesh, format }) => {
      const { nodes, quads, level, parent } = mesh;
      const result = this.#bindings.exportQuads(this.#surface(surface), nodes, quads, level, parent, format);
      return { result, transfer: [result.buffer] };
    },
    quality: ({ mesh, metric }) => {
      const result = this.#bindings.quadQuality(mesh.nodes, mesh.quads, metric);
      return { result, transfer: [result.buffer] };
    },
  };

  #load(source: SurfaceSource): single.Surface {
    const { Surface } = this.#bindings;
    if ('content' in source) {
      const { content, format } = source;
      const bytes = typeof content === 'string' ? new TextEncoder().encode(content) : content;
      return Surface.read(bytes, format);
    }
    return Surface.fromArrays(source.nodes, source.offsets, source.corners);
  }

  #surface(surface: number): single.Surface {
    const loaded = this.#surfaces.get(surface);
    if (!loaded) throw new Error(`surface ${surface} is not loaded`);
    return loaded;
  }

  #begin(surface: number, options: QuadOptions): single.Refinement {
    this.#refinement = new this.#bindings.Refinement(this.#surface(surface), options);
    return this.#refinement;
  }

  #underWay(): single.Refinement {
    if (!this.#refinement) throw new Error('no refinement is under way');
    return this.#refinement;
  }

  #endRefinement(): void {
    this.#refinement?.free();
    this.#refinement = null;
  }

  #candidates(refinement: single.Refinement): Answer<Candidates> {
    const result = { centers: refinement.centers(), longest: refinement.longest() };
    return { result, transfer: [result.centers.buffer, result.longest.buffer] };
  }

  #quads(refined: single.Quads): Answer<QuadData> {
    try {
      const arrays: QuadArrays = {
        nodes: refined.nodes(),
        quads: refined.quads(),
        level: refined.level(),
        parent: refined.parent(),
      };
      const result: QuadData = {
        ...arrays,
        capped: refined.capped(),
        hash: refined.hash(),
        quality: refined.quality(),
        defects: refined.defects(),
      };
      return { result, transfer: Object.values(arrays).map((array: ArrayBufferView) => array.buffer) };
    } finally {
      refined.free();
    }
  }
}
