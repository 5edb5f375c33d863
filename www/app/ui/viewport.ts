/** The bridge to the 3D view: signals in, picks and drags out. The page works without a view. */

import { effect, signal, untracked } from '@preact/signals-core';
import type { Colouring, DrawHexes, DrawMesh, View, ViewFeature, ViewRegion } from '../view.js';
import { complaint } from '../model/complaint.js';
import { colouring } from '../model/colouring.js';
import { nearestAxis } from '../model/cutting.js';
import { featuresOf, lostFeatures, lostOf } from '../model/features.js';
import { isHexes, isSolid } from '../model/job.js';
import type { Cells, Input } from '../model/job.js';
import type { Vec3 } from '../model/settings.js';
import { grown } from '../model/shape.js';
import type { Bounds } from '../model/shape.js';
import type { Page } from './page.js';

export type Axis = '+x' | '-x' | '+y' | '-y' | '+z' | '-z' | 'iso';

export class Viewport {
  readonly edges = signal(true);
  readonly projection = signal<'perspective' | 'orthographic'>('perspective');
  readonly up = signal<'y' | 'z'>('z');
  /** CSS pixels at either side of the canvas that the columns cover, and at either end that the toolbar does. */
  readonly covered = signal<[number, number]>([0, 0]);
  /** Why there is no picture, in plain words. */
  readonly trouble = signal<string | null>(null);
  readonly ready = signal(false);

  readonly #page: Page;
  #view: View | null = null;
  #stop: (() => void)[] = [];
  #dragging = false;
  /** The mesh could not be drawn, though the view works. */
  #undrawn = false;

  constructor(page: Page) {
    this.#page = page;
  }

  /** Makes the view in a new canvas inside `host`. */
  async start(host: HTMLElement): Promise<void> {
    this.#drop();
    const canvas = document.createElement('canvas');
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', 'The model in 3D. Drag to turn, right-drag to move, scroll to come closer, F to see all.');
    host.replaceChildren(canvas);
    try {
      const { createView } = await import('../view.js');
      const view = await createView(canvas);
      this.trouble.value = null;
      this.#connect(view);
    } catch (error) {
      canvas.remove();
      this.#fail(error);
    }
  }

  frameAll(): void {
    this.#view?.frameAll();
  }

  look(axis: Axis): void {
    this.#view?.lookAlong(axis);
  }

