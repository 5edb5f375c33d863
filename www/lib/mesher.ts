/// <reference lib="esnext.disposable" preserve="true" />
import type { Crew } from './crew.js';
import type { Crews } from './crews.js';
import type { Desk, InputRecord } from './engine.js';
import { HexmillError, InputError } from './errors.js';
import { plainGrid, plainHexOptions } from './hex-options.js';
import type { GridOptions, RefineHexesOptions } from './hex-options.js';
import { refuseUnknown } from './known.js';
import { HexMesh, Surface } from './loaded.js';
import type { Held } from './loaded.js';
import { HexedSolid, QuadMesh, RefinedHexes } from './made.js';
import type { Origin } from './made.js';
import { plainOptions } from './options.js';
import type {
  Bounds,
  CallOptions,
  FileInput,
  HexInput,
  InputOptions,
  QuadOptions,
  RefineOptions,
  SizeFunction,
  SurfaceInput,
} from './options.js';
import type { Candidates, HexMeshData, Source, SurfaceData } from './protocol.js';
import type { Estimate, HexPlan } from './results.js';
import { plainSolidOptions } from './solid-options.js';
import type { MeshSolidOptions, PlanSolidOptions } from './solid-options.js';
import type { SolidPlan } from './solid-results.js';
import { hexSource, surfaceSource } from './source.js';

/**
 * Meshes surfaces, refines hexes and fills solids with hexes in workers. Calls are done one after the other, in the order
 * in which they were made. Surfaces, hexes and solids have workers of their own, those of hexes and of solids started when
 * they are first asked for; so have estimates and plans, which neither wait for a mesh nor hold it up.
 */
export class Mesher {
  /** Threads that compute. */
  readonly threads: number;
  readonly #crews: Crews;
  /** Frees an input in the workers when neither it nor a mesh made from it can be reached any more. */
  readonly #unreachable = new FinalizationRegistry<() => void>((free) => free());
  #inputs = 0;

  /** @internal */
  constructor(crews: Crews, threads: number) {
    this.#crews = crews;
    this.threads = threads;
  }

  /**
   * Loads a surface of polygons, from the text or bytes of a file or from arrays, which are copied.
   *
   * @throws {@link InputError} with the line at fault if it cannot be read, or if the file holds hexes (code
   * `surface-expected`).
   */
  async load(input: SurfaceInput, options: InputOptions & CallOptions = {}): Promise<Surface> {
    refuseUnknown(options, LOAD_OPTIONS, 'option');
    const source = await surfaceSource(input, options);
    const crew = await this.#crews.of('mesher', options.signal);
    return this.#load(crew, source, options, (held, data) => new Surface(held, data as SurfaceData));
  }

  /**
   * Loads a mesh of hexes, from the text or bytes of a file or from arrays, which are copied. Hexes that are numbered
   * inside out are turned. What else keeps the mesh from being refined is told in `info.defects` and `info.quality`.
   *
   * @throws {@link InputError} with the line at fault if it cannot be read, or if the file holds a surface (code
   * `hexes-expected`); {@link LimitError} if memory does not hold it.
   */
  async loadHexes(input: HexInput, options: InputOptions & CallOptions = {}): Promise<HexMesh> {
    refuseUnknown(options, LOAD_OPTIONS, 'option');
    return this.#loadHexes(await hexSource(input, options), options);
  }

  /**
   * Loads what a file holds, a surface or hexes.
   *
   * @throws {@link InputError} with the line at fault if it cannot be read, {@link LimitError} if memory does not hold
   * its hexes.
   */
  async loadFile(input: FileInput, options: InputOptions & CallOptions = {}): Promise<Surface | HexMesh> {
    try {
      return await this.load(input, options);
    } catch (error) {
      if (error instanceof InputError && error.code === 'surface-expected') return this.loadHexes(input, options);
      throw error;
    }
  }

  /**
   * Makes a grid of cubes around a mesh or a box, to be refined.
   *
   * @throws {@link OptionsError} if spacing or margin make no sense, {@link InputError} if there is nothing to make a
   * grid around, {@link LimitError} if there would be more hexes than `maxHexes` or than memory holds, or the spacing
   * is too small for the digits of the coordinates.
   */
  async makeGrid(
    around: Surface | HexMesh | Bounds | SurfaceInput,
    options: GridOptions & InputOptions & CallOptions,
  ): Promise<HexMesh> {
    const { signal, onProgress, format, name, ...gridOptions } = options;
    const plain = plainGrid(gridOptions, LOAD_OPTIONS);
    const { min, max } = await this.#boundsOf(around, { format, name, signal });
    return this.#loadHexes({ want: 'hexes', from: { ...plain, min, max } }, { signal, onProgress });
  }

