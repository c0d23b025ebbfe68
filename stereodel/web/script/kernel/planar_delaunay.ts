/** Delaunay triangulation of the plane, exact. */

import { asPoints, type Numbers } from "./checks.ts";
import { Delaunay } from "./delaunay.ts";
import type { Kept } from "./instance.ts";

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
  protected override readonly space = "plane";
  override readonly width = 2;

  /** @param points Finite numbers x, y, row after row; y up. Copied. */
  constructor(points: Numbers) {
    super();
    this.build(points);
  }

  protected override check(points: Numbers, name: string): Float64Array {
    return asPoints(points, 2, name);
  }

  protected override isOpen(): boolean {
    return true;
  }

  protected override closed(): Kept | null {
    return null;
  }
}
