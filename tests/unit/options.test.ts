import { describe, expect, it } from 'vitest';

import { CancelledError, HexmillError, errorOf, failureOf } from '../../www/lib/errors.js';
import { nearest } from '../../www/lib/known.js';
import { inputFormat, plainOptions } from '../../www/lib/options.js';

describe('the format of an input', () => {
  it.each([
    [{}, undefined],
    [{ name: 'car.obj' }, 'obj'],
    [{ name: 'Wing.VTU' }, 'vtu'],
    [{ name: 'part.stl' }, 'stl'],
    [{ name: 'a.b.mesh' }, 'medit'],
    [{ name: 'car.obj', format: 'vtk' as const }, 'vtk'],
    [{ name: 'notes' }, undefined],
    [{ name: 'part.bin' }, undefined],
    [{ name: 'a.constructor' }, undefined],
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
      expect.objectContaining({ code: 'option-unknown', message: expect.stringContaining('Did you mean edgeLength?') }),
    );
  });

  it.each([
    [{ kind: 'sphere', centre: [0, 0, 0], radius: 1, level: 2 }, /regions\[1\], a sphere: key centre\. Did you mean center\?/],
    [{ kind: 'box', min: [0, 0, 0], max: [1, 1, 1], radius: 1, level: 2 }, /a box: key radius\. There are kind, min, max, rotation/],
  ])('are refused if a region has the key of none, as in %j', (region, message) => {
    const regions = [{ kind: 'sphere', center: [0, 0, 0], radius: 1, size: 1 }, region];
    expect(() => plainOptions({ regions } as object)).toThrow(
      expect.objectContaining({ code: 'option-unknown', message: expect.stringMatching(message) }),
    );
  });
});

describe('the name that was meant', () => {
  const known = ['edgeLength', 'levels', 'maxLevels', 'maxQuads', 'gradation'];
  it.each([
    ['edgelength', 'edgeLength'],
    ['egdeLength', 'edgeLength'],
    ['level', 'levels'],
    ['maxquad', 'maxQuads'],
    ['wibble', null],
    ['x', null],
  ])('by %s is %s', (name, meant) => {
    expect(nearest(name, known)).toBe(meant);
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
