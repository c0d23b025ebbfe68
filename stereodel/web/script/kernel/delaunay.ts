/** What the Delaunay triangulations of plane and sphere have in common. */

import { asCount, asIndices, type Numbers } from "./checks.ts";
import { Kept, kernel, type Answer, type Argument } from "./instance.ts";
import { adjacencyOf, boundaryOf, edgesOf } from "./topology.ts";

/** The plane, rows of two, or the sphere, rows of three: how the functions of the kernel begin. */
export type Space = "plane" | "sphere";

/** Tests that each stage left open; `curvature` is a stage of the sphere alone. */
export interface Inconclusive {
  readonly filter: number;
  readonly curvature: number;
  readonly doubleDouble: number;
  readonly exact: number;
}

interface Arrays {
  readonly points: Float64Array;
  readonly simplices: Int32Array;
  readonly neighbors: Int32Array;
  readonly duplicates: Int32Array;
  readonly dimension: number;
  readonly inconclusive: Inconclusive;
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
  /** The space, which names the functions of the kernel. */
  protected abstract readonly space: Space;
  /** Numbers in a row of points: 2 or 3. */
  abstract readonly width: 2 | 3;

  private arrays!: Arrays;
  private kept!: { points: Kept; simplices: Kept; neighbors: Kept };
  private derived: { edges?: Int32Array; hull?: Int32Array; centers?: Float64Array; order?: Int32Array } = {};

  /** Points as the kernel takes them: checked, and not copied if they are an array of doubles. */
  protected abstract check(points: Numbers, name: string): Float64Array;
  /** Whether a query can lie in a triangle. */
  protected abstract isOpen(triangle: number): boolean;
  /** One byte a triangle: 1 where no query can lie; null if there is none. */
  protected abstract closed(): Kept | null;

  /** Takes the place of what a constructor would do, when the fields of the subclass are there. */
  protected build(points: Numbers): void {
    const given = this.check(points, "points");
    this.fresh(given === points ? given.slice() : given);
  }

  /** The points, in the order given, inserted ones at the end. */
  get points(): Float64Array {
    return this.arrays.points;
  }

  /** Number of points, duplicates included. */
  get size(): number {
    return this.points.length / this.width;
  }

  /** Triangles, three points each, counterclockwise, smallest index first. */
  get simplices(): Int32Array {
    return this.arrays.simplices;
  }

  /** The triangle opposite each corner, three each, -1 where there is none. */
  get neighbors(): Int32Array {
    return this.arrays.neighbors;
  }

  /** Pairs dropped, kept of equal points; the lowest index is kept, and is the one in `simplices`. */
  get duplicates(): Int32Array {
    return this.arrays.duplicates;
  }

  /** Of the points: -1 without any, 0, 1 on one line or great circle, or 2 when there are triangles. */
  get dimension(): number {
    return this.arrays.dimension;
  }

  /** Tests that each stage left open, in construction and changes. */
  get inconclusive(): Inconclusive {
    return this.arrays.inconclusive;
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
    return (this.derived.hull ??= boundaryOf(this.simplices, this.neighbors, (t) => this.isOpen(t)));
  }

  /** The centre of each triangle's circle, rounded from the exact one: a point of the plane, or a unit vector. */
  get circumcenters(): Float64Array {
    return (this.derived.centers ??= kernel().run((session) => {
      const count = this.simplices.length / 3;
      const centers = session.place(Float64Array, this.width * count);
      const { points, simplices } = this.kept;
      session.call(`${this.space}_circumcenters`, points, this.size, simplices, count, centers);
      return centers.copy();
    }));
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
    const number = new Int32Array(this.size);
    for (const k of gone) number[k] = -1;
    let left = 0;
    for (let k = 0; k < number.length; ++k) if (number[k] === 0) number[k] = left++;
    const rest = new Float64Array(this.width * left);
    for (let k = 0; k < number.length; ++k) {
      if (number[k] < 0) continue;
      rest.set(this.points.subarray(this.width * k, this.width * (k + 1)), this.width * number[k]);
    }
    if (this.dimension < 2 || REBUILD_REMOVING * (number.length - left) > left) this.fresh(rest);
    else if (gone.length > 0) this.change("remove", [gone, gone.length], rest);
    return number;
  }

