// The viewport: a mesh, regions and a camera on a canvas.
//
// Drawing is done by the viewer's WebAssembly module, which loads when the first view is made. A frame
// is drawn when something has changed, never more than once for each frame of the display. A view that
// loses its WebGL context says so and comes back by itself when the browser returns the context.

import type { Viewer } from '../wasm/viewer/viewer.js';
import { type Actions, listenForGestures } from './view-gestures';

/** A mesh to draw: three coordinates a node, and the nodes of all faces, face after face. */
export type DrawMesh = {
  nodes: Float64Array;
  /** Where each face's corners start in `corners`, and the end of the last; null: all faces are quads. */
  offsets: Uint32Array | null;
  corners: Uint32Array;
};

export type ColourMap = 'viridis' | 'quality' | 'levels';

/** How faces are coloured: all alike, or by one value each. NaN: no value (grey). */
export type Colouring =
  | { kind: 'plain' }
  | { kind: 'scalar'; values: Float32Array; range: [number, number]; map: ColourMap };

export type Vector = [number, number, number];

/** A region in world coordinates; a box may be turned about its middle by a unit quaternion x, y, z, w. */
export type ViewRegion =
  | { kind: 'box'; min: Vector; max: Vector; rotation?: [number, number, number, number] }
  | { kind: 'sphere'; center: Vector; radius: number }
  | { kind: 'cylinder'; from: Vector; to: Vector; radius: number };

export type Style = {
  edges: boolean;
  /** In CSS pixels. */
  edgeWidth: number;
  background: 'light' | 'dark';
  projection: 'perspective' | 'orthographic';
  /** What is up: z as in CAD, y as in modelling. A change looks from the front, right and above again. */
  up: 'y' | 'z';
  /** CSS pixels at both sides, and at the upper and lower end, that panels cover: what is framed stays clear of them. */
  covered: [number, number];
};

export type Direction = '+x' | '-x' | '+y' | '-y' | '+z' | '-z' | 'iso';
export type FaceHit = { face: number; point: Vector };
export type DragPhase = 'drag' | 'end';

export interface View {
  /**
   * Shows a mesh, or none. The camera frames it unless `keepCamera`. The arrays must not change later.
   * @throws {ViewError} The mesh is broken, or larger than the graphics driver allows.
   */
  setMesh(mesh: DrawMesh | null, options?: { keepCamera?: boolean }): void;
  setColouring(colouring: Colouring): void;
  setStyle(style: Partial<Style>): void;
  /** Draws regions as translucent solids, the selected one with handles to drag. */
  setRegions(regions: ViewRegion[], selected: number | null): void;
  onRegionDrag(callback: (index: number, region: ViewRegion, phase: DragPhase) => void): void;
  /** Called when a click meets a region (its index) or none (null). */
  onRegionPick(callback: (index: number | null) => void): void;
  /** Called when a click meets a face or none. A click that selects a region is not reported. */
  onPick(callback: (hit: FaceHit | null) => void): void;
  frameAll(): void;
  frameFace(face: number): void;
  /** Turns the camera to look along an axis: '-z' is the view from above. */
  lookAlong(axis: Direction): void;
  /** The handles of the selected region, in CSS pixels from the canvas's upper left corner. */
  handlePositions(): { name: string; x: number; y: number }[];
  /** What is seen now, as a PNG. */
  screenshot(): Promise<Blob>;
  /** Called with a message in plain words when drawing is no longer possible. */
  onLost(callback: (message: string) => void): void;
  /** Called when drawing is possible again. */
  onRestored(callback: () => void): void;
  /** `frameMs`: what the last frame cost the page. `gpuBytes`: what the mesh takes on the graphics device. */
  stats(): { frameMs: number; faces: number; nodes: number; gpuBytes: number };
  dispose(): void;
}

/** Why there is no view, in plain words. */
export class ViewError extends Error {
  override readonly name = 'ViewError';
}

