/** Delaunay triangulations of the plane and of the sphere. */

import { asCount, asDirections, asIndices, asRows, type Numbers } from "./checks.ts";
import { lonlatToXyz, type Latitude } from "./coordinates.ts";
import { answered, computed, filled, Kept, type Argument } from "./instance.ts";
import { adjacencyOf, boundaryOf, edgesOf } from "./topology.ts";

/** Tests that each stage left open; `curvature` is a stage of the sphere alone. */
export interface Inconclusive {
  readonly filter: number;
  readonly curvature: number;
  readonly doubleDouble: number;
  readonly exact: number;
}

/** Points from which on a fresh start is faster than inserting (removing) one for so many present ones: measured. */
const REBUILD_INSERTING = 3;
const REBUILD_REMOVING = 6;

/**
 * A triangulation that depends on the set of points alone.
 *
 * Arrays are flat, row after row, and must not be written to; `insert` and `remove` replace them, and those handed out
 * earlier do not change.
 */
export abstract class Delaunay {
  /** Numbers in a row of points: 2 or 3. */
  abstract get width(): 2 | 3;

  /** The points, in the order given, inserted ones at the end. */
  readonly points!: Float64Array;
  /** Triangles, three points each, counterclockwise, smallest index first. */
  readonly simplices!: Int32Array;
  /** The triangle opposite each corner, three each, -1 where there is none. */
  readonly neighbors!: Int32Array;
  /** Pairs dropped, kept of equal points; the lowest index is kept, and is the one in `simplices`. */
  readonly duplicates!: Int32Array;
  /** Of the points: -1 without any, 0, 1 on one line or great circle, or 2 when there are triangles. */
  readonly dimension!: number;
  /** Tests that each stage left open, in construction and changes. */
  readonly inconclusive!: Inconclusive;

  /** @internal All that the kernel takes; the arrays may stay there. */
  readonly forKernel!: [points: Kept, size: number, simplices: Kept, neighbors: Kept, count: number];
  private derived: { [K in "edges" | "hull" | "order"]?: Int32Array } & { centers?: Float64Array; closing?: Kept } = {};

  /** @param points Rows of finite numbers x, y, y up, or of directions x, y, z of any length but zero. Copied. */
  constructor(points: Numbers) {
    const given = this.check(points, "points");
    this.fresh(given === points ? given.slice() : given);
  }

  /** Number of points, duplicates included. */
  get size(): number {
    return this.points.length / this.width;
  }

  /** Edges i < j, two points each, in lexicographic order. */
  get edges(): Int32Array {
    return (this.derived.edges ??= edgesOf(this.simplices, this.neighbors));
  }

  /** Neighbours of each point: those of point k are `indices` from `indptr[k]` to before `indptr[k + 1]`. */
  get vertexNeighborVertices(): { indptr: Int32Array; indices: Int32Array } {
    return adjacencyOf(this.edges, this.size);
  }

  /** Directed edges around the triangles, which lie on the left, two points each, in lexicographic order. */
  get convexHull(): Int32Array {
    const closed = this.closed?.values;
    const inside = (triangle: number): boolean => closed?.[triangle] !== 1;
    return (this.derived.hull ??= boundaryOf(this.simplices, this.neighbors, inside));
  }

  /** The centre of each triangle's circle, rounded from the exact one: a point of the plane, or a unit vector. */
  get circumcenters(): Float64Array {
    const [points, size, simplices, , count] = this.forKernel;
    const name = `${this.space}_circumcenters`;
    return (this.derived.centers ??= computed(this.width * count, name, points, size, simplices, count));
  }

  /**
   * Adds points; they follow the old ones.
   *
   * @returns Their indices.
   */
  insert(points: Numbers): Int32Array {
    const added = this.check(points, "points");
    const before = this.size;
    const count = added.length / this.width;
    const all = new Float64Array(this.points.length + added.length);
    all.set(this.points);
    all.set(added, this.points.length);
    if (this.dimension < 2 || REBUILD_INSERTING * count > before) this.fresh(all);
    else if (count > 0) this.change("insert", [added, count], all);
    return Int32Array.from({ length: count }, (_, k) => before + k);
  }

