/** Voronoi diagram of the plane, the dual of the Delaunay triangulation. */

import { asScalar, type Numbers } from "./checks.ts";
import { PlanarDelaunay } from "./planar_delaunay.ts";
import { Diagram } from "./voronoi.ts";

/**
 * Voronoi diagram of points of the plane. Unbounded cells begin with the vertex -1; points on one line have strips
 * without vertices. Equal to that of the Python class of the same name.
 */
export class PlanarVoronoi extends Diagram {
  protected override readonly space = "plane";

  /** @param points Finite numbers x, y, row after row, or their triangulation, which is then not computed again. */
  constructor(points: Numbers | PlanarDelaunay) {
    const triangulation = points instanceof PlanarDelaunay ? points : new PlanarDelaunay(points);
    super(triangulation);
    if (this.triangulated) {
      this.setDiagram(triangulation);
    } else {
      const ridges = this.setFlatDiagram(Int32Array, () => new Float64Array(0));
      this.ridges = { points: ridges, vertices: new Int32Array(ridges.length).fill(-1) };
    }
  }

  /**
   * The area of each point's cell: 0 for duplicates, infinite for unbounded cells.
   *
   * @param radius Length of the unit of the coordinates: areas are multiplied by its square.
   */
  areas(radius = 1): Float64Array {
    const scale = asScalar(radius, "radius", 0) ** 2;
    if (this.triangulated) return this.measured("areas", 1).map((area) => area * scale);
    return Float64Array.from({ length: this.size }, (_, k) => (this.region(k).length > 0 ? Infinity : 0));
  }

  /** The centroid of each point's cell, row after row; NaN for unbounded cells and for duplicates. */
  centroids(): Float64Array {
    return this.triangulated ? this.measured("centroids", 2) : new Float64Array(2 * this.size).fill(NaN);
  }
}
