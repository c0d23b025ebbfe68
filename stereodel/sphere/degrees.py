"""Sine, cosine and angle in degrees, in double-double: no platform mathematics, so the same bits on every machine.

An angle is reduced by `fmod` (exact) and by the nearest multiple of 90° (exact, Sterbenz), so multiples of 90° give 0
and ±1 exactly and mirrored angles give mirrored values.
"""

from __future__ import annotations

from fractions import Fraction
from math import factorial

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble, where

_PI = Fraction(31415926535897932384626433832795028841971693993751, 10**49)


def _split(value: Fraction) -> DoubleDouble:
    """A constant to 106 bits; the division of integers behind `float(Fraction)` is correctly rounded."""
    return DoubleDouble(float(value), float(value - Fraction(float(value))))


_RADIAN = _split(_PI / 180)
_SQRT_HALF = DoubleDouble(0.5).sqrt()
# For |θ| ≤ π/4 the first term left out of either series is below 2⁻¹⁰⁷ (28 in cosine: 2⁻¹⁰⁷·⁷; 29 in sine).
_TERMS = 14
# From θ¹⁸/18! < 2⁻⁵⁸ on, a term in plain double adds an error below 2⁻¹¹⁰.
_DOUBLE_FROM = 9
_RECIPROCAL_FACTORIALS = [_split(Fraction(1, factorial(n))) for n in range(2 * _TERMS + 1)]


def sin_cos_degrees(angle: FloatArray) -> tuple[DoubleDouble, DoubleDouble]:
    """Sine and cosine of angles in degrees.

    Parameters
    ----------
    angle : ndarray of any shape
        Any finite number of degrees.

    Returns
    -------
    sine, cosine : DoubleDouble
        Relative error below 2⁻⁹⁸; exact at multiples of 90°, and of one value at odd multiples of 45°.

    Examples
    --------
    >>> import numpy as np
    >>> sine, cosine = sin_cos_degrees(np.array([30.0, 180.0]))
    >>> print(sine.round(), cosine.round() + 0.0)
    [0.5 0. ] [ 0.8660254 -1.       ]
    """
    turn = np.fmod(angle, 360.0)
    quarter = np.rint(turn / 90.0)
    rest = turn - 90.0 * quarter
    theta = _RADIAN * rest
    square = theta * theta
    sine, cosine = theta * _series(square, 1), _series(square, 0)
    # At ±45° both are √½: the swap of x and y is then as exact as the other mirrors.
    diagonal = np.abs(rest) == 45.0
    sine = where(diagonal, _SQRT_HALF * np.sign(rest), sine)
    cosine = where(diagonal, _SQRT_HALF, cosine)
    odd = quarter % 2 == 1
    swapped_sine, swapped_cosine = where(odd, cosine, sine), where(odd, sine, cosine)
    sine_sign = np.where(np.isin(quarter % 4, (2, 3)), -1.0, 1.0)
    cosine_sign = np.where(np.isin(quarter % 4, (1, 2)), -1.0, 1.0)
    return swapped_sine * sine_sign, swapped_cosine * cosine_sign


def _series(square: DoubleDouble, first: int) -> DoubleDouble:
    """Σ (−θ²)ᵏ / (2k + first)!, Horner's rule."""
    minus = -square
    tail = np.zeros_like(square.hi)
    for k in range(_TERMS if first == 0 else _TERMS - 1, _DOUBLE_FROM - 1, -1):
        tail = tail * minus.hi + _RECIPROCAL_FACTORIALS[2 * k + first].hi
    total = DoubleDouble(tail)
    for k in range(_DOUBLE_FROM - 1, -1, -1):
        total = total * minus + _RECIPROCAL_FACTORIALS[2 * k + first]
    return total


def angle_degrees(y: DoubleDouble, x: DoubleDouble) -> FloatArray:
    """The angle of (x, y) in degrees in [−180, 180], 0 at the origin, within an ulp.

    A guess by the platform's arctangent is corrected in double-double, so the platform's last bits do not show.
    """
    guess = np.where((x.hi == 0) & (y.hi == 0), 0.0, np.degrees(np.arctan2(y.hi, x.hi)))
    sine, cosine = sin_cos_degrees(guess)
    across, along = (y * cosine - x * sine).round(), (x * cosine + y * sine).round()
    step = np.divide(across, along, out=np.zeros_like(guess), where=along != 0)
    return np.asarray(guess + np.degrees(step))
