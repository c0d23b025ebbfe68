/**
 * `Delaunator` with the properties and methods of delaunator, on the exact kernel. Call `load` of the package before.
 *
 * Triangles come in the order of a sweep, as there: by the last of their corners, when points follow one another by
 * their distances from the centre of a first triangle. Differences: where the peer flips edges on its way, its order is
 * another one; which triangles points on one circle have depends on the set of points alone, there on the way, too;
 * coordinates must be finite; points are equal if their coordinates are, and of equal ones the first is kept.
 */

import { PlanarDelaunay } from "./delaunay.ts";

type Points<Point> = ArrayLike<Point> | Iterable<Point>;
type Accessor<Point> = (point: Point, index: number, points: Points<Point>) => number;

/** Triangles of points of the plane and their half-edges; rows and hull run clockwise where y points up. */
export default class Delaunator<Coords extends ArrayLike<number> = ArrayLike<number>> {
  /** The points x0, y0, x1, y1, … as given; `update` reads them again. */
  readonly coords: Coords;
  /** Three points a triangle. */
  triangles!: Uint32Array;
  /** Of each entry of `triangles`, from which an edge leads to the next one of its row: the edge's other side, or -1. */
  halfedges!: Int32Array;
  /** The points around all triangles; without triangles all different points in order. */
  hull!: Uint32Array;
  /** @internal The triangulation. */
  exact!: PlanarDelaunay;
  /** @internal Of each triangle, the row of the triangulation that it is. */
  rows!: Uint32Array;

  /** The triangulation of points [x, y], or, with accessors, which may ask for `this`, of anything. */
  static from<Made, Point>(
    this: new (coords: Float64Array) => Made,
    points: Points<Point>,
    getX: Accessor<Point> = (point) => (point as ArrayLike<number>)[0],
    getY: Accessor<Point> = (point) => (point as ArrayLike<number>)[1],
    that?: unknown,
  ): Made {
    const place = (point: Point, k: number): number[] => [getX, getY].map((at) => at.call(that, point, k, points));
    return new this(Float64Array.from(Array.from(points, place).flat()));
  }

  /** @param coords Finite numbers x0, y0, x1, y1, …; not copied. */
  constructor(coords: Coords) {
    if (coords.length < 0) throw new RangeError(`Invalid typed array length: ${coords.length}`);
    if (coords.length > 0 && typeof coords[0] !== "number") {
      throw new TypeError("Expected coords to contain numbers, row after row in one flat array");
    }
    this.coords = coords;
    this.update();
  }

  /** The number of entries of `triangles`. */
  get trianglesLen(): number {
    return this.triangles.length;
  }

  /** Triangulates anew, after changes of `coords` in place. */
  update(): this {
    this.exact = new PlanarDelaunay(Float64Array.from(this.coords).subarray(0, this.coords.length & ~1));
    const { points, size, simplices, neighbors, dimension } = this.exact;
    const triangles = (this.triangles = new Uint32Array(simplices.length));
    const halfedges = (this.halfedges = new Int32Array(simplices.length));
    this.rows = new Uint32Array(simplices.length / 3).map((_, row) => row);
    if (dimension < 2) {
      this.hull = Uint32Array.from(this.exact.flatOrder);
      const [first, last] = [2 * this.hull[0], 2 * this.hull[this.hull.length - 1]];
      if ((points[first] - points[last] || points[first + 1] - points[last + 1]) > 0) this.hull.reverse();
      return this;
    }

    const swept = sweep(this.exact);
    const place = new Uint32Array(size);
    for (let k = 0; k < size; ++k) place[swept[k]] = k;
    /** Of each row the corner that comes last, which becomes the second entry; the first triangle begins with the first. */
    const last = new Uint8Array(this.rows.length);
    const [keys, seconds] = [new Uint32Array(last.length), new Uint32Array(last.length)];
    for (let row = 0; row < last.length; ++row) {
      const a = place[simplices[3 * row]];
      const b = place[simplices[3 * row + 1]];
      const c = place[simplices[3 * row + 2]];
      keys[row] = Math.max(a, b, c);
      seconds[row] = simplices[3 * row + 1];
      if (a + b + c === 3) last[row] = a === 0 ? 2 : b === 0 ? 0 : 1;
      else last[row] = a === keys[row] ? 0 : b === keys[row] ? 1 : 2;
    }
    const firsts = seconds.map((_, row) => simplices[3 * row]);
    const rows = (this.rows = sorted(sorted(sorted(this.rows, seconds, size), firsts, size), keys, size));
    const at = new Uint32Array(rows.length);
    for (let k = 0; k < rows.length; ++k) at[rows[k]] = 3 * k;
    // Row after row as they are in the triangulation, where neighbours are near each other.
    const after = new Map<number, number>();
    for (let row = 0; row < last.length; ++row) {
      for (let k = 0; k < 3; ++k) {
        const from = simplices[3 * row + ((last[row] + 4 - k) % 3)];
        const beyond = neighbors[3 * row + ((last[row] + 5 - k) % 3)];
        triangles[at[row] + k] = from;
        if (beyond < 0) after.set(from, simplices[3 * row + ((last[row] + 3 - k) % 3)]);
        const corner = neighbors[3 * beyond] === row ? 0 : neighbors[3 * beyond + 1] === row ? 1 : 2;
        halfedges[at[row] + k] = beyond < 0 ? -1 : at[beyond] + ((last[beyond] + 5 - corner) % 3);
      }
    }
    // The last of the sweep, the farthest, is the second one.
    let farthest = size - 1;
    while (!after.has(swept[farthest])) --farthest;
    let point = rows.length === 1 ? triangles[1] : swept[farthest];
    this.hull = new Uint32Array(after.size).map(() => (point = after.get(point)!));
    this.hull = Uint32Array.from([...this.hull.subarray(-2), ...this.hull.subarray(0, -2)]);
    return this;
  }
}

