/// <reference lib="esnext.disposable" preserve="true" />
import { Engine } from './engine.js';
import type { Desk, EngineSettings, SurfaceRecord } from './engine.js';
import { HexmillError, InputError, InternalError, OptionsError } from './errors.js';
import { refuseUnknown } from './known.js';
import { inputFormat, plainOptions } from './options.js';
import type {
  CallOptions,
  InputOptions,
  OutputFormat,
  QuadOptions,
  RefineOptions,
  SizeFunction,
  SurfaceInput,
} from './options.js';
import type { Platform, WasmFile } from './platform.js';
import type { QuadArrays, QuadData, SurfaceData, SurfaceSource } from './protocol.js';
import type { Estimate, MeshQuality, Metric, SurfaceInfo } from './results.js';

/** How the mesher is to run. */
export interface MesherOptions {
  /**
   * Threads of the pool, from 1 to {@link MOST_THREADS}; by default as many as the processor runs at once, at most 16,
   * beyond which the work gains nothing. More than one needs shared memory, in browsers a cross-origin isolated page;
   * elsewhere there is one thread.
   */
  threads?: number | undefined;
  /**
   * Where the WebAssembly module is, if it is not beside this package's files: the address of the file that is
   * used (`mesher.wasm` for one thread, `mesher-threads.wasm` for more), or a function that tells it.
   */
  wasmUrl?: string | URL | ((file: WasmFile) => string | URL) | undefined;
  /** Where the worker's script is, if it is not beside this package's files. */
  workerUrl?: string | URL | undefined;
}

/** The most threads that can be asked for. */
export const MOST_THREADS = 64;

/** Threads that are taken by default, at most. */
const USUAL_THREADS = 16;

/** An aborted estimate that cannot be asked to stop may go on for this long, in milliseconds: most end sooner by themselves. */
const ESTIMATE_GRACE = 1000;

/** Every option of a mesher by name: the compiler holds this to be complete. */
const MESHER_OPTIONS: Readonly<Record<keyof MesherOptions, true>> = { threads: true, wasmUrl: true, workerUrl: true };

/** Starts the workers of a mesher. */
export async function startMesher(platform: Platform, options: MesherOptions): Promise<Mesher> {
  refuseUnknown(options, Object.keys(MESHER_OPTIONS), 'option of a mesher');
  const threads = threadsFor(platform, options.threads);
  try {
    return await start(platform, options, threads);
  } catch (error) {
    // Some browsers refuse so much shared memory; who asked for threads is told.
    const fixed = options.threads !== undefined || typeof options.wasmUrl === 'string' || options.wasmUrl instanceof URL;
    if (threads === 1 || fixed) throw error;
    return start(platform, options, 1);
  }
}

async function start(platform: Platform, options: MesherOptions, threads: number): Promise<Mesher> {
  const file: WasmFile = threads > 1 ? 'mesher-threads.wasm' : 'mesher.wasm';
  const { wasmUrl, workerUrl } = options;
  const url = (typeof wasmUrl === 'function' ? wasmUrl(file) : wasmUrl) ?? platform.wasmUrl(file);
  const settings: EngineSettings = { platform, workerUrl, module: platform.resolve(url), pool: threads > 1 ? threads : 0 };
  // Threads that share memory stop when they are asked to.
  const engine = new Engine({ ...settings, reserve: settings.pool === 0 });
  try {
    await engine.start();
  } catch (error) {
    engine.terminate(new InternalError('not-started', 'The mesher could not be started.'));
    throw error;
  }
  const estimator = (): Engine =>
    new Engine({
      ...settings,
      module: engine.module ?? settings.module,
      pool: Math.min(settings.pool, 1),
      grace: ESTIMATE_GRACE,
    });
  return new Mesher(engine, threads, estimator);
}

function threadsFor(platform: Platform, wanted: number | undefined): number {
  if (wanted !== undefined && !(Number.isInteger(wanted) && wanted >= 1 && wanted <= MOST_THREADS)) {
    throw new OptionsError('threads-invalid', `threads is ${wanted}; give a whole number from 1 to ${MOST_THREADS}.`);
  }
  return platform.sharesMemory() ? (wanted ?? Math.min(platform.cores(), USUAL_THREADS)) : 1;
}

/**
 * Meshes surfaces in workers. Calls are done one after the other, in the order in which they were made; estimates
 * have a worker of their own, started with the first, so that they neither wait for a mesh nor hold it up.
 */
