"""One-parameter subgroups: real powers of a conformal map.

An element c + v of SL(2, C), v·v = s² and c² + s² = 1, is cos θ + (v/s) sin θ with a complex angle θ, and its power is
cos tθ + (v/s) sin tθ. The angle is rounded; the result is the exact power for an exponent with a relative error of
about 2⁻⁵². The vector is only scaled, so fixed points do not move.
"""

from __future__ import annotations

import numpy as np

from stereodel.conformal.biquaternions import Biquaternion, from_parts
from stereodel.conformal.complex_pairs import Complex
from stereodel.constants import LARGEST_MAGNIFICATION, SMALL_ANGLE


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
