"""Double-double arithmetic on arrays: a value is the unevaluated sum hi + lo, |lo| ≤ ½ ulp(hi), about 106 bits.

Operators read like formulas: ``(a * b + c).round()``. The error-free transformations are Dekker's and Knuth's; the
operations and their relative error bounds are those of M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous
error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44 (2017), with u = 2⁻⁵³: sum 3u² + 13u³
(algorithm 6), product 7u² (algorithm 10 widened for the missing fused multiply-add), quotient 15u² and root 25u²
(both widened). Valid for magnitudes between 2⁻⁴⁸⁰ and 2⁴⁸⁰: callers scale first; below it the error is absolute, under
2⁻¹⁰²². No operation uses the platform's mathematical library beyond the correctly rounded + − × ÷ and square root.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from stereodel._arrays import AnyIndices, BoolArray, FloatArray, IntArray
from stereodel.constants import STORED_ERROR

_SPLITTER = 2.0**27 + 1.0  # Veltkamp: cuts a 53-bit significand into two halves of at most 26 bits


def two_sum(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rounded sum and its exact error, for any a and b (Knuth)."""
    s = a + b
    shadow = s - a
    return s, (a - (s - shadow)) + (b - shadow)


def fast_two_sum(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The same in three operations, for |a| ≥ |b| or a = 0 (Dekker)."""
    s = a + b
    return s, b - (s - a)


def two_prod(a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Rounded product and its exact error (Dekker, Veltkamp)."""
    p = a * b
    a_high, a_low = _split(a)
    b_high, b_low = (a_high, a_low) if b is a else _split(b)
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


def _split(a: FloatArray) -> tuple[FloatArray, FloatArray]:
    scaled = _SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high


class DoubleDouble:
    """An array of unevaluated sums hi + lo, by default lo = 0; callers see to it that |lo| ≤ ½ ulp(hi)."""

    __array_ufunc__ = None  # so that `ndarray * DoubleDouble` comes to __rmul__
    __slots__ = ("hi", "lo")

    def __init__(self, hi: npt.ArrayLike, lo: npt.ArrayLike | None = None) -> None:
        self.hi: FloatArray = np.asarray(hi, dtype=np.float64)
        self.lo: FloatArray = np.zeros_like(self.hi) if lo is None else np.asarray(lo, dtype=np.float64)

    def round(self) -> FloatArray:
        """The nearest doubles."""
        return self.hi + self.lo

    def __getitem__(self, key: Any) -> DoubleDouble:
        return DoubleDouble(self.hi[key], self.lo[key])

    def __neg__(self) -> DoubleDouble:
        return DoubleDouble(-self.hi, -self.lo)

    def __add__(self, other: DoubleDouble | npt.ArrayLike) -> DoubleDouble:
        b = _lift(other)
        s, e = two_sum(self.hi, b.hi)
        t, f = two_sum(self.lo, b.lo)
        s, e = fast_two_sum(s, e + t)
        return DoubleDouble(*fast_two_sum(s, e + f))

    def __sub__(self, other: DoubleDouble | npt.ArrayLike) -> DoubleDouble:
        return self + -_lift(other)

    def __mul__(self, other: DoubleDouble | npt.ArrayLike) -> DoubleDouble:
        b = _lift(other)
        p, e = two_prod(self.hi, b.hi)
        return DoubleDouble(*fast_two_sum(p, e + (self.hi * b.lo + self.lo * b.hi)))

    def __truediv__(self, other: DoubleDouble | npt.ArrayLike) -> DoubleDouble:
        b = _lift(other)
        first = self.hi / b.hi
        rest = self - b * first
        second = rest.hi / b.hi
        rest = rest - b * second
        return DoubleDouble(*fast_two_sum(first, second)) + rest.hi / b.hi

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other: npt.ArrayLike) -> DoubleDouble:
        return _lift(other) - self

    def __rtruediv__(self, other: npt.ArrayLike) -> DoubleDouble:
        return _lift(other) / self

    def sqrt(self) -> DoubleDouble:
        """Square root; 0 at 0, NaN below."""
        root = np.sqrt(self.hi)
        rest = self - DoubleDouble(*two_prod(root, root))
        correction = np.divide(rest.hi, 2 * root, out=np.zeros_like(root), where=root != 0)
        return DoubleDouble(*fast_two_sum(root, correction))

    def __repr__(self) -> str:
        return f"DoubleDouble({self.hi!r}, {self.lo!r})"


