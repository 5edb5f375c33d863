// Whether the camera moves: a large mesh is then drawn lighter, so that a weak graphics card keeps up.

/** Meshes of more faces are drawn lighter while the camera moves. */
export const LIGHT_FROM = 300_000;
/** Milliseconds after the last move after which the camera rests. */
const REST = 160;

/** Tells when to draw lighter and when in full again. */
export class Motion {
  readonly #lighten: (isMoving: boolean) => void;
  #isMoving = false;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(lighten: (isMoving: boolean) => void) {
    this.#lighten = lighten;
  }

  get isMoving(): boolean {
    return this.#isMoving;
  }

  /** The camera moved before a mesh of so many faces. */
  moved(faces: number): void {
    if (faces <= LIGHT_FROM) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.rest(), REST);
    this.#set(true);
  }

  /** The camera rests. */
  rest(): void {
    clearTimeout(this.#timer);
    this.#set(false);
  }

  #set(isMoving: boolean): void {
    if (isMoving === this.#isMoving) return;
    this.#isMoving = isMoving;
    this.#lighten(isMoving);
  }
}