  /**
   * Takes out points; the others keep their order and are numbered anew.
   *
   * @param indices Points to take out; repetitions count once.
   * @returns The new index of each old point, -1 for those removed.
   */
  remove(indices: Numbers): Int32Array {
    const gone = asIndices(indices, this.size);
    const isGone = new Uint8Array(this.size);
    for (const k of gone) isGone[k] = 1;
    let left = 0;
    const number = Int32Array.from(isGone, (is) => (is ? -1 : left++));
    const rest = this.points.filter((_, at) => !isGone[Math.floor(at / this.width)]);
    if (this.dimension < 2 || REBUILD_REMOVING * (number.length - left) > left) this.fresh(rest);
    else if (gone.length > 0) this.change("remove", [gone, gone.length], rest);
    return number;
  }

  /**
   * The triangle that holds each query, exactly: an index into the rows of `simplices`, the lowest one on a shared edge
   * or vertex, -1 outside `convexHull`.
   */
  findSimplex(queries: Numbers): Int32Array {
    const asked = this.check(queries, "xyz".slice(0, this.width));
    const count = asked.length / this.width;
    return this.answers(count, "find_simplex", [...this.forQueries(), asked, count]);
  }

  /**
   * The nearest point of each query, or the k nearest, exactly: in the order of their distances (angles on the sphere),
   * equally near ones in that of their indices; duplicates are points like all others.
   *
   * @param queries Points, row after row.
   * @param k How many points are wanted of each, 1 to the number of points.
   * @returns Indices of points, k of each query.
   */
  nearest(queries: Numbers, k?: number): Int32Array {
    CHECK: if (this.size === 0) throw new RangeError("nearest needs at least one point; this triangulation has none");
    const asked = this.check(queries, "xyz".slice(0, this.width));
    const each = k === undefined ? 1 : asCount(k, "k", 1, this.size);
    const size = asked.length / this.width;
    const same = [this.duplicates, this.duplicates.length / 2];
    if (this.dimension < 2) {
      const order = [this.forKernel[0], this.flatOrder, this.flatOrder.length];
      return this.answers(size * each, "nearest_flat", [...order, ...same, asked, size, each]);
    }
    if (k === undefined) return this.answers(size, "nearest", [...this.forQueries(), asked, size]);
    return this.answers(size * each, "k_nearest", [...this.forQueries(), ...same, asked, size, each]);
  }

  /** The different points in the order along their line or great circle, without triangles. */
  get flatOrder(): Int32Array {
    const types = [Int32Array, Int32Array, Int32Array, Int32Array] as const;
    return (this.derived.order ??= answered(types, `${this.space}_flat_diagram`, this.forKernel[0], this.size)[3]);
  }

  /** @internal Lists the triangles anew, by the places in `simplices` of what becomes their corners. */
  list(from: Int32Array): void {
    const { simplices, neighbors } = this;
    const place = new Int32Array(from.length / 3);
    for (let row = 0; row < place.length; ++row) place[Math.floor(from[3 * row] / 3)] = row;
    const beyond = from.map((at) => (neighbors[at] < 0 ? -1 : place[neighbors[at]]));
    this.hold(this.forKernel[0], from.map((at) => simplices[at]), beyond); // prettier-ignore
  }

  private forQueries(): Argument[] {
    const [points, , simplices, neighbors, count] = this.forKernel;
    return [points, simplices, neighbors, this.closed, count];
  }

  /** One byte a triangle of the sphere: 1 where no query can lie. */
  protected get closed(): Kept | null {
    if (this.width === 2) return null;
    const [points, size, simplices, , count] = this.forKernel;
    return (this.derived.closing ??= new Kept(
      filled(Uint8Array, count, "sphere_closing", points, size, simplices, count),
    ));
  }

