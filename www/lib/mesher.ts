/// <reference lib="esnext.disposable" preserve="true" />
import type { Crew } from './crew.js';
import type { Desk, Engine, InputRecord } from './engine.js';
import { CancelledError, HexmillError, InputError } from './errors.js';
import { plainGrid, plainHexOptions } from './hex-options.js';
import type { GridOptions, HexOptions, RefineHexesOptions } from './hex-options.js';
import { refuseUnknown } from './known.js';
import { HexMesh, Surface } from './loaded.js';
import type { Held } from './loaded.js';
import { QuadMesh, RefinedHexes } from './made.js';
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
import { hexSource, surfaceSource } from './source.js';

/**
 * Meshes surfaces and refines hexes in workers. Calls are done one after the other, in the order in which they were
 * made. Surfaces and hexes have workers of their own, those of hexes started when they are first asked for; so have
 * estimates and plans, which neither wait for a mesh nor hold it up.
 */
export class Mesher {
  /** Threads that compute. */
  readonly threads: number;
  readonly #surfaces: Crew;
  readonly #startHexes: () => Promise<Crew>;
  #hexes: Promise<Crew> | null = null;
  #end: HexmillError | null = null;
  /** Frees an input in the workers when neither it nor a mesh made from it can be reached any more. */
  readonly #unreachable = new FinalizationRegistry<() => void>((free) => free());
  #inputs = 0;

  /** @internal */
  constructor(surfaces: Crew, threads: number, startHexes: () => Promise<Crew>) {
    this.#surfaces = surfaces;
    this.#startHexes = startHexes;
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
    return this.#load(this.#surfaces, source, options, (held, data) => new Surface(held, data as SurfaceData));
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
    return this.#foretell(this.#surfaces, source, work, { signal, onProgress });
  }

  /**
   * Tells what refinement of hexes will do, before the work and beside it, as {@link Mesher.estimateQuads}: how many
   * elements are refined, and which of them because the method asks for it.
   *
   * @throws {@link OptionsError}, {@link InputError}, {@link LimitError} as `refineHexes` does.
   */
  async planHexes(input: HexMesh | HexInput, options: HexOptions & InputOptions & CallOptions = {}): Promise<HexPlan> {
    const { signal, onProgress, format, name, ...hexOptions } = options;
    const plain = plainHexOptions(hexOptions, LOAD_OPTIONS);
    const source = input instanceof HexMesh ? input : await hexSource(input, { format, name });
    const work = (desk: Desk, id: number) => desk.call('planHexes', { input: id, options: plain });
    return this.#foretell(await this.#hexCrew(signal), source, work, { signal, onProgress });
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
    return this.#refine(this.#surfaces, surface, own, work, QuadMesh, { signal, onProgress });
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
    return this.#refine(await this.#hexCrew(signal), mesh, own, work, RefinedHexes, { signal, onProgress });
  }

  /** Ends the workers. What is pending is rejected with a `HexmillError` of code `terminated`, as is what follows. */
  terminate(): void {
    this.#end ??= new HexmillError('terminated', 'The mesher was terminated.');
    this.#surfaces.terminate(this.#end);
    const end = this.#end;
    this.#hexes?.then((crew) => crew.terminate(end), () => {});
  }

  /** The same as {@link Mesher.terminate}, for `using`. */
  [Symbol.dispose](): void {
    this.terminate();
  }

  /** The workers of hexes, started by the first who asks. */
  async #hexCrew(signal?: AbortSignal): Promise<Crew> {
    if (this.#end) throw this.#end;
    this.#hexes ??= this.#startHexes().catch((error) => {
      this.#hexes = null;
      throw error;
    });
    return unlessAborted(this.#hexes, signal);
  }

  async #loadHexes(source: Source, options: CallOptions): Promise<HexMesh> {
    const crew = await this.#hexCrew(options.signal);
    return this.#load(crew, source, options, (held, data) => new HexMesh(held, data as HexMeshData));
  }

  /** Loads an input; `handleOf` makes what the caller holds of it, from the data that its kind of source gives. */
  async #load<L extends Surface | HexMesh>(
    crew: Crew,
    source: Source,
    { signal, onProgress }: CallOptions,
    handleOf: (held: Held, data: SurfaceData | HexMeshData) => L,
  ): Promise<L> {
    const record = { id: ++this.#inputs, source };
    const free = freeing(crew, record.id);
    try {
      const data = await crew.engine.run((desk) => desk.load(record), { signal, onProgress });
      this.#unreachable.register(record, free);
      return handleOf({ mesher: this, record, free }, data);
    } catch (error) {
      free();
      throw error;
    }
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

  /** Does `work` on what was loaded; `own` is that too if it was loaded for this work alone. */
  async #refine<D, M>(
    { engine }: Crew,
    loaded: Surface | HexMesh,
    own: Surface | HexMesh | null,
    work: (desk: Desk, input: number) => Promise<D>,
    Result: new (origin: { engine: Engine; input: InputRecord; own: Surface | HexMesh | null }, data: D) => M,
    options: CallOptions,
  ): Promise<M> {
    const input = loaded.record(this);
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
function freeing(crew: Crew, input: number): () => void {
  return () => crew.drop(input);
}

/** What `promise` gives, unless the signal is aborted before. */
function unlessAborted<T>(promise: Promise<T>, signal: AbortSignal | undefined): Promise<T> {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const abort = () => reject(new CancelledError());
    if (signal.aborted) abort();
    signal.addEventListener('abort', abort, { once: true });
    promise.then(resolve, reject).finally(() => signal.removeEventListener('abort', abort));
  });
}

/** Refines a level at a time, asking `sizeFunction` before each, until it asks for nothing more. */
async function chooseSizes(desk: Desk, first: Candidates, sizeFunction: SizeFunction): Promise<void> {
  for (let candidates: Candidates | null = first; candidates; ) {
    const targets = await sizeFunction(candidates.centers, candidates.longest);
    candidates = await desk.call('advance', { targets: Float64Array.from(targets) });
  }
}
