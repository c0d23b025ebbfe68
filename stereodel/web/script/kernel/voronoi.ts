/** What planar and spherical Voronoi diagrams share: cells, ridges and vertices as arrays. */

import type { Delaunay, Space } from "./delaunay.ts";
import { Kept, kernel, type Argument, type NumberArray } from "./instance.ts";

interface Cells {
  readonly vertices: Float64Array;
  readonly regionOffsets: Int32Array;
  readonly regionIndices: Int32Array;
  readonly regionNeighbors: Int32Array;
  readonly simplexVertex: Int32Array;
  /** Sites with cells, near ones soon after one another; around the circle without triangles. */
  readonly order: Int32Array;
}

/**
 * A Voronoi diagram, the dual of a Delaunay triangulation.
 *
 * The cell of a site is a range of entries: its vertices counterclockwise from the lowest, and beside each the site
 * beyond the ridge that leaves it. Arrays are flat, row after row, and must not be written to.
 */
export abstract class Diagram {
  protected abstract readonly space: Space;
  /** The sites as given. */
  readonly points: Float64Array;
  /** The triangulation; later changes of the one that was given do not change the diagram. */
  protected readonly triangulated: boolean;
  protected readonly size: number;
  protected ridges: { points: Int32Array; vertices: Int32Array } | null = null;
  private readonly dropped: Int32Array;
  private readonly sites: Kept;
  private cells!: Cells;

  protected constructor(triangulation: Delaunay) {
    this.points = triangulation.points;
    this.size = triangulation.size;
    this.triangulated = triangulation.dimension === 2;
    this.dropped = triangulation.duplicates;
    this.sites = triangulation.forKernel.points;
  }

  /** Vertices, numbered by the three lowest sites of each: points of the plane, or unit vectors. */
  get vertices(): Float64Array {
    return this.cells.vertices;
  }

  /** Vertices of the cells, one after the other; -1 at infinity. */
  get regionIndices(): Int32Array {
    return this.cells.regionIndices;
  }

  /** The cell of site i has the entries from `regionOffsets[i]` to before `regionOffsets[i + 1]`. */
  get regionOffsets(): Int32Array {
    return this.cells.regionOffsets;
  }

  /** The site beyond the ridge from each entry's vertex to the next one's; -1 in strips. */
  get regionNeighbors(): Int32Array {
    return this.cells.regionNeighbors;
  }

  /** The vertex of each Delaunay triangle; exactly cocircular neighbours share one. */
  get simplexVertex(): Int32Array {
    return this.cells.simplexVertex;
  }

  /** The region of each point: its own number, for a duplicate that of the kept point. */
  get pointRegion(): Int32Array {
    const region = Int32Array.from({ length: this.size }, (_, k) => k);
    for (let k = 0; k < this.dropped.length; k += 2) region[this.dropped[k]] = this.dropped[k + 1];
    return region;
  }

  /** Vertices of the cell of a site, counterclockwise from the lowest. */
  region(site: number): Int32Array {
    return this.regionIndices.subarray(this.regionOffsets[site], this.regionOffsets[site + 1]);
  }

  /** Sites i < j on both sides of each ridge, in lexicographic order. */
  get ridgePoints(): Int32Array {
    return this.allRidges().points;
  }

  /** Start and end of each ridge, such that site i is on its left; -1 at infinity. */
  get ridgeVertices(): Int32Array {
    return this.allRidges().vertices;
  }

  /** Numbers in a row of points. */
  protected get width(): number {
    return this.space === "plane" ? 2 : 3;
  }

  /** Cells and vertices from the triangles. */
  protected setDiagram(triangulation: Delaunay): void {
    const { points, size, simplices, neighbors, count } = triangulation.forKernel;
    this.cells = kernel().run((session) =>
      session.ask(`${this.space}_voronoi`, [points, size, simplices, neighbors, count], (answer) => ({
        regionOffsets: answer.next(Int32Array),
        regionIndices: answer.next(Int32Array),
        regionNeighbors: answer.next(Int32Array),
        order: answer.next(Int32Array),
        simplexVertex: answer.next(Int32Array),
        vertices: answer.next(Float64Array),
      })),
    );
  }

  /** Cells without triangles; what the last array of the answer holds. */
  protected setFlatDiagram<A extends NumberArray>(
    Last: { new (buffer: ArrayBufferLike, offset: number, length: number): A; readonly BYTES_PER_ELEMENT: number },
    verticesOf: (last: A) => Float64Array,
  ): A {
    return kernel().run((session) =>
      session.ask(`${this.space}_flat_diagram`, [this.sites, this.size], (answer) => {
        const regionOffsets = answer.next(Int32Array);
        const regionIndices = answer.next(Int32Array);
        const regionNeighbors = answer.next(Int32Array);
        const order = answer.next(Int32Array);
        const last = answer.next(Last);
        const simplexVertex = new Int32Array(0);
        const vertices = verticesOf(last);
        this.cells = { vertices, regionOffsets, regionIndices, regionNeighbors, simplexVertex, order };
        return last;
      }),
    );
  }

  /** Numbers for each site from the cells: areas, centroids. */
  protected measured(what: string, width: number): Float64Array {
    const { order } = this.cells;
    const flat: Argument[] = [this.sites, this.size, order, order.length];
    return kernel().run((session) => {
      const out = session.place(Float64Array, width * this.size);
      if (this.triangulated) {
        session.call(`${this.space}_cell_${what}`, this.sites, ...this.entries(), order, order.length, out);
      } else {
        session.call(`${this.space}_flat_${what}`, ...flat, out);
      }
      return out.copy();
    });
  }

  private entries(): Argument[] {
    const { regionOffsets, regionIndices, regionNeighbors, vertices } = this.cells;
    return [this.size, regionOffsets, regionIndices, regionNeighbors, vertices.length / this.width];
  }

  private allRidges(): { points: Int32Array; vertices: Int32Array } {
    return (this.ridges ??= kernel().run((session) =>
      session.ask("voronoi_ridges", this.entries(), (answer) => ({
        points: answer.next(Int32Array),
        vertices: answer.next(Int32Array),
      })),
    ));
  }
}
