/** Which facets see a point: the kernel's exact sign for each. */

import { inBubble } from "../kernel/api.ts";
import type { Vector } from "./space.ts";

/**
 * `in_bubble(a, b, c, point)` of each facet: above 0 where its bubble holds the point, 0 on the circle.
 *
 * @param xyz directions (n, 3).
 * @param simplices facets (m, 3), counterclockwise seen from outside.
 */
export function bubbleSigns(xyz: Float64Array, simplices: Int32Array, point: Vector): Int8Array {
  if (simplices.length === 0) return new Int8Array(0);
  const corner = (k: number): Float64Array => {
    const rows = new Float64Array(simplices.length);
    for (let at = k; at < simplices.length; at += 3) {
      const site = simplices[at];
      rows.set(xyz.subarray(3 * site, 3 * site + 3), at - k);
    }
    return rows;
  };
  return inBubble(corner(0), corner(1), corner(2), point);
}
