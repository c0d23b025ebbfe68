/** Vectors of space, and directions as longitude and latitude in degrees. */

export type Vector = readonly [number, number, number];

/** Radians of a degree, and degrees of a radian. */
export const DEGREE = Math.PI / 180;
export const DEGREES = 180 / Math.PI;

export function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/** The direction of a vector. */
export function unit(a: Vector): Vector {
  const length = Math.hypot(a[0], a[1], a[2]);
  return [a[0] / length, a[1] / length, a[2] / length];
}

/** Row k of an array (n, 3). */
export function row(xyz: ArrayLike<number>, k: number): Vector {
  return [xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]];
}

/** Longitude in (−180, 180] and latitude of a direction, degrees. */
export function lonLatOf(x: Vector): [number, number] {
  return [Math.atan2(x[1], x[0]) * DEGREES, Math.atan2(x[2], Math.hypot(x[0], x[1])) * DEGREES];
}

/** The direction at a longitude and latitude in degrees. */
export function directionOf(lon: number, lat: number): Vector {
  const c = Math.cos(lat / DEGREES);
  return [c * Math.cos(lon / DEGREES), c * Math.sin(lon / DEGREES), Math.sin(lat / DEGREES)];
}

/** The angle between two directions, degrees; as good for small angles as for large ones. */
export function angle(a: Vector, b: Vector): number {
  const n = cross(a, b);
  return Math.atan2(Math.hypot(n[0], n[1], n[2]), dot(a, b)) * DEGREES;
}
