// The queue in front of the workers: one task at a time, cancelled at once, on fresh workers where they died.

import { CancelledError, HexmillError } from './errors.js';
import type { CallOptions, Progress } from './options.js';
import type { CallName, Calls, Source } from './protocol.js';
import { Team } from './team.js';
import type { TeamSettings } from './team.js';

/** How long a cancelled call may take to stop before its workers are discarded, in milliseconds. */
const GRACE = {
  /** Where it has been asked to. */
  asked: 60,
  /** Where it cannot be asked, and only may happen to end. */
  unasked: 20,
};

/** A task that takes longer has fresh workers started in reserve, in milliseconds. */
const RESERVE_DELAY = 50;

/** A surface or hex mesh as the calling thread keeps it. */
export interface InputRecord {
  readonly id: number;
  readonly source: Source;
}

/** What a task does its work with. */
export interface Desk {
  call<N extends CallName>(name: N, takes: Calls[N]['takes']): Promise<Calls[N]['gives']>;
  /** The number of an input, which is loaded anew if the workers were replaced. */
  input(record: InputRecord): Promise<number>;
  /** Loads an input that the workers have not seen. */
  load(record: InputRecord): Promise<Calls['load']['gives']>;
}

interface Job {
  /** Does the work; never rejects. */
  run(): Promise<void>;
  /** Rejects the caller, wherever the work stands. */
  fail(error: HexmillError): void;
}

/** What an engine is made of. */
export interface EngineSettings extends TeamSettings {
  /** Overrules how long a cancelled call that cannot be asked to stop is waited for. */
  grace?: number;
  /** Has fresh workers started while a call takes its time, so that discarding those at work costs no start. */
  reserve?: boolean;
}

/** Runs tasks on a team of workers. */
export class Engine {
  readonly #settings: EngineSettings;
  readonly #waiting: Job[] = [];
  #team: Team;
  #reserve: Team | null = null;
  #active: Job | null = null;
  #end: HexmillError | null = null;

  constructor(settings: EngineSettings) {
    this.#settings = { ...settings };
    this.#team = this.#newTeam();
  }

  /** The compiled module, once it is there. */
  get module(): WebAssembly.Module | null {
    return this.#team?.module ?? null;
  }

  /** True once it was terminated. */
  get ended(): boolean {
    return this.#end !== null;
  }

  /** Waits until the first workers can work. */
  async start(): Promise<void> {
    await this.#team.ready;
    this.#rest();
  }

  /** Runs `task` when all tasks before it are done. */
  run<T>(task: (desk: Desk) => Promise<T>, { signal, onProgress }: CallOptions = {}): Promise<T> {
    if (this.#end) return Promise.reject(this.#end);
    if (signal?.aborted) return Promise.reject(new CancelledError());
    return new Promise<T>((resolve, reject) => {
      const stop = new AbortController();
      const abort = () => job.fail(new CancelledError());
      const untilStopped = (progress: Progress) => {
        if (!stop.signal.aborted) onProgress?.(progress);
      };
      const settle = () => signal?.removeEventListener('abort', abort);
      const job: Job = {
        run: async () => {
          try {
            resolve(await task(this.#desk(stop.signal, untilStopped)));
          } catch (error) {
            reject(error);
          } finally {
            settle();
          }
        },
        fail: (error) => {
          settle();
          reject(error);
          stop.abort(error);
          this.#withdraw(job);
        },
      };
      signal?.addEventListener('abort', abort);
      this.#waiting.push(job);
      void this.#next();
    });
  }

  /** Frees an input. */
  drop(input: number): void {
    this.#team.drop(input);
  }

  /** Ends the workers; everything pending fails with `error`, and everything that comes. */
  terminate(error: HexmillError): void {
    if (this.#end) return;
    this.#end = error;
    this.#team.dismiss(error);
    this.#reserve?.dismiss(error);
    for (const job of [...(this.#active ? [this.#active] : []), ...this.#waiting.splice(0)]) job.fail(error);
  }

  #newTeam(): Team {
    this.#settings.module = this.module ?? this.#settings.module;
    const team = new Team(this.#settings);
    // Whoever awaits the team hears of it; nobody may be awaiting it.
    team.ready.catch(() => {});
    return team;
  }

  /** Runs the next task, if none is running. */
  async #next(): Promise<void> {
    const job = this.#active ? undefined : this.#waiting.shift();
    if (!job) return;
    this.#active = job;
    this.#team.setBusy(true);
    if (this.#settings.reserve) setTimeout(() => this.#startReserve(job), RESERVE_DELAY);
    await job.run();
    this.#release(job);
  }

  #startReserve(job: Job): void {
    if (this.#active !== job || this.#reserve?.alive) return;
    this.#reserve = this.#newTeam();
    this.#reserve.setBusy(false);
  }

  #release(job: Job): void {
    if (this.#active !== job) return;
    this.#active = null;
    this.#rest();
    void this.#next();
  }

  #rest(): void {
    if (!this.#active && this.#waiting.length === 0) this.#team.setBusy(false);
  }

  /** Takes back a task whose caller has been told that it failed. */
  #withdraw(job: Job): void {
    const place = this.#waiting.indexOf(job);
    if (place >= 0) this.#waiting.splice(place, 1);
    if (this.#active === job) void this.#stopWork(job);
  }

  /** Lets the call under way stop by itself for a moment, then replaces the workers. */
  async #stopWork(job: Job): Promise<void> {
    const team = this.#team;
    const grace = team.interrupt() ? GRACE.asked : (this.#settings.grace ?? GRACE.unasked);
    if (team.busy && !(await team.idleWithin(grace))) this.#replace(new CancelledError());
    this.#release(job);
  }

  #replace(error: HexmillError): void {
    this.#team.dismiss(error);
    if (this.#end) return;
    this.#team = this.#reserve?.alive ? this.#reserve : this.#newTeam();
    this.#reserve = null;
  }

  /** The workers, fresh ones if the last have died. */
  async #readyTeam(): Promise<Team> {
    if (!this.#team.alive) this.#replace(new CancelledError());
    const team = this.#team;
    team.setBusy(true);
    await team.ready;
    return team;
  }

  #desk(stop: AbortSignal, onProgress: (progress: Progress) => void): Desk {
    const call: Desk['call'] = async (name, takes) => {
      const team = await this.#readyTeam();
      stop.throwIfAborted();
      return team.call({ name, ...takes } as Parameters<Team['call']>[0], onProgress) as Promise<never>;
    };
    const load = async <N extends 'load' | 'reload'>(name: N, { id, source }: InputRecord) => {
      const team = await this.#readyTeam();
      stop.throwIfAborted();
      // Before the answer: an input that nobody waits for any more is there to be dropped all the same.
      team.inputs.add(id);
      try {
        return await call(name, { input: id, source });
      } catch (error) {
        team.inputs.delete(id);
        throw error;
      }
    };
    return {
      call,
      load: (record) => load('load', record),
      input: async (record) => {
        const team = await this.#readyTeam();
        if (!team.inputs.has(record.id)) await load('reload', record);
        return record.id;
      },
    };
  }
}
