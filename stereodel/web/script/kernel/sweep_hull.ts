/**
 * The sweep-hull algorithm as delaunator runs it, in doubles: points are inserted by their distance from a seed triangle.
 *
 * Only the order of its triangles is wanted, which users of libraries made on it see; which triangles there are is the
 * exact kernel's to say. Hence each rounded number is made by the same operations as there, ties of the sort included.
 */

import { orient2d } from "./predicates.ts";
import { following } from "./topology.ts";

/** More points than these are listed as the kernel has them: to follow the other order would take as long as to triangulate. */
export const MOST = 4096;

/** Nearer ones are one point. */
const SAME = 2 ** -52;
/** Bound of the rounding of a determinant of two rows of differences, in parts of the sum of its two products. */
const ROUNDING = 2 ** -51;

/** Triangles, three points each, clockwise, and with which point the list of the hull begins. */
export function sweepHull(xy: Float64Array): { triangles: Int32Array; start: number } {
  const count = xy.length / 2;
  const [xs, ys] = [0, 1].map((axis) => xy.filter((_, k) => k % 2 === axis));
  const squared = (i: number, x: number, y: number): number => (xs[i] - x) * (xs[i] - x) + (ys[i] - y) * (ys[i] - y);

  /** Above 0 if the points turn left, below right, 0 on one line; exactly. */
  function turn(a: number, b: number, c: number): number {
    const one = (xs[a] - xs[c]) * (ys[b] - ys[c]);
    const other = (ys[a] - ys[c]) * (xs[b] - xs[c]);
    if (Math.abs(one - other) > ROUNDING * (Math.abs(one) + Math.abs(other))) return one - other;
    const [p, q, r] = [a, b, c].map((i) => [xs[i], ys[i]]);
    return orient2d(p, q, r)[0];
  }

  /** From the first point to the centre of the circle through all three, left in dx and dy; its square. */
  let [dx, dy] = [0, 0];
  function toCenter(a: number, b: number, c: number): number {
    const bx = xs[b] - xs[a];
    const by = ys[b] - ys[a];
    const cx = xs[c] - xs[a];
    const cy = ys[c] - ys[a];
    const bb = bx * bx + by * by;
    const cc = cx * cx + cy * cy;
    const half = 0.5 / (bx * cy - by * cx);
    dx = (cy * bb - by * cc) * half;
    dy = (bx * cc - cx * bb) * half;
    return dx * dx + dy * dy;
  }

  /** The point of which something is least, the first one of several, -1 if it is finite for none. */
  function least(measure: (i: number) => number): number {
    let [found, lowest] = [-1, Infinity];
    for (let i = 0; i < count; ++i) {
      const value = measure(i);
      if (value < lowest) [found, lowest] = [i, value];
    }
    return found;
  }

  const [x, y] = [xs, ys].map((values) => (Math.min(...values) + Math.max(...values)) / 2);
  const seed = least((i) => squared(i, x, y));
  let second = least((i) => squared(i, xs[seed], ys[seed]) || Infinity);
  let third = least((i) => (i === seed || i === second || second < 0 ? Infinity : toCenter(seed, second, i)));
  if (third < 0) return { triangles: new Int32Array(0), start: -1 };
  if (turn(seed, second, third) > 0) [second, third] = [third, second];
  toCenter(seed, second, third);
  const [x0, y0] = [xs[seed] + dx, ys[seed] + dy];
  const distances = xs.map((_, i) => squared(i, x0, y0));
  const order = Int32Array.from(distances.keys()).sort((i, j) => distances[i] - distances[j]);

  const triangles = new Int32Array(6 * count);
  const halfedges = new Int32Array(6 * count);
  let used = 0;
  // The hull as a ring, the side of a triangle at each of its edges, and points of it by their angle.
  const [next, previous, side] = [new Int32Array(count), new Int32Array(count), new Int32Array(count)];
  const buckets = new Int32Array(Math.ceil(Math.sqrt(count))).fill(-1);
  let start = seed;

  function bucket(i: number): number {
    const x = xs[i] - x0;
    const y = ys[i] - y0;
    const p = x / (Math.abs(x) + Math.abs(y));
    return Math.floor(((y > 0 ? 3 - p : 1 + p) / 4) * buckets.length) % buckets.length;
  }

  function link(one: number, other: number): void {
    halfedges[one] = other;
    if (other >= 0) halfedges[other] = one;
  }

  function add(a: number, b: number, c: number, ab: number, bc: number, ca: number): number {
    triangles[used] = a;
    triangles[used + 1] = b;
    triangles[used + 2] = c;
    link(used, ab);
    link(used + 1, bc);
    link(used + 2, ca);
    return (used += 3) - 3;
  }

  /** Whether the fourth point lies in the circle of the three. */
  function inside(a: number, b: number, c: number, p: number): boolean {
    const ax = xs[a] - xs[p];
    const ay = ys[a] - ys[p];
    const bx = xs[b] - xs[p];
    const by = ys[b] - ys[p];
    const cx = xs[c] - xs[p];
    const cy = ys[c] - ys[p];
    const bb = bx * bx + by * by;
    const cc = cx * cx + cy * cy;
    return ax * (by * cc - bb * cy) - ay * (bx * cc - bb * cx) + (ax * ax + ay * ay) * (bx * cy - by * cx) < 0;
  }

  /** Flips until all circles beyond a side are empty; the side before it of its triangle. */
  const open: number[] = [];
  function legalize(first: number): number {
    let before = 0;
    for (let a: number | undefined = first; a !== undefined;) {
      const b = halfedges[a];
      before = preceding(a);
      const far = preceding(b);
      if (b < 0 || !inside(triangles[before], triangles[a], triangles[following(a)], triangles[far])) {
        a = open.pop();
        continue;
      }
      triangles[a] = triangles[far];
      triangles[b] = triangles[before];
      if (halfedges[far] < 0) side[triangles[a]] = a;
      link(a, halfedges[far]);
      link(b, halfedges[before]);
      link(before, far);
      open.push(following(b));
    }
    return before;
  }

  add(seed, second, third, -1, -1, -1);
  [seed, second, third].forEach((i, k, seeds) => {
    [next[i], previous[i], side[i]] = [seeds[(k + 1) % 3], seeds[(k + 2) % 3], k];
    buckets[bucket(i)] = i;
  });
  for (let rank = 0, last = -1; rank < count; ++rank) {
    const i = order[rank];
    if (Math.abs(xs[i] - xs[last]) <= SAME && Math.abs(ys[i] - ys[last]) <= SAME) continue;
    last = i;
    if (i === seed || i === second || i === third) continue;
    let from = 0;
    for (let k = 0, key = bucket(i); k < buckets.length; ++k) {
      from = buckets[(key + k) % buckets.length];
      if (from >= 0 && from !== next[from]) break; // points that left the hull are their own next
    }
    from = previous[from];
    let e = from;
    while (e >= 0 && turn(i, e, next[e]) <= 0) e = next[e] === from ? -1 : next[e];
    if (e < 0) continue;
    let t = add(e, i, next[e], -1, -1, side[e]);
    side[i] = legalize(t + 2);
    side[e] = t;
    let ahead = next[e];
    for (let q = next[ahead]; turn(i, ahead, q) > 0; q = next[ahead]) {
      t = add(ahead, i, q, side[i], -1, side[ahead]);
      side[i] = legalize(t + 2);
      next[ahead] = ahead;
      ahead = q;
    }
    if (e === from) {
      for (let q = previous[e]; turn(i, q, e) > 0; q = previous[e]) {
        t = add(q, i, e, -1, side[e], side[q]);
        legalize(t + 2);
        side[q] = t;
        next[e] = e;
        e = q;
      }
    }
    start = previous[i] = e;
    next[e] = previous[ahead] = i;
    next[i] = ahead;
    buckets[bucket(i)] = i;
    buckets[bucket(e)] = e;
  }
  return { triangles: triangles.subarray(0, used), start };
}

