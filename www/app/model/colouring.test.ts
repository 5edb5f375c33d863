import { readFileSync } from 'node:fs';

import { expect, test } from 'vitest';

import { mapColour } from './colouring';

/** Places and colours of a map of the renderer, from its source. */
function stopsOf(map: string): [number, string][] {
  const source = readFileSync(new URL('../../../src/scene/colour.rs', import.meta.url), 'utf8');
  const table = source.match(new RegExp(`const ${map}: &\\[Stop\\] = &\\[([^;]*)\\];`))?.[1] ?? '';
  const stops = [...table.matchAll(/\(([\d.]+), \[(\d+), (\d+), (\d+)\]\)/g)];
  return stops.map(([, place, ...rgb]) => [Number(place), `rgb(${rgb.join(' ')})`]);
}

test.each(['quality', 'levels'] as const)('the legend of %s has the colours that are drawn', (map) => {
  const stops = stopsOf(map.toUpperCase());
  expect(stops.length).toBeGreaterThan(5);
  for (const [place, colour] of stops) expect(mapColour(map, place)).toBe(colour);
});
