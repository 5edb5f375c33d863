import { expect, test } from 'vitest';
import { History } from './history.js';

test('steps back and forth', () => {
  const history = new History<number>();
  history.record(1, 'a', 0);
  history.record(2, 'b', 10);
  expect(history.undo(3)).toBe(2);
  expect(history.undo(2)).toBe(1);
  expect(history.canUndo).toBe(false);
  expect(history.undo(1)).toBe(1);
  expect(history.redo(1)).toBe(2);
  expect(history.redo(2)).toBe(3);
  expect(history.canRedo).toBe(false);
});

test('edits of one thing in quick succession are one step, until sealed or late', () => {
  const history = new History<number>();
  history.record(1, 'slider', 0);
  history.record(2, 'slider', 100);
  history.record(3, 'slider', 200);
  expect(history.undo(4)).toBe(1);
  history.record(1, 'slider', 300);
  history.seal();
  history.record(2, 'slider', 310);
  expect(history.undo(3)).toBe(2);
  history.record(2, 'slider', 400);
  history.record(5, 'slider', 2000);
  expect(history.undo(6)).toBe(5);
});

test('a new edit ends what could be done again', () => {
  const history = new History<number>();
  history.record(1, 'a', 0);
  history.undo(2);
  history.record(1, 'b', 10);
  expect(history.canRedo).toBe(false);
});
