/** What the panels share: the workbench, the inspection, the viewport, and the state of the page itself. */

/// <reference types="vite/client" />
import { computed, effect, signal } from '@preact/signals-core';
import { Cutting, formatCut } from '../model/cutting.js';
import { EXAMPLES, exampleById } from '../model/examples.js';
import { stem, writable } from '../model/formats.js';
import { Inspection } from '../model/inspection.js';
import { kindOf, wantedKind } from '../model/job.js';
import { formatCommand, parseLink } from '../model/link.js';
import type { Entry, Linked } from '../model/link.js';
import { Workbench } from '../model/workbench.js';
import type { OutputFormat, Mesher } from 'hexmill';
import { Theme } from './theme.js';
import { Viewport } from './viewport.js';

declare global {
  interface Window {
    /** For tests and for the curious. */
    hexmill: Page;
  }
}

/** The addresses of the examples, by file name. */
const EXAMPLE_URLS = Object.fromEntries(
  Object.entries(
    import.meta.glob<string>(
      [
        '../../../examples/models/quads/{bishop,car,pawn,rook}.obj',
        '../../../examples/models/solids/{3holes,MFCAD_3-3-3-3-3-23,bunny,spot}.obj',
      ],
      { query: '?url', import: 'default', eager: true },
    ),
  ).map(([path, url]) => [path.slice(path.lastIndexOf('/') + 1), url]),
);

export type Section = 'input' | 'size' | 'regions';
/** What a phone shows above the model. */
export type Sheet = Section | 'inspect' | null;

export class Page {
  readonly workbench: Workbench;
  readonly inspection: Inspection;
  readonly cutting = new Cutting();
  readonly theme = new Theme();
  readonly viewport: Viewport;

  readonly stepsFolded = signal(false);
  readonly inspectorFolded = signal(false);
  readonly sheet = signal<Sheet>(null);
  readonly moreSize = signal(false);
  readonly logOpen = signal(false);
  readonly dropping = signal(false);
  readonly chosenFormat = signal<OutputFormat>('vtu');
  /** Formats that hold what was made, or will be. */
  readonly formats = computed(() => {
    const { job, result, settings } = this.workbench;
    return writable(result.value ? kindOf(result.value.mesh) : wantedKind(job.value, settings.value));
  });
  readonly exportFormat = computed(() => (this.formats.value.some(({ format }) => format === this.chosenFormat.value) ? this.chosenFormat.value : 'vtu'));
  /** A short word after an action, such as "Link copied". */
  readonly said = signal('');

  constructor(mesher: Promise<Mesher>) {
    this.workbench = new Workbench(mesher);
    this.inspection = new Inspection(this.workbench);
    this.viewport = new Viewport(this);
    this.#followInput();
  }

  /** What a link asks for that a model is loaded for. */
  #linked: Partial<Linked> = {};

  /** Another model is looked at as its link says, else whole and in one colour. */
  #followInput(): void {
    effect(() => {
      if (!this.workbench.input.value) return;
      this.cutting.restore(this.#linked.cut ?? { section: null, peel: 0 });
      this.inspection.colour.value = this.#linked.colour ?? 'plain';
    });
  }

  openFile(file: File): void {
    void this.workbench.load(file.name, () => file.arrayBuffer());
  }

  /** Reads a surface to refine hexes at. */
  openGuide(file: File): void {
    void this.workbench.addGuide(file.name, () => file.arrayBuffer());
  }

  openExample(id: string, linked: Partial<Linked> = {}): void {
    const example = exampleById(id);
    const url = example && EXAMPLE_URLS[example.file];
    if (example && url) {
      this.viewport.up.value = example.up;
      this.#linked = linked;
      void this.workbench.loadExample(example, url, linked.settings).finally(() => (this.#linked = {}));
    } else this.say(`There is no example "${id}". There are ${EXAMPLES.map((known) => known.id).join(', ')}.`);
  }

  /** Opens what the address asks for. */
  openLink(): void {
    const linked = parseLink(location.hash);
    if (linked && location.hash !== this.link()) this.openExample(linked.example, linked);
  }

  /** The link that makes this job again and looks at it so; null unless the input is an example. */
  link(): string | null {
    const { cutting, inspection, workbench } = this;
    const view: Entry[] = workbench.makesHexes.value ? formatCut({ section: cutting.section.value, peel: cutting.peel.value }) : [];
    if (inspection.colour.value !== 'plain') view.push(['colour', inspection.colour.value]);
    return workbench.link(view);
  }

  async download(): Promise<void> {
    const file = await this.workbench.export(this.exportFormat.value);
    if (file) save(file.name, new Blob([file.content as Uint8Array<ArrayBuffer>]));
  }

  async screenshot(): Promise<void> {
    const picture = await this.viewport.screenshot();
    if (picture) save(`${stem(this.workbench.input.value?.name ?? 'hexmill')}.png`, picture);
  }

  async copyLink(): Promise<void> {
    const link = this.link();
    if (link) await this.#copy(new URL(link, location.href).href, 'Link copied');
  }

  async copyCommand(): Promise<void> {
    const { input, settings } = this.workbench;
    if (!input.value) return;
    const { name, hexes } = input.value;
    await this.#copy(formatCommand({ name, holdsHexes: hexes !== null }, `${stem(name)}-mesh.${this.exportFormat.value === 'medit' ? 'mesh' : this.exportFormat.value}`, settings.value), 'Command copied');
  }

  async copyHash(hash: string): Promise<void> {
    await this.#copy(hash, 'Hash copied');
  }

  /** Says something in the status line for a few seconds. */
  say(text: string): void {
    this.said.value = text;
    setTimeout(() => {
      if (this.said.value === text) this.said.value = '';
    }, SAID_FOR);
  }

  async #copy(text: string, done: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(text);
      this.say(done);
    } catch {
      this.workbench.log.add('info', text);
      this.logOpen.value = true;
      this.say('The browser allows no copying here; the text is in the log');
    }
  }
}

/** Milliseconds. */
const SAID_FOR = 4000;

function save(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  const anchor = document.createElement('a');
  anchor.href = url;
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
