/** Rotations of the sphere, each defined exactly by the direction of a quaternion of four doubles. */

import { asDirections, asLonlat, asRows, asScalar, entry, type Numbers } from "./checks.ts";
import { lonlatToXyz } from "./coordinates.ts";
import {
  cross,
  difference,
  dot,
  DoubleDouble,
  exactly,
  over,
  rounded,
  scaled,
  sum,
  unit,
  type Row,
} from "./double_double.ts";
import { kernel } from "./instance.ts";

const TWO = new DoubleDouble(2);
const HALF = new DoubleDouble(0.5);
/** Distance of unit vectors in double-double that cannot be told from none. */
const UNDECIDED = 2 ** -100;

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
  private exact: Row | null = null;

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
    const [sine, sineLow, cosine, cosineLow] = kernel().run((session) => {
      const parts = session.place(Float64Array, 4);
      session.call("sin_cos_degrees", Float64Array.of(half), 1, parts);
      return parts.copy();
    });
    const direction = unit(asDirection(axis, "axis")).map((part) => part.times(new DoubleDouble(sine, sineLow)));
    return new Rotation(rounded([new DoubleDouble(cosine, cosineLow), ...direction]));
  }

  /** The shortest rotation that takes one point to another, both (longitude, latitude) in degrees or directions. */
  static between(start: Numbers, end: Numbers): Rotation {
    return new Rotation(rounded(between(unit(asDirection(start, "start")), unit(asDirection(end, "end")))));
  }

  /** Rotated vectors, row after row: the exact result for the exact quaternion, rounded once. */
  apply(xyz: Numbers): Float64Array {
    const rows = asRows(xyz, 3, "xyz");
    const [a, b, c, d, e, f, g, h, i] = this.exactMatrix;
    const turned = new Float64Array(rows.length);
    for (let k = 0; k < rows.length; k += 3) {
      const [x, y, z] = exactly(rows.subarray(k, k + 3));
      turned[k] = a.times(x).plus(b.times(y)).plus(c.times(z)).round() + 0;
      turned[k + 1] = d.times(x).plus(e.times(y)).plus(f.times(z)).round() + 0;
      turned[k + 2] = g.times(x).plus(h.times(y)).plus(i.times(z)).round() + 0;
    }
    return turned;
  }

  /** The matrix, row after row, rounded once. */
  get matrix(): Float64Array {
    return rounded(this.exactMatrix).map((value) => value + 0);
  }

  /** The matrix in double-double, row after row. */
  get exactMatrix(): Row {
    return (this.exact ??= rotationMatrix(exactly(this.quaternion)));
  }

  /** First `other`, then this one; the exact product rounded once. */
  after(other: Rotation): Rotation {
    return new Rotation(rounded(multiply(exactly(this.quaternion), exactly(other.quaternion))));
  }

  /** The exact inverse. */
  inverse(): Rotation {
    return new Rotation(conjugate(exactly(this.quaternion)).map((part) => part.hi));
  }
}

/** One point of the sphere as a direction: (longitude, latitude) in degrees if it has two numbers. */
export function asDirection(point: Numbers, name: string): Float64Array {
  const values = asRows(point, 1, name);
  if (values.length === 2) return lonlatToXyz(asLonlat(values, name));
  if (values.length === 3) {
    CHECK: if (values.every((value) => value === 0)) {
      throw new RangeError(`${entry(name)} is the zero vector, which has no direction`);
    }
    return asDirections(values, name);
  }
  throw new RangeError(`${name} must be (lon, lat) in degrees or a direction (x, y, z), got ${values.length} numbers`);
}

/** The product p q of quaternions: as rotations, first q, then p. */
function multiply([pw, px, py, pz]: Row, [qw, qx, qy, qz]: Row): Row {
  return [
    pw.times(qw).minus(px.times(qx)).minus(py.times(qy)).minus(pz.times(qz)),
    pw.times(qx).plus(px.times(qw)).plus(py.times(qz)).minus(pz.times(qy)),
    pw.times(qy).minus(px.times(qz)).plus(py.times(qw)).plus(pz.times(qx)),
    pw.times(qz).plus(px.times(qy)).minus(py.times(qx)).plus(pz.times(qw)),
  ];
}

/** The inverse rotation, exactly. */
const conjugate = ([w, ...axis]: Row): Row => [w, ...axis.map((part) => part.negated())];

function rotationMatrix(q: Row): Row {
  const [w, x, y, z] = q;
  const [ww, xx, yy, zz] = q.map((part) => part.times(part));
  const rows = [
    ww.plus(xx).minus(yy).minus(zz),
    x.times(y).minus(w.times(z)).times(TWO),
    x.times(z).plus(w.times(y)).times(TWO),
    x.times(y).plus(w.times(z)).times(TWO),
    ww.minus(xx).plus(yy).minus(zz),
    y.times(z).minus(w.times(x)).times(TWO),
    x.times(z).minus(w.times(y)).times(TWO),
    y.times(z).plus(w.times(x)).times(TWO),
    ww.minus(xx).minus(yy).plus(zz),
  ];
  return over(rows, dot(q, q));
}

/**
 * The shortest rotation from unit vector a to b, as a quaternion of any length: (1 + a·b, a × b), written so that
 * nothing cancels; half a turn about a × e, e the axis along which a is shortest, for opposite ones.
 */
function between(a: Row, b: Row): Row {
  const total = sum(a, b);
  const square = dot(total, total);
  if (square.hi <= UNDECIDED ** 2) {
    const sizes = a.map((part) => Math.abs(part.hi));
    const least = sizes.indexOf(Math.min(...sizes));
    return [new DoubleDouble(0), ...cross(a, exactly([0, 1, 2].map((k) => (k === least ? 1 : 0))))];
  }
  return [square.times(HALF), ...cross(a, dot(a, b).hi < 0 ? total : difference(b, a))];
}
