/** Voronoi diagrams of the plane and of the sphere, the duals of the Delaunay triangulations. */

import { asScalar, type Numbers } from "./checks.ts";
import { lonlatToXyz, type Latitude } from "./coordinates.ts";
import { PlanarDelaunay, SphericalDelaunay, type Delaunay } from "./delaunay.ts";
import { answered, computed, type Argument, type Kept } from "./instance.ts";

/**
 * A Voronoi diagram, the dual of a Delaunay triangulation.
 *
 * The cell of a site is a range of entries: its vertices counterclockwise from the lowest, and beside each the site
 * beyond the ridge that leaves it. Arrays are flat, row after row, and must not be written to.
 */
export abstract class Diagram {
  /** The sites as given; later changes of the triangulation do not change the diagram. */
  readonly points: Float64Array;
  /** Vertices, numbered by the three lowest sites of each: points of the plane, or unit vectors. */
  readonly vertices: Float64Array;
  /** The cell of site i has the entries from `regionOffsets[i]` to before `regionOffsets[i + 1]`. */
  readonly regionOffsets: Int32Array;
  /** Vertices of the cells, one after the other; -1 at infinity. */
  readonly regionIndices: Int32Array;
  /** The site beyond the ridge from each entry's vertex to the next one's; -1 in strips. */
  readonly regionNeighbors: Int32Array;
  /** The vertex of each Delaunay triangle; exactly cocircular neighbours share one. */
  readonly simplexVertex: Int32Array;
  private readonly width: 2 | 3;
  private readonly size: number;
  private readonly space: string;
  private readonly triangulated: boolean;
  private readonly dropped: Int32Array;
  private readonly sites: Kept;
  /** Sites with cells, near ones soon after one another; around the circle without triangles. */
  private readonly order: Int32Array;
  private ridges: readonly [points: Int32Array, vertices: Int32Array] | null = null;

  protected constructor(triangulation: Delaunay) {
    const given = triangulation.forKernel;
    [this.points, this.width, this.space] = [triangulation.points, triangulation.width, triangulation.space];
    [this.sites, this.size] = given;
    [this.triangulated, this.dropped] = [triangulation.dimension === 2, triangulation.duplicates];
    const last = this.triangulated ? [Int32Array, Float64Array] : [this.isStrips ? Int32Array : Float64Array];
    const types = [Int32Array, Int32Array, Int32Array, Int32Array, ...last];
    const all = this.triangulated
      ? answered(types, `${this.space}_voronoi`, ...given)
      : answered(types, `${this.space}_flat_diagram`, this.sites, this.size);
    const integers = all.filter((array) => array instanceof Int32Array);
    [this.regionOffsets, this.regionIndices, this.regionNeighbors, this.order] = integers;
    const line = integers[4] ?? new Int32Array(0);
    this.vertices = all.find((array) => array instanceof Float64Array) ?? new Float64Array(0);
    this.simplexVertex = this.isStrips ? new Int32Array(0) : line;
    if (this.isStrips) this.ridges = [line, new Int32Array(line.length).fill(-1)];
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
    return this.allRidges()[0];
  }

  /** Start and end of each ridge, such that site i is on its left; -1 at infinity. */
  get ridgeVertices(): Int32Array {
    return this.allRidges()[1];
  }

  /**
   * The area of each point's cell: 0 for duplicates; infinite for unbounded cells of the plane, and together 4π radius² on
   * the sphere.
   *
   * @param radius Of the sphere, or length of the unit of the plane's coordinates: areas are multiplied by its square.
   */
  areas(radius = 1): Float64Array {
    const scale = asScalar(radius, "radius", 0) ** 2;
    if (!this.isStrips) return this.measured("areas", 1).map((area) => area * scale);
    return Float64Array.from({ length: this.size }, (_, k) => (this.region(k).length > 0 ? Infinity : 0));
  }

  /**
   * The centroid of each point's cell, row after row: on the sphere the direction of the mean, a unit vector. NaN for
   * unbounded cells and for duplicates.
   */
  centroids(): Float64Array {
    return this.isStrips ? new Float64Array(2 * this.size).fill(NaN) : this.measured("centroids", this.width);
  }

  /** Whether all sites of a plane lie on one line: there are ridges, and no vertices. */
  private get isStrips(): boolean {
    return this.width === 2 && !this.triangulated;
  }

  /** Numbers for each site from the cells. */
  private measured(what: string, width: number): Float64Array {
    const given = this.triangulated ? this.entries() : [this.size];
    const name = `${this.space}_${this.triangulated ? "cell" : "flat"}_${what}`;
    return computed(width * this.size, name, this.sites, ...given, this.order, this.order.length);
  }

  private entries(): Argument[] {
    const { regionOffsets, regionIndices, regionNeighbors, vertices } = this;
    return [this.size, regionOffsets, regionIndices, regionNeighbors, vertices.length / this.width];
  }

  private allRidges(): readonly [points: Int32Array, vertices: Int32Array] {
    return (this.ridges ??= answered([Int32Array, Int32Array], "voronoi_ridges", ...this.entries()));
  }
}

/**
 * Voronoi diagram of points of the plane. Unbounded cells begin with the vertex -1; points on one line have strips
 * without vertices. Equal to that of the Python class of the same name.
 */
export class PlanarVoronoi extends Diagram {
  /** @param points Finite numbers x, y, row after row, or their triangulation, which is then not computed again. */
  constructor(points: Numbers | PlanarDelaunay) {
    super(points instanceof PlanarDelaunay ? points : new PlanarDelaunay(points));
  }
}

/**
 * Voronoi diagram of directions, on the unit sphere. Equal to that of the Python class of the same name.
 *
 * A ridge is the arc of the great circle normal to p/|p| - q/|q| from its start to its end, counterclockwise about that
 * normal (`ridgeNormals`); this says which arc it is even between opposite vertices. Points all on one circle have two
 * opposite vertices, a single point has none.
 */
export class SphericalVoronoi extends Diagram {
  /** @param points Directions x, y, z, row after row, or their triangulation, which is then not computed again. */
  constructor(points: Numbers | SphericalDelaunay) {
    super(points instanceof SphericalDelaunay ? points : new SphericalDelaunay(points));
    // Opposite ends to the last bit, as of one circle.
    if (this.vertices.length === 6) for (let k = 0; k < 3; ++k) this.vertices[3 + k] = 0 - this.vertices[k];
  }

  /** The diagram of points given by longitude and latitude in degrees, row after row; `latitude` as in `lonlatToXyz`. */
  static fromLonlat(lonlat: Numbers, latitude: Latitude = "spherical"): SphericalVoronoi {
    return new SphericalVoronoi(lonlatToXyz(lonlat, latitude));
  }

  /** The unit normal of each ridge's plane, on the side of site i, row after row. */
  ridgeNormals(): Float64Array {
    const ridges = this.ridgePoints;
    const [p, q] = [new Float64Array((ridges.length / 2) * 3), new Float64Array((ridges.length / 2) * 3)];
    for (let k = 0; k < ridges.length / 2; ++k) {
      p.set(this.points.subarray(3 * ridges[2 * k], 3 * ridges[2 * k] + 3), 3 * k);
      q.set(this.points.subarray(3 * ridges[2 * k + 1], 3 * ridges[2 * k + 1] + 3), 3 * k);
    }
    return computed(p.length, "bisector_normals", p, q, p.length / 3);
  }
}
