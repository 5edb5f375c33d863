/** Errors as the page shows them. */

import { HexmillError } from 'hexmill';

export interface Complaint {
  /** In plain words, with what to do. */
  readonly text: string;
  /** The error's stable name. */
  readonly code: string | null;
  /** The line of the file at fault, from 1. */
  readonly line: number | null;
  /** The file. */
  readonly about?: string;
}

export function complaint(error: unknown): Complaint {
  if (error instanceof HexmillError) {
    return { text: sentence(error.message), code: error.code, line: error.line ?? null };
  }
  if (error instanceof RangeError && /alloc|memory|buffer/i.test(error.message)) {
    return { text: 'The browser ran out of memory. Use a larger edge length or fewer levels.', code: 'out-of-memory', line: null };
  }
  return { text: sentence(error instanceof Error ? error.message : String(error)), code: null, line: null };
}

/** With a capital and a full stop. */
function sentence(text: string): string {
  const capital = text.charAt(0).toUpperCase() + text.slice(1);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}
