// The calls as a worker answers them, over the bindings of src/web/.

import type * as hexes from '../wasm/hexes/hexes.js';
import type * as mesher from '../wasm/mesher/mesher.js';
import type * as solids from '../wasm/solids/solids.js';
import type {
  Call,
  CallName,
  Calls,
  Candidates,
  FileData,
  HexData,
  HexedSolidData,
  HexMeshData,
  HexSource,
  MadeHexData,
  QuadArrays,
  QuadData,
  Source,
  SurfaceData,
  SurfaceSource,
} from './protocol.js';

/** The bindings of the modules: a worker has those of one of them. */
export type Bindings = Pick<typeof mesher, 'Surface' | 'Refinement' | 'refineQuads' | 'estimateQuads' | 'exportQuads' | 'quadQuality'> &
  Pick<typeof hexes, 'HexMesh' | 'HexRefinement' | 'refineHexes' | 'planHexes' | 'exportHexes' | 'hexQuality'> &
  Pick<typeof solids, 'planSolid' | 'meshSolid' | 'exportSolid' | 'solidDistances'>;

/** What a call gives and which of its buffers may move to the calling thread. */
interface Answer<Result> {
  result: Result;
  transfer: ArrayBufferLike[];
}

type Handlers = { [N in CallName]: (takes: Calls[N]['takes']) => Answer<Calls[N]['gives']> };

/** Calls that go on with the refinement under way. */
const GOES_ON: ReadonlySet<CallName> = new Set(['advance', 'finish', 'finishHexes', 'planBegunHexes']);

/** The surfaces or hex meshes of one worker and the refinement under way, if any. */
export class Meshing {
  readonly #bindings: Bindings;
  readonly #surfaces = new Map<number, mesher.Surface>();
  readonly #hexMeshes = new Map<number, hexes.HexMesh>();
  #refinement: mesher.Refinement | null = null;
  #hexRefinement: hexes.HexRefinement | null = null;

  constructor(bindings: Bindings) {
    this.#bindings = bindings;
  }

  /** Answers a call; throws what the bindings throw. */
  answer(call: Call): Answer<unknown> {
    if (!GOES_ON.has(call.name)) this.#endRefinement();
    const handler = this.#handlers[call.name] as (takes: Call) => Answer<unknown>;
    return handler(call);
  }

