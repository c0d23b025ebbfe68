"""Circumcentres: constructed in double-double from differences of the given coordinates and rounded once.

Where the cross product of the differences cancels too far for double-double, integers take over: a triangle of any
shape that the predicates accept has the right circumcentre, up to rounding.
"""

from __future__ import annotations

from fractions import Fraction
from math import inf, isqrt

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._double_double import DoubleDouble, cross, dot, stack, unit
from stereodel.predicates.integers import primitive

_CANCELLED = 2.0**-44
# Unit vectors are within 2⁻¹⁰² per component, so a difference d is within e = 2√3·2⁻¹⁰² and d × d' within e(|d| + |d'|)
# and second order. At |d × d'| > 2⁻⁴⁴(|d| + |d'|) that is less than 2⁻⁵⁶ of it. In the plane differences are exact sums
# of two doubles, the product is off by less than 16·2⁻¹⁰⁶|d||d'|, and |d × d'| > 2⁻⁴⁴|d||d'| leaves 2⁻⁵⁸.


def planar_circumcenters(triangles: FloatArray) -> FloatArray:
    """Circumcentres (k, 2) of triangles (k, 3, 2) of the plane; infinite where they exceed the range of doubles.

    Notes
    -----
    With d = b − a, e = c − a: a + (e_y|d|² − d_y|e|², d_x|e|² − e_x|d|²) / (2 d×e).
    """
    with np.errstate(over="ignore", invalid="ignore"):
        differences = triangles[:, 1:] - triangles[:, :1]
    size = np.abs(differences).max(axis=(1, 2), initial=0.0)
    tame = (size > 2.0**-400) & (size < 2.0**400)
    shift = np.where(tame, np.frexp(np.where(tame, size, 1.0))[1], 0)
    scaled = np.ldexp(np.where(tame[:, None, None], triangles, 0.0), -shift[:, None, None])
    a, b, c = (DoubleDouble(scaled[:, k]) for k in range(3))
    d, e = b - a, c - a
    area = d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]
    dd, ee = dot(d, d), dot(e, e)
    sharp = np.abs(area.hi) > _CANCELLED * np.sqrt(dd.hi * ee.hi)
    divisor = DoubleDouble(np.where(sharp, area.hi, 1.0), np.where(sharp, area.lo, 0.0)) * 2.0
    offset = stack([(e[:, 1] * dd - d[:, 1] * ee) / divisor, (d[:, 0] * ee - e[:, 0] * dd) / divisor])
    centers = np.ldexp((a + offset).round(), shift[:, None])
    for k in np.flatnonzero(~sharp).tolist():
        centers[k] = _planar_exactly(triangles[k])
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


def spherical_circumcenters(triangles: FloatArray) -> FloatArray:
    """Unit outward normals (k, 3) of counterclockwise hull facets (k, 3, 3): circumcentres of their outer bubbles.

    Notes
    -----
    The direction of (b̂ − â) × (ĉ − â). For facets that close a set within a hemisphere it points away from the set.
    """
    a, b, c = (unit(triangles[:, k]) for k in range(3))
    d, e = b - a, c - a
    normal = cross(d, e)
    length = dot(normal, normal).sqrt()
    sharp = length.hi > _CANCELLED * (np.sqrt(dot(d, d).hi) + np.sqrt(dot(e, e).hi))
    length = DoubleDouble(np.where(sharp, length.hi, 1.0), np.where(sharp, length.lo, 0.0))
    centers = (normal / length[:, None]).round() + 0.0
    for k in np.flatnonzero(~sharp).tolist():
        centers[k] = _normal_exactly(triangles[k])
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