/** Milliseconds that the camera takes to fly somewhere. */
const FLIGHT_MS = 280;
/** Milliseconds after which a new mesh is prepared for picking. */
const PREPARATION_MS = 400;
const DEFAULT_STYLE: Style = {
  edges: true,
  edgeWidth: 1,
  background: 'light',
  projection: 'perspective',
  up: 'z',
  covered: [0, 0],
};
const LOST =
  'The browser took the graphics away, often because memory ran out or the graphics driver restarted. ' +
  'Your meshes are safe; the picture comes back when the browser allows it.';

type Module = typeof import('../wasm/viewer/viewer.js');
let loading: Promise<Module> | undefined;

/**
 * Makes a view on a canvas that nothing else has drawn on.
 * @throws {ViewError} WebGL2 is missing, or the viewer cannot be loaded or started.
 */
export async function createView(canvas: HTMLCanvasElement): Promise<View> {
  if (!document.createElement('canvas').getContext('webgl2')) {
    throw new ViewError(
      'This browser offers no WebGL2, so meshes cannot be drawn. Meshing and export still work. ' +
        'Turning on hardware acceleration in the browser settings usually helps.',
    );
  }
  const module = await load();
  const view = new CanvasView(canvas, module);
  await view.start();
  return view;
}

/** The viewer's module, loaded once; a failed load is tried again by the next view. */
async function load(): Promise<Module> {
  loading ??= (async () => {
    const module = await import('../wasm/viewer/viewer.js');
    await module.default({ module_or_path: new URL('../wasm/viewer/viewer.wasm', import.meta.url) });
    return module;
  })();
  try {
    return await loading;
  } catch (cause) {
    loading = undefined;
    throw new ViewError(`The 3D viewer could not be loaded: ${messageOf(cause)}. Check the connection and reload.`);
  }
}

function messageOf(cause: unknown): string {
  return cause instanceof Error ? cause.message : String(cause);
}

class CanvasView implements View {
  readonly #canvas: HTMLCanvasElement;
  readonly #module: Module;
  readonly #disposal = new AbortController();
  readonly #observer: ResizeObserver;
  #viewer: Viewer | null = null;

  // What is shown, kept to show it again after a loss.
  #mesh: DrawMesh | null = null;
  #colouring: Colouring = { kind: 'plain' };
  #style = DEFAULT_STYLE;
  #regions: ViewRegion[] = [];
  #selected: number | null = null;
  #camera: Float64Array | null = null;

  #frame = 0;
  #frameMs = 0;
  #preparation: ReturnType<typeof setTimeout> | undefined;
  #flightStart: number | null = null;

  #regionDrag: (index: number, region: ViewRegion, phase: DragPhase) => void = () => {};
  #regionPick: (index: number | null) => void = () => {};
  #pick: (hit: FaceHit | null) => void = () => {};
  #lost: (message: string) => void = () => {};
  #restored: () => void = () => {};

  constructor(canvas: HTMLCanvasElement, module: Module) {
    this.#canvas = canvas;
    this.#module = module;
    this.#observer = new ResizeObserver(([entry]) => this.#resize(entry?.devicePixelContentBoxSize?.[0]));
  }

  async start(): Promise<void> {
    const { signal } = this.#disposal;
    try {
      this.#viewer = await this.#module.Viewer.create(this.#canvas);
    } catch (cause) {
      throw new ViewError(`The 3D viewer could not start: ${messageOf(cause)}.`);
    }
    this.#resize();
    try {
      // Exact device pixels, and a call when the window goes to a screen of another density.
      this.#observer.observe(this.#canvas, { box: 'device-pixel-content-box' });
    } catch {
      this.#observer.observe(this.#canvas);
    }
    this.#canvas.addEventListener('webglcontextlost', (event) => this.#lose(event), { signal });
    this.#canvas.addEventListener('webglcontextrestored', () => void this.#restore(), { signal });
    listenForGestures(this.#canvas, this.#actions(), signal);
  }

  setMesh(mesh: DrawMesh | null, { keepCamera = false } = {}): void {
    this.#mesh = mesh;
    this.#colouring = { kind: 'plain' };
    this.#change((viewer) => {
      if (mesh) viewer.setMesh(mesh.nodes, mesh.offsets ?? undefined, mesh.corners, keepCamera);
      else viewer.clearMesh();
    });
    // Once the mesh is seen and the page has nothing else to do.
    clearTimeout(this.#preparation);
    this.#preparation = setTimeout(() => this.#viewer?.preparePicking(), PREPARATION_MS);
  }

