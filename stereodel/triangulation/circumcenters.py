"""Circumcentres: constructed by the kernel in double-double from differences of the given coordinates, rounded once.

Where the product of the differences cancels too far for double-double, integers take over: a triangle of any shape that
the predicates accept has the right circumcentre, up to rounding.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf, isqrt

from stereodel import _kernel
from stereodel._arrays import FloatArray, IntArray
from stereodel.predicates.integers import primitive


def planar_circumcenters(
    points: FloatArray, triangles: IntArray, place: IntArray | None = None, *, workers: int = 1
) -> FloatArray:
    """Circumcentres (k, 2) of triangles of the plane; infinite where they exceed the range of doubles.

    Parameters
    ----------
    points : (n, 2) array
    triangles : (k, 3) array of int32
        Their corners.
    place : (k,) array of int32, optional
        Row of the result for each triangle, a permutation.

    Notes
    -----
    With d = b − a, e = c − a: a + (e_y|d|² − d_y|e|², d_x|e|² − e_x|d|²) / (2 d×e).
    """
    centers: FloatArray
    centers, flat = _kernel.circumcenters_plane(points, triangles, place, workers)
    for k in flat.tolist():
        centers[k if place is None else place[k]] = _planar_exactly(points[triangles[k]])
    return centers


def _planar_exactly(triangle: FloatArray) -> list[float]:
    (ax, ay), (bx, by), (cx, cy) = ([Fraction(x) for x in p] for p in triangle.tolist())
    dx, dy, ex, ey = bx - ax, by - ay, cx - ax, cy - ay
    dd, ee, divisor = dx * dx + dy * dy, ex * ex + ey * ey, 2 * (dx * ey - dy * ex)
    return [_nearest(ax + (ey * dd - dy * ee) / divisor), _nearest(ay + (dx * ee - ex * dd) / divisor)]


def _nearest(number: Fraction) -> float:
    try:
        return float(number)
    except OverflowError:
        return inf if number > 0 else -inf


def spherical_circumcenters(
    points: FloatArray, triangles: IntArray, place: IntArray | None = None, *, workers: int = 1
) -> FloatArray:
    """Unit outward normals (k, 3) of counterclockwise hull facets: circumcentres of their outer bubbles.

    Parameters
    ----------
    points : (n, 3) array
        Directions.
    triangles : (k, 3) array of int32
        Their corners.
    place : (k,) array of int32, optional
        Row of the result for each triangle, a permutation.

    Notes
    -----
    The direction of (b̂ − â) × (ĉ − â). For facets that close a set within a hemisphere it points away from the set.
    """
    centers: FloatArray
    centers, flat = _kernel.circumcenters_sphere(points, triangles, place, workers)
    for k in flat.tolist():
        centers[k if place is None else place[k]] = _normal_exactly(points[triangles[k]])
    return centers


def _normal_exactly(triangle: FloatArray) -> list[float]:
    """|c| a×b + |a| b×c + |b| c×a with integer rays and roots of enough digits, rounded once."""
    rays = [primitive(p) for p in triangle.tolist()]
    # Each product has up to 3B bits, B those of a component, and the sum of the three can cancel to 1 against them.
    digits = 8 * max(abs(x) for p in rays for x in p).bit_length() + 64
    lengths = [isqrt(sum(x * x for x in p) << 2 * digits) for p in rays]
    terms = [[lengths[k - 2] * x for x in integer_cross(rays[k - 1], rays[k])] for k in range(3)]
    return integer_unit([sum(column) for column in zip(*terms, strict=True)])


def integer_cross(a: tuple[int, int, int], b: tuple[int, int, int]) -> tuple[int, int, int]:
    """Vector product of integer vectors."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def integer_unit(vector: list[int] | tuple[int, int, int]) -> list[float]:
    """Unit vector of an integer vector, each component rounded from at least 64 further bits."""
    squared = sum(x * x for x in vector)
    root = isqrt(squared << 128)
    return [(x << 64) / root for x in vector]
