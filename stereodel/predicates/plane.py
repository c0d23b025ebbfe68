"""Orientation and incircle in the plane, y up: filtered in doubles, decided in integers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_vectors
from stereodel.constants import FILTER_RANGE, UNIT_ROUNDOFF
from stereodel.predicates.integers import sign, to_integers
from stereodel.predicates.staged import Pair, Real, SignArray, columns, decide, over_rows

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


def _integer_points(*points: FloatArray) -> list[IntPoint]:
    flat = to_integers(np.concatenate(points).tolist())
    return [flat[k : k + 2] for k in range(0, len(flat), 2)]


def orient2d_signs(a: FloatArray, b: FloatArray, c: FloatArray) -> SignArray:
    """`orient2d` for (k, 2) arrays."""
    value, bound = orient2d_filter(*(columns(filter_coordinates(p)) for p in (a, b, c)))
    return decide(value, bound, lambda k: orient2d_integer(*_integer_points(a[k], b[k], c[k])))


def incircle_signs(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> SignArray:
    """`incircle` for (k, 2) arrays."""
    value, bound = incircle_filter(*(columns(filter_coordinates(p)) for p in (a, b, c, d)))
    return decide(value, bound, lambda k: incircle_integer(*_integer_points(a[k], b[k], c[k], d[k])))


def orient2d(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike) -> SignArray | int:
    """Orientation of the triangle abc, exactly.

    Parameters
    ----------
    a, b, c : array_like, (..., 2)
        Points of the plane, y up; leading shapes are broadcast together.

    Returns
    -------
    int8 ndarray of the broadcast leading shape, or int for single points
        1 counterclockwise, −1 clockwise, 0 collinear.

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, or another last axis than 2.

    Notes
    -----
    The sign of (b−a) × (c−a) in exact arithmetic on the given doubles. Source: J. R. Shewchuk, "Adaptive precision
    floating-point arithmetic and fast robust geometric predicates" (1997), section 4.

    Examples
    --------
    >>> orient2d([0, 0], [1, 0], [[0, 1], [2, 0], [0, -1e-300]])
    array([ 1,  0, -1], dtype=int8)
    """
    return over_rows(orient2d_signs, as_vectors(a, 2, "a"), as_vectors(b, 2, "b"), as_vectors(c, 2, "c"))


def incircle(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> SignArray | int:
    """Side of d on the circle through a, b, c, exactly.

    Parameters
    ----------
    a, b, c, d : array_like, (..., 2)
        Points of the plane; leading shapes are broadcast together.

    Returns
    -------
    int8 ndarray of the broadcast leading shape, or int for single points
        1 inside, −1 outside, 0 on the circle, for abc counterclockwise; reversed for abc clockwise. For collinear
        abc the sign of det[x y x²+y² 1] remains: 0 if d is collinear with them or a repetition.

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, or another last axis than 2.

    Notes
    -----
    The sign of the determinant with rows (x, y, x² + y², 1) for a, b, c, d. Source: Shewchuk (1997), section 4.

    Examples
    --------
    >>> incircle([0, 0], [1, 0], [0, 1], [[0.5, 0.5], [1, 1], [2, 2]])
    array([ 1,  0, -1], dtype=int8)
    """
    return over_rows(
        incircle_signs, as_vectors(a, 2, "a"), as_vectors(b, 2, "b"), as_vectors(c, 2, "c"), as_vectors(d, 2, "d")
    )
