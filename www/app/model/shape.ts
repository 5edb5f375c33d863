/** Shapes of refinement regions: where a new one goes, and the numbers that a person edits. */

import { editable } from './text.js';
import type { Shape, ShapeKind, Vec3 } from './settings.js';

export interface Bounds {
  readonly min: Vec3;
  readonly max: Vec3;
}

export const SHAPES: readonly { kind: ShapeKind; label: string }[] = [
  { kind: 'box', label: 'Box' },
  { kind: 'sphere', label: 'Sphere' },
  { kind: 'cylinder', label: 'Cylinder' },
];

/** The box of cubes, `spacing` long, that holds `bounds` with `margin` around it, as the mesher makes it. */
export function grown({ min, max }: Bounds, { spacing, margin }: { readonly spacing: number; readonly margin: number }): Bounds {
  const half = min.map((low, i) => {
    const size = (max[i] ?? low) - low + 2 * margin;
    return (Math.max(1, Math.ceil(size / spacing - 1e-9)) * spacing) / 2;
  });
  const middle = center({ min, max });
  return { min: middle.map((x, i) => x - (half[i] ?? 0)) as Vec3, max: middle.map((x, i) => x + (half[i] ?? 0)) as Vec3 };
}

/** A new shape's radius, as a part of the model's diagonal. */
const NEW_RADIUS = 0.12;

export function diagonal({ min, max }: Bounds): number {
  return Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
}

export function center({ min, max }: Bounds): Vec3 {
  return [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
}

/** A shape of `kind` about `point`, of a size that fits `bounds`, in numbers a person would have typed. */
export function newShape(kind: ShapeKind, point: Vec3, bounds: Bounds): Shape {
  const radius = Number(((diagonal(bounds) || 1) * NEW_RADIUS).toPrecision(2));
  const step = 10 ** Math.floor(Math.log10(radius) - 2);
  const at = point.map((x) => Number((Math.round(x / step) * step).toPrecision(8))) as Vec3;
  return tidy(about(kind, at, radius));
}

function about(kind: ShapeKind, at: Vec3, radius: number): Shape {
  switch (kind) {
    case 'box':
      return { kind, min: moved(at, [-radius, -radius, -radius]), max: moved(at, [radius, radius, radius]) };
    case 'sphere':
      return { kind, center: at, radius };
    case 'cylinder':
      return { kind, from: moved(at, [0, 0, -radius]), to: moved(at, [0, 0, radius]), radius };
  }
}

/** The shape displaced by `by`. */
export function translated(shape: Shape, by: Vec3): Shape {
  switch (shape.kind) {
    case 'box':
      return { ...shape, min: moved(shape.min, by), max: moved(shape.max, by) };
    case 'sphere':
      return { ...shape, center: moved(shape.center, by) };
    case 'cylinder':
      return { ...shape, from: moved(shape.from, by), to: moved(shape.to, by) };
  }
}

/** Half of a shape's greatest extent: what a duplicate is displaced by. */
export function extent(shape: Shape): number {
  return shape.kind === 'box' ? diagonal(shape) / 2 : shape.radius;
}

/** Why the shape is none, or null. */
export function fault(shape: Shape): string | null {
  if (shape.kind === 'box') {
    const flat = shape.min.findIndex((low, axis) => low >= (shape.max[axis] ?? low));
    return flat < 0 ? null : `The box has no extent along ${'xyz'[flat]}: its maximum must be greater than its minimum.`;
  }
  if (!(shape.radius > 0)) return 'The radius must be greater than 0.';
  if (shape.kind === 'cylinder' && shape.from.every((x, axis) => x === shape.to[axis])) {
    return 'The cylinder has no length: its two ends are the same point.';
  }
  return null;
}

/** The shape with six significant digits a number, as dragging a handle leaves it. */
export function tidy(shape: Shape): Shape {
  const short = (v: Vec3): Vec3 => v.map((x) => Number(editable(x))) as Vec3;
  switch (shape.kind) {
    case 'box':
      return { ...shape, min: short(shape.min), max: short(shape.max) };
    case 'sphere':
      return { ...shape, center: short(shape.center), radius: Number(editable(shape.radius)) };
    case 'cylinder':
      return { ...shape, from: short(shape.from), to: short(shape.to), radius: Number(editable(shape.radius)) };
  }
}

export function moved(point: Vec3, by: Vec3): Vec3 {
  return [point[0] + by[0], point[1] + by[1], point[2] + by[2]];
}
