// The workers that mesh together: one that takes the calls, and the threads of its pool.

import { InternalError, errorOf } from './errors.js';
import type { HexmillError } from './errors.js';
import type { Progress } from './options.js';
import type { ModuleName, Platform, WorkerHandle } from './platform.js';
import { CONTROL } from './protocol.js';
import type { Call, FromWorker, SharedControl } from './protocol.js';

/** What a team is made of. */
export interface TeamSettings {
  platform: Platform;
  workerUrl: string | URL | undefined;
  /** What the module does. */
  name: ModuleName;
  /** The module, or its address. */
  module: string | WebAssembly.Module;
  /** Threads of the pool; 0: no pool, and the module of one thread. */
  pool: number;
}

/** Shared memory is looked at this often for progress, in milliseconds. */
const POLL_INTERVAL = 100;

/** Steps of a stage's progress in the control block. */
const STEPS = 65535;

interface Pending {
  id: number;
  resolve(result: unknown): void;
  reject(error: HexmillError): void;
  onProgress: ((progress: Progress) => void) | undefined;
}

/** Workers that live and die together; one call at a time. */
export class Team {
  /** Numbers of the inputs that the worker has or is loading. */
  readonly inputs = new Set<number>();
  readonly #lead: WorkerHandle;
  readonly #helpers: WorkerHandle[] = [];
  #module: WebAssembly.Module | null = null;
  #control: Control | null = null;
  #pending: Pending | null = null;
  #answer: Promise<unknown> = Promise.resolve();
  #lastCall = 0;
  #death: HexmillError | null = null;
  #starting: { resolve(): void; reject(error: HexmillError): void } | null = null;
  #missing = 0;
  /** Fulfilled when the team can take calls. */
  readonly ready: Promise<void>;

  constructor(settings: TeamSettings) {
    this.ready = new Promise((resolve, reject) => {
      this.#starting = { resolve, reject };
    });
    const { name, module, pool } = settings;
    this.#lead = this.#spawn(settings);
    this.#lead.post({ type: 'start', name, module, pool });
  }

  /** The compiled module, once the team is ready. */
  get module(): WebAssembly.Module | null {
    return this.#module;
  }

  /** False once a worker has died or the team was dismissed. */
  get alive(): boolean {
    return this.#death === null;
  }

  /** True while a call is under way. */
  get busy(): boolean {
    return this.#pending !== null;
  }

