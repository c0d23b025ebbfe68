/** What a screen reader hears: one polite live region, which speaks once the hand rests. */

import { plain } from "./dom.ts";

/** Milliseconds without a change after which a sentence is spoken. */
const REST = 600;

export class Announcer {
  readonly #region: Element;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /** `region` is an element with `role="status"`. */
  constructor(region: Element) {
    this.#region = region;
  }

  /** Says a sentence after a while without another; marks of `say` are taken out. */
  say(sentence: string): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      this.#region.textContent = plain(sentence);
    }, REST);
  }
}
