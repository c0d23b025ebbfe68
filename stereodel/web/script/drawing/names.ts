/** Names beside dots, none over another: set one after the other, each on the first side where there is room. */

import { make } from "../dom.ts";
import type { Disc, Pen, Point } from "./pen.ts";
import { SERIF, type LabelStyle } from "./styles.ts";

/** Right and down of a dot, as signs. */
type Side = readonly [number, number];

/** In the order in which they are tried: off the axes, beside, above and below. */
const SIDES = [1, 1, -1, -1, 1, -1, 0, 0].map((right, k): Side => [right, [-1, 1, -1, 1, 0, 0, -1, 1][k]]);

/** Left, top, right and bottom. */
export type Box = readonly [number, number, number, number];

/** Side of the squares of which it is known who takes them; from a dot to its name, between names, pixels. */
const [SQUARE, GAP, APART] = [3, 4, 4];

/** Above and below the baseline, in sizes of the type. */
const [ASCENT, DESCENT] = [0.7, 0.22];

/** Radius of a usual dot, pixels. */
const USUAL = 2;

/** Letters of the longest name. */
const LONGEST = 40;

/** Names that are tried in a frame: while the globe moves, beyond those that stood before, and at rest. */
const [TRIED_MOVING, TRIED] = [150, 2000];

/** Square pixels of a ball for one name, and of the front for one dot: if they have less, names hide tiny dots. */
const [ROOM, CROWD] = [3000, 150];

/** Height above the picture, ball radii, below which a name would be cut by the limb. */
const LEAST_HEIGHT = 0.12;

let context: CanvasRenderingContext2D | null = null;

const widths = new Map<string, number>();

/** Of a label, pixels. */
export function widthOf(text: string, { size, italic }: LabelStyle): number {
  context ??= make("canvas").getContext("2d")!;
  const font = `${italic ? "italic " : ""}${size}px ${SERIF}`;
  const key = `${font} ${text}`;
  const known = widths.get(key);
  if (known !== undefined) return known;
  context.font = font;
  const { width } = context.measureText(text.replaceAll("*", ""));
  widths.set(key, width);
  return width;
}

/** The squares of a drawing: which of them are taken. */
export class Seats {
  readonly #disc: Disc;
  readonly #columns: number;
  readonly #rows: number;
  /** The number of the dot, from 1 on, −1 for what no name may touch, 0 where it is free. */
  readonly #taken: Int32Array;

  /** @param disc In which names stay. */
  constructor({ width, height }: Pen, disc: Disc = { x: 0, y: 0, r: Infinity }, taken: readonly Box[] = []) {
    [this.#disc, this.#columns, this.#rows] = [disc, Math.floor(width / SQUARE), Math.floor(height / SQUARE)];
    this.#taken = new Int32Array(this.#columns * this.#rows);
    for (const box of taken) this.take(box);
  }

  take(box: Box, owner = -1): void {
    this.#every(box, (at) => {
      this.#taken[at] = this.#taken[at] === 0 ? owner : -1;
      return true;
    });
  }

  takeDot([x, y]: Point, radius: number, owner: number): void {
    this.take([x - radius, y - radius, x + radius, y + radius], owner);
  }

  /** Sets the label of a dot on the first side with room, which is then taken; undefined where there is none. */
  set(
    pen: Pen,
    text: string,
    dot: Point,
    style: LabelStyle,
    owner: number,
    sides: readonly Side[],
    radius = USUAL,
  ): Side | undefined {
    const width = widthOf(text, style);
    return sides.find((side) => {
      const box = boxOf(dot, radius, side, width, style.size);
      if (!this.#isFree(box, owner)) return false;
      this.take([box[0] - APART, box[1], box[2] + APART, box[3]]);
      pen.label(text, box[0], box[3] - DESCENT * style.size, style);
      return true;
    });
  }

  #isFree(box: Box, owner: number): boolean {
    const [left, top, right, bottom] = box;
    const { x, y, r } = this.#disc;
    if (Math.hypot(Math.max(x - left, right - x), Math.max(y - top, bottom - y)) > r) return false;
    if (left < 0 || top < 0 || right > this.#columns * SQUARE || bottom > this.#rows * SQUARE) return false;
    return this.#every(box, (at) => this.#taken[at] === 0 || this.#taken[at] === owner);
  }

  /** Whether something holds of all squares of a box. */
  #every(box: Box, holds: (at: number) => boolean): boolean {
    const [left, top, right, bottom] = box.map((side) => Math.floor(side / SQUARE));
    for (let row = Math.max(0, top); row <= Math.min(this.#rows - 1, bottom); ++row) {
      for (let column = Math.max(0, left); column <= Math.min(this.#columns - 1, right); ++column)
        if (!holds(row * this.#columns + column)) return false;
    }
    return true;
  }
}

/** Sides of a dot, the one toward (right, down) first. */
export function sidesToward(right: number, down: number): Side[] {
  const along = ([u, v]: Side): number => (u * right + v * down) / Math.hypot(u, v);
  return [...SIDES].sort((a, b) => along(b) - along(a));
}

function boxOf([x, y]: Point, radius: number, [u, v]: Side, width: number, size: number): Box {
  const away = GAP + radius;
  const [across, down] = u === 0 ? [0, away] : v === 0 ? [away, 0] : [0.5 * GAP + 0.75 * radius, 0.5 * radius];
  const left = x + u * across - (width * (1 - u)) / 2;
  const top = y + v * down - (ASCENT * size * (1 - v)) / 2 - (v < 0 ? DESCENT * size : 0);
  return [left, top, left + width, top + (ASCENT + DESCENT) * size];
}

/** Names of dots, some of them empty, and on which sides of which dots they stand in the drawing. */
export interface Named {
  readonly names: readonly string[];
  /** Of the dots, pixels, where they differ. */
  readonly radii?: readonly number[];
  readonly standing: Map<number, Side>;
  readonly isMoving: boolean;
}

/**
 * Draws names on a ball, the first ones first. At rest they follow from the picture alone; while it moves, those that
 * stand keep their places as long as they can.
 * @param images Of their dots, axes of the view.
 */
export function drawNames(
  pen: Pen,
  seats: Seats,
  disc: Disc,
  { names, radii, standing, isMoving }: Named,
  images: ArrayLike<number>,
  style: LabelStyle,
): void {
  const place = (k: number): Point => [disc.x + disc.r * images[3 * k], disc.y - disc.r * images[3 * k + 1]];
  const front = Array.from(names.keys()).filter((k) => images[3 * k + 2] >= LEAST_HEIGHT);
  const size = Math.PI * disc.r * disc.r;
  const radius = (k: number): number => Math.max(USUAL, radii?.[k] ?? 0);
  if (front.length * CROWD < size) for (const k of front) seats.takeDot(place(k), radius(k), k + 1);
  const before = new Map(isMoving ? standing : []);
  standing.clear();
  const rest = front.filter((k) => names[k] !== "" && !before.has(k)).slice(0, isMoving ? TRIED_MOVING : TRIED);
  for (const k of [...before.keys(), ...rest]) {
    if (standing.size * ROOM > size) break;
    if (!(images[3 * k + 2] >= LEAST_HEIGHT)) continue;
    const name = names[k].length > LONGEST ? `${names[k].slice(0, LONGEST - 1)}…` : names[k];
    const kept = before.get(k);
    const side = seats.set(
      pen,
      name.replaceAll("*", "∗"),
      place(k),
      style,
      k + 1,
      kept ? [kept, ...SIDES] : SIDES,
      radius(k),
    );
    if (side !== undefined) standing.set(k, side);
  }
}