  setColouring(colouring: Colouring): void {
    this.#colouring = colouring;
    this.#change((viewer) => {
      if (colouring.kind === 'plain') return viewer.colourPlain();
      const { values, range, map } = colouring;
      viewer.colourByValue(values, range[0], range[1], map);
    });
  }

  setStyle(style: Partial<Style>): void {
    this.#style = { ...this.#style, ...style };
    this.#change((viewer) => viewer.setStyle(this.#style));
  }

  setRegions(regions: ViewRegion[], selected: number | null): void {
    this.#regions = regions;
    this.#selected = selected;
    this.#change((viewer) => viewer.setRegions(regions, selected ?? undefined));
  }

  onRegionDrag(callback: (index: number, region: ViewRegion, phase: DragPhase) => void): void {
    this.#regionDrag = callback;
  }

  onRegionPick(callback: (index: number | null) => void): void {
    this.#regionPick = callback;
  }

  onPick(callback: (hit: FaceHit | null) => void): void {
    this.#pick = callback;
  }

  onLost(callback: (message: string) => void): void {
    this.#lost = callback;
  }

  onRestored(callback: () => void): void {
    this.#restored = callback;
  }

  frameAll(): void {
    this.#fly((viewer) => viewer.flyToAll());
  }

  frameFace(face: number): void {
    this.#fly((viewer) => viewer.flyToFace(face));
  }

  lookAlong(axis: Direction): void {
    this.#fly((viewer) => viewer.flyAlong(axis));
  }

  handlePositions(): { name: string; x: number; y: number }[] {
    return this.#viewer?.handles() ?? [];
  }

  screenshot(): Promise<Blob> {
    return new Promise((resolve, reject) => {
      if (!this.#draw()) return reject(new ViewError('There is no picture: the graphics are lost.'));
      // In the same task as the drawing: afterwards the browser may clear the canvas.
      this.#canvas.toBlob((blob) => {
        if (blob) resolve(blob);
        else reject(new ViewError('The browser could not make a PNG of the picture.'));
      }, 'image/png');
    });
  }

  stats(): { frameMs: number; faces: number; nodes: number; gpuBytes: number } {
    const { nodes, offsets, corners } = this.#mesh ?? { nodes: [], offsets: null, corners: [] };
    const faces = offsets ? offsets.length - 1 : corners.length / 4;
    return { frameMs: this.#frameMs, faces, nodes: nodes.length / 3, gpuBytes: this.#viewer?.meshBytes() ?? 0 };
  }

  dispose(): void {
    this.#disposal.abort();
    this.#observer.disconnect();
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#preparation);
    this.#viewer?.free();
    this.#viewer = null;
  }

  /** Changes what is shown, and draws it. Without a viewer (context lost) it waits for the next one. */
  #change(change: (viewer: Viewer) => void): void {
    if (!this.#viewer) return;
    try {
      change(this.#viewer);
    } catch (cause) {
      if (cause instanceof WebAssembly.RuntimeError) return this.#fail(cause);
      throw new ViewError(`This cannot be shown: ${messageOf(cause)}.`);
    }
    this.#redraw();
  }

  /** Gives up: the module has run out of memory or stands in an unknown state. */
  #fail(cause: unknown): void {
    this.#viewer = null;
    this.#lost(`The picture can no longer be drawn: ${messageOf(cause)}. Reload the page to see it again.`);
  }

  #redraw(): void {
    if (this.#frame === 0) this.#frame = requestAnimationFrame((now) => this.#tick(now));
  }

  #tick(now: number): void {
    this.#frame = 0;
    if (this.#flightStart !== null && this.#viewer) {
      const share = Math.min((now - this.#flightStart) / FLIGHT_MS, 1);
      // Slow at both ends.
      const flying = this.#viewer.fly(share * share * (3 - 2 * share));
      if (flying && share < 1) this.#redraw();
      else this.#flightStart = null;
    }
    this.#draw();
  }

  #draw(): boolean {
    if (!this.#viewer) return false;
    const start = performance.now();
    try {
      this.#viewer.draw();
    } catch (cause) {
      this.#fail(cause);
      return false;
    }
    this.#frameMs = performance.now() - start;
    return true;
  }

  #fly(prepare: (viewer: Viewer) => void): void {
    this.#change((viewer) => {
      prepare(viewer);
      const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
      this.#flightStart = still ? -Infinity : performance.now();
    });
  }

  #resize(device?: ResizeObserverSize): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    const deviceWidth = device?.inlineSize ?? Math.round(width * devicePixelRatio);
    const deviceHeight = device?.blockSize ?? Math.round(height * devicePixelRatio);
    this.#viewer?.resize(width, height, deviceWidth, deviceHeight);
    // At once: a canvas of a new size is empty until it is drawn.
    this.#draw();
  }

  #lose(event: Event): void {
    // Without this the browser never gives the context back.
    event.preventDefault();
    this.#camera = this.#viewer?.camera() ?? this.#camera;
    this.#viewer = null;
    this.#lost(LOST);
  }

  async #restore(): Promise<void> {
    try {
      this.#viewer = await this.#module.Viewer.create(this.#canvas);
      this.#resize();
      const colouring = this.#colouring;
      this.setStyle({});
      this.setMesh(this.#mesh);
      this.setColouring(colouring);
      this.setRegions(this.#regions, this.#selected);
      if (this.#camera) this.#viewer.setCamera(this.#camera);
      this.#restored();
    } catch (cause) {
      this.#viewer = null;
      this.#lost(`The picture could not be brought back: ${messageOf(cause)}. Reload the page to see it again.`);
    }
  }

  #actions(): Actions {
    const act = (action: (viewer: Viewer) => void) => this.#change(action);
    let dragged: number | null = null;
    return {
      press: (x, y, reach) => {
        dragged = this.#viewer?.dragStart(x, y, reach) ? this.#selected : null;
        if (dragged === null) act((viewer) => viewer.grab(x, y));
        return dragged === null ? 'camera' : 'handle';
      },
      grabMiddle: () => act((viewer) => viewer.grabMiddle()),
      drag: (x, y) => {
        if (dragged === null) return;
        const index = dragged;
        act((viewer) => {
          const region: ViewRegion = viewer.dragTo(x, y);
          this.#regions = this.#regions.map((old, i) => (i === index ? region : old));
          this.#regionDrag(index, region, 'drag');
        });
      },
      release: () => {
        act((viewer) => viewer.release());
        const region = dragged === null ? undefined : this.#regions[dragged];
        if (dragged !== null && region) this.#regionDrag(dragged, region, 'end');
        dragged = null;
      },
      hover: (x, y, reach) => {
        if (!this.#viewer) return null;
        const before = this.#viewer.hovered();
        this.#viewer.hover(x, y, reach);
        const after = this.#viewer.hovered();
        if (after !== before) this.#redraw();
        return after ?? null;
      },
      click: (x, y) => this.#click(x, y),
      orbit: (yaw, pitch) => act((viewer) => viewer.orbit(yaw, pitch)),
      pan: (x, y) => act((viewer) => viewer.pan(x, y)),
      dolly: (x, y, factor) => act((viewer) => viewer.dolly(x, y, factor)),
      setPivot: (x, y) => this.#fly((viewer) => viewer.setPivot(x, y)),
      frameAll: () => this.frameAll(),
    };
  }

  #click(x: number, y: number): void {
    if (!this.#viewer) return;
    const region = this.#viewer.regionAt(x, y) ?? null;
    this.#regionPick(region);
    if (region !== null && region !== this.#selected) return;
    const hit = this.#viewer.pick(x, y);
    this.#pick(hit ? { face: hit.face, point: [hit.x, hit.y, hit.z] } : null);
  }
}
