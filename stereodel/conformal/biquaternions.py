"""Conformal maps as quaternions with complex coefficients: the group SL(2, C), in double-double.

q = a + i b with real quaternions a, b stands for the 2×2 matrix in which the quaternion units are −i times the Pauli
matrices. A rotation is a real unit quaternion; the fisheye of magnification S along the unit vector f is
cosh(η/2) − i sinh(η/2) f with η = ln S. Products are compositions. For q = L·fisheye(S)·R the two parts are
a = cosh(η/2) L R and b = −sinh(η/2) L z R, so the decomposition loses nothing however large S is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from stereodel._double_double import DoubleDouble, dot, stack
from stereodel.sphere import Rotation
from stereodel.sphere.quaternions import between, conjugate, multiply, normalized

Z_AXIS = DoubleDouble(np.array([0.0, 0.0, 1.0]))


class Biquaternion(NamedTuple):
    """The element real + i·imag of SL(2, C); q and −q are the same map."""

    real: DoubleDouble
    imag: DoubleDouble

    def __matmul__(self, other: Biquaternion) -> Biquaternion:
        return Biquaternion(
            multiply(self.real, other.real) - multiply(self.imag, other.imag),
            multiply(self.real, other.imag) + multiply(self.imag, other.real),
        )

    def inverse(self) -> Biquaternion:
        """The inverse of an element of determinant 1."""
        return Biquaternion(conjugate(self.real), conjugate(self.imag))

    def determinant(self) -> tuple[DoubleDouble, DoubleDouble]:
        """Real and imaginary part of a complex number, 1 in SL(2, C)."""
        return dot(self.real, self.real) - dot(self.imag, self.imag), dot(self.real, self.imag) * 2.0

    def norm(self) -> DoubleDouble:
        """|a|² + |b|², which is cosh η = (S + 1/S)/2 for determinant 1."""
        return dot(self.real, self.real) + dot(self.imag, self.imag)

    def normalized(self) -> Biquaternion:
        """Over a square root of the determinant, which must not be zero."""
        re, im = self.determinant()
        size = (re * re + im * im).sqrt()
        # (p + i q)² = re + i im; of |p| and |q| the larger comes from the root, without cancellation.
        if float(re.hi) >= 0:
            p = ((size + re) * 0.5).sqrt()
            q = im / (p * 2.0)
        else:
            q = ((size - re) * 0.5).sqrt()
            p = im / (q * 2.0)
        return Biquaternion((self.real * p + self.imag * q) / size, (self.imag * p - self.real * q) / size)

    def decomposed(self) -> tuple[Rotation, float, Rotation]:
        """Left rotation, magnification S ≥ 1 along z and right rotation, each rounded once."""
        a, b = dot(self.real, self.real).sqrt(), dot(self.imag, self.imag).sqrt()
        magnification = float(((a + b) * (a + b)).round())
        if magnification <= 1:
            return Rotation.identity(), 1.0, Rotation.rounded(self.real / a)
        axis = -multiply(self.imag, conjugate(self.real))[1:]
        left = normalized(between(Z_AXIS, axis / dot(axis, axis).sqrt()))
        right = multiply(conjugate(left), self.real / a)
        return Rotation.rounded(left), magnification, Rotation.rounded(right)


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
