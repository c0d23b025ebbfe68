/**
 * Double-double arithmetic: a value is the unevaluated sum hi + lo, about 106 bits. Operation by operation that of
 * stereodel/_double_double.py, so that rotations and maps have the same bits here and there.
 */

const SPLITTER = 2 ** 27 + 1; // Veltkamp: cuts a significand of 53 bits into two halves

function twoSum(a: number, b: number): [number, number] {
  const sum = a + b;
  const shadow = sum - a;
  return [sum, a - (sum - shadow) + (b - shadow)];
}

function fastTwoSum(a: number, b: number): [number, number] {
  const sum = a + b;
  return [sum, b - (sum - a)];
}

function split(a: number): [number, number] {
  const scaled = SPLITTER * a;
  const high = scaled - (scaled - a);
  return [high, a - high];
}

function twoProduct(a: number, b: number): [number, number] {
  const product = a * b;
  const [ah, al] = split(a);
  const [bh, bl] = split(b);
  return [product, ah * bh - product + ah * bl + al * bh + al * bl];
}

/** One number; sums and products of others. */
export class DoubleDouble {
  readonly hi: number;
  readonly lo: number;

  constructor(hi: number, lo = 0) {
    this.hi = hi;
    this.lo = lo;
  }

  plus(b: DoubleDouble): DoubleDouble {
    const [sum, error] = twoSum(this.hi, b.hi);
    const [t, f] = twoSum(this.lo, b.lo);
    const [high, rest] = fastTwoSum(sum, error + t);
    return new DoubleDouble(...fastTwoSum(high, rest + f));
  }

  negated(): DoubleDouble {
    return new DoubleDouble(-this.hi, -this.lo);
  }

  minus(b: DoubleDouble): DoubleDouble {
    return this.plus(b.negated());
  }

  times(b: DoubleDouble): DoubleDouble {
    const [product, error] = twoProduct(this.hi, b.hi);
    return new DoubleDouble(...fastTwoSum(product, error + (this.hi * b.lo + this.lo * b.hi)));
  }

  over(b: DoubleDouble): DoubleDouble {
    const first = this.hi / b.hi;
    const rest = this.minus(b.times(new DoubleDouble(first)));
    const second = rest.hi / b.hi;
    const last = rest.minus(b.times(new DoubleDouble(second)));
    return new DoubleDouble(...fastTwoSum(first, second)).plus(new DoubleDouble(last.hi / b.hi));
  }

  sqrt(): DoubleDouble {
    const root = Math.sqrt(this.hi);
    const rest = this.minus(new DoubleDouble(...twoProduct(root, root)));
    return new DoubleDouble(...fastTwoSum(root, root === 0 ? 0 : rest.hi / (2 * root)));
  }

  /** The nearest double. */
  round(): number {
    return this.hi + this.lo;
  }
}

/** A vector or a quaternion. */
export type Row = readonly DoubleDouble[];

/** Doubles as they stand. */
export const exactly = (values: ArrayLike<number>): Row => Array.from(values, (value) => new DoubleDouble(value));

export function dot(a: Row, b: Row): DoubleDouble {
  return a.map((value, k) => value.times(b[k])).reduce((sum, term) => sum.plus(term));
}

export function cross([ax, ay, az]: Row, [bx, by, bz]: Row): Row {
  return [ay.times(bz).minus(az.times(by)), az.times(bx).minus(ax.times(bz)), ax.times(by).minus(ay.times(bx))];
}

export const sum = (a: Row, b: Row): Row => a.map((value, k) => value.plus(b[k]));
export const difference = (a: Row, b: Row): Row => a.map((value, k) => value.minus(b[k]));
export const over = (a: Row, b: DoubleDouble): Row => a.map((value) => value.over(b));
export const rounded = (a: Row): Float64Array => Float64Array.from(a, (value) => value.round());

/** The direction of doubles that are not all zero, whatever their length. */
export function unit(vector: ArrayLike<number>): Row {
  const row = exactly(scaled(vector));
  return over(row, dot(row, row).sqrt());
}

/** Doubles over a power of two, the largest of them in [1/2, 1). */
export function scaled(values: ArrayLike<number>): Float64Array {
  const largest = Array.from(values).reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const exponent = exponentOf(largest);
  const half = Math.floor(exponent / 2); // in two steps: 2^1074 is no double
  return Float64Array.from(values, (value) => value * 2 ** -half * 2 ** (half - exponent));
}

/** k with |value| in [2^(k - 1), 2^k); 0 for 0. */
function exponentOf(value: number): number {
  if (value === 0) return 0;
  const bits = new DataView(new ArrayBuffer(8));
  bits.setFloat64(0, value);
  const stored = (bits.getUint32(0) >>> 20) & 0x7ff;
  return stored > 0 ? stored - 1022 : exponentOf(value * 2 ** 54) - 54; // below: a subnormal number
}
