import { describe, expect, test } from 'vitest';
import { formatCommand, formatLink, formatRegion, parseLink, parseRegion } from './link.js';
import { DEFAULTS, region } from './settings.js';
import type { Settings } from './settings.js';

const full: Settings = {
  by: 'length',
  edgeLength: 0.05,
  levels: 1,
  curvature: 15,
  gradation: 1.5,
  keepCoarse: true,
  maxLevels: 8,
  maxQuads: 500_000,
  regions: [
    region({ kind: 'sphere', center: [0, -0.5, 1e-7], radius: 2 }, { by: 'size', size: 0.01 }),
    region({ kind: 'box', min: [0, 0, 0], max: [1, 2, 3] }, { by: 'level', level: 4 }),
    region({ kind: 'box', min: [0, 0, 0], max: [1, 2, 3], rotation: [0, 0, 0.6, 0.8] }, { by: 'level', level: 4 }),
    region({ kind: 'cylinder', from: [0, 0, 0], to: [0, 0, 1], radius: 0.25 }, { by: 'size', size: 0.02 }),
  ],
};

/** Regions without the ids that are the page's own. */
const bare = (settings: Partial<Settings>): unknown => ({ ...settings, regions: settings.regions?.map(({ shape, target }) => ({ shape, target })) });

describe('links', () => {
  test('say what the command line says', () => {
    expect(formatLink('spot', { ...DEFAULTS, edgeLength: 0.05, regions: full.regions.slice(0, 1) })).toBe(
      'example=spot&edge-length=0.05&region=sphere:0,-0.5,1e-7,2:h=0.01',
    );
  });

  test('give the settings back', () => {
    const linked = parseLink(`#${formatLink('spot', full)}`);
    expect(linked?.example).toBe('spot');
    expect(bare({ ...DEFAULTS, ...linked?.settings })).toEqual(bare(full));
  });

  test('give levels back', () => {
    expect(parseLink(formatLink('car', { ...DEFAULTS, by: 'levels', levels: 3 }))?.settings).toMatchObject({ by: 'levels', levels: 3 });
  });

  test('that are wrong are read as far as they are right', () => {
    expect(parseLink('')).toBeNull();
    expect(parseLink('#section-2')).toBeNull();
    const linked = parseLink('#example=spot&edge-length=-1&gradation=7&levels=x&region=sphere:0,0,0:h=1&region=sphere:0,0,0,1:h=0&region=torus:1:h=1');
    expect(linked?.settings).toMatchObject({ gradation: DEFAULTS.gradation, regions: [] });
    expect(linked?.settings).not.toHaveProperty('edgeLength');
    expect(linked?.settings).not.toHaveProperty('levels');
  });
});

describe('regions as text', () => {
  test.each(full.regions.map((r) => formatRegion(r)))('%s', (text) => expect(formatRegion(parseRegion(text) ?? region({ kind: 'sphere', center: [0, 0, 0], radius: 1 }, { by: 'level', level: 0 }))).toBe(text));

  test('a box turned inside out is none', () => expect(parseRegion('box:1,0,0,0,1,1:h=1')).toBeNull());
});

test('the command names files with spaces', () => {
  expect(formatCommand("my model's.obj", 'out.vtu', { ...DEFAULTS, keepCoarse: true })).toBe(
    String.raw`hexmill refine 'my model'\''s.obj' -o out.vtu --edge-length 1 --keep-coarse`,
  );
});
