/**
 * Conformal maps in integers: products of any magnification without a rounding, as in
 * stereodel/conformal/integers.py. A map is (real + i·imag)/√determinant of quaternions in SL(2, C).
 */

import { DoubleDouble, type Row } from "./double_double.ts";

type Quaternion = readonly [bigint, bigint, bigint, bigint];

/** Bits of the root of a determinant at least: no double-double shows what it is off. */
const ROOT_BITS = 256;

/** A map in integers, up to a common factor. */
export class IntegerMap {
  private readonly real: Quaternion;
  private readonly imag: Quaternion;
  private readonly determinant: bigint;

  private constructor(real: Quaternion, imag: Quaternion, determinant: bigint) {
    this.real = real;
    this.imag = imag;
    this.determinant = determinant;
  }

  /** Rotation, fisheye of a magnification along z and rotation, from quaternions of any length. */
  static of(left: Float64Array, magnification: number, right: Float64Array): IntegerMap {
    const [first, last] = [integers(left), integers(right)];
    const [size, one] = ratio(magnification);
    return new IntegerMap(
      product(times(first, size + one), last),
      product(product(times(first, size - one), [0n, 0n, 0n, -1n]), last),
      4n * size * one * square(first) * square(last),
    );
  }

  /** First `other`, then this one. */
  after(other: IntegerMap): IntegerMap {
    const [a, b, c, d] = [this.real, this.imag, other.real, other.imag];
    return new IntegerMap(
      plus(product(a, c), times(product(b, d), -1n)),
      plus(product(a, d), product(b, c)),
      this.determinant * other.determinant,
    );
  }

  /** Both parts of the element of determinant 1 in double-double. */
  rounded(): { real: Row; imag: Row } {
    const shift = BigInt(Math.max(0, ROOT_BITS - (bitLength(this.determinant) >> 1)));
    const root = integerRoot(this.determinant << (2n * shift));
    const parts = (q: Quaternion): Row => q.map((part) => quotientPair(part << shift, root));
    return { real: parts(this.real), imag: parts(this.imag) };
  }
}

function product([a, b, c, d]: Quaternion, [w, x, y, z]: Quaternion): Quaternion {
  return [
    a * w - b * x - c * y - d * z,
    a * x + b * w + c * z - d * y,
    a * y - b * z + c * w + d * x,
    a * z + b * y - c * x + d * w,
  ];
}

const times = ([w, x, y, z]: Quaternion, factor: bigint): Quaternion => [
  factor * w,
  factor * x,
  factor * y,
  factor * z,
];
const plus = (p: Quaternion, q: Quaternion): Quaternion => [p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]];
const square = ([w, x, y, z]: Quaternion): bigint => w * w + x * x + y * y + z * z;

/** A quaternion of doubles times a power of two. */
function integers(quaternion: Float64Array): Quaternion {
  const ratios = Array.from(quaternion, ratio);
  const unit = ratios.reduce((most, [, denominator]) => (denominator > most ? denominator : most), 1n);
  const [w, x, y, z] = ratios.map(([numerator, denominator]) => numerator * (unit / denominator));
  return [w, x, y, z];
}

/** A double as a quotient of integers, the second a power of two. */
function ratio(value: number): [bigint, bigint] {
  let shift = 0;
  let whole = value;
  while (!Number.isInteger(whole)) {
    whole *= 2;
    ++shift;
  }
  return [BigInt(whole), 1n << BigInt(shift)];
}

const magnitude = (value: bigint): bigint => (value < 0n ? -value : value);
const bitLength = (value: bigint): number => (value === 0n ? 0 : magnitude(value).toString(2).length);

/** The largest integer whose square is not above `value`. */
function integerRoot(value: bigint): bigint {
  if (value < 2n) return value;
  let root = 1n << BigInt((bitLength(value) + 1) >> 1);
  for (;;) {
    const next = (root + value / root) >> 1n;
    if (next >= root) return root;
    root = next;
  }
}

/** A quotient rounded once: more bits than a double has, and whether there are others, decide. */
function quotient(numerator: bigint, denominator: bigint): number {
  const negative = numerator < 0n !== denominator < 0n;
  const [top, bottom] = [magnitude(numerator), magnitude(denominator)];
  const shift = 64 - bitLength(top) + bitLength(bottom);
  const [n, d] = shift > 0 ? [top << BigInt(shift), bottom] : [top, bottom << BigInt(-shift)];
  const bits = (n / d) | (n % d === 0n ? 0n : 1n);
  const half = Math.floor(shift / 2); // 2^-shift alone may be no double
  const size = Number(bits) * 2 ** -half * 2 ** (half - shift);
  return negative ? -size : size;
}

/** A quotient as a double and what that leaves, rounded once each. */
function quotientPair(numerator: bigint, denominator: bigint): DoubleDouble {
  const high = quotient(numerator, denominator);
  const [top, bottom] = ratio(high);
  return new DoubleDouble(high, quotient(numerator * bottom - top * denominator, denominator * bottom));
}
