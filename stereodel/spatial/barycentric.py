"""Barycentric coordinates in all triangles at once, and the triangles that hold a point up to a tolerance."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray
from stereodel.constants import INSIDE_TOLERANCE, TRANSFORM_CONDITION
from stereodel.triangulation import PlanarDelaunay


def transforms(corners: FloatArray) -> FloatArray:
    """Maps to barycentric coordinates, (m, 3, 2), of triangles (m, 3, 2); NaN for degenerate ones.

    Row 2 is the last corner r, rows 0 and 1 are the inverse of T = [a − r, b − r] (columns): the coordinates of x for
    a and b are T⁻¹(x − r). A triangle is degenerate when the reciprocal condition number of T in the maximum norm,
    |det T| / (‖T‖·‖adj T‖), is below `TRANSFORM_CONDITION`, or when its sides or their inverses exceed doubles.
    """
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        # Sides over a power of two, so that products stay within the range of doubles; the inverse takes it back.
        sides = corners[:, :2] - corners[:, 2:]
        shift = -np.frexp(np.abs(sides).max(axis=(1, 2), initial=0.0))[1]
        (ax, ay), (bx, by) = np.ldexp(sides, shift[:, None, None]).transpose(1, 2, 0)
        determinant = ax * by - ay * bx
        norms = _larger(ax, bx, ay, by) * _larger(by, bx, ay, ax)
        inverse = np.stack([by, -bx, -ay, ax], axis=-1).reshape(-1, 2, 2) / determinant[:, None, None]
        result = np.concatenate([np.ldexp(inverse, shift[:, None, None]), corners[:, 2:]], axis=1)
        sound = (np.abs(determinant) >= TRANSFORM_CONDITION * norms) & np.isfinite(result).all(axis=(1, 2))
    result[~sound] = np.nan
    return result


def _larger(p: FloatArray, q: FloatArray, r: FloatArray, s: FloatArray) -> FloatArray:
    return np.maximum(np.abs(p) + np.abs(q), np.abs(r) + np.abs(s))


class NearMisses:
    """A better answer than the exact one for queries just outside the hull, and for those in degenerate triangles.

    Let x have barycentric coordinates of at least -tol in a triangle, and f be a side of the hull. All corners lie on
    one side of f and within the hull's width w of it, so x is at most 2·tol·w beyond f. The hull's centroid is at least
    w/3 inside (Minkowski and Radon), so x moved by 8·tol of its way there is inside f: only queries that come into the
    hull when moved can be in a triangle.
    """

    def __init__(self, triangulation: PlanarDelaunay, transform: FloatArray) -> None:
        self._triangulation = triangulation
        self._transform = transform
        self._degenerate = np.isnan(transform[:, 0, 0])

    def improve(self, queries: FloatArray, found: IntArray, tol: float) -> IntArray:
        """Replace exact answers (k,), -1 outside, by triangles that hold the queries (k, 2) within `tol`.

        A triangle that is not degenerate holds what has no barycentric coordinate below -tol; towards a degenerate
        neighbour, below -√tol. Asked are the triangles of the query moved by 8·tol, by less, so that a larger `tol`
        loses nothing, and by 8·√tol, which is beyond degenerate triangles, and their neighbors. Where none does the
        exact answer stays.
        """
        doubtful = self._doubtful(queries, found, tol)
        if len(doubtful) == 0:
            return found
        shares = 0.0, 8.0 * min(tol, INSIDE_TOLERANCE), 8.0 * tol, 8.0 * np.sqrt(tol)
        near = [self._moved(queries[doubtful], share) for share in shares]
        result = found.copy()
        result[doubtful] = self._first_holding(queries[doubtful], self._with_neighbors(near), found[doubtful], tol)
        return result

    def _doubtful(self, queries: FloatArray, found: IntArray, tol: float) -> Indices:
        """Queries whose exact answer can be bettered: in degenerate triangles, and outside but coming inside."""
        if len(self._transform) == 0:
            return np.zeros(0, dtype=np.intp)
        outside = np.flatnonzero(found < 0)
        inside = np.flatnonzero((found >= 0) & self._degenerate[found])
        if len(outside) == 0:
            return inside
        return np.concatenate([inside, outside[self._moved(queries[outside], 8.0 * tol) >= 0]])

    def _moved(self, queries: FloatArray, share: float) -> IntArray:
        """Triangles of queries that are moved a share of their way to the centroid, all of it at most."""
        moved = (1.0 - min(share, 1.0)) * queries + min(share, 1.0) * self._centroid
        return np.asarray(self._triangulation.find_simplex(moved))

    def _with_neighbors(self, near: list[IntArray]) -> IntArray:
        """Columns of triangles, -1 for none, and of their neighbors, (k, 4c), filled up with what there is."""
        # Where there is no triangle there are no neighbours; its places are taken by some other candidate of the row.
        columns = np.column_stack(near)
        beside = np.where(columns[:, :, None] < 0, -1, self._triangulation.neighbors[columns])
        around = np.concatenate([columns, beside.reshape(len(columns), -1)], axis=1)
        return np.where(around < 0, around.max(axis=1, keepdims=True), around)

    def _first_holding(self, queries: FloatArray, candidates: IntArray, otherwise: IntArray, tol: float) -> IntArray:
        """The first of the candidates (k, c) or (1, c) that holds each query (k, 2)."""
        # The first column that holds: argmax finds the first True, and any tells whether there is one.
        lowest = np.where(self._beside_degenerate[candidates], -np.sqrt(tol), -tol)
        holds = np.all(coordinates(self._transform[candidates], queries[:, None]) >= lowest, axis=-1)
        first = holds.argmax(axis=1)
        chosen = np.take_along_axis(np.broadcast_to(candidates, holds.shape), first[:, None], axis=1)[:, 0]
        return np.where(holds.any(axis=1), chosen, otherwise)

    @cached_property
    def _centroid(self) -> FloatArray:
        """Centroid of the hull's area, (2,)."""
        points = self._triangulation.points
        size = np.frexp(np.abs(points).max())[1] + 1
        corners = np.ldexp(points, -size)[self._triangulation.simplices]
        d, e = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        areas = np.abs(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
        return np.ldexp(areas / areas.sum() @ corners.mean(axis=1), size)

    @cached_property
    def _beside_degenerate(self) -> BoolArray:
        """Whether there is a degenerate triangle opposite each corner, (m, 3)."""
        neighbors = self._triangulation.neighbors
        return self._degenerate[neighbors] & (neighbors >= 0)


def coordinates(transform: FloatArray, points: FloatArray) -> FloatArray:
    """Barycentric coordinates (..., 3) of points (..., 2) by maps (..., 3, 2)."""
    with np.errstate(over="ignore", invalid="ignore"):  # what is that far away is in no triangle
        first = np.einsum("...ij,...j->...i", transform[..., :2, :], points - transform[..., 2, :])
    return np.concatenate([first, 1.0 - first.sum(axis=-1, keepdims=True)], axis=-1)
