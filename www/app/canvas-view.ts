// The view on its canvas: what is shown, when it is drawn, and how it comes back after a loss.

import type { Viewer } from '../wasm/viewer/viewer.js';
import { Motion } from './motion.js';
import { type Actions, listenForGestures } from './view-gestures.js';
import { messageOf, ViewError } from './view-types.js';
import type { Colouring, Direction, DragPhase, DrawHexes, DrawMesh, FaceHit, Section, Style, Vector, View, ViewFeature, ViewRegion } from './view-types.js';

export type Module = typeof import('../wasm/viewer/viewer.js');

/** Milliseconds that the camera takes to fly somewhere. */
const FLIGHT_MS = 280;
/** Milliseconds after which a new mesh is prepared for picking. */
const PREPARATION_MS = 400;
/** Resolution of a large mesh while it moves, as a part of the screen's. */
const MOVING_RESOLUTION = 0.5;
const DEFAULT_STYLE: Style = {
  edges: true,
  edgeWidth: 1,
  background: 'light',
  projection: 'perspective',
  up: 'z',
  covered: [0, 0],
};
/** What is shown. */
type Told = 'style' | 'box' | 'features' | 'regions' | 'mesh' | OfMesh;
/** What is told of one mesh, and forgotten with it. */
const OF_MESH = ['colouring', 'section', 'peel', 'filter', 'mark'] as const;
type OfMesh = (typeof OF_MESH)[number];
const LOST =
  'The browser took the graphics away, often because memory ran out or the graphics driver restarted. ' +
  'Your meshes are safe; the picture comes back when the browser allows it.';

/** A view on a canvas, drawn by the viewer's module. */
export class CanvasView implements View {
  readonly #canvas: HTMLCanvasElement;
  readonly #module: Module;
  readonly #disposal = new AbortController();
  readonly #observer: ResizeObserver;
  #viewer: Viewer | null = null;

  /** What a viewer was told last of each thing it shows, in order: a new one is told all of it after a loss. */
  readonly #told = new Map<Told, (viewer: Viewer) => void>();
  #style = DEFAULT_STYLE;
  #nodes = 0;
  #selected: number | null = null;
  #camera: Float64Array | null = null;

  readonly #motion = new Motion(() => this.#lighten());
  /** Device pixels across and down, where the browser tells them exactly. */
  #device: [number, number] | null = null;
  #frame = 0;
  #frameMs = 0;
  #preparation: ReturnType<typeof setTimeout> | undefined;
  #flightStart: number | null = null;

  #regionDrag: (index: number, region: ViewRegion, phase: DragPhase) => void = () => {};
  #sectionDrag: (section: Section, phase: DragPhase) => void = () => {};
  #regionPick: (index: number | null) => void = () => {};
  #pick: (hit: FaceHit | null) => void = () => {};
  #lost: (message: string) => void = () => {};
  #restored: () => void = () => {};

