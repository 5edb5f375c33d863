import { describe, expect, it } from 'vitest';

import { CancelledError, HexmillError, errorOf, failureOf } from '../../www/lib/errors.js';
import { inputFormat, plainOptions } from '../../www/lib/options.js';

describe('the format of an input', () => {
  it.each([
    [{}, 'obj'],
    [{ name: 'car.obj' }, 'obj'],
    [{ name: 'Wing.VTU' }, 'vtu'],
    [{ name: 'a.b.mesh' }, 'medit'],
    [{ name: 'car.obj', format: 'vtk' as const }, 'vtk'],
    [{ name: 'notes' }, 'obj'],
  ])('%o is %s', (options, format) => {
    expect(inputFormat(options)).toBe(format);
  });
});

describe('options on their way to the mesher', () => {
  it('are without undefined entries', () => {
    expect(plainOptions({ levels: 2, edgeLength: undefined })).toEqual({ levels: 2 });
  });

  it('are refused if misspelt', () => {
    expect(() => plainOptions({ edgeLenght: 1 } as object)).toThrow(
      expect.objectContaining({ code: 'option-unknown', message: expect.stringContaining('edgeLength') }),
    );
  });
});

describe('errors on their way from the mesher', () => {
  it.each(['input', 'options', 'limit', 'internal'] as const)('%s errors keep code, message and line', (kind) => {
    const error = errorOf({ kind, code: 'some-code', message: 'words', line: 12 });
    expect(error).toBeInstanceOf(HexmillError);
    expect(error).toMatchObject({ code: 'some-code', message: 'words', line: 12 });
    expect(error.name.toLowerCase()).toBe(`${kind}error`);
  });

  it('become AbortErrors when cancelled', () => {
    const error = errorOf({ kind: 'cancelled', code: 'cancelled', message: '' });
    expect(error).toBeInstanceOf(CancelledError);
    expect(error.name).toBe('AbortError');
    expect('line' in error).toBe(false);
  });

  it('are internal if nobody expected them', () => {
    expect(failureOf(new TypeError('x is null'))).toEqual({ kind: 'internal', code: 'unexpected', message: 'x is null' });
  });
});