  /** Frees an input. */
  drop(input: number): void {
    for (const inputs of [this.#surfaces, this.#hexMeshes]) {
      inputs.get(input)?.free();
      inputs.delete(input);
    }
  }

  readonly #handlers: Handlers = {
    load: ({ input, source }) => {
      this.#load(input, source);
      return source.want === 'surface' ? surfaceData(this.#surface(input)) : hexMeshData(this.#hexes(input));
    },
    reload: ({ input, source }) => {
      this.#load(input, source);
      return { result: null, transfer: [] };
    },
    estimate: ({ input, options }) => ({
      result: this.#bindings.estimateQuads(this.#surface(input), options),
      transfer: [],
    }),
    refine: ({ input, options }) => quadData(this.#bindings.refineQuads(this.#surface(input), options)),
    begin: ({ input, options }) => {
      this.#refinement = new this.#bindings.Refinement(this.#surface(input), options);
      return candidates(this.#refinement);
    },
    advance: ({ targets }) => {
      const refinement = underWay(this.#refinement ?? this.#hexRefinement);
      return refinement.advance(targets) ? candidates(refinement) : { result: null, transfer: [] };
    },
    finish: () => {
      const refinement = underWay(this.#refinement);
      this.#refinement = null;
      return quadData(refinement.finish());
    },
    export: ({ input, mesh, format }) => {
      const { nodes, quads, level, parent } = mesh;
      const result = this.#bindings.exportQuads(this.#surface(input), nodes, quads, level, parent, format);
      return { result, transfer: [result.buffer] };
    },
    quality: ({ mesh, metric }) => {
      const result = this.#bindings.quadQuality(mesh.nodes, mesh.quads, metric);
      return { result, transfer: [result.buffer] };
    },
    planHexes: ({ input, options }) => ({
      result: this.#bindings.planHexes(this.#hexes(input), options),
      transfer: [],
    }),
    beginHexes: ({ input, options }) => {
      this.#hexRefinement = new this.#bindings.HexRefinement(this.#hexes(input), options);
      return candidates(this.#hexRefinement);
    },
    planBegunHexes: () => {
      const refinement = underWay(this.#hexRefinement);
      this.#hexRefinement = null;
      return { result: refinement.plan(), transfer: [] };
    },
    finishHexes: () => {
      const refinement = underWay(this.#hexRefinement);
      this.#hexRefinement = null;
      return hexData(refinement.finish());
    },
    refineHexes: ({ input, options }) => hexData(this.#bindings.refineHexes(this.#hexes(input), options)),
    exportHexes: ({ input, mesh, format }) => {
      const { nodes, hexes, level, parent, groupedFaces } = mesh;
      const from = this.#hexes(input);
      const result = this.#bindings.exportHexes(from, nodes, hexes, level, parent, groupedFaces, format);
      return { result, transfer: [result.buffer] };
    },
    hexQuality: ({ mesh, metric }) => {
      const result = this.#bindings.hexQuality(mesh.nodes, mesh.hexes, metric);
      return { result, transfer: [result.buffer] };
    },
    planSolid: ({ input, options }) => ({
      result: this.#bindings.planSolid(this.#solid(input), options),
      transfer: [],
    }),
    meshSolid: ({ input, options }) => solidData(this.#bindings.meshSolid(this.#solid(input), options)),
    exportSolid: ({ mesh, file }) => {
      const result = this.#bindings.exportSolid(mesh.nodes, mesh.hexes, mesh.groupedFaces, mesh.bodies, mesh.middleNodes, mesh.secondOrder, file);
      return { result, transfer: [result.buffer] };
    },
    solidDistances: ({ input, mesh }) => {
      const result = this.#bindings.solidDistances(this.#solid(input), mesh.nodes, mesh.hexes);
      return { result, transfer: [result.buffer] };
    },
  };

  /** Loads an input in the place of the one of that number, if there is one. */
  #load(input: number, source: Source): void {
    this.drop(input);
    if (source.want === 'surface') this.#surfaces.set(input, this.#loadedSurface(source.from));
    else this.#hexMeshes.set(input, this.#loadedHexes(source.from));
  }

  #loadedSurface(from: SurfaceSource): mesher.Surface {
    const { Surface } = this.#bindings;
    if ('content' in from) return Surface.read(bytesOf(from), from.format);
    return Surface.fromArrays(from.nodes, from.offsets, from.corners);
  }

  #loadedHexes(from: HexSource): hexes.HexMesh {
    const { HexMesh } = this.#bindings;
    if ('content' in from) return HexMesh.read(bytesOf(from), from.format);
    return 'hexes' in from ? HexMesh.fromArrays(from.nodes, from.hexes) : HexMesh.grid(from);
  }

  #surface(input: number): mesher.Surface {
    const loaded = this.#surfaces.get(input);
    if (!loaded) throw new Error(`surface ${input} is not loaded`);
    return loaded;
  }

  /** A surface, as the module of solids has the class: made from the same Rust as that of the module of surfaces. */
  #solid(input: number): solids.Surface {
    return this.#surface(input) as unknown as solids.Surface;
  }

  #hexes(input: number): hexes.HexMesh {
    const loaded = this.#hexMeshes.get(input);
    if (!loaded) throw new Error(`hex mesh ${input} is not loaded`);
    return loaded;
  }

  #endRefinement(): void {
    this.#refinement?.free();
    this.#hexRefinement?.free();
    this.#refinement = this.#hexRefinement = null;
  }
}

function bytesOf({ content }: FileData): Uint8Array {
  return typeof content === 'string' ? new TextEncoder().encode(content) : content;
}

function surfaceData(surface: mesher.Surface): Answer<SurfaceData> {
  const arrays = { nodes: surface.nodes(), offsets: surface.offsets(), corners: surface.corners() };
  return { result: { kind: 'surface', info: surface.info(), ...arrays }, transfer: buffersOf(arrays) };
}

function hexMeshData(mesh: hexes.HexMesh): Answer<HexMeshData> {
  const arrays = { nodes: mesh.nodes(), hexes: mesh.hexes() };
  return { result: { kind: 'hexes', info: mesh.info(), ...arrays }, transfer: buffersOf(arrays) };
}

function underWay<R>(refinement: R | null): R {
  if (!refinement) throw new Error('no refinement is under way');
  return refinement;
}

function candidates(refinement: mesher.Refinement | hexes.HexRefinement): Answer<Candidates> {
  const result: Candidates = { centers: refinement.centers(), longest: refinement.longest() };
  return { result, transfer: buffersOf({ ...result }) };
}

function quadData(refined: mesher.Quads): Answer<QuadData> {
  try {
    const arrays: QuadArrays = { nodes: refined.nodes(), quads: refined.quads(), level: refined.level(), parent: refined.parent() };
    const result: QuadData = { ...arrays, hash: refined.hash(), quality: refined.quality(), defects: refined.defects(), capped: refined.capped() };
    return { result, transfer: buffersOf({ ...arrays }) };
  } finally {
    refined.free();
  }
}

function hexData(refined: hexes.Hexes): Answer<HexData> {
  try {
    const arrays = { level: refined.level(), parent: refined.parent(), groupedFaces: refined.groups() };
    const told = { capped: refined.capped(), added: refined.added(), stages: refined.stages(), turned: refined.turned() };
    return withMesh(refined.arrays(), arrays, told);
  } finally {
    refined.free();
  }
}

function solidData(hexed: solids.HexedSolid): Answer<HexedSolidData> {
  try {
    const arrays = { groupedFaces: hexed.sides(), bodies: hexed.bodies(), middleNodes: hexed.middleNodes(), secondOrder: hexed.secondOrder() };
    const told = { report: hexed.report() };
    return withMesh(hexed.arrays(), arrays, told);
  } finally {
    hexed.free();
  }
}

/** A hex mesh with what else is known of it: as arrays, and as told. */
function withMesh<A extends Record<string, ArrayBufferView>, T>(mesh: hexes.HexArrays | solids.HexArrays, arrays: A, told: T): Answer<MadeHexData & A & T> {
  try {
    const all = { nodes: mesh.nodes(), hexes: mesh.hexes(), ...arrays };
    const result = { ...all, hash: mesh.hash(), quality: mesh.quality(), defects: mesh.defects(), ...told };
    return { result, transfer: buffersOf(all) };
  } finally {
    mesh.free();
  }
}

function buffersOf(arrays: Record<string, ArrayBufferView>): ArrayBufferLike[] {
  return Object.values(arrays).map((array) => array.buffer);
}
