/**
 * Arcs of circles of a ball seen from afar, as the true arcs of ellipses that they are, and regions that fill right from
 * every side and through every lens.
 * Points are in the axes of the view: x right, y up, z toward the reader, on the unit sphere; row k of an array is
 * point k. What has z >= 0 is seen. A circle n·x = d of the ball is seen as an ellipse with the middle d n and the half
 * axes r across n and r |n_z|, r = √(1 − d²).
 */

import type { MoebiusMap } from "../kernel/api.ts";
import { cross, dot, minus, row, unit, type Vector } from "../space.ts";
import { traceDisc, type Disc, type Path } from "./pen.ts";

/** The half of the ball that is drawn: that in front, or that behind. */
export type Side = "front" | "back";

/** Largest distance of an arc from its chord that no eye sees, pixels: such arcs are drawn as lines. */
const UNSEEN_BOW = 0.1;

/** Product of two sides of a triangle, ball radii, below which its corners are one point, told apart by rounding alone. */
const ONE_POINT = 1e-24;

const TURN = 2 * Math.PI;

/** Points d n + r (cos t e + sin t f) of a circle of the ball, t from `from` to `to`, counterclockwise about n. */
export interface Circle {
  readonly n: Vector;
  /** Distance of its plane from the ball's middle, along n. */
  readonly d: number;
  readonly r: number;
  /** Long axis of its image, level; and that of its plane at a right angle, which rises toward the reader. */
  readonly e: Vector;
  readonly f: Vector;
  readonly from: number;
  readonly to: number;
}

/** The circle n·x = d, n of length 1, all of it, from its lowest point on: what is in front is one part. */
export function circle(n: Vector, d: number): Circle {
  const h = Math.hypot(n[0], n[1]);
  const e: Vector = h > 0 ? [-n[1] / h, n[0] / h, 0] : [1, 0, 0];
  return { n, d, r: Math.sqrt(Math.max(0, 1 - d * d)), e, f: cross(n, e), from: -TURN / 4, to: (3 * TURN) / 4 };
}

/**
 * The arc from row a over the next one to that after it; null where two of them are one point.
 * @param whole The whole circle through the three.
 */
export function arcThrough(p: ArrayLike<number>, a = 0, whole = false): Circle | null {
  const [begin, middle, end] = [row(p, a), row(p, a + 1), row(p, a + 2)];
  const normal = cross(minus(middle, begin), minus(end, begin));
  if (Math.hypot(...normal) === 0) return null;
  const n = unit(normal);
  const all = circle(n, dot(n, begin));
  if (whole) return all;
  const [from, to] = [begin, end].map((x) => Math.atan2(dot(all.f, x), dot(all.e, x)));
  return { ...all, from, to: to > from ? to : to + TURN };
}

/** The parts on one side of the ball, as pairs of angles. */
function partsOf({ n, d, r, f, from, to }: Circle, side: Side = "front"): number[] {
  const isFront = side === "front";
  const sine = (-d * n[2]) / (r * f[2]); // of the angle at which z = d n_z + r f_z sin t is zero
  if (!(Math.abs(sine) < 1)) return (isFront ? d * n[2] : -d * n[2]) >= 0 ? [from, to] : [];
  const rise = Math.asin(sine);
  const [low, high] = isFront ? [rise, Math.PI - rise] : [Math.PI - rise, TURN + rise];
  const parts: number[] = [];
  for (let k = Math.floor((from - high) / TURN); low + TURN * k < to; ++k) {
    const [begin, end] = [Math.max(from, low + TURN * k), Math.min(to, high + TURN * k)];
    if (begin < end) parts.push(begin, end);
  }
  return parts;
}

/** The point at an angle, axes of the view. */
export function pointAt({ n, d, r, e, f }: Circle, t: number): Vector {
  const [c, s] = [r * Math.cos(t), r * Math.sin(t)];
  return [d * n[0] + c * e[0] + s * f[0], d * n[1] + c * e[1] + s * f[1], d * n[2] + s * f[2]];
}

