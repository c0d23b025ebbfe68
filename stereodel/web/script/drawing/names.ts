/** Names beside dots, none over another: set one after the other, each on the first side where there is room. */

import { make } from "../dom.ts";
import type { Disc, Pen, Point } from "./pen.ts";
import { fontOf, type LabelStyle } from "./styles.ts";

/** Right and down of a dot, as signs. */
type Side = readonly [number, number];

/** In the order in which they are tried: off the axes, beside, above and below. */
const SIDES = [1, 1, -1, -1, 1, -1, 0, 0].map((right, k): Side => [right, [-1, 1, -1, 1, 0, 0, -1, 1][k]]);

/** Left, top, right and bottom. */
export type Box = readonly [number, number, number, number];

/** From a dot to its name, and between names, pixels. */
const [GAP, APART] = [4, 4];

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
export function widthOf(text: string, style: LabelStyle): number {
  const font = fontOf(style, style.italic ?? false);
  const key = `${font} ${text}`;
  if (!widths.has(key)) {
    context ??= make("canvas").getContext("2d")!;
    context.font = font;
    widths.set(key, context.measureText(text.replaceAll("*", "")).width);
  }
  return widths.get(key)!;
}

/** The room for names in a drawing, and what is taken of it. */
export class Seats {
  readonly #pen: Pen;
  readonly #taken: Box[];
  /** In which names stay. */
  readonly disc: Disc;

  constructor(pen: Pen, disc: Disc = { x: 0, y: 0, r: Infinity }, taken: readonly Box[] = []) {
    [this.#pen, this.disc, this.#taken] = [pen, disc, [...taken]];
  }

  takeDot([x, y]: Point, radius: number): void {
    this.#taken.push([x - radius, y - radius, x + radius, y + radius]);
  }

  /** Sets the label of a dot on the first side with room, which is then taken; undefined where there is none. */
  set(text: string, dot: Point, style: LabelStyle, sides: readonly Side[], radius = USUAL): Side | undefined {
    const width = widthOf(text, style);
    return sides.find((side) => {
      const box = boxOf(dot, radius, side, width, style.size);
      if (!this.#isFree(box)) return false;
      this.#taken.push([box[0] - APART, box[1] - APART / 2, box[2] + APART, box[3] + APART / 2]);
      this.#pen.label(text, box[0], box[3] - DESCENT * style.size, style);
      return true;
    });
  }

  #isFree([left, top, right, bottom]: Box): boolean {
    const { x, y, r } = this.disc;
    if (Math.hypot(Math.max(x - left, right - x), Math.max(y - top, bottom - y)) > r) return false;
    if (left < 0 || top < 0 || right > this.#pen.width || bottom > this.#pen.height) return false;
    return !this.#taken.some(([l, t, r, b]) => left < r && l < right && top < b && t < bottom);
  }
}

/** Sides of a dot, the one toward (right, down) first. */
export function sidesToward(right: number, down: number): Side[] {
  const along = ([u, v]: Side): number => (u * right + v * down) / Math.hypot(u, v);
  return [...SIDES].sort((a, b) => along(b) - along(a));
}

/** Beside, above or below a dot, or off its corner, which is nearer to it. */
function boxOf([x, y]: Point, radius: number, [u, v]: Side, width: number, size: number): Box {
  const [across, down] = u === 0 || v === 0 ? [radius + GAP, radius + GAP] : [radius + 0.5 * GAP, 0.5 * radius];
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
  seats: Seats,
  { names, radii, standing, isMoving }: Named,
  images: ArrayLike<number>,
  style: LabelStyle,
): void {
  const { disc } = seats;
  const place = (k: number): Point => [disc.x + disc.r * images[3 * k], disc.y - disc.r * images[3 * k + 1]];
  const isSeen = (k: number): boolean => images[3 * k + 2] >= LEAST_HEIGHT;
  const front = Array.from(names.keys()).filter(isSeen);
  const size = Math.PI * disc.r * disc.r;
  const radius = (k: number): number => Math.max(USUAL, radii?.[k] ?? 0);
  if (front.length * CROWD < size) for (const k of front) seats.takeDot(place(k), radius(k));
  const before = new Map(isMoving ? standing : []);
  standing.clear();
  const rest = front.filter((k) => names[k] !== "" && !before.has(k)).slice(0, isMoving ? TRIED_MOVING : TRIED);
  for (const k of [...before.keys()].filter(isSeen).concat(rest)) {
    if (standing.size * ROOM > size) break;
    const name = names[k].length > LONGEST ? `${names[k].slice(0, LONGEST - 1)}…` : names[k];
    const sides = before.has(k) ? [before.get(k)!, ...SIDES] : SIDES;
    const side = seats.set(name.replaceAll("*", "∗"), place(k), style, sides, radius(k));
    if (side !== undefined) standing.set(k, side);
  }
}