/** Numbers in the order of their keys below `size`; in the order given where these are equal. */
function sorted(numbers: Uint32Array, keys: Uint32Array, size: number): Uint32Array {
  const next = new Uint32Array(size + 1);
  for (let k = 0; k < keys.length; ++k) ++next[keys[k] + 1];
  for (let k = 0; k < size; ++k) next[k + 1] += next[k];
  const order = new Uint32Array(numbers.length);
  for (let k = 0; k < numbers.length; ++k) order[next[keys[numbers[k]]]++] = numbers[k];
  return order;
}

/**
 * Points by their distances from the centre of the first triangle, equally far ones from the left. Its corners begin: the
 * point in the middle, that next to it, and the one with which both have the smallest circle.
 */
function sweep(exact: PlanarDelaunay): Uint32Array {
  const { points, size, simplices } = exact;
  const [low, high] = [points.slice(0, 2), points.slice(0, 2)];
  for (let k = 0; k < points.length; ++k) {
    if (points[k] < low[k % 2]) low[k % 2] = points[k];
    if (points[k] > high[k % 2]) high[k % 2] = points[k];
  }
  const [middle] = exact.nearest([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2]);
  const apart = (k: number, x: number, y: number): number => (points[2 * k] - x) ** 2 + (points[2 * k + 1] - y) ** 2;
  const fromMiddle = (k: number): number => apart(k, points[2 * middle], points[2 * middle + 1]);
  let first: { corners: number[]; center: Float64Array; measures: number[] } | null = null;
  for (let at = simplices.indexOf(middle); at >= 0; at = simplices.indexOf(middle, at + 1)) {
    const row = Array.from(simplices.subarray(at - (at % 3), at - (at % 3) + 3));
    const corners = row.sort((i, j) => fromMiddle(i) - fromMiddle(j) || i - j);
    const center = new PlanarDelaunay(corners.flatMap((k) => [points[2 * k], points[2 * k + 1]])).circumcenters;
    const measures = [fromMiddle(corners[1]), apart(middle, center[0], center[1]), corners[2]];
    const differ = measures.findIndex((measure, k) => measure !== first?.measures[k]);
    if (first === null || measures[differ] < first.measures[differ]) first = { corners, center, measures };
  }
  const { corners, center } = first!;

  // Sorted as doubles, which is fast: steps of the distances, then the numbers of the points, which are below 2^24.
  const keys = new Float64Array(size);
  for (let k = 0; k < size; ++k) keys[k] = apart(k, center[0], center[1]);
  const steps = (2 ** 28 - 4) / keys.reduce((most, distance) => Math.max(most, distance), 0);
  for (let k = 0; k < size; ++k) keys[k] = (3 + Math.floor(keys[k] * steps)) * 2 ** 24 + k;
  corners.forEach((point, place) => (keys[point] = place * 2 ** 24 + point));
  keys.sort();
  const order = new Uint32Array(size);
  for (let k = 0; k < size; ++k) order[k] = keys[k] % 2 ** 24;
  const sameStep = (i: number, j: number): boolean => Math.floor(keys[i] / 2 ** 24) === Math.floor(keys[j] / 2 ** 24);
  const before = (i: number, j: number): number => points[i] - points[j] || points[i + 1] - points[j + 1];
  for (let from = 0, to = 1; to <= size; ++to) {
    if (to < size && sameStep(from, to)) continue;
    if (to > from + 1) order.subarray(from, to).sort((i, j) => before(2 * i, 2 * j));
    from = to;
  }
  return order;
}