/** Lays a part of a circle into a path. */
function tracePart(path: Path, disc: Disc, arc: Circle, from: number, to: number): void {
  const { n, d, r, e } = arc;
  const begin = pointAt(arc, from);
  path.moveTo(disc.x + disc.r * begin[0], disc.y - disc.r * begin[1]);
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

/** Lays the arc from row a over the next one to that after it into a path. */
export function traceArc(path: Path, disc: Disc, p: ArrayLike<number>, a = 0, side: Side = "front"): void {
  const sign = side === "front" ? 1 : -1;
  const i = 3 * a;
  const [isAIn, isBIn] = [sign * p[i + 2] >= 0, sign * p[i + 8] >= 0];
  if (isAIn === isBIn && bow(p, a) * disc.r < UNSEEN_BOW) {
    if (!isAIn) return;
    path.moveTo(disc.x + disc.r * p[i], disc.y - disc.r * p[i + 1]);
    path.lineTo(disc.x + disc.r * p[i + 6], disc.y - disc.r * p[i + 7]);
    return;
  }
  const arc = arcThrough(p, a);
  if (arc !== null) traceCircle(path, disc, arc, side);
}

/**
 * How far the image of an arc is from its chord, at the most; infinite for more than half a circle.
 * The middle point may lie anywhere on the arc, even next to an end: if it is h from the chord c and p and q from the
 * ends, the circle has the radius ρ = p q / (2 h), and the arc the height c² / 4 / (ρ + √(ρ² − c² / 4)).
 */
function bow(p: ArrayLike<number>, a = 0): number {
  const [i, j, k] = [3 * a, 3 * a + 3, 3 * a + 6];
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

/** Rings of points in the axes of the view: ring i is rows [offsets[i], offsets[i + 1]), its end joined to its start. */
export interface Rings {
  readonly points: Float64Array;
  readonly offsets: ArrayLike<number>;
}

/** Points nearer to the last one, pixels, are passed over. */
const UNSEEN_STEP = 0.5;

/** Lays rings into a path as lines, cut at the limb. */
export function traceOutlines(path: Path, disc: Disc, { points, offsets }: Rings): void {
  for (let ring = 0; ring + 1 < offsets.length; ++ring)
    traceRing(path, disc, points, offsets[ring], offsets[ring + 1], false);
}

/**
 * Lays regions into a path.
 * What is hidden is pushed outward to the limb: the disc is then the sphere without its hidden pole M, the middle of the
 * far side. With regions on the left of their rings the pushed rings wind once about what is inside and not at all about
 * the rest, or, if M is inside, not at all and minus once: then the whole disc is added. Whether M is inside is found by
 * counting crossings on the way from a place of which it is known, and never from areas, whose signs cannot be trusted.
 * @param holdsHidden Whether M = (0, 0, −1) is inside: `holdsHidden` tells.
 */
export function traceRegions(path: Path, disc: Disc, rings: Rings, holdsHidden: boolean): void {
  let discs = holdsHidden ? 1 : 0;
  for (let ring = 0; ring + 1 < rings.offsets.length; ++ring) {
    discs += traceRing(path, disc, rings.points, rings.offsets[ring], rings.offsets[ring + 1]);
  }
  // About the whole disc: with the rings' own sense, counterclockwise to the eye, or against it.
  for (let k = 0; k < Math.abs(discs); ++k) traceDisc(path, disc, discs > 0);
}

/** One ring, filled or as a line; one that is filled and all hidden is not drawn, and its turns about M are returned. */
function traceRing(path: Path, disc: Disc, p: Float64Array, begin: number, end: number, isFilled = true): number {
  let i = 3 * begin;
  while (i < 3 * end && p[i + 2] < 0) i += 3;
  const isHidden = i === 3 * end;
  if (isHidden) i = 3 * begin;
  if (isHidden && !isFilled) return 0;
  let [x, y] = [disc.x + disc.r * p[i], disc.y - disc.r * p[i + 1]];
  if (!isHidden) path.moveTo(x, y);
  let [from, turn] = [Math.atan2(p[i + 1], p[i]), 0]; // along the limb, while the ring is hidden
  for (let n = end - begin; n > 0; --n) {
    const j = i + 3 === 3 * end ? 3 * begin : i + 3;
    const [z, w] = [p[i + 2], p[j + 2]];
    if (z >= 0 !== w >= 0) {
      const t = z / (z - w);
      const azimuth = Math.atan2(p[i + 1] + t * (p[j + 1] - p[i + 1]), p[i] + t * (p[j] - p[i]));
      [x, y] = [disc.x + disc.r * Math.cos(azimuth), disc.y - disc.r * Math.sin(azimuth)];
      if (w < 0) {
        path.lineTo(x, y);
        [from, turn] = [azimuth, wrapped(Math.atan2(p[j + 1], p[j]) - azimuth)];
      } else if (isFilled) traceLimb(path, disc, from, turn + wrapped(azimuth - from - turn));
      else path.moveTo(x, y);
    } else if (w < 0 && isFilled) turn += wrapped(Math.atan2(p[j + 1], p[j]) - from - turn);
    if (w >= 0) {
      const [nx, ny] = [disc.x + disc.r * p[j], disc.y - disc.r * p[j + 1]];
      if (Math.abs(nx - x) + Math.abs(ny - y) > UNSEEN_STEP || n === 1) path.lineTo((x = nx), (y = ny));
    }
    i = j;
  }
  if (isHidden) return Math.round(turn / TURN);
  if (isFilled) path.closePath();
  return 0;
}

function wrapped(angle: number): number {
  return angle - TURN * Math.round(angle / TURN);
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
  const { n, d } = cap;
  const parts = partsOf(cap);
  if (parts.length === 0 && n[2] > d) traceDisc(path, disc);
  if (parts.length === 0) return;
  const [begin, end] = parts;
  tracePart(path, disc, cap, begin, end);
  if (end < cap.to) {
    // Its hidden part, along the limb.
    const [from, middle, to] = [end, (begin + end + TURN) / 2, begin].map((t) => {
      const [x, y] = pointAt(cap, t);
      return Math.atan2(y, x);
    });
    traceLimb(path, disc, from, wrapped(middle - from) + wrapped(to - middle));
  }
  path.closePath();
  if (-n[2] > d) traceDisc(path, disc, true);
}

/** Goes on along the limb, counterclockwise for positive turns; a canvas forgets all turns of an arc but one. */
function traceLimb(path: Path, { x, y, r }: Disc, from: number, turn: number): void {
  const pieces = Math.ceil(Math.abs(turn) / Math.PI);
  for (let k = 0; k < pieces; ++k) {
    const [begin, end] = [from + (turn * k) / pieces, from + (turn * (k + 1)) / pieces];
    path.ellipse(x, y, r, r, 0, -begin, -end, turn > 0);
  }
}

/** Sides of images that are shorter are left as they are, pixels. */
const SHORT = 8;

/** Largest distance of an outline from its points' polygon, pixels: less than half the width of a coast. */
const LEAST_BOW = 0.3;

/** Points of one side at the most: of half a circle round the whole ball they are some pixels apart. */
const MOST_PIECES = 128;

/**
 * The images of rings of great-circle arcs, with as many points more as it takes: the distance from a side's chord falls
 * with the square of the number of its pieces.
 * @param source The rings' points before the map.
 * @param rings Their images, in the axes of the view.
 * @param radius Of the ball, pixels.
 */
export function bentRings(source: Float64Array, rings: Rings, map: MoebiusMap, radius: number): Rings {
  const { points: p, offsets } = rings;
  const sides: [from: number, to: number][] = [];
  const least = (SHORT / radius) ** 2;
  for (let ring = 0; ring + 1 < offsets.length; ++ring) {
    for (let from = offsets[ring]; from < offsets[ring + 1]; ++from) {
      const to = from + 1 < offsets[ring + 1] ? from + 1 : offsets[ring];
      const [i, j] = [3 * from, 3 * to];
      const [x, y, z] = [p[j] - p[i], p[j + 1] - p[i + 1], p[j + 2] - p[i + 2]];
      if (x * x + y * y + z * z > least) sides.push([from, to]);
    }
  }
  const on = ([from, to]: (typeof sides)[0], t: number): number[] =>
    [0, 1, 2].map((k) => (1 - t) * source[3 * from + k] + t * source[3 * to + k]);
  const middles = map.apply(sides.flatMap((side) => on(side, 0.5)));
  const shift = new Uint32Array(p.length / 3 + 1); // how many points more there are before each
  const between = sides.flatMap((side, at) => {
    const [from, to] = side;
    const bent = (radius * bow([...row(p, from), ...row(middles, at), ...row(p, to)])) / LEAST_BOW;
    const count = Math.max(1, Math.min(MOST_PIECES, Math.ceil(Math.sqrt(bent))));
    shift[from + 1] = count - 1;
    return Array.from({ length: count - 1 }, (_, k) => on(side, (k + 1) / count)).flat();
  });
  if (between.length === 0) return rings;
  for (let k = 1; k < shift.length; ++k) shift[k] += shift[k - 1];
  const images = map.apply(between);
  const points = new Float64Array(p.length + images.length);
  for (let i = 0; i < p.length; ++i) points[i + 3 * shift[Math.floor(i / 3)]] = p[i];
  for (const [from] of sides)
    points.set(images.subarray(3 * shift[from], 3 * shift[from + 1]), 3 * (from + 1 + shift[from]));
  return { points, offsets: Uint32Array.from(offsets, (offset) => offset + shift[offset]) };
}