  /**
   * The triangle that holds each query, exactly: an index into the rows of `simplices`, the lowest one on a shared edge
   * or vertex, -1 outside `convexHull`.
   */
  findSimplex(queries: Numbers): Int32Array {
    const asked = this.check(queries, this.width === 2 ? "xy" : "xyz");
    return this.answers(asked.length / this.width, `${this.space}_find_simplex`, (count, found) => [
      ...this.triangles(),
      asked,
      count,
      found,
    ]);
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
    const asked = this.check(queries, this.width === 2 ? "xy" : "xyz");
    const each = k === undefined ? 1 : asCount(k, "k", 1, this.size);
    const size = asked.length / this.width;
    const same = [this.duplicates, this.duplicates.length / 2];
    if (this.dimension < 2) {
      const order = this.flatOrder;
      return this.answers(size * each, `${this.space}_nearest_flat`, (_, found) => {
        return [this.kept.points, order, order.length, ...same, asked, size, each, found];
      });
    }
    if (k === undefined) {
      return this.answers(size, `${this.space}_nearest`, (_, found) => [...this.triangles(), asked, size, found]);
    }
    return this.answers(size * each, `${this.space}_k_nearest`, (_, found) => {
      return [...this.triangles(), ...same, asked, size, each, found];
    });
  }

  /** The different points in the order along their line or great circle, without triangles. */
  get flatOrder(): Int32Array {
    return (this.derived.order ??= kernel().run((session) =>
      session.ask(`${this.space}_flat_diagram`, [this.kept.points, this.size], (answer) => {
        for (let skipped = 0; skipped < 3; ++skipped) answer.next(Int32Array);
        return answer.next(Int32Array);
      }),
    ));
  }

  /** @internal Points, simplices, neighbours and size for the kernel; the arrays may stay there. */
  get forKernel(): { points: Kept; size: number; simplices: Kept; neighbors: Kept; count: number } {
    return { ...this.kept, size: this.size, count: this.simplices.length / 3 };
  }

  private triangles(): Argument[] {
    const { points, simplices, neighbors } = this.kept;
    return [points, simplices, neighbors, this.closed(), this.simplices.length / 3];
  }

  private answers(length: number, name: string, given: (length: number, found: Argument) => Argument[]): Int32Array {
    return kernel().run((session) => {
      const found = session.place(Int32Array, length);
      session.call(name, ...given(length, found));
      return found.copy();
    });
  }

  private fresh(points: Float64Array): void {
    const kept = new Kept(points);
    const size = points.length / this.width;
    this.hold(
      kernel().run((session) =>
        session.ask(`${this.space}_triangulate`, [kept, size], (answer) => read(answer, points, nothing)),
      ),
      kept,
    );
  }

  /** The version after a change of this one; from the points alone if no triangles are left. */
  private change(what: "insert" | "remove", given: Argument[], points: Float64Array): void {
    const { simplices, neighbors } = this.kept;
    const now = [this.kept.points, this.size, simplices, neighbors, this.simplices.length / 3];
    const same = [this.duplicates, this.duplicates.length / 2];
    const changed = kernel().run((session) =>
      session.ask(`${this.space}_${what}`, [...now, ...same, ...given], (answer) =>
        read(answer, points, this.inconclusive),
      ),
    );
    if (changed.dimension === 2) this.hold(changed, new Kept(points));
    else this.fresh(points);
  }

  private hold(arrays: Arrays, points: Kept): void {
    this.arrays = arrays;
    this.derived = {};
    this.kept = { points, simplices: new Kept(arrays.simplices), neighbors: new Kept(arrays.neighbors) };
    this.changed();
  }

  /** What a subclass derived from arrays that are there no more. */
  protected changed(): void {}
}

const nothing: Inconclusive = { filter: 0, curvature: 0, doubleDouble: 0, exact: 0 };

function read(answer: Answer, points: Float64Array, before: Inconclusive): Arrays {
  const [simplices, neighbors, duplicates] = [
    answer.next(Int32Array),
    answer.next(Int32Array),
    answer.next(Int32Array),
  ];
  const [dimension] = answer.next(Int32Array);
  const [filter, curvature, doubleDouble, exact] = answer.next(Float64Array);
  const inconclusive = {
    filter: before.filter + filter,
    curvature: before.curvature + curvature,
    doubleDouble: before.doubleDouble + doubleDouble,
    exact: before.exact + exact,
  };
  return { points, simplices, neighbors, duplicates, dimension, inconclusive };
}
