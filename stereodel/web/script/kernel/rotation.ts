/** Rotations of the sphere, each defined exactly by the direction of a quaternion of four doubles. */

import { asDirections, asLonlat, asRows, asScalar, type Numbers } from "./checks.ts";
import { lonlatToXyz } from "./coordinates.ts";
import { computed } from "./instance.ts";

/**
 * A rotation about the centre of the sphere. Equal to that of the Python class of the same name, bit for bit.
 *
 * @example
 * const quarter = Rotation.about([0, 90], 90);
 * quarter.apply([1, 0, 0]); // 0 1 0
 */
export class Rotation {
  /** (w, x, y, z) over a power of two; only its direction counts. */
  readonly quaternion: Float64Array;
  private exact: Float64Array | null = null;

  /** @param quaternion (cos θ/2, axis · sin θ/2) up to length: counterclockwise by θ, seen from the axis' tip. */
  constructor(quaternion: Numbers) {
    const values = asRows(quaternion, 1, "quaternion");
    CHECK: if (values.length !== 4)
      throw new RangeError(`quaternion must be four numbers (w, x, y, z), got ${values.length}`);
    CHECK: if (values.every((value) => value === 0)) {
      throw new RangeError("quaternion is the zero quaternion, which is not a rotation");
    }
    this.quaternion = scaled(values);
  }

  /** The rotation that moves nothing. */
  static identity(): Rotation {
    return new Rotation([1, 0, 0, 0]);
  }

  /**
   * Counterclockwise about an axis, seen from its tip.
   *
   * @param axis (longitude, latitude) in degrees, or a direction x, y, z.
   * @param angle Degrees, any finite number.
   */
  static about(axis: Numbers, angle: number): Rotation {
    const half = asScalar(angle, "angle") / 2;
    return new Rotation(computed(4, "rotation_about", asDirection(axis, "axis"), half));
  }

  /** The shortest rotation that takes one point to another, both (longitude, latitude) in degrees or directions. */
  static between(start: Numbers, end: Numbers): Rotation {
    return new Rotation(computed(4, "rotation_between", asDirection(start, "start"), asDirection(end, "end")));
  }

  /** Rotated vectors, row after row: the exact result for the exact quaternion, rounded once. */
  apply(xyz: Numbers): Float64Array {
    const rows = asRows(xyz, 3, "xyz");
    return computed(rows.length, "rotated", this.quaternion, rows, rows.length / 3);
  }

  /** The matrix, row after row, rounded once. */
  get matrix(): Float64Array {
    return this.exactMatrix.slice(0, 9).map((value) => value + 0);
  }

  /** The matrix in double-double, row after row: its doubles, then what they leave. */
  get exactMatrix(): Float64Array {
    return (this.exact ??= computed(18, "rotation_matrix", this.quaternion));
  }

  /** First `other`, then this one; the exact product rounded once. */
  after(other: Rotation): Rotation {
    return new Rotation(computed(4, "rotation_product", this.quaternion, other.quaternion));
  }

  /** The exact inverse. */
  inverse(): Rotation {
    const [w, x, y, z] = this.quaternion;
    return new Rotation([w, -x, -y, -z]);
  }
}

/** One point of the sphere as a direction: (longitude, latitude) in degrees if it has two numbers. */
export function asDirection(point: Numbers, name: string): Float64Array {
  const values = asRows(point, 1, name);
  if (values.length === 2) return lonlatToXyz(asLonlat(values, name));
  if (values.length === 3) return asDirections(values, name, name);
  throw new RangeError(`${name} must be (lon, lat) in degrees or a direction (x, y, z), got ${values.length} numbers`);
}

/** Doubles over a power of two, the largest of them in [1/2, 1). */
function scaled(values: Float64Array): Float64Array {
  const most = values.reduce((largest, value) => Math.max(largest, Math.abs(value)), 0);
  const near = most === 0 ? 0 : Math.floor(Math.log2(most)) + 1; // logarithms just below a whole number are rounded to it
  const exponent = most < 2 ** (near - 1) ? near - 1 : near;
  const half = Math.floor(exponent / 2); // in two steps: 2^1074 is no double
  return values.map((value) => value * 2 ** -half * 2 ** (half - exponent));
}
