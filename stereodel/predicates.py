"""Exact signs: orientation, incircle and their counterpart on the sphere.

The kernel evaluates each polynomial in doubles with a derived error bound, then, where that leaves the sign open, in
about twice the precision, and in integers at last: the answer is always that of exact arithmetic on the given doubles.
Plane: the idea of Shewchuk's staged predicates ("Adaptive precision floating-point arithmetic", 1997); sphere: the
curvature form of the paper's idea to lift flat regions (rows P5 and P6 of the ledger).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, SignArray, as_directions, as_vectors
from stereodel._docs import shared
from stereodel._tasks.threads import thread_count

__all__ = ["in_bubble", "incircle", "orient2d", "orient3d"]

_SHARED = {
    "signs": """
        Returns
        -------
        int8 ndarray of the broadcast leading shape, or int for single points
        """,
    "raises": """
        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors as directions, or another last axis.
        """,
}


@shared(**_SHARED)
def orient2d(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike) -> SignArray | int:
    """Orientation of the triangle abc, exactly.

    Parameters
    ----------
    a, b, c : array_like, (..., 2)
        Points of the plane, y up; leading shapes are broadcast together.

    {signs}
        1 counterclockwise, −1 clockwise, 0 collinear.

    {raises}

    Notes
    -----
    The sign of (b−a) × (c−a) in exact arithmetic on the given doubles. Source: J. R. Shewchuk, "Adaptive precision
    floating-point arithmetic and fast robust geometric predicates" (1997), section 4.

    Examples
    --------
    >>> orient2d([0, 0], [1, 0], [[0, 1], [2, 0], [0, -1e-300]])
    array([ 1,  0, -1], dtype=int8)
    """
    return _over_rows(_kernel.plane.turn, partial(as_vectors, dimension=2), a=a, b=b, c=c)


@shared(**_SHARED)
def incircle(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> SignArray | int:
    """Side of d on the circle through a, b, c, exactly.

    Parameters
    ----------
    a, b, c, d : array_like, (..., 2)
        Points of the plane; leading shapes are broadcast together.

    {signs}
        1 inside, −1 outside, 0 on the circle, for abc counterclockwise; reversed for abc clockwise. For collinear
        abc the sign of det[x y x²+y² 1] remains: 0 if d is collinear with them or a repetition.

    {raises}

    Notes
    -----
    The sign of the determinant with rows (x, y, x² + y², 1) for a, b, c, d. Source: Shewchuk (1997), section 4.

    Examples
    --------
    >>> incircle([0, 0], [1, 0], [0, 1], [[0.5, 0.5], [1, 1], [2, 2]])
    array([ 1,  0, -1], dtype=int8)
    """
    return _over_rows(_kernel.plane.in_circle, partial(as_vectors, dimension=2), a=a, b=b, c=c, d=d)


@shared(**_SHARED)
def orient3d(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> SignArray | int:
    """Side of d on the plane through a, b, c, exactly.

    Parameters
    ----------
    a, b, c, d : array_like, (..., 3)
        Points of space (for directions see `in_bubble`); leading shapes are broadcast together.

    {signs}
        Sign of det(b−a, c−a, d−a): 1 if a, b, c appear counterclockwise from d, −1 if clockwise, 0 if coplanar.

    {raises}

    Notes
    -----
    Source: Shewchuk (1997), section 4, with the rows in the order that makes the unit axes positive.

    Examples
    --------
    >>> orient3d([0, 0, 0], [1, 0, 0], [0, 1, 0], [[0, 0, 1], [5, 5, 0], [0, 0, -1e-200]])
    array([ 1,  0, -1], dtype=int8)
    """
    return _over_rows(_kernel.orient3d, partial(as_vectors, dimension=3), a=a, b=b, c=c, d=d)


@shared(**_SHARED)
def in_bubble(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, p: npt.ArrayLike) -> SignArray | int:
    """Side of p on the circle of the sphere through a, b, c, exactly.

    Parameters
    ----------
    a, b, c, p : array_like, (..., 3)
        Directions, of any length; leading shapes are broadcast together.

    {signs}
        1 if p lies in the open bubble that the plane abc cuts off on the side from which a, b, c appear
        counterclockwise (p sees that hull facet from outside), −1 beyond it, 0 on the circle.

    {raises}

    Notes
    -----
    The sign of det(b̂−â, ĉ−â, p̂−â), where the hat is the exact direction and not a rounded unit vector; equally of the
    determinant with rows (x, y, z, |p|), reversed. Source: the paper's sidedness test (rows P5, P6, P14).

    Examples
    --------
    >>> in_bubble([1, 0, 0], [0, 2, 0], [0, 0, 3], [[1, 1, 1], [-1, 0, 0], [0, 0, 7]])
    array([ 1, -1,  0], dtype=int8)
    """
    return _over_rows(_kernel.sphere.in_circle, as_directions, a=a, b=b, c=c, p=p)


def _over_rows(
    signs: Callable[..., SignArray], check: Callable[..., FloatArray], **given: npt.ArrayLike
) -> SignArray | int:
    """Signs for points of any leading shape, broadcast together; an int for single points."""
    points = [check(point, name=name) for name, point in given.items()]
    leading = np.broadcast_shapes(*(p.shape[:-1] for p in points))
    workers = thread_count(None, math.prod(leading))
    result = signs(*(_rows(p, leading) for p in points), workers=workers)
    return result.reshape(leading) if leading else int(result[0])


def _rows(points: FloatArray, leading: tuple[int, ...]) -> FloatArray:
    """The points one below the other; a single one stands for all."""
    if points.ndim == 1:
        return points[None]
    broadcast = np.broadcast_to(points, (*leading, points.shape[-1]))
    return np.ascontiguousarray(broadcast.reshape(-1, points.shape[-1]))
