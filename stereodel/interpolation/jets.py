"""Values with their derivatives by two parameters, so that one formula gives values and gradients.

Forward-mode automatic differentiation: each operation also applies its derivative rule.
"""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.interpolation.triangles import lengths


class Jet:
    """An array of values with the derivatives of each.

    slope: derivatives by the two parameters; the rest of the shape broadcasts against that of `value`.
    """

    __array_ufunc__ = None  # so that `ndarray * Jet` calls __rmul__
    __slots__ = ("slope", "value")

    def __init__(self, value: FloatArray, slope: FloatArray) -> None:
        self.value = value
        self.slope = slope

    def __add__(self, other: Number) -> Jet:
        b = _lift(other)
        return Jet(self.value + b.value, self.slope + b.slope)

    def __sub__(self, other: Number) -> Jet:
        b = _lift(other)
        return Jet(self.value - b.value, self.slope - b.slope)

    def __mul__(self, other: Number) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value * other, self.slope * other)
        return Jet(self.value * other.value, self.slope * other.value + self.value * other.slope)

    def __truediv__(self, other: Number) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.value / other, self.slope / other)
        quotient = self.value / other.value
        return Jet(quotient, (self.slope - quotient * other.slope) / other.value)

    def __radd__(self, other: FloatArray | float) -> Jet:
        return self + other

    def __rsub__(self, other: FloatArray | float) -> Jet:
        return Jet(other - self.value, -self.slope)

    def __rmul__(self, other: FloatArray | float) -> Jet:
        return self * other

    def __rtruediv__(self, other: FloatArray | float) -> Jet:
        return _lift(other) / self


Number = Jet | FloatArray | float


def _lift(number: Number) -> Jet:
    return number if isinstance(number, Jet) else Jet(np.asarray(number), np.zeros(1))


def sin_cos(angle: Number) -> tuple[Number, Number]:
    """Sine and cosine."""
    if not isinstance(angle, Jet):
        return np.sin(angle), np.cos(angle)
    sine, cosine = np.sin(angle.value), np.cos(angle.value)
    return Jet(sine, cosine * angle.slope), Jet(cosine, -sine * angle.slope)


def arctan2(y: Number, x: Number) -> Number:
    """Angle of the vector (x, y)."""
    if not isinstance(y, Jet) and not isinstance(x, Jet):
        return np.arctan2(y, x)
    b, a = _lift(y), _lift(x)
    square = a.value * a.value + b.value * b.value
    return Jet(np.arctan2(b.value, a.value), (a.value * b.slope - b.value * a.slope) / square)


def sqrt(number: Number) -> Number:
    """Square root of a positive number."""
    if not isinstance(number, Jet):
        return np.sqrt(number)
    root = np.sqrt(number.value)
    return Jet(root, number.slope / (2.0 * root))


def norm(vector: Number) -> Number:
    """Length along the last axis, which is kept."""
    if not isinstance(vector, Jet):
        return lengths(np.asarray(vector))
    length = lengths(vector.value)
    return Jet(length, np.sum(vector.value / length * vector.slope, axis=-1, keepdims=True))
