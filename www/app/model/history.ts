/** Undo and redo over snapshots of an immutable value. */

/** Edits with the same key that follow within this many milliseconds are one step. */
const MERGE_WITHIN = 800;
/** Steps kept. */
const DEPTH = 200;

export class History<T> {
  #past: T[] = [];
  #future: T[] = [];
  #key: string | null = null;
  #time = Number.NEGATIVE_INFINITY;

  get canUndo(): boolean {
    return this.#past.length > 0;
  }

  get canRedo(): boolean {
    return this.#future.length > 0;
  }

  /** Remembers `before`, the value that an edit named `key` is about to replace. */
  record(before: T, key: string, now = performance.now()): void {
    const merges = key === this.#key && now - this.#time < MERGE_WITHIN;
    this.#key = key;
    this.#time = now;
    if (merges) return;
    this.#past.push(before);
    if (this.#past.length > DEPTH) this.#past.shift();
    this.#future = [];
  }

  /** The next edit starts a step of its own, whatever its key. */
  seal(): void {
    this.#key = null;
  }

  undo(current: T): T {
    return this.#step(current, this.#past, this.#future);
  }

  redo(current: T): T {
    return this.#step(current, this.#future, this.#past);
  }

  clear(): void {
    this.#past = [];
    this.#future = [];
    this.seal();
  }

  #step(current: T, from: T[], to: T[]): T {
    const value = from.pop();
    if (value === undefined) return current;
    to.push(current);
    this.seal();
    return value;
  }
}
