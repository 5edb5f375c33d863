/**
 * The state of the page and what can be done with it. Panels read the signals and call the methods;
 * the viewport draws what the signals say. No DOM here.
 */

import { batch, computed, effect, signal } from '@preact/signals-core';
import { HexMesh } from 'hexmill';
import type { Mesher, OutputFormat, SolidPlan } from 'hexmill';
import { complaint } from './complaint.js';
import type { Complaint } from './complaint.js';
import type { Example } from './examples.js';
import { stem, WRITABLE } from './formats.js';
import { History } from './history.js';
import { debounced, Latest } from './latest.js';
import { DEFAULT_FINENESS, fitting } from './fitting.js';
import { countedCells, exported, groupsOf, inputOf, jobOf, Maker } from './job.js';
import type { Forecast, Input, Made } from './job.js';
import { USUAL } from './guide.js';
import type { Guide } from './guide.js';
import { formatLink } from './link.js';
import type { Entry, GivenSettings } from './link.js';
import { Log } from './log.js';
import { DEFAULTS, newId, region } from './settings.js';
import type { HexSettings, Job, Region, Settings, Shape, ShapeKind, SolidSettings, Vec3 } from './settings.js';
import { center, diagonal, extent, fault, newShape, tidy, translated } from './shape.js';
import type { Bounds } from './shape.js';
import { bytes, counted, doing, duration, rounded } from './text.js';

/** A finished mesh with what made it. */
export interface Result extends Made {
  readonly input: Input;
  readonly settings: Settings;
  readonly milliseconds: number;
}

/** Work that a person waits for. */
export interface Running {
  readonly what: 'reading' | 'meshing' | 'writing';
  readonly stage: string;
  /** 0 to 1 within the stage; null when unknown. */
  readonly fraction: number | null;
  readonly since: number;
}

const ESTIMATE_DELAY = 120;
/** Live meshing stops above this many cells: hexes take longer, as their transitions are smoothed. */
const LIVE = { quad: 400_000, hex: 5_000 } as const;

export class Workbench {
  readonly log = new Log();
  readonly input = signal<Input | null>(null);
  readonly settings = signal<Settings>(DEFAULTS);
  /** Id of the region that has handles, or of the guide, whose numbers are shown. */
  readonly selected = signal<number | null>(null);
  readonly estimate = signal<Forecast | null>(null);
  readonly #estimated = signal<Settings | null>(null);
  /** Whether the estimate is of the settings as they now are. */
  readonly isEstimated = computed(() => this.estimate.value !== null && this.#estimated.value === this.settings.value);
  readonly running = signal<Running | null>(null);
  /** Milliseconds after which meshing was cancelled; null unless that was the last of it. */
  readonly cancelled = signal<number | null>(null);
  readonly result = signal<Result | null>(null);
  /** What went wrong, beside what caused it. */
  readonly trouble = {
    engine: signal<Complaint | null>(null),
    input: signal<Complaint | null>(null),
    guide: signal<Complaint | null>(null),
    estimate: signal<Complaint | null>(null),
    mesh: signal<Complaint | null>(null),
    output: signal<Complaint | null>(null),
  };
  readonly shows = signal<'input' | 'mesh'>('input');
  readonly live = signal(false);
  /** Where the model was last picked: where the next region goes. */
  readonly pickedPoint = signal<Vec3 | null>(null);
  readonly threads = signal<number | null>(null);
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);

  readonly bounds = computed<Bounds | null>(() => {
    const input = this.input.value;
    const info = (input?.surface ?? input?.hexes)?.info;
    return info ? { min: info.bounds.min as Vec3, max: info.bounds.max as Vec3 } : null;
  });
  /** The first thing in the settings that no mesh can be made with. */
  readonly fault = computed<string | null>(() => {
    for (const [index, { shape }] of this.settings.value.regions.entries()) {
      const problem = fault(shape);
      if (problem) return `Region ${index + 1}: ${problem}`;
    }
    return null;
  });
  /** What is made; quads as long as there is no input. */
  readonly job = computed<Job>(() => (this.input.value ? jobOf(this.input.value, this.settings.value) : 'quads'));
  /** Whether hexes are made. */
  readonly makesHexes = computed(() => this.job.value !== 'quads');
  /** What was last found of the solid that is to be filled. */
  readonly solid = computed<SolidPlan | null>(() => (this.job.value === 'solid' ? (this.estimate.value?.solid ?? null) : null));
  /** The most cells that are made live. */
  readonly liveLimit = computed(() => LIVE[this.makesHexes.value ? 'hex' : 'quad']);
  /** Whether the result is of the input and the settings as they now are. */
  readonly isCurrent = computed(() => {
    const result = this.result.value;
    return result !== null && result.input === this.input.value && result.settings === this.settings.value;
  });