  /** Flies to a cell of the result; hexes are cut open there. */
  show(cell: number): void {
    const { workbench, cutting } = this.#page;
    workbench.shows.value = 'mesh';
    const mesh = workbench.result.value?.mesh;
    if (mesh && isHexes(mesh) && this.#view) cutting.reveal(middleOf(mesh.nodes, mesh.hexes.subarray(8 * cell, 8 * cell + 8)), this.#view.depthOf(cell), this.#axisToEye());
    this.#view?.frameFace(cell);
  }

  /** The direction towards the eye, a unit vector. */
  toEye(): Vec3 {
    return (this.#view?.forward() ?? [0, 1, 0]).map((x) => 0 - x) as Vec3;
  }

  /** Cuts hexes across the horizontal axis along which they are shortest, or else that points most towards the eye. */
  cutOpen(): void {
    const { cutting } = this.#page;
    const { min, max } = cutting.bounds.value ?? { min: [0, 0, 0], max: [0, 0, 0] };
    const upward = this.up.value === 'z' ? 2 : 1;
    const across = upward === 2 ? 1 : 2;
    const [x, other] = [0, across].map((axis) => (max[axis] ?? 0) - (min[axis] ?? 0)) as [number, number];
    const eye = this.toEye();
    if (Math.min(x, other) > LONG * Math.max(x, other)) return cutting.facing(this.#axisToEye());
    const shortest = x < other ? 0 : across;
    cutting.facing(nearestAxis(eye.map((e, i) => (i === shortest ? e || 1 : 0)) as Vec3));
  }

  /** The horizontal axis that points most towards the eye. */
  #axisToEye(): Vec3 {
    const upward = this.up.value === 'z' ? 2 : 1;
    return nearestAxis(this.toEye().map((x, i) => (i === upward ? 0 : x)) as Vec3);
  }

  async screenshot(): Promise<Blob | null> {
    return (await this.#view?.screenshot()) ?? null;
  }

  /** Where the handles of the selected region are, in CSS pixels of the canvas. */
  handles(): { name: string; x: number; y: number }[] {
    return this.#view?.handlePositions() ?? [];
  }

  stats(): { frameMs: number; faces: number; nodes: number } | null {
    return this.#view?.stats() ?? null;
  }

  #drop(): void {
    for (const stop of this.#stop.splice(0)) stop();
    this.#view?.dispose();
    this.#view = null;
    this.ready.value = false;
  }

  #connect(view: View): void {
    this.#view = view;
    this.ready.value = true;
    this.#listen(view);
    this.#stop = [this.#drawStyle(view), this.#drawMesh(view), this.#drawCut(view), this.#drawBox(view), this.#drawFeatures(view), this.#drawRegions(view)];
  }

  #listen(view: View): void {
    const { workbench, inspection, cutting } = this.#page;
    view.onSectionDrag(({ normal, offset }) => cutting.move(normal, offset));
    view.onRegionDrag((index, region, phase) => {
      this.#dragging = phase === 'drag';
      workbench.dragRegion(index, region, phase);
    });
    view.onRegionPick((index) => {
      workbench.selected.value = index === null ? null : (workbench.settings.value.regions[index]?.id ?? null);
    });
    view.onPick((hit) => {
      workbench.pickedPoint.value = hit?.point ?? null;
      if (workbench.shows.value === 'mesh') inspection.cell.value = hit?.face ?? null;
    });
    view.onLost((message) => {
      this.#undrawn = false;
      this.#fail(message);
    });
    view.onRestored(() => {
      this.trouble.value = null;
    });
  }

  #drawMesh(view: View): () => void {
    let drawn: unknown = null;
    let drawnOf: unknown = null;
    return effect(() => {
      const { workbench, inspection } = this.#page;
      const input = workbench.input.value;
      const mesh = workbench.shows.value === 'mesh' ? (workbench.result.value?.mesh ?? null) : null;
      const colours: Colouring = mesh ? colouring(mesh, inspection) : { kind: 'plain' };
      this.#guard(() => {
        if ((mesh ?? input) !== drawn) {
          drawn = mesh ?? input;
          // A box around the model is larger than the model.
          const keepCamera = input === drawnOf;
          drawnOf = input;
          this.#setMesh(view, mesh, input, keepCamera);
        }
        view.setColouring(colours);
      });
    });
  }

  #setMesh(view: View, mesh: Cells | null, input: Input | null, keepCamera: boolean): void {
    const shown = mesh ? ofCells(mesh) : (input?.hexes ?? input?.surface ?? null);
    const hexes = shown && 'hexes' in shown ? shown : null;
    if (hexes) view.setHexes(hexes, { keepCamera });
    else view.setMesh(shown as DrawMesh | null, { keepCamera });
    const { cutting } = this.#page;
    untracked(() => {
      cutting.layers.value = hexes ? view.layers() : 0;
      cutting.bounds.value = hexes ? boundsOf(hexes.nodes) : null;
      // A box around a model shows nothing of what is in it before it is cut.
      if (hexes && mesh && !isSolid(mesh) && input?.surface && !cutting.isChosen) this.cutOpen();
      this.#cutAgain.value += 1;
    });
  }

  /** A new mesh is not cut yet. */
  readonly #cutAgain = signal(0);

  #drawCut(view: View): () => void {
    const { cutting, inspection, workbench } = this.#page;
    const cut = (draw: () => void): (() => void) =>
      effect(() => {
        if (this.#cutAgain.value > 0 && cutting.bounds.value) this.#guard(draw);
      });
    const stops = [
      cut(() => view.setSection(cutting.section.value)),
      cut(() => view.setPeel(Math.min(cutting.peel.value, Math.max(0, cutting.layers.value - 1)))),
      cut(() => {
        const isShown = workbench.shows.value === 'mesh';
        const [values, brush] = [inspection.values.value, inspection.brush.value];
        view.setFilter(isShown && values && brush ? { values, range: [brush.low, brush.high] } : null);
      }),
      cut(() => view.mark(workbench.shows.value === 'mesh' ? inspection.cell.value : null)),
    ];
    return () => stops.forEach((stop) => stop());
  }

  /** The bounds of the surface whose numbers are shown. */
  #boundsOfGuide(): Bounds | null {
    const { settings, selected } = this.#page.workbench;
    const guide = settings.value.guides.find(({ id }) => id === selected.value);
    const bounds = guide?.surface.info.bounds;
    return bounds ? { min: bounds.min as Vec3, max: bounds.max as Vec3 } : null;
  }

  /**
   * The box that is to be filled with hexes, around the surface that they are made for; it is seen whole at first. Else the
   * bounds of the surface that hexes of a file are refined at and whose numbers are shown.
   */
  #drawBox(view: View): () => void {
    let framed: Input | null = null;
    return effect(() => {
      const { workbench } = this.#page;
      const { job, hexes } = workbench.settings.value;
      const input = workbench.input.value;
      const isBox = job === 'hexes' && input?.surface != null;
      const bounds = isBox && workbench.shows.value === 'input' ? workbench.bounds.value : null;
      view.setBox(bounds ? grown(bounds, hexes) : this.#boundsOfGuide());
      if (bounds && framed !== input) view.frameAll();
      framed = isBox ? input : null;
    });
  }

  /** What was found of a solid, over the surface; what the mesh does not show of it, over the mesh. */
  #drawFeatures(view: View): () => void {
    return effect(() => {
      const features = this.#features();
      this.#guard(() => view.setFeatures(features));
    });
  }

  #features(): ViewFeature[] {
    const { workbench } = this.#page;
    const { solid, result, shows } = workbench;
    if (shows.value === 'input') return solid.value ? featuresOf(solid.value) : [];
    const made = result.value;
    return made && isSolid(made.mesh) ? lostFeatures(lostOf(made.mesh), made.plan) : [];
  }

  /** Flies to a place of the model and what is `reach` around it. */
  showPlace(place: Vec3, reach: number): void {
    this.#view?.frameBox({ min: place.map((x) => x - reach) as Vec3, max: place.map((x) => x + reach) as Vec3 });
  }

  /** Draws; what cannot be drawn, such as a mesh too large for the graphics card, is said and harms nothing else. */
  #guard(draw: () => void): void {
    try {
      draw();
      if (this.#undrawn) this.trouble.value = null;
      this.#undrawn = false;
    } catch (error) {
      this.#undrawn = true;
      this.#fail(error);
    }
  }

  #fail(error: unknown): void {
    const reason = complaint(error).text;
    this.trouble.value = reason;
    this.#page.workbench.log.add('error', `3D view: ${reason}`);
  }

  #drawStyle(view: View): () => void {
    return effect(() =>
      view.setStyle({
        edges: this.edges.value,
        projection: this.projection.value,
        background: this.#page.theme.scheme.value,
        up: this.up.value,
        covered: this.covered.value,
      }),
    );
  }

  #drawRegions(view: View): () => void {
    return effect(() => {
      const { settings, selected } = this.#page.workbench;
      const regions = settings.value.regions;
      const index = regions.findIndex(({ id }) => id === selected.value);
      if (this.#dragging) return;
      view.setRegions(regions.map(({ shape }): ViewRegion => shape), index < 0 ? null : index);
    });
  }
}

/** Extents that differ by less are alike. */
const LONG = 0.85;

function ofCells(mesh: Cells): DrawMesh | DrawHexes {
  return isHexes(mesh) ? { nodes: mesh.nodes, hexes: mesh.hexes } : { nodes: mesh.nodes, offsets: null, corners: mesh.quads };
}

function boundsOf(nodes: Float64Array): { min: Vec3; max: Vec3 } {
  const [min, max]: [Vec3, Vec3] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  nodes.forEach((x, i) => {
    const axis = (i % 3) as 0 | 1 | 2;
    if (x < min[axis]) min[axis] = x;
    if (x > max[axis]) max[axis] = x;
  });
  return { min, max };
}

function middleOf(nodes: Float64Array, cell: Uint32Array): Vec3 {
  return [0, 1, 2].map((axis) => cell.reduce((sum, node) => sum + (nodes[3 * node + axis] ?? 0), 0) / cell.length) as Vec3;
}
