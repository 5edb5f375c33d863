/** The bridge to the 3D view: signals in, picks and drags out. The page works without a view. */

import { effect, signal } from '@preact/signals-core';
import type { Colouring, DrawMesh, View, ViewRegion } from '../view.js';
import type { QuadMesh } from 'hexmill';
import { complaint } from '../model/complaint.js';
import { colouring } from '../model/colouring.js';
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

  /** Flies to a cell of the result. */
  show(cell: number): void {
    this.#page.workbench.shows.value = 'mesh';
    this.#view?.frameFace(cell);
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
    this.#stop = [this.#drawStyle(view), this.#drawMesh(view), this.#drawRegions(view)];
  }

  #listen(view: View): void {
    const { workbench, inspection } = this.#page;
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
      const surface = workbench.input.value?.surface ?? null;
      const mesh = workbench.shows.value === 'mesh' ? (workbench.result.value?.mesh ?? null) : null;
      const colours: Colouring = mesh ? colouring(mesh, inspection) : { kind: 'plain' };
      this.#guard(() => {
        if ((mesh ?? surface) !== drawn) {
          drawn = mesh ?? surface;
          view.setMesh(mesh ? ofQuads(mesh) : surface, { keepCamera: surface === drawnOf });
          drawnOf = surface;
        }
        view.setColouring(colours);
      });
    });
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

function ofQuads(mesh: QuadMesh): DrawMesh {
  return { nodes: mesh.nodes, offsets: null, corners: mesh.quads };
}
