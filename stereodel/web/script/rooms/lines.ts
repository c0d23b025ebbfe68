/** Lines and regions of great circles on a ball, from directions in the axes of the view. */

import { traceArc } from "../drawing/arcs.ts";
import type { Side } from "../drawing/arcs.ts";
import type { Disc, Path } from "../drawing/pen.ts";
import { traceRegions } from "../drawing/fill.ts";
import { cross, dot, unit } from "./space.ts";
import type { Vector } from "./space.ts";

/** Degrees between points along the side of a region. */
const FINE = 1;

/** Where a direction is on the picture. */
export function placeOf(disc: Disc, point: Vector): [number, number] {
  return [disc.x + disc.r * point[0], disc.y - disc.r * point[1]];
}

/** The shorter great-circle arc between two directions. */
export function traceGreat(path: Path, disc: Disc, a: Vector, b: Vector, side: Side = "front"): void {
  traceArc(path, disc, [...a, ...unit([a[0] + b[0], a[1] + b[1], a[2] + b[2]]), ...b], 0, 1, 2, side);
}

/** The sides of a polygon of directions. */
export function traceSides(path: Path, disc: Disc, corners: readonly Vector[]): void {
  corners.forEach((a, k) => traceGreat(path, disc, a, corners[(k + 1) % corners.length]));
}

/** The region on the left of a polygon of great-circle sides. */
export function tracePolygon(path: Path, disc: Disc, corners: readonly Vector[], holdsHidden: boolean): void {
  const points = corners.flatMap((a, k) => along(a, corners[(k + 1) % corners.length]));
  traceRegions(path, disc, { points: Float64Array.from(points.flat()), offsets: [0, points.length] }, holdsHidden);
}

/** Points of a great-circle side, a degree apart at the most, from its first corner on, without its last. */
export function along(a: Vector, b: Vector): Vector[] {
  const n = cross(a, b);
  const sine = Math.hypot(n[0], n[1], n[2]);
  const whole = Math.atan2(sine, dot(a, b));
  const count = Math.max(1, Math.ceil((whole * 180) / Math.PI / FINE));
  return Array.from({ length: count }, (_, k) => {
    const t = (whole * k) / count;
    const [s, u] = sine === 0 ? [1, 0] : [Math.sin(whole - t) / sine, Math.sin(t) / sine];
    return unit([s * a[0] + u * b[0], s * a[1] + u * b[1], s * a[2] + u * b[2]]);
  });
}
