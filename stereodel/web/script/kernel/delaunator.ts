/**
 * `Delaunator` with the properties and methods of delaunator, on the exact kernel. Call `load` of the package before.
 *
 * Triangles come in the order of that package for up to `MOST` points, more as the kernel lists them. Differences: which
 * triangles points on one circle have depends on the set of points alone, there on the way, too; those that the peer has
 * not come first; coordinates must be finite; points are equal if their coordinates are, and of equal ones the first is kept.
 */

import { PlanarDelaunay } from "./delaunay.ts";
import { cornersAs, halfedgesOf, mirrored, MOST, sweepHull } from "./sweep_hull.ts";
import { following } from "./topology.ts";

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
  /** @internal The triangulation, whose rows run the other way. */
  exact!: PlanarDelaunay;

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
    const { points, size, dimension } = this.exact;
    const swept = dimension === 2 && size <= MOST ? sweepHull(points) : null;
    if (swept !== null) this.exact.list(cornersAs(mirrored(swept.triangles), this.exact.simplices));
    const triangles = mirrored(this.exact.simplices);
    this.triangles = new Uint32Array(triangles);
    this.halfedges = halfedgesOf(triangles, mirrored(this.exact.neighbors));
    if (dimension < 2) {
      this.hull = Uint32Array.from(this.exact.flatOrder);
      const [first, last] = [2 * this.hull[0], 2 * this.hull[this.hull.length - 1]];
      if ((points[first] - points[last] || points[first + 1] - points[last + 1]) > 0) this.hull.reverse();
      return this;
    }
    const after = new Map<number, number>();
    this.halfedges.forEach((other, e) => other < 0 && after.set(triangles[e], triangles[following(e)]));
    let point = after.has(swept?.start ?? -1) ? swept!.start : [...after.keys()][0];
    this.hull = new Uint32Array(after.size).map((_, k) => (point = k === 0 ? point : after.get(point)!));
    return this;
  }
}
