/** How densely lines and dots lie: where they would fill the ground they are finer and fainter, place by place. */

/** Side of the squares in which ink is measured, pixels. */
export const SQUARE = 24;

/** What covers more than it may is weaker by steps, so much each, where there are more than a few lines or dots. */
const [STEP, FEW] = [0.8, 1000];

/** Ink by squares of a drawing, with a row and a column round it that have none. */
export class Ink {
  readonly #columns: number;
  readonly #rows: number;
  /** By which squares are weaker. */
  #steps: Float64Array | null = null;

  constructor({ width, height }: { width: number; height: number }) {
    [this.#columns, this.#rows] = [Math.ceil(width / SQUARE) + 2, Math.ceil(height / SQUARE) + 2];
  }

  /**
   * Calls back with things by the parts of their ink that they keep, the weakest first; what came first is measured.
   * @param places x, y of each.
   * @param area Their ink, square pixels.
   * @param most Part of the ground that they may cover.
   */
  each(
    places: ArrayLike<number>,
    area: (k: number) => number,
    most: number,
    visit: (part: number, numbers: readonly number[]) => void,
  ): void {
    const groups: number[][] = [];
    const steps = (this.#steps ??= this.#measured(places, area, places.length > 2 * FEW ? most : Infinity));
    for (let k = 0; 2 * k < places.length; ++k) {
      // Between the middles of four squares, so that these are not seen.
      const [u, v] = [places[2 * k] / SQUARE - 0.5, places[2 * k + 1] / SQUARE - 0.5];
      const [s, t] = [u - Math.floor(u), v - Math.floor(v)];
      const upper = (1 - s) * steps[this.#at(u, v)] + s * steps[this.#at(u + 1, v)];
      const lower = (1 - s) * steps[this.#at(u, v + 1)] + s * steps[this.#at(u + 1, v + 1)];
      (groups[Math.round((1 - t) * upper + t * lower)] ??= []).push(k);
    }
    for (let step = groups.length - 1; step >= 0; --step) if (step in groups) visit(STEP ** step, groups[step]);
  }

  /** The mean of nine squares counts, of those with ink, as beyond the limb there is none. */
  #measured(places: ArrayLike<number>, area: (k: number) => number, most: number): Float64Array {
    const [columns, ink] = [this.#columns, new Float64Array(this.#columns * this.#rows)];
    for (let k = 0; 2 * k < places.length; ++k) {
      const [u, v] = [places[2 * k] / SQUARE, places[2 * k + 1] / SQUARE];
      if (u >= 0 && v >= 0 && u < columns - 2 && v < this.#rows - 2) ink[this.#at(u, v)] += area(k);
    }
    return ink.map((_, at) => {
      let [sum, inked] = [0, 0];
      for (let k = 0; k < 9; ++k) {
        const near = ink[at + ((k % 3) - 1) + columns * (Math.floor(k / 3) - 1)] ?? 0;
        sum += near;
        if (near > 0) ++inked;
      }
      return inked === 0 ? 0 : Math.max(0, Math.log(sum / (inked * SQUARE * SQUARE * most)) / -Math.log(STEP));
    });
  }

  /** The square of a place in squares, or the one next to it. */
  #at(u: number, v: number): number {
    const [column, down] = [Math.max(0, Math.min(this.#columns - 3, u)), Math.max(0, Math.min(this.#rows - 3, v))];
    return Math.floor(column) + 1 + this.#columns * (Math.floor(down) + 1);
  }
}
