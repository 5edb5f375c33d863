// A platform whose workers do what a test tells them to.

import type { Platform, WorkerEvents, WorkerHandle } from '../../www/lib/platform.js';
import { CONTROL } from '../../www/lib/protocol.js';
import type { Call, FromWorker, ToWorker } from '../../www/lib/protocol.js';

/** A worker that records what it is told and answers when the test says so. */
export class FakeWorker implements WorkerHandle {
  readonly received: ToWorker[] = [];
  /** What it shares with the calling thread where it has a pool. */
  readonly control = { memory: new WebAssembly.Memory({ initial: 1, maximum: 1, shared: true }), address: 0 };
  terminated = false;
  busy = true;
  readonly #events: WorkerEvents;

  constructor(events: WorkerEvents) {
    this.#events = events;
  }

  post(message: ToWorker): void {
    this.received.push(message);
    if (message.type === 'start') this.say({ type: 'started', module: EMPTY_MODULE, shared: message.pool > 0 ? this.control : null });
    if (message.type === 'join') this.say({ type: 'joined' });
  }

  terminate(): void {
    this.terminated = true;
  }

  setBusy(busy: boolean): void {
    this.busy = busy;
  }

  /** Sends a message to the calling thread, as a real worker does: later. */
  say(message: FromWorker): void {
    queueMicrotask(() => this.#events.onMessage(message));
  }

  /** Dies. */
  die(message: string): void {
    this.#events.onError(message);
  }

  /** Whether the call under way was asked to stop. */
  get isAsked(): boolean {
    return new Int32Array(this.control.memory.buffer)[CONTROL.cancelled] !== 0;
  }

  /** The inputs that it was told to free. */
  get dropped(): number[] {
    return this.received.flatMap((message) => (message.type === 'drop' ? [message.input] : []));
  }

  /** The calls received so far. */
  get calls(): (Call & { id: number })[] {
    return this.received.flatMap((message) => (message.type === 'call' ? [{ ...message.call, id: message.id }] : []));
  }

  /** Answers the last call. */
  answer(result: unknown): void {
    this.say({ type: 'done', id: this.calls.at(-1)?.id ?? 0, result });
  }
}

/** The smallest module there is. */
const EMPTY_MODULE = new WebAssembly.Module(new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]));

/** A platform and the workers that it has started. */
export function fakePlatform({ sharesMemory = false } = {}): { platform: Platform; workers: FakeWorker[] } {
  const workers: FakeWorker[] = [];
  const platform: Platform = {
    cores: () => 4,
    sharesMemory: () => sharesMemory,
    wasmUrl: (file) => new URL(`http://localhost/${file}`),
    resolve: (url) => String(url),
    spawn: (_, events) => {
      const worker = new FakeWorker(events);
      workers.push(worker);
      return worker;
    },
  };
  return { platform, workers };
}

/** Lets everything that is ready happen. */
export function settle(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 5));
}
