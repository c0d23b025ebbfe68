"""1 + c and 1 − c for the height c of a point or a circle along an axis, without cancellation.

Near the axis one of the two is |t|² over the other, t the part of the vector across the axis; it is never formed by
subtraction, so points and circles next to a pole keep their digits.
"""

from __future__ import annotations

import numpy as np

from stereodel._double_double import DoubleDouble, where


def one_plus_minus(height: DoubleDouble, across: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    """1 + c and 1 − c of unit vectors with height c and |t|² = `across`, with small relative errors."""
    upper = height.hi >= 0
    large = 1.0 + where(upper, height, -height)
    small = across / large
    return where(upper, large, small), where(upper, small, large)


def light_cone(normal: DoubleDouble, cosine: DoubleDouble, sine: DoubleDouble) -> tuple[DoubleDouble, DoubleDouble]:
    """n_z + cos α and n_z − cos α of the circle n·x = cos α, n of shape (3,).

    As a vector (n, cos α) of Minkowski space these are its light-cone coordinates, with
    n_x² + n_y² + (n_z + cos α)(n_z − cos α) = sin² α. Each is written as a difference of whichever of 1 ± n_z and
    1 ± cos α are small, so that a tiny circle near the axis keeps its relative size.
    """
    n_plus, n_minus = one_plus_minus(normal[2], normal[0] * normal[0] + normal[1] * normal[1])
    d_plus, d_minus = one_plus_minus(cosine, sine * sine)
    plus = n_plus - d_minus if float(n_plus.hi + d_minus.hi) < 2 else d_plus - n_minus
    minus = d_minus - n_minus if float(d_minus.hi + n_minus.hi) < 2 else n_plus - d_plus
    return plus, minus


def shift_exponent(value: DoubleDouble, exponent: np.ndarray[tuple[int, ...], np.dtype[np.int32]]) -> DoubleDouble:
    """Times a power of two, exactly unless it underflows."""
    return DoubleDouble(np.ldexp(value.hi, exponent), np.ldexp(value.lo, exponent))
