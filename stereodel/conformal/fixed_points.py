"""Classification of conformal maps by their fixed points and multipliers.

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
from stereodel.conformal.biquaternions import Biquaternion
from stereodel.conformal.complex_pairs import Complex
from stereodel.conformal.powers import principal, sine_of
from stereodel.constants import KIND_TOLERANCE

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