  /**
   * Tells how large a mesh will be, before the work and beside it: in a worker of its own, on one thread, with a copy
   * of the surface.
   *
   * @throws {@link OptionsError}, {@link InputError} as `refineQuads` does.
   */
  async estimateQuads(
    input: Surface | SurfaceInput,
    options: QuadOptions & InputOptions & CallOptions = {},
  ): Promise<Estimate> {
    const { signal, onProgress, format, name, ...quadOptions } = options;
    const plain = plainOptions(quadOptions, LOAD_OPTIONS);
    const source = input instanceof Surface ? input : await surfaceSource(input, { format, name });
    const work = (desk: Desk, id: number) => desk.call('estimate', { input: id, options: plain });
    return this.#foretell(await this.#crews.of('mesher', signal), source, work, { signal, onProgress });
  }

  /**
   * Tells what refinement of hexes will do, before the work and beside it, as {@link Mesher.estimateQuads}: how many
   * elements are refined, and which of them because the method asks for it.
   *
   * @throws {@link OptionsError}, {@link InputError}, {@link LimitError} as `refineHexes` does.
   */
  async planHexes(input: HexMesh | HexInput, options: RefineHexesOptions & InputOptions = {}): Promise<HexPlan> {
    const { signal, onProgress, sizeFunction, format, name, ...hexOptions } = options;
    const plain = plainHexOptions(hexOptions, [...LOAD_OPTIONS, 'sizeFunction']);
    const source = input instanceof HexMesh ? input : await hexSource(input, { format, name });
    const work = async (desk: Desk, id: number) => {
      if (!sizeFunction) return desk.call('planHexes', { input: id, options: plain });
      await chooseSizes(desk, await desk.call('beginHexes', { input: id, options: plain }), sizeFunction);
      return desk.call('planBegunHexes', {});
    };
    return this.#foretell(await this.#crews.of('hexes', signal), source, work, { signal, onProgress });
  }

  /**
   * Tells of the solid in a closed surface, before the work and beside it, as {@link Mesher.estimateQuads}: its corners,
   * curves and surfaces, what had to be mended, and about how many hexes will fill it.
   *
   * @throws {@link InputError} if the surface bounds no solid, with the place; {@link OptionsError} if an option cannot be
   * met.
   */
  async planSolid(input: Surface | SurfaceInput, options: PlanSolidOptions & InputOptions = {}): Promise<SolidPlan> {
    const { signal, onProgress, format, name, ...solidOptions } = options;
    const plain = plainSolidOptions(solidOptions, LOAD_OPTIONS);
    const source = input instanceof Surface ? input : await surfaceSource(input, { format, name });
    const work = (desk: Desk, id: number) => desk.call('planSolid', { input: id, options: plain });
    return this.#foretell(await this.#crews.of('solids', signal), source, work, { signal, onProgress });
  }

  /**
   * Refines a surface to a conforming mesh of quads.
   *
   * @throws {@link InputError} if the surface cannot be refined, {@link OptionsError} if an option cannot be met,
   * {@link LimitError} if there would be more quads than `maxQuads` or than memory holds, {@link CancelledError} once
   * `signal` is aborted.
   */
  async refineQuads(input: Surface | SurfaceInput, options: RefineOptions & InputOptions = {}): Promise<QuadMesh> {
    const { signal, onProgress, sizeFunction, format, name, ...quadOptions } = options;
    const plain = plainOptions(quadOptions, [...LOAD_OPTIONS, 'sizeFunction']);
    const own = input instanceof Surface ? null : await this.load(input, { format, name, signal });
    const surface = own ?? (input as Surface);
    const work = async (desk: Desk, id: number) => {
      if (!sizeFunction) return desk.call('refine', { input: id, options: plain });
      await chooseSizes(desk, await desk.call('begin', { input: id, options: plain }), sizeFunction);
      return desk.call('finish', {});
    };
    return this.#make(await this.#crews.of('mesher', signal), surface.record(this), own, work, QuadMesh, { signal, onProgress });
  }

  /**
   * Refines a mesh of hexes to a conforming mesh of hexes, without hanging nodes and without inverted hexes.
   *
   * @throws {@link InputError} if the mesh cannot be refined, {@link OptionsError} if an option cannot be met,
   * {@link LimitError} if there would be more hexes than `maxHexes` or than memory holds, {@link CancelledError} once
   * `signal` is aborted.
   */
  async refineHexes(input: HexMesh | HexInput, options: RefineHexesOptions & InputOptions = {}): Promise<RefinedHexes> {
    const { signal, onProgress, sizeFunction, format, name, ...hexOptions } = options;
    const plain = plainHexOptions(hexOptions, [...LOAD_OPTIONS, 'sizeFunction']);
    const own = input instanceof HexMesh ? null : await this.loadHexes(input, { format, name, signal });
    const mesh = own ?? (input as HexMesh);
    const work = async (desk: Desk, id: number) => {
      if (!sizeFunction) return desk.call('refineHexes', { input: id, options: plain });
      await chooseSizes(desk, await desk.call('beginHexes', { input: id, options: plain }), sizeFunction);
      return desk.call('finishHexes', {});
    };
    return this.#make(await this.#crews.of('hexes', signal), mesh.record(this), own, work, RefinedHexes, { signal, onProgress });
  }

