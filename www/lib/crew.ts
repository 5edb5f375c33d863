// The workers of one module: those that mesh, and one for estimates alone.

import { Engine } from './engine.js';
import type { EngineSettings } from './engine.js';
import { InternalError } from './errors.js';
import type { HexmillError } from './errors.js';

/** An aborted estimate that cannot be asked to stop may go on for this long, in milliseconds: most end sooner by themselves. */
const ESTIMATE_GRACE = 1000;

/** The workers of one module. */
export class Crew {
  /** The workers that mesh. */
  readonly engine: Engine;
  readonly #settings: EngineSettings;
  /** The worker of estimates, and what does them once it has started. */
  #estimator: { engine: Engine; ready: Promise<Engine> } | null = null;

  private constructor(settings: EngineSettings) {
    this.#settings = settings;
    // Threads that share memory stop when they are asked to.
    this.engine = new Engine({ ...settings, reserve: settings.pool === 0 });
  }

  /**
   * Starts the workers that mesh.
   *
   * @throws {@link InternalError} if a worker or the module cannot be loaded.
   */
  static async start(settings: EngineSettings): Promise<Crew> {
    const crew = new Crew(settings);
    try {
      await crew.engine.start();
    } catch (error) {
      crew.terminate(new InternalError('not-started', 'The mesher could not be started.'));
      throw error;
    }
    return crew;
  }

  /** The worker of estimates, started with the first; where no more workers can be had, those that mesh. */
  estimator(): Promise<Engine> {
    if (!this.#estimator && !this.engine.ended) {
      const { module, pool } = this.#settings;
      const engine = new Engine({
        ...this.#settings,
        module: this.engine.module ?? module,
        pool: Math.min(pool, 1),
        grace: ESTIMATE_GRACE,
      });
      this.#estimator = { engine, ready: engine.start().then(() => engine, () => this.engine) };
    }
    return this.#estimator?.ready ?? Promise.resolve(this.engine);
  }

  /** Frees an input in all workers. */
  drop(input: number): void {
    this.engine.drop(input);
    this.#estimator?.engine.drop(input);
  }

  /** Ends the workers; everything pending fails with `error`, and everything that comes. */
  terminate(error: HexmillError): void {
    this.engine.terminate(error);
    this.#estimator?.engine.terminate(error);
  }
}
