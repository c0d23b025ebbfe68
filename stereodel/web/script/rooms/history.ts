/** Earlier states of an array that the reader changes, to go back to. */

/** States that are kept. */
const MOST = 100;

export class History {
  readonly #states: Float64Array[] = [];

  get isEmpty(): boolean {
    return this.#states.length === 0;
  }

  /** Keeps a state; nobody writes to it afterwards. */
  push(state: Float64Array): void {
    this.#states.push(state);
    if (this.#states.length > MOST) this.#states.shift();
  }

  /** The state before, or null. */
  pop(): Float64Array | null {
    return this.#states.pop() ?? null;
  }

  clear(): void {
    this.#states.length = 0;
  }
}
