/** Sites of the sheet with all that the kernel says of them: triangles of the plane, facets that see the pole. */

import { PlanarDelaunay, PlanarVoronoi, SphericalDelaunay } from "../kernel/api.ts";
import { rectangleAround, Sheet } from "./lift_sheet.ts";
import type { Rectangle } from "./lift_sheet.ts";
import { bubbleSigns } from "./bubble_signs.ts";

type Place = [number, number];

export class LiftSites {
  /** x and y in turn, in any unit. */
  readonly places: Float64Array;
  readonly rectangle: Rectangle;
  readonly delaunay: PlanarDelaunay;
  #closing: Int32Array | null = null;
  #ridges: [Place, Place][] | null = null;

  /** @param sides Width and height of the sheet, where it is not the smallest rectangle round the sites. */
  constructor(places: Float64Array, sides?: readonly [number, number]) {
    this.places = places;
    this.rectangle = rectangleAround(places, sides);
    this.delaunay = new PlanarDelaunay(places);
  }

  get count(): number {
    return this.places.length / 2;
  }

  /** The sheet bent so that its corners stand at so many degrees from the point of contact. */
  sheet(corner: number): Sheet {
    return new Sheet(this.rectangle, corner);
  }

  /** Distance of two sites in the plane. */
  distance(p: number, q: number): number {
    const { places } = this;
    return Math.hypot(places[2 * p] - places[2 * q], places[2 * p + 1] - places[2 * q + 1]);
  }

  /**
   * The facets of the lifted sites that see the pole, (m, 3): those whose circle in the plane has no site outside. They
   * are the same however far the sheet is bent.
   */
  get closing(): Int32Array {
    return (this.#closing ??= this.#facetsThatSee());
  }

  /** Sides of the cells of the plane, each from end to end; those without an end go on far beyond the sheet. */
  get ridges(): [Place, Place][] {
    return (this.#ridges ??= this.#ridgesOfPlane());
  }

  #ridgesOfPlane(): [Place, Place][] {
    if (this.count < 2) return [];
    const { vertices, ridgeVertices, ridgePoints } = new PlanarVoronoi(this.delaunay);
    const site = (k: number): Place => [this.places[2 * k], this.places[2 * k + 1]];
    const far = 4 * Math.hypot(this.rectangle.width, this.rectangle.height);
    return Array.from({ length: ridgeVertices.length / 2 }, (_, k): [Place, Place] => {
      const [[ax, ay], [bx, by]] = [site(ridgePoints[2 * k]), site(ridgePoints[2 * k + 1])];
      // Site a is on the left of the way from start to end.
      const size = Math.hypot(bx - ax, by - ay);
      const [u, v] = [(far * (ay - by)) / size, (far * (bx - ax)) / size];
      const [start, end] = [ridgeVertices[2 * k], ridgeVertices[2 * k + 1]].map((vertex): Place | null =>
        vertex < 0 ? null : [vertices[2 * vertex], vertices[2 * vertex + 1]],
      );
      const [x, y] = start ?? end ?? [(ax + bx) / 2, (ay + by) / 2];
      return [start ?? [x - u, y - v], end ?? [x + u, y + v]];
    });
  }

  /**
   * The hull of the rays (2u, 2v, 1 − u² − v²) through the lifted sites. The unit is a power of two, so that a grid of
   * small whole numbers is lifted without rounding and its squares stay squares.
   */
  #facetsThatSee(): Int32Array {
    const { middle, width, height } = this.rectangle;
    const unit = 2 ** -Math.round(Math.log2(Math.hypot(width, height) || 1));
    const rays = new Float64Array(3 * this.count);
    for (let k = 0; k < this.count; ++k) {
      const u = (this.places[2 * k] - middle[0]) * unit;
      const v = (this.places[2 * k + 1] - middle[1]) * unit;
      rays.set([2 * u, 2 * v, 1 - u * u - v * v], 3 * k);
    }
    const { simplices } = new SphericalDelaunay(rays);
    const signs = bubbleSigns(rays, simplices, [0, 0, -1]);
    return simplices.filter((_, k) => signs[Math.floor(k / 3)] >= 0);
  }
}
