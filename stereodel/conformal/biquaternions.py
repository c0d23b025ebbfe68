"""Conformal maps as quaternions with complex coefficients: the group SL(2, C), in double-double.

q = a + i b with real quaternions a, b stands for the 2×2 matrix in which the quaternion units are −i times the Pauli
matrices. A rotation is a real unit quaternion; the fisheye of magnification S along the unit vector f is cosh(η/2) − i
sinh(η/2) f with η = ln S. Products are compositions; those of stored maps are exact, and the kernel's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from stereodel import _kernel
from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble, dot, stack, where
from stereodel.sphere import Rotation
from stereodel.sphere.rotations import conjugate, multiply, normalized


@dataclass(frozen=True)
class Complex:
    """re + i im, in double-doubles: scalars, or vectors of space along the last axis."""

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


Z_AXIS = DoubleDouble(np.array([0.0, 0.0, 1.0]))

Parts = tuple[Rotation, float, Rotation]
"""Left rotation, magnification along z, right rotation."""


def parts(numbers: FloatArray) -> Parts:
    """The parts of a map from the nine numbers that the kernel gives: quaternion, magnification, quaternion."""
    return Rotation(numbers[:4]), float(numbers[4]), Rotation(numbers[5:])


class Biquaternion(NamedTuple):
    """The element real + i·imag of SL(2, C); q and −q are the same map."""

    real: DoubleDouble
    imag: DoubleDouble
    known_square: Complex | None = None
    """v·v of the vector part, if known more accurately than from the components, among which it may cancel."""

    def __matmul__(self, other: Biquaternion) -> Biquaternion:
        return Biquaternion(
            multiply(self.real, other.real) - multiply(self.imag, other.imag),
            multiply(self.real, other.imag) + multiply(self.imag, other.real),
        )

    def inverse(self) -> Biquaternion:
        """The inverse of an element of determinant 1."""
        return Biquaternion(conjugate(self.real), conjugate(self.imag))

    @property
    def scalar(self) -> Complex:
        """The scalar component, half the trace of the matrix."""
        return Complex(self.real[0], self.imag[0])

    @property
    def vector(self) -> Complex:
        """The other three components, (3,)."""
        return Complex(self.real[1:], self.imag[1:])

    @property
    def vector_square(self) -> Complex:
        """v·v of the vector part, 1 − c² for determinant 1 and the scalar part c."""
        return inner(self.vector, self.vector) if self.known_square is None else self.known_square

    def determinant(self) -> Complex:
        """1 in SL(2, C)."""
        return Complex(dot(self.real, self.real) - dot(self.imag, self.imag), dot(self.real, self.imag) * 2.0)

    def norm(self) -> DoubleDouble:
        """|a|² + |b|², which is cosh η = (S + 1/S)/2 for determinant 1."""
        return dot(self.real, self.real) + dot(self.imag, self.imag)

    def normalized(self) -> Biquaternion:
        """The element divided by a square root of its determinant, which must not be zero."""
        element = Complex(self.real, self.imag) / self.determinant().sqrt()
        return Biquaternion(element.re, element.im)

    @classmethod
    def of(cls, numbers: FloatArray) -> Biquaternion:
        """The element of a map's nine numbers (`parts`): each component within 2⁻¹⁰⁵ of itself, and v·v as accurate."""
        rows = _kernel.moebius_element(numbers)
        square = DoubleDouble(rows[4, ::2], rows[4, 1::2])
        return cls(DoubleDouble(*rows[:2]), DoubleDouble(*rows[2:4]), Complex(square[0], square[1]))

    def decomposed(self) -> Parts:
        """The parts of the map, of magnification S ≥ 1, each rounded once."""
        return parts(_kernel.moebius_decomposed(np.stack([self.real.hi, self.real.lo, self.imag.hi, self.imag.lo])))


def rotation(quaternion: DoubleDouble) -> Biquaternion:
    """The rotation of a quaternion (4,) of any length."""
    return Biquaternion(normalized(quaternion), DoubleDouble(np.zeros(4)))


def boost(axis: DoubleDouble, magnification: DoubleDouble) -> Biquaternion:
    """The fisheye of magnification S along a unit vector (3,)."""
    root = magnification.sqrt()
    cosh, sinh = (root + 1.0 / root) * 0.5, (root - 1.0 / root) * 0.5
    zero = DoubleDouble(0.0)
    vector = axis * -sinh
    return Biquaternion(stack([cosh, zero, zero, zero]), stack([zero, vector[0], vector[1], vector[2]]))


def from_parts(scalar: Complex, vector: Complex) -> Biquaternion:
    """The element with a scalar and a vector (3,)."""
    return Biquaternion(_join(scalar.re, vector.re), _join(scalar.im, vector.im))


def _join(scalar: DoubleDouble, vector: DoubleDouble) -> DoubleDouble:
    return stack([scalar, vector[0], vector[1], vector[2]])


Spinors = tuple[tuple[Complex, Complex], tuple[Complex, Complex]]
"""A 2×2 matrix on spinors (ξ₁, ξ₂), where 1 + z : x + iy : 1 − z = |ξ₁|² : ξ₁* ξ₂ : |ξ₂|²."""


def from_spinors(matrix: Spinors) -> Biquaternion:
    """The element of a matrix on spinors, of the same determinant.

    Over the Pauli matrices it is α₀ + α·σ, and that is the biquaternion α₀ + i α.
    """
    (a, b), (c, d) = matrix
    scalar, along_z = (a + d) * 0.5, (a - d) * 0.5
    along_x, along_y = (b + c) * 0.5, ((b - c) * 0.5).times_i()
    parts = [part.times_i() for part in (along_x, along_y, along_z)]
    return from_parts(scalar, Complex(stack([part.re for part in parts]), stack([part.im for part in parts])))
