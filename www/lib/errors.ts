/** What a worker says of an error: plain data, since classes do not survive the way between threads. */
export interface Failure {
  kind: 'input' | 'options' | 'limit' | 'cancelled' | 'internal';
  code: string;
  message: string;
  line?: number;
}

/** Every error that this package throws on purpose. */
export class HexmillError extends Error {
  /** A stable name of what is wrong, such as `obj-index-out-of-range`; messages may change, codes do not. */
  readonly code: string;
  /** The line of the input file that is at fault, from 1, where there is one. */
  declare readonly line?: number;

  constructor(code: string, message: string, line?: number) {
    super(message);
    this.name = 'HexmillError';
    this.code = code;
    if (line !== undefined) this.line = line;
  }
}

/** The file or the arrays given cannot be used. The message says where and what to do. */
export class InputError extends HexmillError {
  override name = 'InputError';
}

/** An option is unknown, out of range, or cannot be met for this input. */
export class OptionsError extends HexmillError {
  override name = 'OptionsError';
}

/** The mesh would become larger than `maxQuads` allow (code `too-many-quads`) or memory holds (`memory-exceeded`). */
export class LimitError extends HexmillError {
  override name = 'LimitError';
}

/** The caller's `AbortSignal` stopped the work. Its `name` is `AbortError`, as everywhere on the platform. */
export class CancelledError extends HexmillError {
  override name = 'AbortError';

  constructor() {
    super('cancelled', 'The work was cancelled.');
  }
}

/**
 * The mesher failed: a bug, or memory ran out (code `out-of-memory`). Surfaces and meshes stay good: the next call finds
 * a fresh mesher, which loads them again.
 */
export class InternalError extends HexmillError {
  override name = 'InternalError';
}

/** The error that a failure stands for. */
export function errorOf({ kind, code, message, line }: Failure): HexmillError {
  switch (kind) {
    case 'input':
      return new InputError(code, message, line);
    case 'options':
      return new OptionsError(code, message, line);
    case 'limit':
      return new LimitError(code, message, line);
    case 'cancelled':
      return new CancelledError();
    case 'internal':
      return new InternalError(code, message, line);
  }
}

/** What is left of any thrown value on its way out of a worker. */
export function failureOf(thrown: unknown): Failure {
  if (isFailure(thrown)) return thrown;
  const message = thrown instanceof Error ? thrown.message : String(thrown);
  return { kind: 'internal', code: 'unexpected', message };
}

function isFailure(thrown: unknown): thrown is Failure {
  return typeof thrown === 'object' && thrown !== null && 'kind' in thrown && 'code' in thrown;
}
