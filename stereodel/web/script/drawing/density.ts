/** How densely lines and dots lie: where they would fill the ground they are finer and fainter, place by place. */

import type { Path, Trace } from "./pen.ts";

/** Side of the squares in which ink is measured, pixels. */
const SQUARE = 24;

/** Parts of the ground that lines of one net, and dots, may cover if they are not few; what covers more is weaker by steps, so much each. */
const [MOST_LINES, MOST_DOTS, FEW] = [0.16, 0.07, 1000];
const [STEP, STEPS] = [0.8, 50];

/** The finest lines and the smallest dots as parts of the usual, and the faintest ink that eight bits a colour tell. */
const [FINEST, SMALLEST, FAINTEST] = [0.55, 0.4, 0.07];

type Size = Readonly<Record<"width" | "height", number>>;

/** Ink by squares of a drawing, with a row and a column round it that have none. */
export class Ink {
  readonly #size: Size;
  readonly #columns: number;
  readonly #ink: Float64Array;
  #steps: Float64Array | null = null;

  constructor(size: Size) {
    [this.#size, this.#columns] = [size, Math.ceil(size.width / SQUARE) + 2];
    this.#ink = new Float64Array(this.#columns * (Math.ceil(size.height / SQUARE) + 2));
  }

  /** The square of a place, or the one next to it. */
  #at(x: number, y: number): number {
    const { width, height } = this.#size;
    const [column, row] = [Math.max(0, Math.min(width - 1, x)), Math.max(0, Math.min(height - 1, y))];
    return Math.floor(column / SQUARE) + 1 + this.#columns * (Math.floor(row / SQUARE) + 1);
  }

  add(x: number, y: number, squarePixels: number): void {
    const { width, height } = this.#size;
    if (this.#steps === null && x >= 0 && y >= 0 && x < width && y < height) this.#ink[this.#at(x, y)] += squarePixels;
  }

  /** Steps by which squares are weaker: by the mean of nine, of those with ink, as beyond the limb there is none. */
  #measured(most: number): Float64Array {
    const [columns, ink] = [this.#columns, this.#ink];
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

  /** Calls back with places by the parts of their ink that they keep, the weakest first; from then on all is measured. */
  each(places: ArrayLike<number>, most: number, visit: (part: number, numbers: readonly number[]) => void): void {
    const [steps, groups] = [
      (this.#steps ??= this.#measured(places.length > 2 * FEW ? most : Infinity)),
      Array.from({ length: STEPS + 1 }, (): number[] => []),
    ];
    for (let k = 0; 2 * k < places.length; ++k) {
      // Between the middles of four squares, so that these are not seen.
      const [x, y] = [places[2 * k] - SQUARE / 2, places[2 * k + 1] - SQUARE / 2];
      const [s, t] = [x / SQUARE - Math.floor(x / SQUARE), y / SQUARE - Math.floor(y / SQUARE)];
      const upper = (1 - s) * steps[this.#at(x, y)] + s * steps[this.#at(x + SQUARE, y)];
      const lower = (1 - s) * steps[this.#at(x, y + SQUARE)] + s * steps[this.#at(x + SQUARE, y + SQUARE)];
      groups[Math.min(STEPS, Math.round((1 - t) * upper + t * lower))].push(k);
    }
    for (let step = STEPS; step >= 0; --step) if (groups[step].length > 0) visit(STEP ** step, groups[step]);
  }
}

/** Calls back with dots by their sizes and opacities. @param area Of a usual one, square pixels. */
export function eachDots(
  places: ArrayLike<number>,
  area: number,
  ink: Ink,
  visit: (size: number, opacity: number, places: ArrayLike<number>) => void,
): void {
  for (let k = 0; k < places.length; k += 2) ink.add(places[k], places[k + 1], area);
  ink.each(places, MOST_DOTS, (part, numbers) => {
    const size = Math.max(SMALLEST, Math.sqrt(part));
    const opacity = Math.max(FAINTEST, part / size ** 2);
    const stride = Math.round((opacity * size ** 2) / part); // one of so many: fainter they cannot be
    const those = new Float64Array(2 * Math.ceil(numbers.length / stride));
    for (let at = 0; at < those.length; ++at) those[at] = places[2 * numbers[stride * (at >> 1)] + (at & 1)];
    visit(size, opacity, those);
  });
}

/** Calls back with lines of a trace by their widths and opacities. @param width Of a usual one, pixels. */
export function eachLines(
  trace: Trace,
  width: number,
  ink: Ink,
  visit: (size: number, opacity: number, trace: Trace) => void,
): void {
  // Of each step, behind how many they are, its numbers: two of a place, eight of an arc.
  const [middles, begins, steps] = [[] as number[], [] as number[], [] as number[]];
  let [fromX, fromY] = [0, 0];
  const ends = (x: number, y: number): void => {
    const length = Math.hypot(x - fromX, y - fromY);
    const pieces = Math.min(64, Math.ceil(length / SQUARE));
    for (let t = 0.5 / pieces; t < 1; t += 1 / pieces)
      ink.add(fromX + t * (x - fromX), fromY + t * (y - fromY), (width * length) / pieces);
    middles[2 * begins.length - 2] = (fromX + x) / 2;
    middles[2 * begins.length - 1] = (fromY + y) / 2;
    [fromX, fromY] = [x, y];
  };
  trace({
    moveTo(x, y) {
      [fromX, fromY] = [x, y];
      middles.push(x, y);
      begins.push(steps.length);
      steps.push(2, x, y);
    },
    lineTo(x, y) {
      steps.push(2, x, y);
      ends(x, y);
    },
    ellipse(x, y, rx, ry, turn, begin, end, isBack = false) {
      steps.push(8, x, y, rx, ry, turn, begin, end, Number(isBack));
      const [c, s, u, v] = [Math.cos(turn), Math.sin(turn), rx * Math.cos(end), ry * Math.sin(end)];
      ends(x + u * c - v * s, y + u * s + v * c);
    },
    closePath() {
      const begin = begins[begins.length - 1];
      this.lineTo(steps[begin + 1], steps[begin + 2]);
    },
  });
  const lay = (path: Path, line: number): void => {
    const [s, begin, end] = [steps, begins[line], begins[line + 1] ?? steps.length];
    path.moveTo(s[begin + 1], s[begin + 2]);
    for (let k = begin + 3; k < end; k += s[k] + 1) {
      if (s[k] === 2) path.lineTo(s[k + 1], s[k + 2]);
      else path.ellipse(s[k + 1], s[k + 2], s[k + 3], s[k + 4], s[k + 5], s[k + 6], s[k + 7], s[k + 8] === 1);
    }
  };
  ink.each(middles, MOST_LINES, (part, numbers) => {
    const size = Math.max(FINEST, Math.sqrt(part));
    visit(size, Math.max(FAINTEST, part / size), (path) => numbers.forEach((line) => lay(path, line)));
  });
}
