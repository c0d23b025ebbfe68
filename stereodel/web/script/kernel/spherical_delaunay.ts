/** Delaunay triangulation of the sphere: the convex hull of directions, exact on rays. */

import { asDirections, type Numbers } from "./checks.ts";
import { lonlatToXyz } from "./coordinates.ts";
import { Delaunay } from "./delaunay.ts";
import { Kept, kernel } from "./instance.ts";
import type { Latitude } from "./latitudes.ts";

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
  protected override readonly space = "sphere";
  override readonly width = 3;
  private bytes: Kept | null = null;

  /** @param points Directions x, y, z, row after row: vectors of any length but zero. Copied. */
  constructor(points: Numbers) {
    super();
    this.build(points);
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
    return this.closed().values as Uint8Array;
  }

  protected override check(points: Numbers, name: string): Float64Array {
    return asDirections(points, name);
  }

  protected override isOpen(facet: number): boolean {
    return this.closing[facet] === 0;
  }

  protected override closed(): Kept {
    return (this.bytes ??= kernel().run((session) => {
      const { points, size, simplices, count } = this.forKernel;
      const closing = session.place(Uint8Array, count);
      session.call("sphere_closing", points, size, simplices, count, closing);
      return new Kept(closing.copy());
    }));
  }

  protected override changed(): void {
    this.bytes = null;
  }
}
