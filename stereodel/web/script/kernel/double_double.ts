/**
 * Double-double arithmetic: a value is the unevaluated sum hi + lo, about 106 bits. Operation by operation that of
 * stereodel/_double_double.py, so that latitudes have the same bits here and there.
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

/** One number. */
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
