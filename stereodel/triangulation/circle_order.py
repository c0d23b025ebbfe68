"""Directions of one great circle: their order around it and its axis, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel.predicates.integers import primitive, sign
from stereodel.triangulation.circumcenters import integer_cross, integer_unit

Indices = npt.NDArray[np.intp]
IntegerVector = tuple[int, int, int]


def circle_order(points: FloatArray) -> Indices:
    """Two or more different directions of one great circle in cyclic order, as a permutation, (n,).

    Dropping a coordinate in which the axis is not zero keeps the cyclic order, and the remaining two are exact.
    """
    if len(points) == 2:
        return np.arange(2)
    first, *others = (primitive(p) for p in points[:3].tolist())
    axis = next(normal for normal in (integer_cross(first, p) for p in others) if any(normal))
    dropped = next(k for k in range(3) if axis[k])
    flat = np.delete(points, dropped, axis=1).tolist()
    return np.array(sorted(range(len(flat)), key=lambda k: _pseudo_angle(*flat[k])))


def _pseudo_angle(x: float, y: float) -> Fraction:
    """A number in [0, 4) that grows with the angle: the way along the unit square |x| + |y| = 1."""
    slope = Fraction(x) / (abs(Fraction(x)) + abs(Fraction(y)))
    return 1 - slope if y >= 0 else 3 + slope


def circle_axis(sites: FloatArray) -> FloatArray:
    """Both ends of the axis of a great circle, (2, 3), first the one around which the sites are counterclockwise.

    Parameters
    ----------
    sites : (2, 3) or (3, 3) array
        Two directions, taken the short way from the first to the second, or three in counterclockwise order. The axis
        of two antipodal ones is p × e, e the first of the coordinate axes along which |p| is smallest.
    """
    rays = [primitive(p) for p in sites.tolist()]
    normal = integer_cross(rays[0], rays[1]) if len(rays) == 2 else _normal(rays)
    if not any(normal):
        shortest = min(range(3), key=lambda k: abs(rays[0][k]))
        normal = integer_cross(rays[0], (int(shortest == 0), int(shortest == 1), int(shortest == 2)))
    axis = np.array(integer_unit(normal)) + 0.0
    return np.array([axis, 0.0 - axis])


def _normal(rays: Sequence[IntegerVector]) -> IntegerVector:
    """A vector along that axis.

    Of the three steps around the circle at most one is a half-turn or more: two or three of the products point along
    the axis, at most one is zero or points against it.
    """
    products = [integer_cross(rays[k - 1], rays[k]) for k in range(3)]
    k = next(k for k in range(3) if any(product[k] for product in products))
    turn = sum(sign(product[k]) for product in products)
    return next(product for product in products if product[k] * turn > 0)
