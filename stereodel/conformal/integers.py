"""Conformal maps in integers: products of any magnification without rounding.

The numbers that define a `MoebiusMap` are doubles, and so integers over a power of two. As cosh(η/2) : sinh(η/2) is S +
1 : S − 1, the quaternions L (S + 1 − i (S − 1) z) R are integers up to a common factor. So are their products, and
their determinants are positive. Double-doubles would lose a product of magnifications of 1e16 that cancel each other,
as its terms are that much larger than their sum.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isqrt

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble
from stereodel.conformal.biquaternions import Biquaternion, Complex

Quaternion = tuple[int, int, int, int]

_ROOT_BITS = 256
"""Least number of bits of a determinant's root: its relative error is then 2⁻²⁵⁵, below any double-double."""


@dataclass(frozen=True)
class IntegerElement:
    """The element (real + i·imag)/√determinant of SL(2, C)."""

    real: Quaternion
    imag: Quaternion
    determinant: int

    @classmethod
    def of(cls, left: FloatArray, magnification: float, right: FloatArray) -> IntegerElement:
        """Rotation, fisheye of magnification S along z and rotation, from quaternions (4,) of any length."""
        first, last = _integers(left), _integers(right)
        size, unit = magnification.as_integer_ratio()
        scaled = _times(first, size - unit)
        return cls(
            _product(_times(first, size + unit), last),
            _product(_product(scaled, (0, 0, 0, -1)), last),
            4 * size * unit * _square(first) * _square(last),
        )

    def __matmul__(self, other: IntegerElement) -> IntegerElement:
        a, b, c, d = self.real, self.imag, other.real, other.imag
        return IntegerElement(
            _sum(_product(a, c), _times(_product(b, d), -1)),
            _sum(_product(a, d), _product(b, c)),
            self.determinant * other.determinant,
        )

    def rounded(self) -> Biquaternion:
        """The element in double-double, each component to 2⁻¹⁰⁵ of itself, and v·v of its vector part."""
        shift = max(0, _ROOT_BITS - self.determinant.bit_length() // 2)
        root = isqrt(self.determinant << 2 * shift)
        real, imag = (_double_doubles([x << shift for x in part], root) for part in (self.real, self.imag))
        return Biquaternion(real, imag, self._vector_square())

    def _vector_square(self) -> Complex:
        (_, *v), (_, *w) = self.real, self.imag
        inner = sum(x * y for x, y in zip(v, w, strict=True))
        parts = _double_doubles([sum(x * x for x in v) - sum(y * y for y in w), 2 * inner], self.determinant)
        return Complex(parts[0], parts[1])


def _integers(quaternion: FloatArray) -> Quaternion:
    """A quaternion of doubles times a power of two."""
    ratios = [x.as_integer_ratio() for x in quaternion.tolist()]
    unit = max(denominator for _, denominator in ratios)
    w, x, y, z = (numerator * (unit // denominator) for numerator, denominator in ratios)
    return w, x, y, z


def _product(p: Quaternion, q: Quaternion) -> Quaternion:
    (a, b, c, d), (w, x, y, z) = p, q
    return (
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    )


def _times(q: Quaternion, factor: int) -> Quaternion:
    w, x, y, z = (factor * part for part in q)
    return w, x, y, z


def _sum(p: Quaternion, q: Quaternion) -> Quaternion:
    w, x, y, z = (a + b for a, b in zip(p, q, strict=True))
    return w, x, y, z


def _square(q: Quaternion) -> int:
    return sum(part * part for part in q)


def _double_doubles(numerators: list[int], denominator: int) -> DoubleDouble:
    """Quotients of integers; Python rounds each division once."""
    high = [numerator / denominator for numerator in numerators]
    low = []
    for numerator, quotient in zip(numerators, high, strict=True):
        top, bottom = quotient.as_integer_ratio()
        low.append((numerator * bottom - top * denominator) / (denominator * bottom))
    return DoubleDouble(np.array(high), np.array(low))
