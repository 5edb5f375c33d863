/** Work of which only the latest request counts. */

export class Latest {
  #controller: AbortController | null = null;

  /** Aborts what runs and runs `work`; its result is null if a later request or `cancel` overtook it. */
  async run<T>(work: (signal: AbortSignal) => Promise<T>): Promise<T | null> {
    this.cancel();
    const controller = new AbortController();
    this.#controller = controller;
    try {
      const value = await work(controller.signal);
      return controller.signal.aborted ? null : value;
    } catch (error) {
      if (controller.signal.aborted) return null;
      throw error;
    } finally {
      if (this.#controller === controller) this.#controller = null;
    }
  }

  cancel(): void {
    this.#controller?.abort();
    this.#controller = null;
  }
}

/** Calls `action` once `delay` ms have passed without another call. */
export function debounced(action: () => void, delay: number): { (): void; cancel(): void } {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const call = (): void => {
    clearTimeout(timer);
    timer = setTimeout(action, delay);
  };
  return Object.assign(call, { cancel: () => clearTimeout(timer) });
}