  constructor(canvas: HTMLCanvasElement, module: Module) {
    this.#canvas = canvas;
    this.#module = module;
    this.#observer = new ResizeObserver(([entry]) => {
      const exact = entry?.devicePixelContentBoxSize?.[0];
      this.#device = exact ? [exact.inlineSize, exact.blockSize] : null;
      this.#resize();
    });
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
    this.#show(mesh, (viewer) => {
      if (mesh) viewer.setMesh(mesh.nodes, mesh.offsets ?? undefined, mesh.corners, keepCamera);
      else viewer.clearMesh();
    });
  }

  setHexes(mesh: DrawHexes, { keepCamera = false } = {}): void {
    this.#show(mesh, (viewer) => viewer.setHexes(mesh.nodes, mesh.hexes, keepCamera));
  }

  /** Shows another mesh, all of it and in one colour. */
  #show(mesh: DrawMesh | DrawHexes | null, show: (viewer: Viewer) => void): void {
    this.#nodes = (mesh?.nodes.length ?? 0) / 3;
    for (const what of ['mesh', ...OF_MESH] as const) this.#told.delete(what);
    this.#tell('mesh', show);
    this.#preparePicking();
  }

  /** Tells the viewer of something that it shows from now on. */
  #tell(what: Told, tell: (viewer: Viewer) => void): void {
    this.#told.set(what, tell);
    this.#change(tell);
  }

  /** Once the mesh is seen and the page has nothing else to do. */
  #preparePicking(): void {
    clearTimeout(this.#preparation);
    this.#preparation = setTimeout(() => this.#viewer?.preparePicking(), PREPARATION_MS);
  }

  setColouring(colouring: Colouring): void {
    this.#tell('colouring', (viewer) => {
      if (colouring.kind === 'plain') return viewer.colourPlain();
      const { values, range, map } = colouring;
      viewer.colourByValue(values, range[0], range[1], map);
    });
  }

  setSection(section: Section | null): void {
    this.#tell('section', (viewer) => viewer.setSection(section ? { kind: 'section', ...section } : undefined));
    this.#preparePicking();
  }

  onSectionDrag(callback: (section: Section, phase: DragPhase) => void): void {
    this.#sectionDrag = callback;
  }

  setPeel(layers: number): void {
    this.#tell('peel', (viewer) => viewer.peel(layers));
    this.#preparePicking();
  }

  layers(): number {
    return this.#viewer?.layers() ?? 0;
  }

  depthOf(cell: number): number {
    return this.#viewer?.depthOf(cell) ?? 0;
  }

  setFilter(filter: { values: Float32Array; range: [number, number] } | null): void {
    this.#tell('filter', (viewer) => viewer.filter(filter?.values, ...(filter?.range ?? ([0, 0] as const))));
    this.#preparePicking();
  }

  mark(cell: number | null): void {
    this.#tell('mark', (viewer) => viewer.mark(cell ?? undefined));
  }

  setFeatures(features: ViewFeature[]): void {
    this.#tell('features', (viewer) => viewer.setFeatures(features));
  }

  setBox(box: { min: Vector; max: Vector } | null): void {
    this.#tell('box', (viewer) => viewer.setBox(box ? new Float64Array([...box.min, ...box.max]) : undefined));
  }

  forward(): Vector {
    const [x = 0, y = 0, z = -1] = this.#viewer?.forward() ?? [];
    return [x, y, z];
  }

  setStyle(style: Partial<Style>): void {
    this.#style = { ...this.#style, ...style };
    this.#tell('style', (viewer) => viewer.setStyle(this.#drawnStyle()));
  }

  setRegions(regions: ViewRegion[], selected: number | null): void {
    this.#selected = selected;
    this.#tell('regions', (viewer) => viewer.setRegions(regions, selected ?? undefined));
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

  frameBox({ min, max }: { min: Vector; max: Vector }): void {
    this.#fly((viewer) => viewer.flyToBox(new Float64Array([...min, ...max])));
  }

  lookAlong(axis: Direction): void {
    this.#fly((viewer) => viewer.flyAlong(axis));
  }

  handlePositions(): { name: string; x: number; y: number }[] {
    return this.#viewer?.handles() ?? [];
  }

  screenshot(): Promise<Blob> {
    this.#motion.rest();
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
    return { frameMs: this.#frameMs, faces: this.#faces(), nodes: this.#nodes, gpuBytes: this.#viewer?.meshBytes() ?? 0 };
  }

  #faces(): number {
    return this.#viewer?.faceCount() ?? 0;
  }

  dispose(): void {
    this.#disposal.abort();
    this.#observer.disconnect();
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#preparation);
    this.#motion.rest();
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
      this.#motion.moved(this.#faces());
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

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#canvas;
    if (width === 0 || height === 0) return;
    const resolution = this.#motion.isMoving ? MOVING_RESOLUTION : 1;
    const [across, down] = this.#device ?? [width * devicePixelRatio, height * devicePixelRatio];
    this.#viewer?.resize(width, height, Math.round(across * resolution), Math.round(down * resolution));
    // At once: a canvas of a new size is empty until it is drawn.
    this.#draw();
  }

  /** The style, as it is drawn now: edges of a large mesh wait until it rests. */
  #drawnStyle(): Style {
    return { ...this.#style, edges: this.#style.edges && !this.#motion.isMoving };
  }

  #lighten(): void {
    this.#viewer?.setStyle(this.#drawnStyle());
    this.#resize();
  }

  /** Changes the camera. */
  #move(change: (viewer: Viewer) => void): void {
    this.#motion.moved(this.#faces());
    this.#change(change);
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
      for (const tell of this.#told.values()) this.#change(tell);
      if (this.#camera) this.#viewer.setCamera(this.#camera);
      this.#restored();
    } catch (cause) {
      this.#viewer = null;
      this.#lost(`The picture could not be brought back: ${messageOf(cause)}. Reload the page to see it again.`);
    }
  }

  #actions(): Actions {
    const act = (action: (viewer: Viewer) => void) => this.#change(action);
    let isDragging = false;
    return {
      press: (x, y, reach) => {
        isDragging = this.#viewer?.dragStart(x, y, reach) ?? false;
        if (!isDragging) act((viewer) => viewer.grab(x, y));
        return isDragging ? 'handle' : 'camera';
      },
      grabMiddle: () => act((viewer) => viewer.grabMiddle()),
      drag: (x, y) => {
        if (!isDragging) return;
        this.#motion.moved(this.#faces());
        act((viewer) => this.#dragged(viewer.dragTo(x, y), 'drag'));
      },
      release: () => {
        if (isDragging) act((viewer) => this.#dragged(viewer.dragged(), 'end'));
        isDragging = false;
        act((viewer) => viewer.release());
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
      orbit: (yaw, pitch) => this.#move((viewer) => viewer.orbit(yaw, pitch)),
      pan: (x, y) => this.#move((viewer) => viewer.pan(x, y)),
      dolly: (x, y, factor) => this.#move((viewer) => viewer.dolly(x, y, factor)),
      setPivot: (x, y) => this.#fly((viewer) => viewer.setPivot(x, y)),
      frameAll: () => this.frameAll(),
    };
  }

  /** A handle has moved what it belongs to. */
  #dragged(moved: ViewRegion | ({ kind: 'section' } & Section), phase: DragPhase): void {
    if (moved.kind === 'section') {
      this.#sectionDrag({ normal: moved.normal, offset: moved.offset }, phase);
    } else if (this.#selected !== null) this.#regionDrag(this.#selected, moved, phase);
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
