/** The value of a text field, that leaves alone what a person is writing there. */

import { noChange } from 'lit-html';
import type { PropertyPart } from 'lit-html';
import { Directive, directive } from 'lit-html/directive.js';
import { setCommittedValue } from 'lit-html/directive-helpers.js';

/**
 * Panels are drawn again whenever something that they show changes, such as an estimate that arrives. A field that
 * has the focus then keeps its text, unless its own value is another than when it was last drawn.
 */
class Written extends Directive {
  #drawn: string | null = null;

  override render(value: string): unknown {
    return value;
  }

  override update(part: PropertyPart, [value]: [string]): unknown {
    const field = part.element as HTMLInputElement;
    const isBeingWritten = value === this.#drawn && field.matches(':focus');
    this.#drawn = value;
    if (isBeingWritten || field.value === value) return noChange;
    // What was drawn last may not be what is there now.
    setCommittedValue(part);
    return value;
  }
}

export const written = directive(Written);
