"""Orientation of four points of space."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_vectors
from stereodel.constants import UNIT_ROUNDOFF
from stereodel.predicates.integers import sign, to_integers
from stereodel.predicates.plane import filter_coordinates
from stereodel.predicates.staged import SignArray, columns, decide, det3, over_rows

# A term: three differences and the five roundings of det3: N = 8.
_ORIENT3D = 9 * UNIT_ROUNDOFF


def orient3d_signs(a: FloatArray, b: FloatArray, c: FloatArray, d: FloatArray) -> SignArray:
    """`orient3d` for (k, 3) arrays."""
    origin = filter_coordinates(a)
    u, v, w = (columns(filter_coordinates(p) - origin) for p in (b, c, d))
    absolute_u, absolute_v, absolute_w = (tuple(map(np.abs, edge)) for edge in (u, v, w))
    # The permanent is the determinant with every minus turned into a plus: |u|·(|v| ⊗ |w|).
    permanent = sum(
        absolute_u[i] * (absolute_v[j] * absolute_w[k] + absolute_v[k] * absolute_w[j])
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    )

    def exact(row: int) -> int:
        flat = to_integers(np.concatenate([a[row], b[row], c[row], d[row]]).tolist())
        edges = [tuple(flat[3 * i + k] - flat[k] for k in range(3)) for i in (1, 2, 3)]
        return sign(det3(*edges))

    return decide(det3(u, v, w), _ORIENT3D * permanent, exact)


def orient3d(a: npt.ArrayLike, b: npt.ArrayLike, c: npt.ArrayLike, d: npt.ArrayLike) -> SignArray | int:
    """Side of d on the plane through a, b, c, exactly.

    Parameters
    ----------
    a, b, c, d : array_like, (..., 3)
        Points of space, taken as they stand (for directions see `in_bubble`); leading shapes are broadcast together.

    Returns
    -------
    int8 ndarray of the broadcast leading shape, or int for single points
        Sign of det(b−a, c−a, d−a): 1 if a, b, c appear counterclockwise from d, −1 if clockwise, 0 if coplanar.

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, or another last axis than 3.

    Notes
    -----
    Source: Shewchuk (1997), section 4, with the rows in the order that makes the unit axes positive.

    Examples
    --------
    >>> orient3d([0, 0, 0], [1, 0, 0], [0, 1, 0], [[0, 0, 1], [5, 5, 0], [0, 0, -1e-200]])
    array([ 1,  0, -1], dtype=int8)
    """
    return over_rows(
        orient3d_signs, as_vectors(a, 3, "a"), as_vectors(b, 3, "b"), as_vectors(c, 3, "c"), as_vectors(d, 3, "d")
    )