export class Mesher {
  /** Threads that compute. */
  readonly threads: number;
  readonly #engine: Engine;
  readonly #newEstimator: () => Engine;
  /** Estimates, and what does them once it has started. */
  #estimator: { engine: Engine; ready: Promise<Engine> } | null = null;
  /** Frees a surface in the workers when neither it nor a mesh made from it can be reached any more. */
  readonly #unreachable: FinalizationRegistry<number>;
  #surfaces = 0;

  /** @internal */
  constructor(engine: Engine, threads: number, newEstimator: () => Engine) {
    this.#engine = engine;
    this.#newEstimator = newEstimator;
    this.threads = threads;
    this.#unreachable = new FinalizationRegistry((surface) => this.#drop(surface));
  }

  /**
   * Loads a surface of polygons, from the text or bytes of a file or from arrays, which are copied.
   *
   * @throws {@link InputError} with the line at fault if it cannot be read.
   */
  async load(input: SurfaceInput, options: InputOptions & CallOptions = {}): Promise<Surface> {
    refuseUnknown(options, LOAD_OPTIONS, 'option');
    const record = await this.#newRecord(input, options);
    try {
      const data = await this.#engine.run((desk) => desk.load(record), options);
      this.#unreachable.register(record, record.id);
      return new Surface(this, record, data);
    } catch (error) {
      this.#drop(record.id);
      throw error;
    }
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
    const isLoaded = input instanceof Surface;
    const record = isLoaded ? input.record(this) : await this.#newRecord(input, { format, name });
    const engine = await this.#estimatingEngine();
    try {
      return await engine.run(
        async (desk) => desk.call('estimate', { surface: await desk.surface(record), options: plain }),
        { signal, onProgress },
      );
    } finally {
      if (!isLoaded) engine.drop(record.id);
    }
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
    const record = (own ?? (input as Surface)).record(this);
    try {
      const data = await this.#engine.run(
        async (desk) => {
          const surface = await desk.surface(record);
          if (sizeFunction) return refineBySize(desk, surface, plain, sizeFunction);
          return desk.call('refine', { surface, options: plain });
        },
        { signal, onProgress },
      );
      return new QuadMesh(this.#engine, record, data, own);
    } catch (error) {
      own?.dispose();
      throw error;
    }
  }

  /** Ends the workers. What is pending is rejected with a `HexmillError` of code `terminated`, as is what follows. */
  terminate(): void {
    const error = new HexmillError('terminated', 'The mesher was terminated.');
    this.#engine.terminate(error);
    this.#estimator?.engine.terminate(error);
  }

  /** The same as {@link Mesher.terminate}, for `using`. */
  [Symbol.dispose](): void {
    this.terminate();
  }

  /** @internal */
  free(record: SurfaceRecord): void {
    this.#drop(record.id);
  }

  #drop(surface: number): void {
    this.#engine.drop(surface);
    this.#estimator?.engine.drop(surface);
  }

  async #newRecord(input: SurfaceInput, options: InputOptions): Promise<SurfaceRecord> {
    return { id: ++this.#surfaces, source: await sourceOf(input, options) };
  }

  /** The worker of estimates; where no more workers can be had, the one of meshes. */
  #estimatingEngine(): Promise<Engine> {
    if (!this.#estimator && !this.#engine.ended) {
      const engine = this.#newEstimator();
      this.#estimator = { engine, ready: engine.start().then(() => engine, () => this.#engine) };
    }
    return this.#estimator?.ready ?? Promise.resolve(this.#engine);
  }
}

/** What can be said of a call beside what the mesh is to be like. */
const LOAD_OPTIONS: readonly (keyof (InputOptions & CallOptions))[] = ['format', 'name', 'signal', 'onProgress'];

/** A surface that a mesher has loaded. It is freed when it is disposed of or no longer used. */
export class Surface {
  /** What is known of it. */
  readonly info: SurfaceInfo;
  /** x, y, z of each node. */
  readonly nodes: Float64Array;
  /** Where each face's corners start in `corners`, and the end of the last. */
  readonly offsets: Uint32Array;
  /** The nodes of all faces, face after face. */
  readonly corners: Uint32Array;
  readonly #mesher: Mesher;
  readonly #record: SurfaceRecord;
  #disposed = false;

  /** @internal */
  constructor(mesher: Mesher, record: SurfaceRecord, data: SurfaceData) {
    this.#mesher = mesher;
    this.#record = record;
    this.info = data.info;
    this.nodes = data.nodes;
    this.offsets = data.offsets;
    this.corners = data.corners;
  }

  /** Frees its memory in the worker. Meshes made from it stay good. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#mesher.free(this.#record);
  }

  /** The same as {@link Surface.dispose}, for `using`. */
  [Symbol.dispose](): void {
    this.dispose();
  }

