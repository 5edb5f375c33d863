/** What happened, in order, in words. */

import { signal } from '@preact/signals-core';

export interface LogEntry {
  readonly at: Date;
  readonly kind: 'info' | 'warning' | 'error';
  readonly text: string;
}

/** Entries kept. */
const LENGTH = 500;

export class Log {
  readonly entries = signal<readonly LogEntry[]>([]);

  add(kind: LogEntry['kind'], text: string): void {
    this.entries.value = [...this.entries.value, { at: new Date(), kind, text }].slice(-LENGTH);
  }
}