/**
 * Where in `simplices` the corners are of triangles that come as in a list of the same kind, their first ones as there;
 * those that it does not have come before.
 */
export function cornersAs(list: Int32Array, simplices: Int32Array): Int32Array {
  const rows = new Map<number, number>(); // by their first two points, of which the first one is the lowest
  for (let e = 0; e < simplices.length; e += 3) rows.set(simplices[e] * MOST + simplices[e + 1], e);
  const found = new Int32Array(simplices.length);
  let at = simplices.length;
  for (let e = list.length - 3; e >= 0; e -= 3) {
    let low = list[e + 1] < list[e] ? e + 1 : e;
    if (list[e + 2] < list[low]) low = e + 2;
    const side = list[low] * MOST + list[following(low)];
    const row = rows.get(side);
    if (row === undefined || simplices[row + 2] !== list[preceding(low)]) continue;
    rows.delete(side);
    for (let k = 2; k >= 0; --k) found[--at] = row + ((k + 3 - (low - e)) % 3);
  }
  for (const row of [...rows.values()].reverse()) for (let k = 2; k >= 0; --k) found[--at] = row + k;
  return found;
}

/** Rows of three the other way around, from their first numbers on. */
export function mirrored(rows: Int32Array): Int32Array {
  const turned = rows.slice();
  for (let e = 1; e < rows.length; e += 3) {
    turned[e] = rows[e + 1];
    turned[e + 1] = rows[e];
  }
  return turned;
}

/** The entry before one in its row of three. */
export const preceding = (entry: number): number => (entry % 3 === 0 ? entry + 2 : entry - 1);

/** Of each side of a triangle, from its first point on, the same side of the one beyond it, or -1. */
export function halfedgesOf(triangles: Int32Array, beyond: Int32Array): Int32Array {
  return triangles.map((_, e) => {
    const row = 3 * beyond[preceding(e)];
    const to = triangles[following(e)];
    return row < 0 ? -1 : triangles[row] === to ? row : triangles[row + 1] === to ? row + 1 : row + 2;
  });
}
