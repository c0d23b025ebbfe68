/**
 * Regions of a ball that fill right from every side and through every lens.
 * What is hidden is pushed outward to the limb: the disc is then the sphere without its hidden pole M, the middle of the
 * far side. With regions on the left of their rings the pushed rings wind once about what is inside and not at all about
 * the rest, or, if M is inside, not at all and minus once: then the whole disc is added. Whether M is inside is found by
 * counting crossings on the way from a place of which it is known, and never from areas, whose signs cannot be trusted.
 */

import type { Vector } from "../space.ts";
import { partsOf, pointAt, tracePart, type Circle } from "./arcs.ts";
import { traceDisc, type Disc, type Path } from "./pen.ts";

const TURN = 2 * Math.PI;
const HALF_TURN = Math.PI;

/** Rings of points in the axes of the view: ring i is rows [offsets[i], offsets[i + 1]), its end joined to its start. */
export interface Rings {
  readonly points: Float64Array;
  readonly offsets: ArrayLike<number>;
}

/**
 * Lays regions into a path.
 * @param holdsHidden Whether M = (0, 0, −1) is inside: `holdsHidden` tells.
 * @param least Points nearer to the last one, pixels, are passed over.
 */
export function traceRegions(path: Path, disc: Disc, rings: Rings, holdsHidden: boolean, least = 0.5): void {
  let discs = holdsHidden ? 1 : 0;
  for (let ring = 0; ring + 1 < rings.offsets.length; ++ring) {
    discs += traceRing(path, disc, rings.points, rings.offsets[ring], rings.offsets[ring + 1], least);
  }
  // About the whole disc: with the rings' own sense, counterclockwise to the eye, or against it.
  for (; discs > 0; --discs) traceWhole(path, disc, false);
  for (; discs < 0; ++discs) traceWhole(path, disc, true);
}

/** One ring; a ring that is all hidden is not drawn, and its turns about M are returned. */
function traceRing(path: Path, disc: Disc, p: Float64Array, begin: number, end: number, least: number): number {
  let first = begin;
  while (first < end && p[3 * first + 2] < 0) ++first;
  if (first === end) return Math.round(turnsOf(p, begin, end) / TURN);
  let [x, y] = [disc.x + disc.r * p[3 * first], disc.y - disc.r * p[3 * first + 1]];
  path.moveTo(x, y);
  let [from, turn] = [0, 0]; // along the limb, while the ring is hidden
  let i = 3 * first;
  for (let n = end - begin; n > 0; --n) {
    const j = i + 3 === 3 * end ? 3 * begin : i + 3;
    const [z, w] = [p[i + 2], p[j + 2]];
    if (z >= 0 !== w >= 0) {
      const t = z / (z - w);
      const azimuth = Math.atan2(p[i + 1] + t * (p[j + 1] - p[i + 1]), p[i] + t * (p[j] - p[i]));
      if (w < 0) {
        [from, turn] = [azimuth, 0];
        path.lineTo(disc.x + disc.r * Math.cos(azimuth), disc.y - disc.r * Math.sin(azimuth));
        turn += wrapped(Math.atan2(p[j + 1], p[j]) - azimuth);
      } else {
        turn += wrapped(azimuth - from - turn);
        traceLimb(path, disc, from, turn);
        [x, y] = [Infinity, Infinity];
      }
    } else if (w < 0) turn += wrapped(Math.atan2(p[j + 1], p[j]) - from - turn);
    if (w >= 0) {
      const [nx, ny] = [disc.x + disc.r * p[j], disc.y - disc.r * p[j + 1]];
      if (Math.abs(nx - x) + Math.abs(ny - y) > least) path.lineTo((x = nx), (y = ny));
    }
    i = j;
  }
  path.closePath();
  return 0;
}

/** How far a ring turns about the view's axis, counterclockwise from the front. */
function turnsOf(p: Float64Array, begin: number, end: number): number {
  let sum = 0;
  for (let k = begin; k < end; ++k) {
    const [i, j] = [3 * k, k + 1 === end ? 3 * begin : 3 * k + 3];
    sum += wrapped(Math.atan2(p[j + 1], p[j]) - Math.atan2(p[i + 1], p[i]));
  }
  return sum;
}

function wrapped(angle: number): number {
  return angle - TURN * Math.round(angle / TURN);
}

function traceWhole(path: Path, { x, y, r }: Disc, clockwise: boolean): void {
  path.moveTo(x + r, y);
  path.ellipse(x, y, r, r, 0, 0, clockwise ? TURN : -TURN, !clockwise);
  path.closePath();
}

/**
 * Whether M = (0, 0, −1) lies in regions.
 * @param place A place of which it is known, axes of the view, nowhere near an outline.
 * @param inside Whether that place is in the regions.
 */
export function holdsHidden({ points: p, offsets }: Rings, place: Vector, inside: boolean): boolean {
  const [rx, ry, rz] = place;
  let holds = inside;
  for (let ring = 0; ring + 1 < offsets.length; ++ring) {
    const [begin, end] = [3 * offsets[ring], 3 * offsets[ring + 1]];
    let i = end - 3;
    let before = rx * p[i + 1] - ry * p[i];
    for (let j = begin; j < end; i = j, j += 3) {
      const side = rx * p[j + 1] - ry * p[j];
      if (side >= 0 !== before >= 0) {
        // The plane through the axis and the place is crossed here; on their side, and below the place?
        const t = before / (before - side);
        const [x, y] = [p[i] + t * (p[j] - p[i]), p[i + 1] + t * (p[j + 1] - p[i + 1])];
        const z = p[i + 2] + t * (p[j + 2] - p[i + 2]);
        const along = x * rx + y * ry; // times the place's distance from the axis
        if (along > 0 && z * (rx * rx + ry * ry) < rz * along) holds = !holds;
      }
      before = side;
    }
  }
  return holds;
}

/** Lays the cap n·x > d into a path, with its hidden part pushed to the limb. */
export function traceCap(path: Path, disc: Disc, cap: Circle): void {
  const { n, d, from } = cap;
  const parts = partsOf({ ...cap, to: from + TURN });
  if (parts.length === 0) {
    if (n[2] > d) traceDisc(path, disc);
    return;
  }
  // A part that goes on over the circle's beginning is one.
  if (parts.length === 4) parts.splice(0, 4, parts[2], parts[1] + TURN);
  tracePart(path, disc, cap, parts[0], parts[1]);
  if (parts[1] - parts[0] < TURN) traceHidden(path, disc, cap, parts[1], parts[0] + TURN);
  path.closePath();
  if (-n[2] > d) traceWhole(path, disc, false);
}

/** The hidden part of a circle, along the limb. */
function traceHidden(path: Path, disc: Disc, cap: Circle, begin: number, end: number): void {
  const azimuth = (t: number): number => {
    const [x, y] = pointAt(cap, t);
    return Math.atan2(y, x);
  };
  const [from, middle, to] = [azimuth(begin), azimuth((begin + end) / 2), azimuth(end)];
  traceLimb(path, disc, from, wrapped(middle - from) + wrapped(to - middle));
}

/** Goes on along the limb, counterclockwise for positive turns; a canvas forgets all turns of an arc but one. */
function traceLimb(path: Path, { x, y, r }: Disc, from: number, turn: number): void {
  const pieces = Math.ceil(Math.abs(turn) / HALF_TURN);
  for (let k = 0; k < pieces; ++k) {
    const [begin, end] = [from + (turn * k) / pieces, from + (turn * (k + 1)) / pieces];
    path.ellipse(x, y, r, r, 0, -begin, -end, turn > 0);
  }
}
