/**
 * Checks of what callers hand in: every message about points and indices stands here. What is no number is a
 * `TypeError`, a number that will not do a `RangeError`; both name the argument and the entry. Behind these checks arrays
 * are finite and of known shape: the kernel takes that for granted.
 *
 * Statements with the label CHECK are left out of the page and the widget (`tools/bundle_web.mjs`): there, numbers come
 * from fields, links and files that were checked in the words for readers.
 */

/** Coordinates as callers may give them: numbers, row after row, in one flat array. */
export type Numbers = ArrayLike<number>;

/** Points in 4 GiB, of which a triangulation takes 236 bytes each while it is made. Diagrams take twice as much. */
const MOST_POINTS = 16_000_000;

/** What a message calls an entry: `points[3, 0]` by its row and column, or `indices[3]`. */
function place(name: string, at: number, width: number): string {
  return `${name}[${width === 1 ? at : `${Math.floor(at / width)}, ${at % width}`}]`;
}

function kindOf(value: unknown): string {
  if (value === null) return "null";
  return Array.isArray(value) || ArrayBuffer.isView(value) ? "an array" : `of type ${typeof value}`;
}

/** Finite doubles in rows of `width`, as many as the kernel has memory for; an array of doubles is returned as it is, not copied. */
export function asRows(values: Numbers, width: number, name: string): Float64Array {
  CHECK: if (values === null || typeof values !== "object" || typeof values.length !== "number") {
    throw new TypeError(`${name} must be an array of numbers, row after row, but is ${kindOf(values)}`);
  }
  CHECK: if (values.length > MOST_POINTS * width) {
    const rows = `${Math.floor(values.length / width)} rows, more than the ${MOST_POINTS}`;
    throw new RangeError(`${name} has ${rows} that the kernel has memory for; give fewer`);
  }
  CHECK: for (let k = 0; k < values.length; ++k) {
    const value: unknown = values[k];
    if (typeof value !== "number") {
      const advice = Array.isArray(value) ? "; give all rows in one flat array" : "";
      throw new TypeError(`${place(name, k, width)} is ${kindOf(value)}, which is not a real number${advice}`);
    }
    if (!Number.isFinite(value)) {
      throw new RangeError(`${place(name, k, width)} is ${value}; every value must be a finite number`);
    }
  }
  CHECK: if (values.length % width !== 0) {
    const rows = `(n, ${width}) as one flat array, ${width} numbers a row`;
    throw new RangeError(`${name} must have shape ${rows}, got ${values.length} numbers`);
  }
  return values instanceof Float64Array ? values : new Float64Array(values);
}

/** Vectors of three that are not zero; `single` is the name of one that stands alone. */
export function asDirections(values: Numbers, name: string, single?: string): Float64Array {
  const array = asRows(values, 3, name);
  CHECK: for (let k = 0; k < array.length; k += 3) {
    if (array[k] === 0 && array[k + 1] === 0 && array[k + 2] === 0) {
      throw new RangeError(`${single ?? place(name, k / 3, 1)} is the zero vector, which has no direction`);
    }
  }
  return array;
}

/** Rows (longitude, latitude) in degrees: any finite longitude, latitude in [-90, 90]. */
export function asLonlat(values: Numbers, name = "lonlat"): Float64Array {
  const array = asRows(values, 2, name);
  CHECK: for (let k = 1; k < array.length; k += 2) {
    if (Math.abs(array[k]) > 90) {
      throw new RangeError(
        `${place(name, k, 2)} is latitude ${array[k]}, outside [-90, 90]; the order is (longitude, latitude)`,
      );
    }
  }
  return array;
}

/** Numbers of points below `size`. */
export function asIndices(values: Numbers, size: number, name = "indices"): Int32Array {
  const array = new Int32Array(values.length);
  for (let k = 0; k < array.length; ++k) {
    const value: unknown = values[k];
    CHECK: if (!Number.isInteger(value))
      throw new TypeError(`${name} must be integers, but ${place(name, k, 1)} is ${String(value)}`);
    CHECK: if ((value as number) < 0 || (value as number) >= size) {
      throw new RangeError(`${place(name, k, 1)} is ${String(value)}, but there are ${size} points (0 to ${size - 1})`);
    }
    array[k] = value as number;
  }
  return array;
}

/** One whole number, at least `low`, at most `high`. */
export function asCount(value: number, name: string, low: number, high: number): number {
  CHECK: if (!Number.isInteger(value)) throw new TypeError(`${name} must be one integer, got ${String(value)}`);
  CHECK: if (value < low) throw new RangeError(`${name} is ${value}, but must be at least ${low}`);
  CHECK: if (value > high) throw new RangeError(`${name} is ${value}, but must be at most ${high}`);
  return value;
}

/** One finite number above `low`. */
export function asScalar(value: number, name: string, low = -Infinity): number {
  CHECK: if (typeof value !== "number") throw new TypeError(`${name} is ${kindOf(value)}, which is not a real number`);
  CHECK: if (!Number.isFinite(value)) throw new RangeError(`${name} is ${value}; every value must be a finite number`);
  CHECK: if (value <= low) throw new RangeError(`${name} is ${value}, outside (${low}, inf]`);
  return value;
}
