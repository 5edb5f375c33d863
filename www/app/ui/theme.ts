/** Light or dark: as the system says until a person chooses. */

import { computed, effect, signal } from '@preact/signals-core';

export type Scheme = 'light' | 'dark';
const KEY = 'hexmill.theme';

export class Theme {
  readonly #system = signal<Scheme>('light');
  readonly #chosen = signal<Scheme | null>(null);
  readonly scheme = computed<Scheme>(() => this.#chosen.value ?? this.#system.value);

  constructor() {
    const query = matchMedia('(prefers-color-scheme: dark)');
    const follow = (): void => void (this.#system.value = query.matches ? 'dark' : 'light');
    follow();
    query.addEventListener('change', follow);
    const stored = read();
    if (stored === 'light' || stored === 'dark') this.#chosen.value = stored;
    effect(() => {
      document.documentElement.dataset['theme'] = this.scheme.value;
    });
  }

  flip(): void {
    this.#chosen.value = this.scheme.value === 'dark' ? 'light' : 'dark';
    write(this.#chosen.value);
  }
}

/** Storage may be forbidden; then the choice lasts as long as the page. */
function read(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function write(value: string): void {
  try {
    localStorage.setItem(KEY, value);
  } catch {
    return;
  }
}
