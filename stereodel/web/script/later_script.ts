/** Scripts of the page that are compiled at first need: `exchange.ts` and `lift.ts`. */

import type { Contents } from "./contents.ts";
import { shared } from "page:shared";

/** The element of such a script: what the page hands over, and what the script offers. */
interface Handover<T> extends HTMLScriptElement {
  shared?: typeof shared;
  offers?: T;
}

export class LaterScript<T> {
  readonly #contents: Contents;
  readonly #name: string;
  #loaded: Promise<T> | null = null;

  constructor(contents: Contents, name: string) {
    this.#contents = contents;
    this.#name = name;
  }

  /** What it offers; after a failure the next call tries again. */
  async get(): Promise<T> {
    this.#loaded ??= this.#contents.script(this.#name).then((code) => this.#run(code));
    try {
      return await this.#loaded;
    } catch (error) {
      this.#loaded = null;
      throw error;
    }
  }

  /** Runs code that the policy of the page allows by its hash. */
  #run(code: string): T {
    const element: Handover<T> = document.createElement("script");
    element.shared = shared;
    element.textContent = code;
    document.head.append(element); // runs it, to its end
    element.remove();
    if (element.offers === undefined) throw new Error(`the page's script ${this.#name} did not run`);
    return element.offers;
  }
}
