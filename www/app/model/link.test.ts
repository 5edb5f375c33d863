import { describe, expect, test } from 'vitest';
import { formatCut } from './cutting.js';
import { formatCommand, formatLink, formatRegion, parseLink, parseRegion } from './link.js';
import type { Entry } from './link.js';
import { DEFAULTS, region } from './settings.js';
import type { Settings } from './settings.js';

const full: Settings = {
  ...DEFAULTS,
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
    expect(bare({ ...DEFAULTS, ...linked?.settings, hexes: DEFAULTS.hexes, solid: DEFAULTS.solid })).toEqual(bare(full));
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

describe('links to hexes', () => {
  const hexes: Settings = {
    ...DEFAULTS,
    job: 'hexes',
    gradation: 1.5,
    hexes: { ...DEFAULTS.hexes, spacing: 0.2, margin: 0.35, atSurface: 3, method: 'one', by: 'levels', levels: 1, maxLevels: 6, maxHexes: 400_000 },
    regions: full.regions.slice(1, 2),
  };

  test('give the job back, and how the mesh is looked at', () => {
    const view: Entry[] = [...formatCut({ section: { normal: [0, -1, 0], offset: 0.25 }, peel: 2 }), ['colour', 'level']];
    const link = formatLink('spot', hexes, view);
    expect(link).toBe(
      'example=spot&job=hexes&spacing=0.2&margin=0.35&at-surface=3&method=one&levels=1&gradation=1.5&max-levels=6&max-hexes=400000' +
        '&region=box:0,0,0,1,2,3:level=4&section=0,-1,0,0.25&peel=2&colour=level',
    );
    const linked = parseLink(link);
    expect(bare({ ...DEFAULTS, ...linked?.settings, hexes: { ...DEFAULTS.hexes, ...linked?.settings.hexes }, solid: DEFAULTS.solid })).toEqual(bare(hexes));
    expect(linked?.cut).toEqual({ section: { normal: [0, -1, 0], offset: 0.25 }, peel: 2 });
    expect(linked?.colour).toBe('level');
  });

  test('that are wrong are read as far as they are right', () => {
    const linked = parseLink('#example=spot&job=hexes&spacing=-1&margin=2&at-surface=99&method=four&section=0,0,0,1&peel=-3&colour=red');
    expect(linked?.settings).toEqual({ job: 'hexes', hexes: { margin: 2 }, gradation: DEFAULTS.gradation, regions: [] });
    expect(linked?.cut).toEqual({ section: null, peel: 0 });
    expect(linked?.colour).toBe('plain');
  });

  test('of an edge length refine to it', () => {
    const { settings } = parseLink(formatLink('spot', { ...hexes, hexes: { ...hexes.hexes, by: 'length', edgeLength: 0.05 } })) ?? {};
    expect(settings?.hexes).toMatchObject({ by: 'length', edgeLength: 0.05 });
  });

  test('are two commands: a box, then its refinement', () => {
    const surface = { name: 'spot.obj', holdsHexes: false };
    expect(formatCommand(surface, 'out.vtu', { ...DEFAULTS, job: 'hexes' })).toBe(
      'hexmill grid spot.obj -o box.vtu --spacing 1 --margin 1 && hexmill refine box.vtu -o out.vtu --region surface:spot.obj,0:level=2',
    );
    expect(formatCommand({ name: 'part.msh', holdsHexes: true }, 'out.vtu', { ...DEFAULTS, hexes: { ...DEFAULTS.hexes, method: 'two', levels: 2 } })).toBe(
      'hexmill refine part.msh -o out.vtu --method two --levels 2',
    );
  });
});

describe('links to solids', () => {
  const solid: Settings = { ...DEFAULTS, job: 'solid', solid: { ...DEFAULTS.solid, edgeLength: 0.5, featureAngle: 40, background: 'octree', maxDistance: 0.01, maxLevels: 1, secondOrder: 'hex27' }, regions: full.regions.slice(1, 2) };

  test('give the job back', () => {
    const link = formatLink('plate', solid);
    expect(link).toBe('example=plate&job=solid&edge-length=0.5&feature-angle=40&background=octree&max-distance=0.01&max-levels=1&second-order=hex27&region=box:0,0,0,1,2,3:level=4');
    const linked = parseLink(link);
    expect(bare({ ...DEFAULTS, ...linked?.settings, hexes: DEFAULTS.hexes, solid: { ...DEFAULTS.solid, ...linked?.settings.solid } })).toEqual(bare(solid));
    expect(parseLink('#example=plate&job=solid&feature-angle=400&background=none&second-order=hex8')?.settings).toMatchObject({ job: 'solid', solid: {} });
  });

  test('are one command', () => {
    expect(formatCommand({ name: 'plate.obj', holdsHexes: false }, 'out.vtu', solid)).toBe(
      'hexmill hex plate.obj -o out.vtu --edge-length 0.5 --feature-angle 40 --background octree --max-distance 0.01 --max-levels 1 --second-order hex27 --region box:0,0,0,1,2,3:level=4',
    );
  });
});

describe('regions as text', () => {
  test.each(full.regions.map((r) => formatRegion(r)))('%s', (text) => expect(formatRegion(parseRegion(text) ?? region({ kind: 'sphere', center: [0, 0, 0], radius: 1 }, { by: 'level', level: 0 }))).toBe(text));

  test('a box turned inside out is none', () => expect(parseRegion('box:1,0,0,0,1,1:h=1')).toBeNull());
});

test('the command names files with spaces', () => {
  expect(formatCommand({ name: "my model's.obj", holdsHexes: false }, 'out.vtu', { ...DEFAULTS, keepCoarse: true })).toBe(
    String.raw`hexmill refine 'my model'\''s.obj' -o out.vtu --edge-length 1 --keep-coarse`,
  );
});
