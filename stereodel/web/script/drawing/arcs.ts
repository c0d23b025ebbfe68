/**
 * Arcs of circles of a ball seen from afar, as the true arcs of ellipses that they are.
 * Points are in the axes of the view: x right, y up, z toward the reader, on the unit sphere; row k of an array is
 * point k. What has z >= 0 is seen. A circle n·x = d of the ball is seen as an ellipse with the middle d n and the half
 * axes r across n and r |n_z|, r = √(1 − d²).
 */

import type { Vector } from "../space.ts";
import type { Disc, Path } from "./pen.ts";

/** The half of the ball that is drawn: that in front, or that behind. */
export type Side = "front" | "back";

/** Largest distance of an arc from its chord that no eye sees, pixels: such arcs are drawn as lines. */
const UNSEEN_BOW = 0.1;

/** Product of two sides of a triangle, ball radii, below which its corners are one point, told apart by rounding alone. */
const ONE_POINT = 1e-24;

/** Points c + r (cos t e + sin t f) of a circle of the ball, t from `from` to `to`, counterclockwise about n. */
export interface Circle {
  readonly n: Vector;
  /** Distance of its plane from the ball's middle, along n. */
  readonly d: number;
  readonly r: number;
  /** Long axis of its image, level. */
  readonly e: readonly [number, number];
  readonly from: number;
  readonly to: number;
}

/** The circle n·x = d, n of length 1, all of it. */
export function circle(n: Vector, d: number): Circle {
  const h = Math.hypot(n[0], n[1]);
  const e = h > 0 ? ([-n[1] / h, n[0] / h] as const) : ([1, 0] as const);
  return { n, d, r: Math.sqrt(Math.max(0, 1 - d * d)), e, from: 0, to: 2 * Math.PI };
}

/**
 * The arc from row a over row m to row b; null where two of them are one point.
 * @param whole The whole circle through the three.
 */
export function arcThrough(p: ArrayLike<number>, a: number, m: number, b: number, whole = false): Circle | null {
  const [i, j, k] = [3 * a, 3 * m, 3 * b];
  const [ux, uy, uz] = [p[j] - p[i], p[j + 1] - p[i + 1], p[j + 2] - p[i + 2]];
  const [vx, vy, vz] = [p[k] - p[i], p[k + 1] - p[i + 1], p[k + 2] - p[i + 2]];
  const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  const length = Math.hypot(nx, ny, nz);
  if (length === 0) return null;
  const n: Vector = [nx / length, ny / length, nz / length];
  const all = circle(n, n[0] * p[i] + n[1] * p[i + 1] + n[2] * p[i + 2]);
  const from = angleOf(all, p, i);
  if (whole) return { ...all, from, to: from + 2 * Math.PI };
  const to = angleOf(all, p, k);
  return { ...all, from, to: to > from ? to : to + 2 * Math.PI };
}

/** The angle t of a point of the circle, whose coordinates begin at i. */
function angleOf({ n, d, e }: Circle, p: ArrayLike<number>, i: number): number {
  const [x, y, z] = [p[i] - d * n[0], p[i + 1] - d * n[1], p[i + 2] - d * n[2]];
  return Math.atan2(-n[2] * e[1] * x + n[2] * e[0] * y + (n[0] * e[1] - n[1] * e[0]) * z, e[0] * x + e[1] * y);
}

/** The parts on one side of the ball, as pairs of angles. */
export function partsOf(arc: Circle, side: Side = "front"): number[] {
  const { n, d, r, e, from, to } = arc;
  const sign = side === "front" ? 1 : -1;
  const [middle, reach] = [sign * d * n[2], sign * r * (n[0] * e[1] - n[1] * e[0])]; // z = middle + reach sin t
  if (middle >= Math.abs(reach)) return [from, to];
  if (middle <= -Math.abs(reach)) return [];
  const rise = Math.asin(-middle / Math.abs(reach));
  const [low, high] = reach > 0 ? [rise, Math.PI - rise] : [Math.PI + rise, 2 * Math.PI - rise];
  const parts: number[] = [];
  const turn = 2 * Math.PI;
  for (let k = Math.floor((from - high) / turn); low + turn * k < to; ++k) {
    const [begin, end] = [Math.max(from, low + turn * k), Math.min(to, high + turn * k)];
    if (begin < end) parts.push(begin, end);
  }
  return parts;
}

/** The point at an angle, axes of the view. */
export function pointAt({ n, d, r, e }: Circle, t: number): Vector {
  const [c, s] = [r * Math.cos(t), r * Math.sin(t)];
  return [
    d * n[0] + c * e[0] - s * n[2] * e[1],
    d * n[1] + c * e[1] + s * n[2] * e[0],
    d * n[2] + s * (n[0] * e[1] - n[1] * e[0]),
  ];
}

