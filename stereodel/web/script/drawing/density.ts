/** How densely lines and dots lie: where they would fill the ground they are finer and fainter, place by place. */

import type { Path, Trace } from "./pen.ts";

/** Side of the squares in which ink is measured, pixels. */
const SQUARE = 24;

/** The parts of the ground that the lines of one net, and dots, may cover before they are weakened. */
const MOST_LINES = 0.16;
const MOST_DOTS = 0.07;

/** A step weaker has this part of the ink; the weakest is so many steps down. */
const STEP = 0.8;
const STEPS = 50;

/** The finest lines and the smallest dots as parts of the usual ones: what must be weaker than they are is fainter. */
const FINEST = 0.55;
const SMALLEST = 0.4;

/** Least opacity: eight bits a colour tell no fainter ones. Of dots that would have less, some are left out. */
const FAINTEST = 0.07;

/** How things are drawn, as parts of the usual: their width, and how they cover the ground. */
export interface Strength {
  readonly size: number;
  readonly opacity: number;
}

/** Width and height of a drawing. */
interface Size {
  readonly width: number;
  readonly height: number;
}

/** Ink by squares of a drawing, with a row and a column round it that have none. */
class Ink {
  readonly #size: Size;
  readonly #columns: number;
  readonly #rows: number;
  readonly #ink: Float64Array;

