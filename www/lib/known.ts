// Names that people misspell, and the ones that they meant.

import { OptionsError } from './errors.js';

/** A name that differs by no more than this share of its letters is taken for a misspelling. */
const LIKENESS = 0.5;

/**
 * Refuses an object with a key that is none of `known`, naming the one that was probably meant.
 *
 * @throws {@link OptionsError} with the code `option-unknown`.
 */
export function refuseUnknown(given: object, known: readonly string[], what: string): void {
  const unknown = Object.keys(given).find((key) => !known.includes(key));
  if (unknown === undefined) return;
  const meant = nearest(unknown, known);
  const hint = meant === null ? '' : ` Did you mean ${meant}?`;
  throw new OptionsError('option-unknown', `There is no ${what} ${unknown}.${hint} There are ${known.join(', ')}.`);
}

/** The name of `known` that is most like `name`; null if none is like it. */
export function nearest(name: string, known: readonly string[]): string | null {
  let [best, least] = [null as string | null, LIKENESS * name.length];
  for (const candidate of known) {
    const distance = editDistance(name.toLowerCase(), candidate.toLowerCase());
    if (distance <= least && (best === null || distance < least)) [best, least] = [candidate, distance];
  }
  return best;
}

/** How many letters have to be put in, left out or changed to make `b` of `a` (Levenshtein, row by row). */
function editDistance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      const change = (row[j - 1] ?? 0) + (a[i - 1] === b[j - 1] ? 0 : 1);
      next.push(Math.min(change, (row[j] ?? 0) + 1, (next[j - 1] ?? 0) + 1));
    }
    row = next;
  }
  return row[b.length] ?? 0;
}
