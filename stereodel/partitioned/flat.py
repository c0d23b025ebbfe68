"""Flat sets: all points on one line or great circle, where there are no triangles, and nothing is to be partitioned."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from stereodel._arrays import FloatArray, Indices
from stereodel._spaces import space_of


def is_flat(lots: Iterable[FloatArray]) -> bool:
    """Whether all points of some arrays lie on one line, or great circle, exactly; it reads no further than it must.

    lots, iterable of (n, 2) or (n, 3) arrays: points of the plane, or directions.

    >>> is_flat([np.array([[0.0, 0], [1, 1]]), np.array([[5.0, 5]])])
    True
    >>> is_flat([np.array([[0.0, 0], [1, 1]]), np.array([[5.0, 6]])])
    False
    """
    first: FloatArray | None = None
    second: FloatArray | None = None
    for points in lots:
        if first is None and len(points):
            first = points[:1].copy()
        if first is not None and second is None:
            others = _others(first, points)
            second = points[others[:1]].copy() if len(others) else None
        if first is not None and second is not None and _signs(first, second, points).any():
            return False
    return True


def _others(first: FloatArray, points: FloatArray) -> Indices:
    """Which points determine a line, or a great circle, with a first one."""
    if points.shape[1] == 2:
        return np.flatnonzero((points != first).any(axis=1))
    signs = [_signs(first, axis, points) for axis in np.eye(3)[:, None]]  # all 0 where two directions are parallel
    return np.flatnonzero(np.any(signs, axis=0))


def _signs(a: FloatArray, b: FloatArray, points: FloatArray) -> Indices:
    return np.asarray(space_of(points).turn(a, b, np.ascontiguousarray(points)), dtype=np.intp)
