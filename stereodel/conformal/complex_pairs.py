"""Complex numbers whose parts are double-doubles: scalars, or vectors of space along the last axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel._double_double import DoubleDouble, dot, where


@dataclass(frozen=True)
class Complex:
    """re + i im."""

    re: DoubleDouble
    im: DoubleDouble

    @classmethod
    def of(cls, value: complex) -> Complex:
        """A complex number of two doubles, exactly."""
        return cls(DoubleDouble(value.real), DoubleDouble(value.imag))

    def __complex__(self) -> complex:
        return complex(float(self.re.round()), float(self.im.round()))

    def __neg__(self) -> Complex:
        return Complex(-self.re, -self.im)

    def __add__(self, other: Complex) -> Complex:
        return Complex(self.re + other.re, self.im + other.im)

    def __sub__(self, other: Complex) -> Complex:
        return self + -other

    def __mul__(self, other: Complex | float) -> Complex:
        if not isinstance(other, Complex):
            return Complex(self.re * other, self.im * other)
        return Complex(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def __truediv__(self, other: Complex) -> Complex:
        size = other.square_size()
        product = self * other.conjugate()
        return Complex(product.re / size, product.im / size)

    def conjugate(self) -> Complex:
        """The complex conjugate."""
        return Complex(self.re, -self.im)

    def times_i(self) -> Complex:
        """The number times i."""
        return Complex(-self.im, self.re)

    def square_size(self) -> DoubleDouble:
        """|z|²."""
        return self.re * self.re + self.im * self.im

    def sqrt(self) -> Complex:
        """A square root of a number other than 0: that of positive real part, or of imaginary part with its sign."""
        half = self.square_size().sqrt()
        # (p + i q)² = re + i im; of |p| and |q| the larger comes from the root, without cancellation.
        large = ((half + where(self.re.hi >= 0, self.re, -self.re)) * 0.5).sqrt()
        small = self.im / (large * 2.0)
        if float(self.re.hi) >= 0:
            return Complex(large, small)
        sign = float(np.copysign(1.0, self.im.hi))
        return Complex(small * sign, large * sign)


def inner(a: Complex, b: Complex) -> Complex:
    """The sum of products of the components of two vectors, without conjugation."""
    return Complex(dot(a.re, b.re) - dot(a.im, b.im), dot(a.re, b.im) + dot(a.im, b.re))
