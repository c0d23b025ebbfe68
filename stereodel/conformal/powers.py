"""One-parameter subgroups: real powers of a conformal map.

An element c + v of SL(2, C), v·v = s² and c² + s² = 1, is cos θ + (v/s) sin θ with a complex angle θ, and its power is
cos tθ + (v/s) sin tθ = exp(t (θ/s) v). The factor κ = tθ/s is rounded; what is rounded is then the exact power for an
exponent that differs by some 2⁻⁵² of itself, and everything after it is done in double-double: fixed points stay where
they are.
"""

from __future__ import annotations

import numpy as np

from stereodel._double_double import DoubleDouble
from stereodel.conformal.biquaternions import Biquaternion, from_parts
from stereodel.conformal.complex_pairs import Complex, inner
from stereodel.constants import LARGEST_MAGNIFICATION

_TERMS = 9
_SMALL = 2.0**-4  # |w| ≤ 2⁻⁸ in the series: the first term left out, w⁹/18!, is below 2⁻¹²⁴
_NO_ANGLE = 1e-9  # |s| below which θ/s is 1 + s²/6 to a double


def power(element: Biquaternion, exponent: float) -> Biquaternion:
    """The real power of an element of determinant 1; of the two signs the one of the smaller rotation is taken."""
    element = principal(element)
    square = complex(inner(element.vector, element.vector))
    if abs(square) <= _NO_ANGLE**2:
        return exponential(element.vector * Complex.of(exponent * (1 + square / 6)))
    sine = sine_of(element)
    angle = _angle(element, sine)
    if 2 * abs(exponent * angle.imag) > np.log(LARGEST_MAGNIFICATION):
        raise ValueError(f"exponent is {exponent:g}: the power has a magnification above {LARGEST_MAGNIFICATION:g}")
    return exponential(element.vector * Complex.of(exponent * angle / complex(sine)))


def principal(element: Biquaternion) -> Biquaternion:
    """The element or its negative, the same map: that with 0 ≤ Re c, so that the rotation is by at most 180°.

    With Re c = 0 both are by 180°; the last component of the vector that is not zero is then made positive.
    """
    scalar = float(element.real.hi[0])
    if scalar == 0:
        components = [*element.imag.hi[1:], *element.real.hi[1:]]
        scalar = next((float(part) for part in reversed(components) if part != 0), 1.0)
    return element if scalar > 0 else Biquaternion(-element.real, -element.imag)


def sine_of(element: Biquaternion) -> Complex:
    """The number s with c + i s of size 1 or more, up to rounding; not for s = 0."""
    root = inner(element.vector, element.vector).sqrt()
    return root if _excess(element, root) >= 0 else -root


def _excess(element: Biquaternion, sine: Complex) -> float:
    """|c + i s|² − 1."""
    return float(((element.scalar + sine.times_i()).square_size() - 1.0).round())


def _angle(element: Biquaternion, sine: Complex) -> complex:
    """θ with c = cos θ and s = sin θ, from the logarithm of exp(iθ) = c + i s."""
    value = complex(element.scalar + sine.times_i())
    return complex(np.arctan2(value.imag, value.real), -0.5 * np.log1p(_excess(element, sine)))


def exponential(generator: Complex) -> Biquaternion:
    """The element cos z + (sin z / z) g of a vector g (3,), z² = g·g, by Taylor's series and repeated squaring."""
    size = float((generator.square_size().hi.sum()) ** 0.5)
    halvings = max(0, int(np.ceil(np.log2(size / _SMALL)))) if size > 0 else 0
    g = generator * 2.0**-halvings
    w = -inner(g, g)
    result = from_parts(_series(w, 0), g * _series(w, 1))
    for _ in range(halvings):
        result = result @ result
    return result


def _series(w: Complex, first: int) -> Complex:
    """The sum of w^k / (2k + first)!: cos z for 0, sin z / z for 1, w = −z²."""
    one = Complex.of(1 + 0j)
    total = one
    for k in range(_TERMS - 1, 0, -1):
        n = 2 * k + first
        total = one + total * w * Complex(1.0 / DoubleDouble(float(n * (n - 1))), DoubleDouble(0.0))
    return total