  /** @internal Of the kernel's functions: the beginning of their names. */
  get space(): string {
    return this.width === 2 ? "plane" : "sphere";
  }

  private check(points: Numbers, name: string): Float64Array {
    return this.width === 2 ? asRows(points, 2, name) : asDirections(points, name);
  }

  private answers(length: number, name: string, given: Argument[]): Int32Array {
    return filled(Int32Array, length, `${this.space}_${name}`, ...given);
  }

  private fresh(points: Float64Array): void {
    const kept = new Kept(points);
    const none: Inconclusive = { filter: 0, curvature: 0, doubleDouble: 0, exact: 0 };
    this.take(points, kept, none, "triangulate", kept, points.length / this.width);
  }

  /** The version after a change of this one; from the points alone if no triangles are left. */
  private change(what: "insert" | "remove", given: Argument[], points: Float64Array): void {
    const now = [...this.forKernel, this.duplicates, this.duplicates.length / 2, ...given];
    this.take(points, new Kept(points), this.inconclusive, what, ...now);
    if (this.dimension < 2) this.fresh(points);
  }

  /** What the kernel makes of points; tests are counted on from those before. */
  private take(points: Float64Array, kept: Kept, before: Inconclusive, what: string, ...given: Argument[]): void {
    const types = [Int32Array, Int32Array, Int32Array, Int32Array, Float64Array] as const;
    const name = `${this.space}_${what}`;
    const [simplices, neighbors, duplicates, [dimension], open] = answered(types, name, ...given);
    const inconclusive = {
      filter: before.filter + open[0],
      curvature: before.curvature + open[1],
      doubleDouble: before.doubleDouble + open[2],
      exact: before.exact + open[3],
    };
    Object.assign(this, { points, duplicates, dimension, inconclusive });
    this.hold(kept, simplices, neighbors);
  }

  private hold(points: Kept, simplices: Int32Array, neighbors: Int32Array): void {
    const forKernel = [points, this.size, new Kept(simplices), new Kept(neighbors), simplices.length / 3];
    Object.assign(this, { simplices, neighbors, forKernel, derived: {} });
  }
}

/**
 * Delaunay triangulation of points of the plane: no point lies inside a triangle's circle.
 *
 * The answer is that of exact arithmetic on the given doubles, and equal to that of the Python class of the same name,
 * row by row.
 *
 * @example
 * const square = new PlanarDelaunay([0, 0, 2, 0, 2, 2, 0, 2, 1, 1]);
 * square.edges; // 0 1, 0 3, 0 4, 1 2, 1 4, 2 3, 2 4, 3 4
 */
export class PlanarDelaunay extends Delaunay {
  override get width(): 2 {
    return 2;
  }
}

/**
 * Delaunay triangulation of directions: each triangle's bubble on the outer side of its plane is empty.
 *
 * The answer is that of exact arithmetic on the rays through the given doubles, and equal to that of the Python class of
 * the same name, row by row.
 *
 * @example
 * const octahedron = new SphericalDelaunay([1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1]);
 * octahedron.nearest([1, 2, 3]); // 4
 */
export class SphericalDelaunay extends Delaunay {
  override get width(): 3 {
    return 3;
  }

  /** The triangulation of points given by longitude and latitude in degrees, row after row; `latitude` as in `lonlatToXyz`. */
  static fromLonlat(lonlat: Numbers, latitude: Latitude = "spherical"): SphericalDelaunay {
    return new SphericalDelaunay(lonlatToXyz(lonlat, latitude));
  }

  /**
   * One byte for each facet: 1 where its empty bubble is a hemisphere or more, so that it is no spherical triangle.
   * There are some exactly if all points lie in a closed hemisphere.
   */
  get closing(): Uint8Array {
    return this.closed!.values as Uint8Array;
  }
}
