// Copies of what the caller gave: they outlive workers, and the caller's later changes do not reach them.

import { InputError } from './errors.js';
import { inputFormat } from './options.js';
import type { HexInput, InputOptions, SurfaceInput } from './options.js';
import type { FileData, Source } from './protocol.js';

/** The source of a surface. */
export async function surfaceSource(input: SurfaceInput, options: InputOptions): Promise<Source> {
  const file = await fileData(input, options);
  if (file) return { want: 'surface', from: file };
  if (isArrays(input) && input.nodes instanceof Float64Array && 'corners' in input && input.corners instanceof Uint32Array) {
    const { nodes, offsets, corners } = input;
    return { want: 'surface', from: { nodes: nodes.slice(), offsets: offsets?.slice(), corners: corners.slice() } };
  }
  throw unknown('text nor bytes nor { nodes: Float64Array, corners: Uint32Array }');
}

/** The source of a hex mesh. */
export async function hexSource(input: HexInput, options: InputOptions): Promise<Source> {
  const file = await fileData(input, options);
  if (file) return { want: 'hexes', from: file };
  if (isArrays(input) && input.nodes instanceof Float64Array && 'hexes' in input && input.hexes instanceof Uint32Array) {
    return { want: 'hexes', from: { nodes: input.nodes.slice(), hexes: input.hexes.slice() } };
  }
  throw unknown('text nor bytes nor { nodes: Float64Array, hexes: Uint32Array }');
}

/** The file that `input` is; null if it is none. */
async function fileData(input: unknown, options: InputOptions): Promise<FileData | null> {
  if (typeof input === 'string') return { format: inputFormat(options), content: input };
  if (input instanceof Blob) {
    const name = options.name ?? ('name' in input ? String(input.name) : undefined);
    return { format: inputFormat({ ...options, name }), content: new Uint8Array(await input.arrayBuffer()) };
  }
  if (input instanceof ArrayBuffer) return { format: inputFormat(options), content: new Uint8Array(input.slice(0)) };
  if (input instanceof Uint8Array) return { format: inputFormat(options), content: Uint8Array.from(input) };
  return null;
}

function isArrays<I>(input: I): input is Extract<I, { nodes: Float64Array }> {
  return typeof input === 'object' && input !== null && 'nodes' in input;
}

function unknown(accepted: string): InputError {
  return new InputError('input-unknown', `The input is neither ${accepted}.`);
}
