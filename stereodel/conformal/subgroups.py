"""One-parameter subgroups: real powers of a conformal map, and what they keep, its fixed points and multipliers.

An element c + v of SL(2, C), v·v = s² and c² + s² = 1, is cos θ + (v/s) sin θ with a complex angle θ, and its power is
cos tθ + (v/s) sin tθ. The angle is rounded; the result is the exact power for an exponent with a relative error of
about 2⁻⁵². The vector is only scaled, so fixed points do not move.

An element c + v of SL(2, C) with v·v = s² ≠ 0 is conjugate to the turn and stretch ζ ↦ kζ, k = (c + i s)². Its fixed
points belong to n = v/s = a + i b, where |a|² − |b|² = 1 and a·b = 0: they are (±a + a × b)/|a|². H. S. M. Coxeter,
"The inversive plane and hyperbolic space", Abh. Math. Sem. Hamburg 29 (1966), and R. Penrose, W. Rindler, "Spinors and
Space-Time" 1 (1984), section 1.3, describe the kinds.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble, cross, dot
from stereodel.conformal.biquaternions import Biquaternion, Complex, from_parts
from stereodel.constants import KIND_TOLERANCE, LARGEST_MAGNIFICATION, SMALL_ANGLE


def power(element: Biquaternion, exponent: float) -> Biquaternion:
    """The real power of an element of determinant 1, with the sign that gives the smaller rotation."""
    element = principal(element)
    square = complex(element.vector_square)
    if abs(square) <= SMALL_ANGLE**2:
        ratio = exponent * (1 + square / 6)  # tθ/s
        z = square * ratio**2
        cosine, factor = 1 - z / 2 + z**2 / 24, ratio * (1 - z / 6 + z**2 / 120)
    else:
        sine = sine_of(element)
        angle = exponent * _angle(element, sine)
        if 2 * abs(angle.imag) > np.log(LARGEST_MAGNIFICATION):
            raise ValueError(f"exponent is {exponent:g}: the power has a magnification above {LARGEST_MAGNIFICATION:g}")
        cosine, factor = complex(np.cos(angle)), complex(np.sin(angle)) / complex(sine)
    return from_parts(Complex.of(cosine), element.vector * Complex.of(factor))


def principal(element: Biquaternion) -> Biquaternion:
    """The element or its negative, the same map: that with 0 ≤ Re c, so that the rotation is by at most 180°.

    With Re c = 0 both are by 180°; the last component of the vector that is not zero is then made positive.
    """
    scalar = float(element.real.hi[0])
    if scalar == 0:
        components = [*element.imag.hi[1:], *element.real.hi[1:]]
        scalar = next((float(part) for part in reversed(components) if part != 0), 1.0)
    return element if scalar > 0 else element._replace(real=-element.real, imag=-element.imag)


def sine_of(element: Biquaternion) -> Complex:
    """The number s with |c + i s| ≥ |c − i s|, of which the product is 1, up to rounding; not for s = 0."""
    root = element.vector_square.sqrt()
    # A quarter of the difference of the two squares: the smaller number itself would cancel.
    lead = element.scalar * root.times_i().conjugate()
    return root if float(lead.re.hi) >= 0 else -root


def _angle(element: Biquaternion, sine: Complex) -> complex:
    """θ with c = cos θ and s = sin θ, from the logarithm of exp(iθ) = c + i s."""
    exponential = element.scalar + sine.times_i()
    value, excess = complex(exponential), float((exponential.square_size() - 1.0).round())
    return complex(np.arctan2(value.imag, value.real), -0.5 * np.log1p(excess))


Kind = Literal["identity", "rotation", "boost", "parabolic", "loxodromic"]


def kind_of(element: Biquaternion) -> Kind:
    """The kind of a map, or of one within `KIND_TOLERANCE` of it.

    Rounded parameters change c by about 2⁻⁵²|v|, and s² = 1 − c² by twice that where c is 1.
    """
    vector = element.vector
    slack = KIND_TOLERANCE * float(vector.square_size().hi.sum()) ** 0.5
    if slack <= KIND_TOLERANCE**2:
        return "identity"
    square = complex(element.vector_square)
    if abs(square) <= slack:
        return "parabolic"
    if abs(float(element.imag.hi[0])) > slack:
        return "loxodromic"
    return "rotation" if square.real > 0 else "boost"


def fixed_points_of(element: Biquaternion) -> FloatArray:
    """Unit vectors (2, 3), (1, 3) when parabolic: first where the map magnifies or turns counterclockwise."""
    kind = kind_of(element)
    if kind == "identity":
        raise ValueError("every point is a fixed point of the identity")
    element = principal(element)
    if kind == "parabolic":
        real, imag = element.vector.re, element.vector.im
        return _rounded(cross(real, imag))[None]
    axis = element.vector / _sine(element, kind)
    across = cross(axis.re, axis.im)
    return np.stack([_rounded(axis.re + across), _rounded(across - axis.re)])


def multiplier_of(element: Biquaternion) -> complex:
    """The number k with |k| ≥ 1, the complex derivative at the first fixed point; 1 for identity and parabolic maps."""
    kind = kind_of(element)
    if kind in {"identity", "parabolic"}:
        return 1 + 0j
    element = principal(element)
    factor = element.scalar + _sine(element, kind).times_i()
    value = complex(factor * factor)
    if kind == "boost":
        return complex(abs(value))
    return value / abs(value) if kind == "rotation" else value


def _sine(element: Biquaternion, kind: Kind) -> Complex:
    """The root of v·v that makes |c + i s| ≥ 1, or of a rotation that with its real part positive."""
    sine = sine_of(element)
    return -sine if kind == "rotation" and float(sine.re.hi) < 0 else sine


def _rounded(vector: DoubleDouble) -> FloatArray:
    return (vector / dot(vector, vector).sqrt()).round() + 0.0
