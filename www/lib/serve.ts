// A worker's side of the protocol, for browsers and for Node: see worker.ts and node-worker.ts.

import initHexesThreaded, * as hexesThreaded from '../wasm/hexes-threads/hexes-threads.js';
import initHexes, * as hexes from '../wasm/hexes/hexes.js';
import initMesherThreaded, * as mesherThreaded from '../wasm/mesher-threads/mesher-threads.js';
import initMesher, * as mesher from '../wasm/mesher/mesher.js';
import initSolidsThreaded, * as solidsThreaded from '../wasm/solids-threads/solids-threads.js';
import initSolids, * as solids from '../wasm/solids/solids.js';
import { failureOf } from './errors.js';
import type { Failure } from './errors.js';
import { Meshing } from './meshing.js';
import type { Bindings } from './meshing.js';
import type { ModuleName } from './platform.js';
import type { Call, FromWorker, SharedControl, ToWorker } from './protocol.js';

/** What a worker needs of the platform that it runs on. */
export interface Host {
  post(message: FromWorker, transfer: ArrayBufferLike[]): void;
  /** Loads and compiles the module at an address. */
  compile(url: string): Promise<WebAssembly.Module>;
}

const MODULES = {
  mesher: {
    single: { init: initMesher, bindings: mesher },
    threaded: { init: initMesherThreaded, bindings: mesherThreaded },
  },
  hexes: {
    single: { init: initHexes, bindings: hexes },
    threaded: { init: initHexesThreaded, bindings: hexesThreaded },
  },
  solids: {
    single: { init: initSolids, bindings: solids },
    threaded: { init: initSolidsThreaded, bindings: solidsThreaded },
  },
} as const;

/** Progress is told at most this often, in milliseconds: a page draws itself anew each time, on a core that could mesh. */
const PROGRESS_INTERVAL = 100;

/** What the module calls by name: see src/web/listener.rs. */
interface Listeners {
  panicked(message: string): void;
  progressed(stage: string, fraction: number): void;
}

/** Makes the function that takes the messages to this worker, one after the other. */
export function serve(host: Host): (message: ToWorker) => Promise<void> {
  const worker = new ServedWorker(host);
  return async (message) => {
    try {
      await worker.take(message);
    } catch (thrown) {
      host.post({ type: 'crashed', failure: worker.crashOf(thrown) }, []);
    }
  };
}

const OUT_OF_MEMORY: Failure = {
  kind: 'internal',
  code: 'out-of-memory',
  message: 'Memory ran out: ask for fewer cells, by a larger edge length or fewer levels. Nothing that was loaded is lost.',
};

/** Whether an instance died for want of memory: Rust then aborts without a panic, JavaScript refuses an array. */
function wantsMemory(thrown: unknown): boolean {
  if (thrown instanceof WebAssembly.RuntimeError) return /unreachable/i.test(thrown.message);
  return thrown instanceof RangeError && /alloc|memory|length|size/i.test(thrown.message) && !/stack/i.test(thrown.message);
}

/**
 * The bindings of all modules in one type: each is asked only for what it has. The classes of one thread and of a pool
 * differ in name alone, since both are made from the same Rust.
 */
function asBindings(bindings: object): Bindings {
  return bindings as Bindings;
}

class ServedWorker {
  readonly #host: Host;
  #meshing: Meshing | null = null;
  #panic: string | null = null;
  #call = 0;
  #told = { stage: '', time: 0 };

  constructor(host: Host) {
    this.#host = host;
    const listeners: Listeners = {
      panicked: (message) => (this.#panic = message),
      progressed: (stage, fraction) => this.#progressed(stage, fraction),
    };
    Object.assign(globalThis, { hexmillWorker: listeners });
  }

  async take(message: ToWorker): Promise<void> {
    switch (message.type) {
      case 'start':
        return this.#start(message.name, message.module, message.pool);
      case 'join':
        return this.#join(message.name, message.module, message.memory);
      case 'call':
        return this.#answer(message.id, message.call);
      case 'drop':
        return this.#meshing?.drop(message.input);
    }
  }

  /** The failure of a worker that is of no more use. */
  crashOf(thrown: unknown): Failure {
    if (this.#panic !== null) {
      return { kind: 'internal', code: 'panicked', message: `The mesher failed: ${this.#panic}` };
    }
    return wantsMemory(thrown) ? OUT_OF_MEMORY : failureOf(thrown);
  }

  async #start(name: ModuleName, source: string | WebAssembly.Module, pool: number): Promise<void> {
    const module = typeof source === 'string' ? await this.#compile(source) : source;
    const shared = pool > 0 ? await this.#startShared(name, module, pool) : await this.#startSingle(name, module);
    this.#host.post({ type: 'started', module, shared }, []);
  }

  async #compile(url: string): Promise<WebAssembly.Module> {
    try {
      return await this.#host.compile(url);
    } catch (thrown) {
      const why = failureOf(thrown).message;
      const message = `The mesher could not be loaded from ${url} (${why}): see the option wasmUrl.`;
      throw { kind: 'internal', code: 'module-not-loaded', message } satisfies Failure;
    }
  }

  async #startSingle(name: ModuleName, module: WebAssembly.Module): Promise<null> {
    const { init, bindings } = MODULES[name].single;
    await init({ module_or_path: module });
    bindings.reportPanics();
    this.#meshing = new Meshing(asBindings(bindings));
    return null;
  }

  async #startShared(name: ModuleName, module: WebAssembly.Module, pool: number): Promise<SharedControl> {
    const { init, bindings } = MODULES[name].threaded;
    const { memory } = await init({ module_or_path: module });
    bindings.reportPanics();
    bindings.preparePool(pool);
    this.#meshing = new Meshing(asBindings(bindings));
    return { memory, address: bindings.controlAddress() };
  }

  /** Becomes a thread of the pool: never returns, unless the thread dies. */
  async #join(name: ModuleName, module: WebAssembly.Module, memory: WebAssembly.Memory): Promise<void> {
    const { init, bindings } = MODULES[name].threaded;
    await init({ module_or_path: module, memory });
    bindings.reportPanics();
    this.#host.post({ type: 'joined' }, []);
    bindings.runPoolThread();
  }

  #answer(id: number, call: Call): void {
    if (!this.#meshing) throw new Error('the mesher has not been started');
    this.#call = id;
    this.#told = { stage: '', time: 0 };
    try {
      const { result, transfer } = this.#meshing.answer(call);
      this.#host.post({ type: 'done', id, result }, transfer);
    } catch (thrown) {
      if (thrown instanceof Error) throw thrown;
      this.#host.post({ type: 'failed', id, failure: failureOf(thrown) }, []);
    }
  }

  #progressed(stage: string, fraction: number): void {
    const now = performance.now();
    if (stage === this.#told.stage && fraction < 1 && now - this.#told.time < PROGRESS_INTERVAL) return;
    this.#told = { stage, time: now };
    this.#host.post({ type: 'progress', id: this.#call, stage, fraction }, []);
  }
}
