"""Barycentric coordinates in all triangles at once, and the triangles that hold a point up to a tolerance."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, IntArray
from stereodel.constants import TRANSFORM_CONDITION
from stereodel.triangulation import PlanarDelaunay

_PAIRS_AT_ONCE = 2**20
"""Queries times triangles that are compared in one step: 50 MB."""


def transforms(corners: FloatArray) -> FloatArray:
    """Maps to barycentric coordinates, (m, 3, 2), of triangles (m, 3, 2); NaN for degenerate ones.

    Row 2 is the last corner r, rows 0 and 1 are the inverse of T = [a − r, b − r] (columns): the coordinates of x for
    a and b are T⁻¹(x − r). A triangle is degenerate when the reciprocal condition number of T in the maximum norm,
    |det T| / (‖T‖·‖adj T‖), is below `TRANSFORM_CONDITION`.
    """
    sides = corners[:, :2] - corners[:, 2:]
    shift = -np.frexp(np.abs(sides).max(axis=(1, 2), initial=0.0))[1]
    (ax, ay), (bx, by) = np.ldexp(sides, shift[:, None, None]).transpose(1, 2, 0)
    determinant = ax * by - ay * bx
    norms = _larger(ax, bx, ay, by) * _larger(by, bx, ay, ax)
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = np.stack([by, -bx, -ay, ax], axis=-1).reshape(-1, 2, 2) / determinant[:, None, None]
    result = np.concatenate([np.ldexp(inverse, shift[:, None, None]), corners[:, 2:]], axis=1)
    result[~(np.abs(determinant) >= TRANSFORM_CONDITION * norms)] = np.nan
    return result


def _larger(p: FloatArray, q: FloatArray, r: FloatArray, s: FloatArray) -> FloatArray:
    larger: FloatArray = np.maximum(np.abs(p) + np.abs(q), np.abs(r) + np.abs(s))
    return larger


class NearMisses:
    """A better answer than the exact one for queries just outside the hull, and for those in degenerate triangles.

    Parameters
    ----------
    triangulation : PlanarDelaunay
    transform : (m, 3, 2) array
        From `transforms`.

    Notes
    -----
    Let x have barycentric coordinates of at least -tol in a triangle, and f be a side of the hull. All corners lie on
    one side of f and within the hull's width w of it, so x is at most 2·tol·w beyond f. The hull's centroid is at least
    w/3 inside (Minkowski and Radon), so x moved by 8·tol of its way there is inside f: only queries that come into the
    hull when moved need to be compared with the triangles at the hull.
    """

    def __init__(self, triangulation: PlanarDelaunay, transform: FloatArray) -> None:
        self._triangulation = triangulation
        self._transform = transform
        self._degenerate = np.isnan(transform[:, 0, 0])

    def improve(self, queries: FloatArray, found: IntArray, tol: float) -> IntArray:
        """Replace exact answers (k,), -1 outside, by the lowest triangle that holds the query (k, 2) within `tol`.

        A triangle that is not degenerate holds what has no barycentric coordinate below -tol; towards a degenerate
        neighbour, below -√tol. Where there is none the exact answer stays.
        """
        doubtful = self._doubtful(queries, found, tol)
        if len(doubtful) == 0 or len(self._candidates) == 0:
            return found
        lowest = np.where(self._beside_degenerate[self._candidates], -np.sqrt(tol), -tol)
        result = found.copy()
        step = max(1, _PAIRS_AT_ONCE // len(lowest))
        for some in (doubtful[i : i + step] for i in range(0, len(doubtful), step)):
            holds = np.all(_coordinates(self._transform[self._candidates], queries[some]) >= lowest, axis=-1)
            result[some] = np.where(holds.any(axis=1), self._candidates[holds.argmax(axis=1)], found[some])
        return result

    def _doubtful(self, queries: FloatArray, found: IntArray, tol: float) -> npt.NDArray[np.intp]:
        if len(self._transform) == 0:
            return np.zeros(0, dtype=np.intp)
        outside = np.flatnonzero(found < 0)
        inside = np.flatnonzero((found >= 0) & self._degenerate[found])
        if len(outside) == 0:
            return inside
        moved = queries[outside] + min(8.0 * tol, 1.0) * (self._centroid - queries[outside])
        near = np.asarray(self._triangulation.find_simplex(moved)) >= 0
        return np.sort(np.concatenate([inside, outside[near]]))

    @cached_property
    def _centroid(self) -> FloatArray:
        """Of the hull's area, (2,)."""
        corners = self._triangulation.points[self._triangulation.simplices]
        d, e = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        areas = np.abs(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
        return np.asarray(areas / areas.sum() @ corners.mean(axis=1))

    @cached_property
    def _beside_degenerate(self) -> BoolArray:
        """Whether there is a degenerate triangle opposite each corner, (m, 3)."""
        neighbors = self._triangulation.neighbors
        return self._degenerate[neighbors] & (neighbors >= 0)

    @cached_property
    def _candidates(self) -> IntArray:
        """Triangles with a corner on the hull or a degenerate neighbour, themselves not degenerate, ascending."""
        on_hull = np.zeros(len(self._triangulation.points), dtype=np.bool_)
        on_hull[self._triangulation.convex_hull] = True
        touching = on_hull[self._triangulation.simplices].any(axis=1) | self._beside_degenerate.any(axis=1)
        return np.flatnonzero(touching & ~self._degenerate).astype(np.int32)


def _coordinates(transform: FloatArray, queries: FloatArray) -> FloatArray:
    """Barycentric coordinates (k, m, 3) of each query in each triangle."""
    first = np.einsum("mij,kmj->kmi", transform[:, :2], queries[:, None] - transform[:, 2])
    return np.concatenate([first, 1.0 - first.sum(axis=-1, keepdims=True)], axis=-1)