  /** @internal */
  record(mesher: Mesher): SurfaceRecord {
    if (this.#disposed) throw new InputError('surface-disposed', 'The surface was disposed of; load it again.');
    if (mesher !== this.#mesher) {
      throw new InputError('surface-of-another-mesher', 'The surface was loaded by another mesher; load it with this one.');
    }
    return this.#record;
  }
}

/** A conforming mesh of quads. */
export class QuadMesh {
  /** x, y, z of each node. */
  readonly nodes: Float64Array;
  /** The four nodes of each quad, in order around it. */
  readonly quads: Uint32Array;
  /** The refinement level of each quad. */
  readonly level: Uint8Array;
  /** The input face that each quad is part of. */
  readonly parent: Uint32Array;
  /** Elements that are larger than asked for, because `maxLevels` was reached. */
  readonly capped: number;
  /** A fingerprint of nodes and quads: the same for the same input and options on every platform. */
  readonly hash: string;
  /** How well shaped the quads are. */
  readonly quality: MeshQuality;
  /** What is wrong with the mesh, in words: empty for every mesh of a sound surface. */
  readonly defects: readonly string[];
  readonly #engine: Engine;
  readonly #surface: SurfaceRecord;
  /** The surface if it was loaded for this mesh alone. */
  readonly #own: Surface | null;

  /** @internal */
  constructor(engine: Engine, surface: SurfaceRecord, data: QuadData, own: Surface | null) {
    this.#engine = engine;
    this.#surface = surface;
    this.#own = own;
    this.nodes = data.nodes;
    this.quads = data.quads;
    this.level = data.level;
    this.parent = data.parent;
    this.capped = data.capped;
    this.hash = data.hash;
    this.quality = data.quality;
    this.defects = data.defects;
  }

  /** A measure of each quad, for colouring. */
  qualityOf(metric: Metric, options: CallOptions = {}): Promise<Float32Array> {
    return this.#engine.run((desk) => desk.call('quality', { mesh: this.#arrays(), metric }), options);
  }

  /**
   * The mesh as a file, with the tags that the surface's file gave to its faces.
   *
   * @throws {@link OptionsError} if there is no such format.
   */
  export(format: OutputFormat, options: CallOptions = {}): Promise<Uint8Array> {
    return this.#engine.run(async (desk) => {
      const surface = await desk.surface(this.#surface);
      return desk.call('export', { surface, mesh: this.#arrays(), format });
    }, options);
  }

  /** Frees what the worker keeps for it: a surface that was loaded for it alone. The mesh itself stays good. */
  dispose(): void {
    this.#own?.dispose();
  }

  /** The same as {@link QuadMesh.dispose}, for `using`. */
  [Symbol.dispose](): void {
    this.dispose();
  }

  #arrays(): QuadArrays {
    const { nodes, quads, level, parent } = this;
    if (nodes.length === 0) {
      throw new InputError('mesh-detached', 'The arrays of the mesh were transferred elsewhere; transfer copies.');
    }
    return { nodes, quads, level, parent };
  }
}

/** Refines a level at a time, asking `sizeFunction` before each. */
async function refineBySize(
  desk: Desk,
  surface: number,
  options: QuadOptions,
  sizeFunction: SizeFunction,
): Promise<QuadData> {
  let candidates = await desk.call('begin', { surface, options });
  for (;;) {
    const targets = await sizeFunction(candidates.centers, candidates.longest);
    const deeper = await desk.call('advance', { targets: Float64Array.from(targets) });
    if (!deeper) return desk.call('finish', {});
    candidates = deeper;
  }
}

/** A copy of the input that outlives workers, and that the caller's later changes do not reach. */
async function sourceOf(input: SurfaceInput, options: InputOptions): Promise<SurfaceSource> {
  if (typeof input === 'string') return { format: inputFormat(options), content: input };
  if (input instanceof Blob) {
    const name = options.name ?? ('name' in input ? String(input.name) : undefined);
    return { format: inputFormat({ ...options, name }), content: new Uint8Array(await input.arrayBuffer()) };
  }
  if (input instanceof ArrayBuffer) return { format: inputFormat(options), content: new Uint8Array(input.slice(0)) };
  if (input instanceof Uint8Array) return { format: inputFormat(options), content: Uint8Array.from(input) };
  if (input?.nodes instanceof Float64Array && input.corners instanceof Uint32Array) {
    return { nodes: input.nodes.slice(), offsets: input.offsets?.slice(), corners: input.corners.slice() };
  }
  throw new InputError(
    'input-unknown',
    'The input is neither text nor bytes nor { nodes: Float64Array, corners: Uint32Array }.',
  );
}