def where(condition: BoolArray, a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Entries of `a` where `condition` holds, else those of `b`."""
    return DoubleDouble(np.where(condition, a.hi, b.hi), np.where(condition, a.lo, b.lo))


def shift_exponent(value: DoubleDouble, exponent: AnyIndices) -> DoubleDouble:
    """Times a power of two, exactly unless it underflows."""
    return DoubleDouble(np.ldexp(value.hi, exponent), np.ldexp(value.lo, exponent))


def stack(components: list[DoubleDouble]) -> DoubleDouble:
    """Join along a new last axis."""
    return DoubleDouble(np.stack([c.hi for c in components], axis=-1), np.stack([c.lo for c in components], axis=-1))


def dot(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Inner product along the last axis."""
    terms = a * b
    total = terms[..., 0]
    for k in range(1, terms.hi.shape[-1]):
        total = total + terms[..., k]
    return total


def cross(a: DoubleDouble, b: DoubleDouble) -> DoubleDouble:
    """Vector product of (..., 3) along the last axis."""
    ax, ay, az = (a[..., k] for k in range(3))
    bx, by, bz = (b[..., k] for k in range(3))
    return stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def scaled(vectors: FloatArray) -> tuple[FloatArray, IntArray]:
    """Vectors (..., k) over a power of two, so that their largest component is in [½, 1), and its exponent (...)."""
    _, exponent = np.frexp(np.abs(vectors).max(axis=-1, keepdims=True))
    half = exponent // 2  # in two steps, since 2**1074 overflows
    return np.ldexp(np.ldexp(vectors, -half), half - exponent), exponent[..., 0]


def unit(vectors: FloatArray) -> DoubleDouble:
    """Directions of non-zero double vectors (..., 3), each component with an absolute error below 2⁻¹⁰².

    The vectors are first scaled by a power of two (exact): any length and any component down to the subnormals counts.
    """
    # Component by component: a length that is the same along the last axis costs a loop for each three numbers.
    columns = np.ascontiguousarray(np.moveaxis(vectors, -1, 0)).reshape(3, -1)
    found = np.empty((2, *columns.shape))
    for i in range(0, columns.shape[1], ROWS):
        found[..., i : i + ROWS] = _unit(columns[:, i : i + ROWS])
    return DoubleDouble(*(np.moveaxis(part.reshape(3, *vectors.shape[:-1]), 0, -1) for part in found))


def _unit(columns: FloatArray) -> tuple[FloatArray, FloatArray]:
    _, exponent = np.frexp(np.abs(columns).max(axis=0))
    scaled = columns
    if exponent.any():  # in two half steps: 2**1074 alone is not a double
        scaled = columns * np.ldexp(1.0, -(exponent // 2)) * np.ldexp(1.0, -(exponent - exponent // 2))
    terms = DoubleDouble(*two_prod(scaled, scaled))
    square = terms[0] + terms[1] + terms[2]
    # Most have length 1 to rounding: 1/√(1 + δ) = 1 − δ/2 + 3δ²/8 − …, what follows below 2⁻¹⁵⁰.
    excess = (square.hi - 1.0) + square.lo
    found = fast_two_sum(scaled, scaled * (excess * (0.375 * excess - 0.5)))
    rest = np.flatnonzero(~(np.abs(excess) < STORED_ERROR))
    if len(rest):
        others = DoubleDouble(scaled[:, rest]) / square[rest].sqrt()
        found[0][:, rest], found[1][:, rest] = others.hi, others.lo
    return found


def _lift(value: DoubleDouble | npt.ArrayLike) -> DoubleDouble:
    return value if isinstance(value, DoubleDouble) else DoubleDouble(value)


ROWS = 8192
"""Rows in a block: long enough that the calls of NumPy cost less than their work; temporaries of 64 KB stay in the
second-level cache."""


def by_blocks(function: Callable[[FloatArray], FloatArray], rows: FloatArray) -> FloatArray:
    """Apply a map of (m, k) to (m,) or (m, j) along the last axis of (..., k), block by block."""
    flat = rows.reshape(-1, rows.shape[-1])
    if len(flat) <= ROWS:
        result = function(flat)
    else:
        result = np.concatenate([function(flat[i : i + ROWS]) for i in range(0, len(flat), ROWS)])
    return result.reshape(rows.shape[:-1] + result.shape[1:])