  /** Makes a call. The team takes one at a time. */
  call(call: Call, onProgress?: (progress: Progress) => void): Promise<unknown> {
    if (this.#death) return Promise.reject(this.#death);
    const id = ++this.#lastCall;
    this.#control?.reset();
    const stopWatching = onProgress && this.#control ? this.#control.watch(onProgress) : () => {};
    this.#answer = new Promise((resolve, reject) => {
      this.#pending = { id, resolve, reject, onProgress };
      this.#lead.post({ type: 'call', id, call });
    }).finally(stopWatching);
    return this.#answer;
  }

  /** Frees an input. */
  drop(input: number): void {
    if (this.inputs.delete(input)) this.#lead.post({ type: 'drop', input });
  }

  /** Waits until no call is under way; false if one still is after `milliseconds`. */
  async idleWithin(milliseconds: number): Promise<boolean> {
    const answered = this.#answer.then(
      () => true,
      () => true,
    );
    let timer: ReturnType<typeof setTimeout> | undefined;
    const late = new Promise<false>((resolve) => {
      timer = setTimeout(resolve, milliseconds, false);
    });
    const idle = await Promise.race([answered, late]);
    clearTimeout(timer);
    return idle;
  }

  /** Asks the call under way to stop; false if it cannot be asked, for want of shared memory. */
  interrupt(): boolean {
    this.#control?.cancel();
    return this.#control !== null;
  }

  /** Says whether the workers have work, so that an idle mesher does not keep Node from exiting. */
  setBusy(busy: boolean): void {
    this.#lead.setBusy(busy);
  }

  /** Ends all workers at once; what is pending fails with `error`. */
  dismiss(error: HexmillError): void {
    if (this.#death) return;
    this.#death = error;
    for (const worker of [this.#lead, ...this.#helpers]) worker.terminate();
    this.#starting?.reject(error);
    this.#pending?.reject(error);
    this.#pending = null;
  }

  #spawn(settings: TeamSettings): WorkerHandle {
    return settings.platform.spawn(settings.workerUrl, {
      onMessage: (message) => this.#take(message, settings),
      onError: (message) => this.dismiss(new InternalError('worker-failed', `A worker failed: ${message}`)),
    });
  }

  #take(message: FromWorker, settings: TeamSettings): void {
    if (this.#death) return;
    switch (message.type) {
      case 'started':
        return this.#started(message.module, message.shared, settings);
      case 'joined':
        this.#missing -= 1;
        if (this.#missing === 0) this.#starting?.resolve();
        return;
      case 'progress':
        if (message.id === this.#pending?.id) {
          this.#pending.onProgress?.({ stage: message.stage, fraction: message.fraction });
        }
        return;
      case 'done':
        return this.#settle(message.id)?.resolve(message.result);
      case 'failed':
        return this.#settle(message.id)?.reject(errorOf(message.failure));
      case 'crashed':
        return this.dismiss(errorOf(message.failure));
    }
  }

  #started(module: WebAssembly.Module, shared: SharedControl | null, settings: TeamSettings): void {
    this.#module = module;
    if (!shared) {
      this.#starting?.resolve();
      return;
    }
    this.#control = new Control(shared);
    this.#missing = settings.pool;
    for (let thread = 0; thread < settings.pool; thread++) {
      const helper = this.#spawn(settings);
      this.#helpers.push(helper);
      helper.post({ type: 'join', name: settings.name, module, memory: shared.memory });
      helper.setBusy(false);
    }
  }

  #settle(id: number): Pending | null {
    const pending = this.#pending;
    if (pending?.id !== id) return null;
    this.#pending = null;
    return pending;
  }
}

/** The block of shared memory in which a computation tells its progress and is told to stop. */
class Control {
  readonly #words: Int32Array;
  readonly #memory: WebAssembly.Memory;

  constructor({ memory, address }: SharedControl) {
    this.#memory = memory;
    // Memory only grows: this view of its beginning stays good.
    this.#words = new Int32Array(memory.buffer, address, CONTROL.words);
  }

  /** Forgets the last call's progress and cancellation. */
  reset(): void {
    this.#words.fill(0);
  }

  cancel(): void {
    Atomics.store(this.#words, CONTROL.cancelled, 1);
  }

  /** Tells progress as it changes until the function that it returns is called. */
  watch(onProgress: (progress: Progress) => void): () => void {
    let last = '';
    const look = () => {
      const progress = this.#progress();
      const now = JSON.stringify(progress);
      if (progress === null || now === last) return;
      last = now;
      onProgress(progress);
    };
    const timer = setInterval(look, POLL_INTERVAL);
    return () => {
      clearInterval(timer);
      look();
    };
  }

  #progress(): Progress | null {
    const [name, lengthAndSteps] = this.#progressWords();
    if (lengthAndSteps === 0) return null;
    const length = lengthAndSteps & 0xffff;
    const steps = lengthAndSteps >>> 16;
    // Decoders refuse shared memory: copy first.
    const bytes = new Uint8Array(this.#memory.buffer, name, length).slice();
    return { stage: new TextDecoder().decode(bytes), fraction: steps / STEPS };
  }

  /** Both halves of the progress word, read at once. */
  #progressWords(): [number, number] {
    const words = new BigUint64Array(this.#memory.buffer, this.#words.byteOffset, 1);
    const word = Atomics.load(words, 0);
    return [Number(word & 0xffffffffn), Number(word >> 32n)];
  }
}