  /**
   * Fills the solid in a closed surface with hexes: a conforming mesh whose boundary keeps the solid's corners, curves and
   * surfaces, without inverted hexes. What of the solid the mesh does not show is told in its `report`.
   *
   * @throws {@link InputError} if the surface bounds no solid, with the place, {@link OptionsError} if an option cannot be
   * met, {@link LimitError} if there would be more hexes than `maxHexes` or than memory holds, {@link CancelledError} once
   * `signal` is aborted.
   */
  async meshSolid(input: Surface | SurfaceInput, options: MeshSolidOptions & InputOptions): Promise<HexedSolid> {
    const { signal, onProgress, format, name, ...solidOptions } = options;
    const plain = plainSolidOptions(solidOptions, LOAD_OPTIONS);
    const { record, own } = input instanceof Surface ? { record: input.record(this), own: null } : this.#keep(await surfaceSource(input, { format, name }));
    const work = (desk: Desk, id: number) => desk.call('meshSolid', { input: id, options: plain });
    return this.#make(await this.#crews.of('solids', signal), record, own, work, HexedSolid, { signal, onProgress });
  }

  /** Ends the workers. What is pending is rejected with a `HexmillError` of code `terminated`, as is what follows. */
  terminate(): void {
    this.#crews.terminate(new HexmillError('terminated', 'The mesher was terminated.'));
  }

  /** The same as {@link Mesher.terminate}, for `using`. */
  [Symbol.dispose](): void {
    this.terminate();
  }

  async #loadHexes(source: Source, options: CallOptions): Promise<HexMesh> {
    const crew = await this.#crews.of('hexes', options.signal);
    return this.#load(crew, source, options, (held, data) => new HexMesh(held, data as HexMeshData));
  }

  /** Loads an input; `handleOf` makes what the caller holds of it, from the data that its kind of source gives. */
  async #load<L extends Surface | HexMesh>(
    crew: Crew,
    source: Source,
    { signal, onProgress }: CallOptions,
    handleOf: (held: Held, data: SurfaceData | HexMeshData) => L,
  ): Promise<L> {
    const { record, own } = this.#keep(source);
    try {
      const data = await crew.engine.run((desk) => desk.load(record), { signal, onProgress });
      return handleOf({ mesher: this, record, free: own.dispose }, data);
    } catch (error) {
      own.dispose();
      throw error;
    }
  }

  /** Numbers a source, and frees in the workers what they load of it when it is disposed of or unreachable. */
  #keep(source: Source): { record: InputRecord; own: { dispose(): void } } {
    const record = { id: ++this.#inputs, source };
    const dispose = freeing(this.#crews, record.id);
    this.#unreachable.register(record, dispose);
    return { record, own: { dispose } };
  }

  /** Does `work` in the worker of estimates. */
  async #foretell<T>(
    crew: Crew,
    input: Surface | HexMesh | Source,
    work: (desk: Desk, input: number) => Promise<T>,
    options: CallOptions,
  ): Promise<T> {
    const isLoaded = input instanceof Surface || input instanceof HexMesh;
    const record = isLoaded ? input.record(this) : { id: ++this.#inputs, source: input };
    const engine = await crew.estimator();
    try {
      return await engine.run(async (desk) => work(desk, await desk.input(record)), options);
    } finally {
      if (!isLoaded) engine.drop(record.id);
    }
  }

  /** Does `work` on an input; `own` is that too if it is there for this work alone. */
  async #make<D, M>(
    { engine }: Crew,
    input: InputRecord,
    own: Origin['own'],
    work: (desk: Desk, input: number) => Promise<D>,
    Result: new (origin: Origin, data: D) => M,
    options: CallOptions,
  ): Promise<M> {
    try {
      const data = await engine.run(async (desk) => work(desk, await desk.input(input)), options);
      return new Result({ engine, input, own }, data);
    } catch (error) {
      own?.dispose();
      throw error;
    }
  }

  async #boundsOf(around: Surface | HexMesh | Bounds | SurfaceInput, options: InputOptions & CallOptions): Promise<Bounds> {
    if (around instanceof Surface || around instanceof HexMesh) {
      // Refuses what was disposed of.
      around.record(this);
      return around.info.bounds;
    }
    if (typeof around === 'object' && around !== null && 'min' in around) return around;
    const surface = await this.load(around, options);
    surface.dispose();
    return surface.info.bounds;
  }
}

/** What can be said of a call beside what the mesh is to be like. */
const LOAD_OPTIONS: readonly (keyof (InputOptions & CallOptions))[] = ['format', 'name', 'signal', 'onProgress'];

/** Frees an input. Made apart from its record, which would never be unreachable if this closure had it in scope. */
function freeing(crews: Crews, input: number): () => void {
  return () => crews.drop(input);
}

/** Refines a level at a time, asking `sizeFunction` before each, until it asks for nothing more. */
async function chooseSizes(desk: Desk, first: Candidates, sizeFunction: SizeFunction): Promise<void> {
  for (let candidates: Candidates | null = first; candidates; ) {
    const targets = await sizeFunction(candidates.centers, candidates.longest);
    candidates = await desk.call('advance', { targets: Float64Array.from(targets) });
  }
}
