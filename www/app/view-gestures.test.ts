import { describe, expect, test } from 'vitest';

import { type Actions, keyAction, pinch, wheelFactor } from './view-gestures';

describe('wheelFactor', () => {
  test('turning the wheel away comes closer, and back goes back', () => {
    expect(wheelFactor(-100, 0, false)).toBeLessThan(1);
    expect(wheelFactor(-100, 0, false) * wheelFactor(100, 0, false)).toBeCloseTo(1);
    expect(wheelFactor(0, 0, false)).toBe(1);
  });

  test('lines and pages count as many pixels', () => {
    expect(wheelFactor(3, 1, false)).toBeCloseTo(wheelFactor(48, 0, false));
    expect(wheelFactor(0.5, 2, false)).toBeCloseTo(wheelFactor(200, 0, false));
  });

  test('one event never jumps far', () => {
    expect(wheelFactor(1e6, 0, false)).toBeLessThan(1.6);
    expect(wheelFactor(-1e6, 2, false)).toBeGreaterThan(0.6);
  });

  test('a pinch on a trackpad has small steps and a stronger effect', () => {
    expect(wheelFactor(5, 0, true)).toBeGreaterThan(wheelFactor(5, 0, false));
  });
});

describe('pinch', () => {
  const at = (x: number, y: number) => ({ x, y });

  test('fingers going together move', () => {
    const { middle, by, factor } = pinch([at(0, 0), at(10, 0)], [at(5, 7), at(15, 7)]);
    expect([middle, by, factor]).toEqual([at(10, 7), at(5, 7), 1]);
  });

  test('fingers going apart come closer about their middle', () => {
    const { middle, by, factor } = pinch([at(40, 0), at(60, 0)], [at(30, 0), at(70, 0)]);
    expect([middle, by, factor]).toEqual([at(50, 0), at(0, 0), 0.5]);
  });

  test('fingers on one spot divide by nothing', () => {
    expect(pinch([at(1, 1), at(1, 1)], [at(1, 1), at(1, 1)]).factor).toBe(1);
  });
});

describe('keyAction', () => {
  /** The names and arguments of the actions that a key brings about on a canvas of 200 by 100. */
  function pressed(key: string, shift = false): unknown[][] {
    const calls: unknown[][] = [];
    const record = (name: string) => (...values: unknown[]) => calls.push([name, ...values]);
    const actions = new Proxy({} as Actions, { get: (_, name) => record(String(name)) });
    keyAction(key, shift, { clientWidth: 200, clientHeight: 100 }, actions)?.();
    return calls;
  }

  test('F shows all; plus and minus zoom about the middle', () => {
    expect(pressed('f')).toEqual([['frameAll']]);
    expect(pressed('+')).toEqual([['dolly', 100, 50, 0.8]]);
    expect(pressed('-')).toEqual([['dolly', 100, 50, 1.25]]);
  });

  test('arrows turn, with shift they move', () => {
    expect(pressed('ArrowLeft').map(([name]) => name)).toEqual(['grabMiddle', 'orbit', 'release']);
    expect(pressed('ArrowUp', true)).toContainEqual(['pan', 0, 40]);
  });

  test('other keys are left to the page', () => {
    expect(keyAction('Tab', false, { clientWidth: 1, clientHeight: 1 }, {} as Actions)).toBeUndefined();
  });
});
