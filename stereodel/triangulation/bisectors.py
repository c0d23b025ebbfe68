"""Planes that bisect pairs of directions: every ridge of a spherical diagram lies in one."""

from __future__ import annotations

from math import isqrt

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble, dot, unit
from stereodel.predicates.integers import primitive
from stereodel.triangulation.circumcenters import integer_unit

_CANCELLED = 2.0**-48
# Unit vectors are within 2⁻¹⁰² per component, their difference within √3·2⁻¹⁰¹: less than 2⁻⁵² of a length above this.


def bisector_normals(p: FloatArray, q: FloatArray) -> FloatArray:
    """Unit vectors of p̂ − q̂ (k, 3) for different directions p and q (k, 3), however close: normals towards p."""
    difference = unit(p) - unit(q)
    length = dot(difference, difference).sqrt()
    sharp = length.hi > _CANCELLED
    length = DoubleDouble(np.where(sharp, length.hi, 1.0), np.where(sharp, length.lo, 0.0))
    normals = (difference / length[:, None]).round() + 0.0
    for k in np.flatnonzero(~sharp).tolist():
        normals[k] = _exactly(p[k], q[k])
    return normals


def _exactly(p: FloatArray, q: FloatArray) -> list[float]:
    """|q| p − |p| q with integer rays and roots of enough digits, rounded once.

    Two different products |q|pₓ, |p|qₓ of B-bit rays have squares that differ by 1 at least, so they differ by 2⁻²ᴮ⁻²;
    a root cut off after `digits` bits is off by less than 2ᴮ⁺¹⁻ᵈⁱᵍⁱᵗˢ in its product.
    """
    rays = [primitive(vector) for vector in (p.tolist(), q.tolist())]
    digits = 3 * max(abs(x) for ray in rays for x in ray).bit_length() + 70
    lengths = [isqrt(sum(x * x for x in ray) << 2 * digits) for ray in rays]
    return integer_unit([lengths[1] * x - lengths[0] * y for x, y in zip(*rays, strict=True)])
