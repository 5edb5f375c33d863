// The workers of all modules, each started when it is first asked for.

import type { Crew } from './crew.js';
import { CancelledError } from './errors.js';
import type { HexmillError } from './errors.js';
import type { ModuleName } from './platform.js';

/** The workers of all modules. */
export class Crews {
  readonly #start: (name: ModuleName) => Promise<Crew>;
  readonly #started = new Map<ModuleName, Promise<Crew>>();
  readonly #ready: Crew[] = [];
  #end: HexmillError | null = null;

  constructor(start: (name: ModuleName) => Promise<Crew>) {
    this.#start = start;
  }

  /** The workers of a module, started by the first who asks. */
  async of(name: ModuleName, signal?: AbortSignal): Promise<Crew> {
    if (this.#end) throw this.#end;
    const crew = this.#started.get(name) ?? this.#startAnew(name);
    return unlessAborted(crew, signal);
  }

  /** Frees an input in all workers. */
  drop(input: number): void {
    for (const crew of this.#ready) crew.drop(input);
  }

  /** Ends the workers; everything pending fails with `error`, and everything that comes. */
  terminate(error: HexmillError): void {
    this.#end ??= error;
    for (const crew of this.#ready) crew.terminate(this.#end);
  }

  #startAnew(name: ModuleName): Promise<Crew> {
    const starting = this.#start(name);
    this.#started.set(name, starting);
    starting.then(
      (crew) => {
        this.#ready.push(crew);
        if (this.#end) crew.terminate(this.#end);
      },
      // Who asks again after a failure has it tried again.
      () => this.#started.delete(name),
    );
    return starting;
  }
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
