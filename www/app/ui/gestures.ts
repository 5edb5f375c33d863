/** What the whole page answers to: dropped files, keys, the address. */

import { effect } from '@preact/signals-core';
import type { Page } from './page.js';
import { debounced } from '../model/latest.js';

/** Milliseconds. */
const ADDRESS_DELAY = 120;

export function listen(page: Page): void {
  listenToDrops(page);
  addEventListener('keydown', (event) => key(page, event));
  addEventListener('hashchange', () => page.openLink());
  followSettings(page);
  followSelection(page);
  followTrouble(page);
}

function listenToDrops(page: Page): void {
  const holdsFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  addEventListener('dragover', (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    page.dropping.value = true;
  });
  addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) page.dropping.value = false;
  });
  addEventListener('drop', (event) => {
    page.dropping.value = false;
    if (!holdsFiles(event)) return;
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    const isOnRegions = event.target instanceof Element && event.target.closest('[data-section=regions]') !== null;
    if (file && isOnRegions && page.workbench.takesGuides.value) page.openGuide(file);
    else if (file) page.openFile(file);
  });
}

function key(page: Page, event: KeyboardEvent): void {
  const { workbench, viewport } = page;
  const isTyping = event.target instanceof Element && event.target.matches('input[type=text], select');
  const withCommand = event.ctrlKey || event.metaKey;
  const letter = event.key.toLowerCase();
  if (withCommand && event.key === 'Enter') {
    if (event.target instanceof HTMLElement) event.target.blur();
    void workbench.mesh();
  } else if (event.key === 'Escape' && workbench.running.value) workbench.cancel();
  else if (isTyping) return;
  else if (withCommand && letter === 'z') event.shiftKey ? workbench.redo() : workbench.undo();
  else if (withCommand && letter === 'y') workbench.redo();
  else if (!withCommand && !event.altKey && letter === 'f') viewport.frameAll();
  else if (event.key === 'Delete' && workbench.selected.value !== null) workbench.deleteSelected();
  else return;
  event.preventDefault();
}

/** The address always holds the link of what is shown, so that copying it is sharing it. */
function followSettings(page: Page): void {
  // Browsers take it amiss if the address changes as often as a handle moves.
  const write = debounced(() => history.replaceState(null, '', page.link() ?? `${location.pathname}${location.search}`), ADDRESS_DELAY);
  effect(() => {
    page.link();
    if (page.workbench.input.value) write();
  });
}

/** A region that is selected, here or in the view, has its numbers in sight. */
function followSelection(page: Page): void {
  effect(() => {
    if (page.workbench.selected.value === null) return;
    requestAnimationFrame(() => document.querySelector('.regions .open')?.scrollIntoView({ block: 'nearest' }));
  });
}

/** What went wrong comes into sight, wherever its column is scrolled to. */
function followTrouble(page: Page): void {
  const { input, guide, estimate, mesh, output } = page.workbench.trouble;
  effect(() => {
    if (![input, guide, estimate, mesh, output].some((trouble) => trouble.value)) return;
    requestAnimationFrame(() => document.querySelector('.steps .complaint')?.scrollIntoView({ block: 'nearest' }));
  });
}
