/** What is cut away of a hex mesh to look inside: a plane between whole cells, and layers of the boundary. */

import { computed, signal } from '@preact/signals-core';
import type { Section } from '../view.js';
import type { Vec3 } from './settings.js';
import { center } from './shape.js';
import type { Bounds } from './shape.js';
import { editable } from './text.js';

export type SectionAxis = 'x' | 'y' | 'z';
const AXES: readonly SectionAxis[] = ['x', 'y', 'z'];

/** What the page's link says of it. */
export interface Cut {
  readonly section: Section | null;
  readonly peel: number;
}

export class Cutting {
  /** Cells beyond this plane are hidden. */
  readonly section = signal<Section | null>(null);
  /** So many layers of cells are hidden, from the boundary inwards. */
  readonly peel = signal(0);
  /** The box of the mesh that is cut; null if there is none. */
  readonly bounds = signal<Bounds | null>(null);
  /** How many layers the mesh has. */
  readonly layers = signal(0);
  /** Whether a person has chosen a cut, or a link: then none is made up. */
  isChosen = false;

  /** The axis that the plane's normal lies along; null: none, or no plane. */
  readonly axis = computed<SectionAxis | null>(() => {
    const normal = this.section.value?.normal;
    return AXES.find((_, i) => Math.abs(normal?.[i] ?? 0) > 1 - 1e-9) ?? null;
  });
  /** Least and greatest offset at which the plane touches the mesh. */
  readonly range = computed<{ min: number; max: number }>(() => {
    const [section, bounds] = [this.section.value, this.bounds.value];
    return section && bounds ? reach(section.normal, bounds) : { min: 0, max: 1 };
  });

  /** Cuts across an axis, through the middle if there was no cut along it. */
  across(axis: SectionAxis): void {
    const i = AXES.indexOf(axis);
    this.facing([0, 1, 2].map((k) => (k === i ? -1 : 0)) as Vec3);
  }

  /** Cuts so that the side that `normal` points at is hidden, at the middle of what was cut. */
  facing(normal: Vec3): void {
    this.isChosen = true;
    const bounds = this.bounds.value;
    if (!bounds) return;
    const old = this.section.value;
    const middle = center(bounds);
    const at = old ? displaced(middle, old.normal, old.offset - dot(old.normal, middle)) : middle;
    this.#set({ normal, offset: dot(normal, at) }, bounds);
  }

  /** Shows the other side. */
  flip(): void {
    const section = this.section.value;
    if (section) this.move(section.normal.map((x) => 0 - x) as Vec3, -section.offset);
  }

  /** Moves the plane along its normal. */
  to(offset: number): void {
    const section = this.section.value;
    if (section) this.move(section.normal, offset);
  }

  move(normal: Vec3, offset: number): void {
    this.isChosen = true;
    const bounds = this.bounds.value;
    if (bounds) this.#set({ normal, offset }, bounds);
  }

  none(): void {
    this.isChosen = true;
    this.section.value = null;
  }

  /** Cuts through `point`, which lies so many layers deep, so that a cell there is seen. */
  reveal(point: Vec3, depth: number, towardsEye: Vec3): void {
    const normal = this.section.value?.normal ?? towardsEye;
    this.peel.value = Math.min(this.peel.value, depth);
    this.move(normal, dot(normal, point));
  }

  restore({ section, peel }: Cut): void {
    this.isChosen = section !== null || peel > 0;
    this.section.value = section;
    this.peel.value = peel;
  }

  #set({ normal, offset }: Section, bounds: Bounds): void {
    const { min, max } = reach(normal, bounds);
    this.section.value = { normal, offset: Math.min(max, Math.max(min, offset)) };
  }
}

/** The axis nearest to `direction`, towards it. */
export function nearestAxis(direction: Vec3): Vec3 {
  const most = Math.max(...direction.map(Math.abs));
  const i = direction.findIndex((x) => Math.abs(x) === most);
  return direction.map((x, k) => (k === i ? Math.sign(x) || 1 : 0)) as Vec3;
}

/** The entries of a link: `section=0,-1,0,0.25`, the normal and the offset; `peel=2`. */
export function formatCut({ section, peel }: Cut): [string, string][] {
  const list: [string, string][] = [];
  if (section) list.push(['section', [...section.normal, section.offset].map((x) => editable(x)).join(',')]);
  if (peel > 0) list.push(['peel', String(peel)]);
  return list;
}

/** Reads {@link formatCut}'s entries; what is wrong in them is left out. */
export function parseCut(entries: URLSearchParams): Cut {
  const [x = Number.NaN, y = Number.NaN, z = Number.NaN, offset = Number.NaN, ...rest] = (entries.get('section') ?? '').split(',').map((text) => (text === '' ? Number.NaN : Number(text)));
  const length = Math.hypot(x, y, z);
  const isPlane = rest.length === 0 && Number.isFinite(offset) && length > 0 && length < Number.POSITIVE_INFINITY;
  const peel = Number(entries.get('peel') ?? 0);
  return {
    section: isPlane ? { normal: [x / length, y / length, z / length], offset: offset / length } : null,
    peel: Number.isInteger(peel) && peel > 0 ? Math.min(peel, MOST_LAYERS) : 0,
  };
}

/** As many layers as the view counts. */
const MOST_LAYERS = 65_535;

function reach(normal: Vec3, { min, max }: Bounds): { min: number; max: number } {
  const ends = normal.map((n, i) => [n * (min[i] ?? 0), n * (max[i] ?? 0)]);
  const sum = (pick: (...values: number[]) => number): number => ends.reduce((total, pair) => total + pick(...pair), 0);
  return { min: sum(Math.min), max: sum(Math.max) };
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function displaced(point: Vec3, direction: Vec3, by: number): Vec3 {
  return point.map((x, i) => x + by * (direction[i] ?? 0)) as Vec3;
}