  readonly mesher: Promise<Mesher>;
  readonly #maker: Maker;
  readonly #history = new History<Settings>();
  readonly #work = new Latest();
  readonly #estimates = new Latest();

  constructor(mesher: Promise<Mesher>) {
    this.mesher = mesher;
    this.#maker = new Maker(mesher);
    mesher.then(
      (ready) => {
        this.threads.value = ready.threads;
        this.log.add('info', `Mesher ready: ${counted(ready.threads, 'thread')}.`);
      },
      (error: unknown) => {
        this.trouble.engine.value = complaint(error);
        this.log.add('error', `The mesher did not start: ${complaint(error).text}`);
      },
    );
    const estimate = debounced(() => void this.#estimate(), ESTIMATE_DELAY);
    effect(() => {
      if (this.input.value && this.settings.value && this.live.value !== null) estimate();
    });
  }

  // ---- input

  /** Reads a model. If it cannot be read, what was loaded stays. Hexes are shown with their quality at once. */
  async load(name: string, content: () => Promise<ArrayBuffer>, example: Example | null = null, settings: GivenSettings = {}): Promise<void> {
    this.trouble.input.value = null;
    try {
      const model = await this.#busy('reading', async (signal) => {
        const mesher = await this.mesher;
        return await mesher.loadFile(await content(), { name, signal });
      });
      if (model === null) return;
      batch(() => {
        this.input.value = inputOf(name, example, model);
        this.settings.value = fitting(model, settings);
        this.#forget();
      });
      const cells = model instanceof HexMesh ? counted(model.info.hexes, 'hex', 'hexes') : counted(model.info.faces, 'face');
      this.log.add('info', `Read ${name}: ${cells}, ${counted(model.info.nodes, 'node')}.`);
      const linearized = model instanceof HexMesh ? model.info.linearized : 0;
      if (linearized > 0) this.log.add('warning', `${name}: ${counted(linearized, 'hex', 'hexes')} of the second order read as linear: the nodes on edges, on faces and inside are left out`);
      const hidden = model.info.hidden;
      if (hidden > 0) this.log.add('warning', `${name}: ${counted(hidden, 'cell is', 'cells are')} left out, as hidden or of another piece (vtkGhostType)`);
      const arrays = model.info.droppedArrays;
      if (arrays.length > 0) this.log.add('warning', `${name}: these arrays are no tags of cells, and are left out: ${arrays.join(', ')}`);
      for (const defect of model.info.defects) this.log.add('warning', `${name}: ${defect}`);
      if (model instanceof HexMesh) await this.mesh();
    } catch (error) {
      const problem = complaint(error);
      this.trouble.input.value = { ...problem, about: name };
      this.log.add('error', `${name}: ${problem.text}`);
    }
  }

  /** Loads an example that ships with the page, from `url`. */
  async loadExample(example: Example, url: string, settings: GivenSettings = {}): Promise<void> {
    await this.load(
      example.file,
      async () => {
        const answer = await fetch(url);
        if (!answer.ok) throw new Error(`The example could not be fetched (HTTP ${answer.status}). Reload the page and try again.`);
        return await answer.arrayBuffer();
      },
      example,
      settings,
    );
  }

  #forget(): void {
    this.#estimates.cancel();
    this.result.value = null;
    this.estimate.value = null;
    this.shows.value = 'input';
    this.selected.value = null;
    this.pickedPoint.value = null;
    this.cancelled.value = null;
    this.trouble.guide.value = null;
    this.trouble.mesh.value = null;
    this.trouble.output.value = null;
    this.#history.clear();
    this.#syncHistory();
  }

  // ---- settings

  /** Changes settings. Edits of the same `key` in quick succession are undone together. */
  edit(change: Partial<Settings>, key = Object.keys(change).join()): void {
    this.#history.record(this.settings.value, key);
    this.settings.value = { ...this.settings.value, ...change };
    this.#syncHistory();
  }

  editHexes(change: Partial<HexSettings>): void {
    this.edit({ hexes: { ...this.settings.value.hexes, ...change } }, `hexes ${Object.keys(change).join()}`);
  }

  editSolid(change: Partial<SolidSettings>): void {
    this.edit({ solid: { ...this.settings.value.solid, ...change } }, `solid ${Object.keys(change).join()}`);
  }

  /** Chooses what is made of the surface. */
  choose(job: Job): void {
    this.edit({ job });
  }

  undo(): void {
    this.settings.value = this.#history.undo(this.settings.value);
    this.#syncHistory();
  }

  redo(): void {
    this.settings.value = this.#history.redo(this.settings.value);
    this.#syncHistory();
  }

  #syncHistory(): void {
    this.canUndo.value = this.#history.canUndo;
    this.canRedo.value = this.#history.canRedo;
    const { regions, guides } = this.settings.value;
    if (![...regions, ...guides].some(({ id }) => id === this.selected.value)) this.selected.value = null;
  }

  // ---- regions

  /** Adds a region at the picked point, else at the model's centre, and selects it. */
  addRegion(kind: ShapeKind): void {
    const bounds = this.bounds.value;
    if (!bounds) return;
    const size = rounded(this.usualEdge() / 4);
    const shape = newShape(kind, this.pickedPoint.value ?? center(bounds), bounds);
    this.#append(region(shape, { by: 'size', size }));
  }

  /** How long edges are where nothing asks for shorter ones, or would be by default. */
  usualEdge(): number {
    const { hexes, solid, by, edgeLength } = this.settings.value;
    if (this.job.value === 'solid') return solid.edgeLength;
    const bounds = this.bounds.value;
    if (this.makesHexes.value) return this.input.value?.hexes?.info.meanEdge ?? hexes.spacing;
    return by === 'length' || !bounds ? edgeLength : diagonal(bounds) * DEFAULT_FINENESS;
  }

  duplicateRegion(id: number): void {
    const original = this.settings.value.regions.find((r) => r.id === id);
    if (!original) return;
    this.#append(region(tidy(translated(original.shape, [extent(original.shape), 0, 0])), original.target));
  }

  #append(added: Region): void {
    batch(() => {
      this.edit({ regions: [...this.settings.value.regions, added] }, `add ${added.id}`);
      this.selected.value = added.id;
    });
  }

  deleteRegion(id: number): void {
    this.edit({ regions: this.settings.value.regions.filter((r) => r.id !== id) }, `delete ${id}`);
  }

  editRegion(id: number, change: Partial<Pick<Region, 'shape' | 'target'>>): void {
    const regions = this.settings.value.regions.map((r) => (r.id === id ? { ...r, ...change } : r));
    this.edit({ regions }, `region ${id} ${Object.keys(change).join()}`);
  }

  /** A handle of region number `index` was dragged. */
  dragRegion(index: number, shape: Shape, phase: 'drag' | 'end'): void {
    const dragged = this.settings.value.regions[index];
    if (!dragged) return;
    this.editRegion(dragged.id, { shape: phase === 'end' ? tidy(shape) : shape });
    if (phase === 'end') this.#history.seal();
  }

  /** Deletes the region or the guide that is selected. */
  deleteSelected(): void {
    const id = this.selected.value;
    if (id === null) return;
    if (this.settings.value.guides.some((guide) => guide.id === id)) this.deleteGuide(id);
    else this.deleteRegion(id);
  }

  // ---- surfaces that hexes of a file are refined at

  /** Whether hexes can be refined at surfaces of other files. */
  readonly takesGuides = computed(() => this.input.value?.hexes != null);

  /** Reads a surface that the hexes are to be refined at, and selects it. */
  async addGuide(name: string, content: () => Promise<ArrayBuffer>): Promise<void> {
    this.trouble.guide.value = null;
    const input = this.input.value;
    try {
      const surface = await this.#busy('reading', async (signal) => {
        const mesher = await this.mesher;
        return await mesher.load(await content(), { name, signal });
      });
      if (surface === null || input !== this.input.value) return;
      const added: Guide = { id: newId(), name, surface, ...USUAL };
      batch(() => {
        this.edit({ guides: [...this.settings.value.guides, added] }, `add ${added.id}`);
        this.selected.value = added.id;
      });
      this.log.add('info', `Read ${name}: ${counted(surface.info.faces, 'face')} to refine at.`);
    } catch (error) {
      const problem = complaint(error);
      this.trouble.guide.value = { ...problem, about: name };
      this.log.add('error', `${name}: ${problem.text}`);
    }
  }

  editGuide(id: number, change: Partial<Pick<Guide, 'at' | 'distance' | 'target'>>): void {
    const guides = this.settings.value.guides.map((guide) => (guide.id === id ? { ...guide, ...change } : guide));
    this.edit({ guides }, `guide ${id} ${Object.keys(change).join()}`);
  }

  deleteGuide(id: number): void {
    this.edit({ guides: this.settings.value.guides.filter((guide) => guide.id !== id) }, `delete ${id}`);
  }

  // ---- estimate and mesh

  async #estimate(): Promise<void> {
    const input = this.input.value;
    if (!input || this.fault.value) return this.#estimates.cancel();
    try {
      const settings = this.settings.value;
      const estimate = await this.#estimates.run((signal) => this.#maker.foretell(input, settings, signal));
      if (!estimate) return;
      batch(() => {
        this.estimate.value = estimate;
        this.#estimated.value = settings;
        this.trouble.estimate.value = null;
      });
      this.#remesh();
    } catch (error) {
      batch(() => {
        this.estimate.value = null;
        this.trouble.estimate.value = complaint(error);
      });
    }
  }

  #remesh(): void {
    const estimate = this.estimate.value;
    if (this.live.value && !this.isCurrent.value && estimate && estimate.cells <= this.liveLimit.value) void this.mesh();
  }

  /** Makes the mesh; a later call overtakes an earlier one, and what was meshed before stays until then. */
  async mesh(): Promise<void> {
    const input = this.input.value;
    const settings = this.settings.value;
    if (!input || this.fault.value) return;
    this.trouble.mesh.value = null;
    const started = performance.now();
    try {
      const made = await this.#busy('meshing', (signal, onProgress) => this.#maker.make(input, settings, { signal, onProgress }));
      if (made === null) return;
      const milliseconds = performance.now() - started;
      const { mesh } = made;
      batch(() => {
        this.result.value = { ...made, input, settings, milliseconds };
        this.shows.value = 'mesh';
        this.trouble.output.value = null;
      });
      const size = `${countedCells(mesh)}, ${counted(mesh.nodes.length / 3, 'node')}`;
      this.log.add('info', `Meshed ${input.name} in ${duration(milliseconds)}: ${size}, hash ${mesh.hash}.`);
      for (const defect of mesh.defects) this.log.add('warning', defect);
    } catch (error) {
      const problem = complaint(error);
      this.trouble.mesh.value = problem;
      this.log.add('error', `Not meshed: ${problem.text}`);
    }
  }

  /** Stops what runs. */
  cancel(): void {
    const running = this.running.value;
    if (!running) return;
    this.#work.cancel();
    this.running.value = null;
    const spent = performance.now() - running.since;
    if (running.what === 'meshing') this.cancelled.value = spent;
    const reached = running.stage ? `, while ${doing(running.stage)}` : '';
    this.log.add('info', `Cancelled ${running.what} after ${duration(spent)}${reached}.`);
  }

  /** The mesh as a file; null if it could not be written. */
  async export(format: OutputFormat): Promise<{ name: string; content: Uint8Array } | null> {
    const result = this.result.value;
    const known = WRITABLE.find((info) => info.format === format);
    if (!result || !known) return null;
    this.trouble.output.value = null;
    try {
      const content = await this.#busy('writing', (signal) => exported(result.mesh, format, signal));
      if (content === null) return null;
      const name = `${stem(result.input.name)}.${known.extension}`;
      this.log.add('info', `Wrote ${name}: ${bytes(content.byteLength)}.`);
      for (const loss of groupsOf(result.mesh, result.input)?.info.losses[format] ?? []) this.log.add('warning', `${name}: ${loss}`);
      return { name, content };
    } catch (error) {
      const problem = complaint(error);
      this.trouble.output.value = problem;
      this.log.add('error', `Not written: ${problem.text}`);
      return null;
    }
  }

  /** The link that makes this job again and shows it so; null unless the input is an example. */
  link(view: readonly Entry[] = []): string | null {
    const example = this.input.value?.example;
    return example ? `#${formatLink(example.id, this.settings.value, view)}` : null;
  }

  async #busy<T>(what: Running['what'], work: (signal: AbortSignal, onProgress: (p: { stage: string; fraction: number }) => void) => Promise<T>): Promise<T | null> {
    const own: Running = { what, stage: '', fraction: null, since: performance.now() };
    let shown: Running = own;
    this.cancel();
    this.cancelled.value = null;
    this.running.value = own;
    try {
      return await this.#work.run((signal) =>
        work(signal, ({ stage, fraction }) => {
          if (signal.aborted) return;
          shown = { ...own, stage, fraction };
          this.running.value = shown;
        }),
      );
    } finally {
      if (this.running.value === shown) this.running.value = null;
    }
  }
}