/** Lays a part of a circle into a path; it begins a line of its own unless it is a `continued` one. */
export function tracePart(path: Path, disc: Disc, arc: Circle, from: number, to: number, continued = false): void {
  const { n, d, r, e } = arc;
  if (!continued) {
    const [x, y] = pointAt(arc, from);
    path.moveTo(disc.x + disc.r * x, disc.y - disc.r * y);
  }
  // The drawing's y points down: angles turn the other way, and once more where n points away.
  const sign = n[2] >= 0 ? -1 : 1;
  const [x, y] = [disc.x + disc.r * d * n[0], disc.y - disc.r * d * n[1]];
  const turn = Math.atan2(-e[1], e[0]);
  path.ellipse(x, y, disc.r * r, disc.r * r * Math.abs(n[2]), turn, sign * from, sign * to, sign < 0);
}

/** Lays all parts of a circle's arc on one side into a path. */
export function traceCircle(path: Path, disc: Disc, arc: Circle, side: Side = "front"): void {
  const parts = partsOf(arc, side);
  for (let k = 0; k < parts.length; k += 2) tracePart(path, disc, arc, parts[k], parts[k + 1]);
}

/** Lays the arc from row a over row m to row b into a path. */
export function traceArc(
  path: Path,
  disc: Disc,
  p: ArrayLike<number>,
  a: number,
  m: number,
  b: number,
  side: Side = "front",
): void {
  const sign = side === "front" ? 1 : -1;
  const [isAIn, isBIn] = [sign * p[3 * a + 2] >= 0, sign * p[3 * b + 2] >= 0];
  if (isAIn === isBIn && bow(p, a, m, b) * disc.r < UNSEEN_BOW) {
    if (!isAIn) return;
    path.moveTo(disc.x + disc.r * p[3 * a], disc.y - disc.r * p[3 * a + 1]);
    path.lineTo(disc.x + disc.r * p[3 * b], disc.y - disc.r * p[3 * b + 1]);
    return;
  }
  const arc = arcThrough(p, a, m, b);
  if (arc !== null) traceCircle(path, disc, arc, side);
}

/**
 * How far the image of an arc is from its chord, at the most; infinite for more than half a circle.
 * The middle point may lie anywhere on the arc, even next to an end: if it is h from the chord c and p and q from the
 * ends, the circle has the radius ρ = p q / (2 h), and the arc the height c² / 4 / (ρ + √(ρ² − c² / 4)).
 */
export function bow(p: ArrayLike<number>, a: number, m: number, b: number): number {
  const [i, j, k] = [3 * a, 3 * m, 3 * b];
  const [ux, uy, uz] = [p[j] - p[i], p[j + 1] - p[i + 1], p[j + 2] - p[i + 2]];
  const [vx, vy, vz] = [p[k] - p[i], p[k + 1] - p[i + 1], p[k + 2] - p[i + 2]];
  const [wx, wy, wz] = [p[j] - p[k], p[j + 1] - p[k + 1], p[j + 2] - p[k + 2]];
  const sides = Math.sqrt((ux * ux + uy * uy + uz * uz) * (wx * wx + wy * wy + wz * wz));
  if (sides < ONE_POINT) return 0;
  if (ux * wx + uy * wy + uz * wz > 0) return Infinity; // less than a right angle at m
  const square = vx * vx + vy * vy + vz * vz;
  const t = (ux * vx + uy * vy + uz * vz) / square;
  const [hx, hy, hz] = [ux - t * vx, uy - t * vy, uz - t * vz];
  const seen = Math.sqrt(hx * hx + hy * hy);
  const double = 2 * Math.sqrt(hx * hx + hy * hy + hz * hz);
  // The height times h, over h: nothing is divided by an h of zero.
  const flat = Math.sqrt(Math.max(0, sides * sides - (square * double * double) / 4));
  return (seen * square) / (2 * (sides + flat));
}

/** Lays a line of points [begin, end) into a path, cut at the limb; points nearer than `least` pixels are passed over. */
export function traceLine(
  path: Path,
  disc: Disc,
  p: ArrayLike<number>,
  begin: number,
  end: number,
  closed: boolean,
  least = 0.5,
): void {
  const count = end - begin;
  let isDown = false;
  let [x, y, wasIn] = [0, 0, false];
  for (let n = 0; n <= count - (closed ? 0 : 1); ++n) {
    const i = 3 * (begin + (n % count));
    const [px, py, isIn] = [disc.x + disc.r * p[i], disc.y - disc.r * p[i + 1], p[i + 2] >= 0];
    if (n > 0 && isIn !== wasIn) {
      const j = 3 * (begin + n - 1);
      const t = p[j + 2] / (p[j + 2] - p[i + 2]);
      const [cx, cy] = [p[j] + t * (p[i] - p[j]), p[j + 1] + t * (p[i + 1] - p[j + 1])];
      const scale = disc.r / Math.hypot(cx, cy);
      if (isIn) {
        path.moveTo((x = disc.x + scale * cx), (y = disc.y - scale * cy));
        isDown = true;
      } else {
        path.lineTo(disc.x + scale * cx, disc.y - scale * cy);
        isDown = false;
      }
    }
    if (isIn) {
      if (!isDown) {
        path.moveTo((x = px), (y = py));
        isDown = true;
      } else if (Math.abs(px - x) + Math.abs(py - y) > least || n === count - (closed ? 0 : 1)) {
        path.lineTo((x = px), (y = py));
      }
    }
    wasIn = isIn;
  }
}
