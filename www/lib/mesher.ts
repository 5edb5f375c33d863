/// <reference lib="esnext.disposable" preserve="true" />
import { Engine } from './engine.js';
import type { Desk, SurfaceRecord } from './engine.js';
import { HexmillError, InputError, InternalError, OptionsError } from './errors.js';
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
   * Threads of the pool; by default as many as the processor runs at once. More than one needs shared memory, in
   * browsers a cross-origin isolated page; elsewhere there is one thread.
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

/** Starts the workers of a mesher. */
export async function startMesher(platform: Platform, options: MesherOptions): Promise<Mesher> {
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
  const engine = new Engine({ platform, workerUrl, module: platform.resolve(url), threads });
  try {
    await engine.start();
  } catch (error) {
    engine.terminate(new InternalError('not-started', 'The mesher could not be started.'));
    throw error;
  }
  return new Mesher(engine, threads);
}

function threadsFor(platform: Platform, wanted: number | undefined): number {
  if (wanted !== undefined && !(Number.isInteger(wanted) && wanted >= 1)) {
    throw new OptionsError('threads-invalid', `threads is ${wanted}; give a whole number from 1.`);
  }
  return platform.sharesMemory() ? (wanted ?? platform.cores()) : 1;
}

/** Meshes surfaces in workers. Calls are done one after the other, in the order in which they were made. */
export class Mesher {
  /** Threads that compute. */
  readonly threads: number;
  readonly #engine: Engine;
  /** Frees a surface in the worker when neither it nor a mesh made from it can be reached any more. */
  readonly #unreachable: FinalizationRegistry<number>;
  #surfaces = 0;

  /** @internal */
  constructor(engine: Engine, threads: number) {
    this.#engine = engine;
    this.threads = threads;
    this.#unreachable = new FinalizationRegistry((surface) => engine.drop(surface));
  }

  /**
   * Loads a surface of polygons, from the text or bytes of a file or from arrays, which are copied.
   *
   * @throws {@link InputError} with the line at fault if it cannot be read.
   */
  async load(input: SurfaceInput, options: InputOptions & CallOptions = {}): Promise<Surface> {
    const record: SurfaceRecord = { id: ++this.#surfaces, source: await sourceOf(input, options) };
    const data = await this.#engine.run((desk) => desk.load(record), options);
    this.#unreachable.register(record, record.id);
    return new Surface(this, record, data);
  }

  /**
   * Tells how large a mesh will be, before the work.
   *
   * @throws {@link OptionsError}, {@link InputError} as `refineQuads` does.
   */
  async estimateQuads(
    input: Surface | SurfaceInput,
    options: QuadOptions & InputOptions & CallOptions = {},
  ): Promise<Estimate> {
    const { signal, onProgress, format, name, ...quadOptions } = options;
    const plain = plainOptions(quadOptions);
    const record = await this.#record(input, { format, name, signal });
    return this.#engine.run(
      async (desk) => desk.call('estimate', { surface: await desk.surface(record), options: plain }),
      { signal, onProgress },
    );
  }

  /**
   * Refines a surface to a conforming mesh of quads.
   *
   * @throws {@link InputError} if the surface cannot be refined, {@link OptionsError} if an option cannot be met,
   * {@link LimitError} if there would be more quads than `maxQuads`, {@link CancelledError} once `signal` is aborted.
   */
  async refineQuads(input: Surface | SurfaceInput, options: RefineOptions & InputOptions = {}): Promise<QuadMesh> {
    const { signal, onProgress, sizeFunction, format, name, ...quadOptions } = options;
    const plain = plainOptions(quadOptions);
    const record = await this.#record(input, { format, name, signal });
    const data = await this.#engine.run(
      async (desk) => {
        const surface = await desk.surface(record);
        if (sizeFunction) return refineBySize(desk, surface, plain, sizeFunction);
        return desk.call('refine', { surface, options: plain });
      },
      { signal, onProgress },
    );
    return new QuadMesh(this.#engine, record, data);
  }

  /** Ends the workers. What is pending is rejected with a `HexmillError` of code `terminated`, as is what follows. */
  terminate(): void {
    this.#engine.terminate(new HexmillError('terminated', 'The mesher was terminated.'));
  }

  /** The same as {@link Mesher.terminate}, for `using`. */
  [Symbol.dispose](): void {
    this.terminate();
  }

  /** @internal */
  free(record: SurfaceRecord): void {
    this.#engine.drop(record.id);
  }

  async #record(input: Surface | SurfaceInput, options: InputOptions & CallOptions): Promise<SurfaceRecord> {
    const surface = input instanceof Surface ? input : await this.load(input, options);
    return surface.record(this);
  }
}

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

  /** @internal */
  constructor(engine: Engine, surface: SurfaceRecord, data: QuadData) {
    this.#engine = engine;
    this.#surface = surface;
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
