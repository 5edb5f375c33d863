/** Settings that suit a model. */

import type { HexMesh, Surface } from 'hexmill';
import type { GivenSettings } from './link.js';
import { DEFAULTS } from './settings.js';
import type { HexSettings, Settings, SolidSettings, Vec3 } from './settings.js';
import { diagonal } from './shape.js';
import { rounded } from './text.js';

/** Default edge length as a part of the model's diagonal. */
export const DEFAULT_FINENESS = 1 / 60;
/** Default edges of a box of hexes around a model, and how far it reaches beyond it, as parts of the model's diagonal. */
const DEFAULT_SPACING = 1 / 10;
const DEFAULT_MARGIN = 1 / 10;
/** Default edges of hexes that fill a solid, as a part of its diagonal. */
const DEFAULT_FILLING = 1 / 40;

/** The defaults for a model, overruled by `settings`. */
export function fitting({ info }: Surface | HexMesh, settings: GivenSettings): Settings {
  const { min, max } = info.bounds;
  const length = diagonal({ min: min as Vec3, max: max as Vec3 }) || info.longestEdge || 1;
  const hexes: HexSettings = {
    ...DEFAULTS.hexes,
    spacing: rounded(length * DEFAULT_SPACING),
    margin: rounded(length * DEFAULT_MARGIN),
    edgeLength: rounded(info.longestEdge || length),
    ...settings.hexes,
  };
  const solid: SolidSettings = { ...DEFAULTS.solid, edgeLength: rounded(length * DEFAULT_FILLING), ...settings.solid };
  return { ...DEFAULTS, edgeLength: rounded(length * DEFAULT_FINENESS), ...settings, hexes, solid };
}
