"""Orientation and incircle in the plane, y up: filtered in doubles, decided in integers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.constants import FILTER_RANGE, UNIT_ROUNDOFF
from stereodel.predicates.integers import sign
from stereodel.predicates.staged import Pair, Real

# A term of orient2d: two differences, a product, a subtraction: N = 4.
_ORIENT2D = 5 * UNIT_ROUNDOFF
# A term of incircle: four differences, a square, a sum, a product, a subtraction, a product, two sums: N = 11.
_INCIRCLE = 12 * UNIT_ROUNDOFF

IntPoint = Sequence[int]


def filter_coordinates(points: FloatArray) -> FloatArray:
    """The points as the filters see them: NaN, which decides nothing, where exponents leave their range.

    A double of 2⁻¹⁴⁷ or more is a multiple of 2⁻¹⁹⁹, and so are differences of such doubles: with the limits below
    every difference that is not zero lies between 1/FILTER_RANGE and FILTER_RANGE, and no product of four of them
    overflows or underflows.
    """
    size = np.abs(points)
    inside = (size == 0.0) | ((size >= 2.0**53 / FILTER_RANGE) & (size <= FILTER_RANGE / 2))
    return np.where(inside, points, np.nan)


def orient2d_filter(a: Sequence[Real], b: Sequence[Real], c: Sequence[Real]) -> Pair[Real]:
    """Twice the signed area of abc and the bound of its error."""
    left = (b[0] - a[0]) * (c[1] - a[1])
    right = (b[1] - a[1]) * (c[0] - a[0])
    return left - right, _ORIENT2D * (abs(left) + abs(right))


def incircle_filter(a: Sequence[Real], b: Sequence[Real], c: Sequence[Real], d: Sequence[Real]) -> Pair[Real]:
    """The incircle determinant and the bound of its error.

    With A = |a−d|² and so on, |bx·cy| + |by·cx| ≤ √(BC) ≤ (B + C)/2 (Cauchy, then the two means), so the permanent
    is at most AB + BC + CA.
    """
    ax, ay, bx, by, cx, cy = a[0] - d[0], a[1] - d[1], b[0] - d[0], b[1] - d[1], c[0] - d[0], c[1] - d[1]
    aa, bb, cc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    value = aa * (bx * cy - by * cx) + bb * (cx * ay - cy * ax) + cc * (ax * by - ay * bx)
    return value, _INCIRCLE * (aa * bb + bb * cc + cc * aa)


def orient2d_integer(a: IntPoint, b: IntPoint, c: IntPoint) -> int:
    """Sign of the area of a triangle of integer points."""
    return sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def incircle_integer(a: IntPoint, b: IntPoint, c: IntPoint, d: IntPoint) -> int:
    """Sign of the incircle determinant of integer points."""
    ax, ay, bx, by, cx, cy = a[0] - d[0], a[1] - d[1], b[0] - d[0], b[1] - d[1], c[0] - d[0], c[1] - d[1]
    return sign(
        (ax * ax + ay * ay) * (bx * cy - by * cx)
        + (bx * bx + by * by) * (cx * ay - cy * ax)
        + (cx * cx + cy * cy) * (ax * by - ay * bx)
    )
