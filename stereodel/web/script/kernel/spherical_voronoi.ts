/** Voronoi diagram of the sphere, the dual of the Delaunay triangulation. */

import { asScalar, type Numbers } from "./checks.ts";
import { lonlatToXyz } from "./coordinates.ts";
import { kernel } from "./instance.ts";
import type { Latitude } from "./latitudes.ts";
import { SphericalDelaunay } from "./spherical_delaunay.ts";
import { Diagram } from "./voronoi.ts";

/**
 * Voronoi diagram of directions, on the unit sphere. Equal to that of the Python class of the same name.
 *
 * A ridge is the arc of the great circle normal to p/|p| - q/|q| from its start to its end, counterclockwise about that
 * normal (`ridgeNormals`); this says which arc it is even between opposite vertices. Points all on one circle have two
 * opposite vertices, a single point has none.
 */
export class SphericalVoronoi extends Diagram {
  protected override readonly space = "sphere";

  /** @param points Directions x, y, z, row after row, or their triangulation, which is then not computed again. */
  constructor(points: Numbers | SphericalDelaunay) {
    const triangulation = points instanceof SphericalDelaunay ? points : new SphericalDelaunay(points);
    super(triangulation);
    if (this.triangulated) this.setDiagram(triangulation);
    else this.setFlatDiagram(Float64Array, (ends) => ends);
    // Opposite ends to the last bit, as of one circle.
    if (this.vertices.length === 6) for (let k = 0; k < 3; ++k) this.vertices[3 + k] = 0 - this.vertices[k];
  }

  /** The diagram of points given by longitude and latitude in degrees, row after row; `latitude` as in `lonlatToXyz`. */
  static fromLonlat(lonlat: Numbers, latitude: Latitude = "spherical"): SphericalVoronoi {
    return new SphericalVoronoi(lonlatToXyz(lonlat, latitude));
  }

  /**
   * The area of each point's cell: 0 for duplicates; together 4π radius².
   *
   * @param radius Of the sphere; by default areas are steradians.
   */
  areas(radius = 1): Float64Array {
    const scale = asScalar(radius, "radius", 0) ** 2;
    return this.measured("areas", 1).map((area) => area * scale);
  }

  /** The direction of the mean of each point's cell, a unit vector, row after row; NaN for duplicates. */
  centroids(): Float64Array {
    return this.measured("centroids", 3);
  }

  /** The unit normal of each ridge's plane, on the side of site i, row after row. */
  ridgeNormals(): Float64Array {
    const ridges = this.ridgePoints;
    const [p, q] = [new Float64Array((ridges.length / 2) * 3), new Float64Array((ridges.length / 2) * 3)];
    for (let k = 0; k < ridges.length / 2; ++k) {
      p.set(this.points.subarray(3 * ridges[2 * k], 3 * ridges[2 * k] + 3), 3 * k);
      q.set(this.points.subarray(3 * ridges[2 * k + 1], 3 * ridges[2 * k + 1] + 3), 3 * k);
    }
    return kernel().run((session) => {
      const normals = session.place(Float64Array, p.length);
      session.call("bisector_normals", p, q, p.length / 3, normals);
      return normals.copy();
    });
  }
}