  constructor(size: Size) {
    this.#size = size;
    [this.#columns, this.#rows] = [Math.ceil(size.width / SQUARE) + 2, Math.ceil(size.height / SQUARE) + 2];
    this.#ink = new Float64Array(this.#columns * this.#rows);
  }

  /** The square of a place, or the one next to it. */
  #at(x: number, y: number): number {
    const column = Math.max(1, Math.min(this.#columns - 2, Math.floor(x / SQUARE) + 1));
    return column + this.#columns * Math.max(1, Math.min(this.#rows - 2, Math.floor(y / SQUARE) + 1));
  }

  add(x: number, y: number, squarePixels: number): void {
    const { width, height } = this.#size;
    if (x >= 0 && y >= 0 && x < width && y < height) this.#ink[this.#at(x, y)] += squarePixels;
  }

  /** By how many steps what is at places is weaker: as the mean of nine squares has it, of those with ink. */
  steps(places: ArrayLike<number>, most: number): Uint8Array {
    const [columns, ink] = [this.#columns, this.#ink];
    const steps = new Float64Array(ink.length);
    for (let at = columns + 1; at < ink.length - columns - 1; ++at) {
      let [sum, inked] = [0, 0];
      for (let k = 0; k < 9; ++k) {
        const near = ink[at + ((k % 3) - 1) + columns * (Math.floor(k / 3) - 1)];
        sum += near;
        if (near > 0) ++inked; // beyond the limb there is none
      }
      const share = sum / (inked * SQUARE * SQUARE * most);
      if (share > 1) steps[at] = Math.log(share) / -Math.log(STEP);
    }
    // Between the middles of four squares, so that these are not seen.
    const half = SQUARE / 2;
    return Uint8Array.from({ length: places.length / 2 }, (_, k) => {
      const [x, y] = [places[2 * k] - half, places[2 * k + 1] - half];
      const [s, t] = [x / SQUARE - Math.floor(x / SQUARE), y / SQUARE - Math.floor(y / SQUARE)];
      const [upper, lower] = [y, y + SQUARE].map(
        (row) => (1 - s) * steps[this.#at(x, row)] + s * steps[this.#at(x + SQUARE, row)],
      );
      return Math.min(STEPS, Math.round((1 - t) * upper + t * lower));
    });
  }
}

/** Calls back for what has the same strength, the weakest first: its part of the ink, and its numbers. */
function eachStep(steps: Uint8Array, visit: (ink: number, numbers: Uint32Array) => void): void {
  const counts = new Uint32Array(STEPS + 1);
  for (const step of steps) ++counts[step];
  const groups = Array.from(counts, (count) => new Uint32Array(count));
  for (let k = steps.length - 1; k >= 0; --k) groups[steps[k]][--counts[steps[k]]] = k;
  for (let step = STEPS; step >= 0; --step) if (groups[step].length > 0) visit(STEP ** step, groups[step]);
}

/** Dots at x, y in turn by their strength. @param area Of a dot, square pixels. */
export function eachDots(
  places: ArrayLike<number>,
  area: number,
  size: Size,
  visit: (strength: Strength, places: ArrayLike<number>) => void,
): void {
  const ink = new Ink(size);
  for (let k = 0; k < places.length; k += 2) ink.add(places[k], places[k + 1], area);
  eachStep(ink.steps(places, MOST_DOTS), (part, numbers) => {
    const size = Math.max(SMALLEST, Math.sqrt(part));
    const opacity = Math.max(FAINTEST, part / size ** 2);
    const stride = Math.round((opacity * size ** 2) / part); // one of so many
    const those = new Float64Array(2 * Math.ceil(numbers.length / stride));
    for (let at = 0; at < those.length; ++at) those[at] = places[2 * numbers[stride * (at >> 1)] + (at & 1)];
    visit({ size, opacity }, those);
  });
}

/** Lines of a trace by their strength. @param line Their width, pixels. */
export function eachLines(
  trace: Trace,
  line: number,
  size: Size,
  visit: (strength: Strength, trace: Trace) => void,
): void {
  const lines = new Lines(new Ink(size), line);
  trace(lines);
  eachStep(lines.ink.steps(lines.middles, MOST_LINES), (part, numbers) => {
    const size = Math.max(FINEST, Math.sqrt(part));
    visit({ size, opacity: Math.max(FAINTEST, part / size) }, (path) => lines.lay(path, numbers));
  });
}

/** What a trace lays down: its ink, and its lines to be laid down again in another order. */
class Lines implements Path {
  readonly ink: Ink;
  /** Of the chord of each. */
  readonly middles: number[] = [];
  readonly #line: number;
  readonly #begins: number[] = [];
  readonly #numbers: number[] = []; // of each step, behind how many: two of a place, eight of an arc
  #at: readonly [number, number] = [0, 0];

  constructor(ink: Ink, line: number) {
    [this.ink, this.#line] = [ink, line];
  }

  moveTo(x: number, y: number): void {
    this.#begins.push(this.#numbers.length);
    this.#numbers.push(2, x, y);
    this.middles.push(x, y);
    this.#at = [x, y];
  }

  lineTo(x: number, y: number): void {
    this.#numbers.push(2, x, y);
    this.#ends(x, y);
  }

  ellipse(...[x, y, rx, ry, turn, from, to, isBack = false]: Parameters<Path["ellipse"]>): void {
    this.#numbers.push(8, x, y, rx, ry, turn, from, to, Number(isBack));
    const [c, s, u, v] = [Math.cos(turn), Math.sin(turn), rx * Math.cos(to), ry * Math.sin(to)];
    this.#ends(x + u * c - v * s, y + u * s + v * c);
  }

  closePath(): void {
    const begin = this.#begins[this.#begins.length - 1];
    this.lineTo(this.#numbers[begin + 1], this.#numbers[begin + 2]);
  }

  #ends(x: number, y: number): void {
    const [fromX, fromY] = this.#at;
    const length = Math.hypot(x - fromX, y - fromY);
    const pieces = Math.min(64, Math.ceil(length / SQUARE));
    for (let t = 0.5 / pieces; t < 1; t += 1 / pieces)
      this.ink.add(fromX + t * (x - fromX), fromY + t * (y - fromY), (this.#line * length) / pieces);
    this.middles.splice(-2, 2, (fromX + x) / 2, (fromY + y) / 2);
    this.#at = [x, y];
  }

  lay(path: Path, lines: Iterable<number>): void {
    const n = this.#numbers;
    for (const line of lines) {
      const [begin, end] = [this.#begins[line], this.#begins[line + 1] ?? n.length];
      path.moveTo(n[begin + 1], n[begin + 2]);
      for (let k = begin + 3; k < end; k += n[k] + 1) {
        if (n[k] === 2) path.lineTo(n[k + 1], n[k + 2]);
        else path.ellipse(n[k + 1], n[k + 2], n[k + 3], n[k + 4], n[k + 5], n[k + 6], n[k + 7], n[k + 8] === 1);
      }
    }
  }
}
