"""Barycentric coordinates in all triangles at once, and the triangles that hold a point up to a tolerance."""

from __future__ import annotations

import numpy as np

from stereodel._arrays import FloatArray, IntArray
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

    def __init__(self, triangulation: PlanarDelaunay) -> None:
        points, simplices, neighbors = triangulation.points, triangulation.simplices, triangulation.neighbors
        self._triangulation = triangulation
        self._transform = transforms(points[simplices])
        self._degenerate = np.isnan(self._transform[:, 0, 0])
        if len(simplices):
            self._beside_degenerate = self._degenerate[neighbors] & (neighbors >= 0)
            size = np.frexp(np.abs(points).max())[1] + 1
            corners = np.ldexp(points, -size)[simplices]
            d, e = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
            areas = np.abs(d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0])
            self._centroid = np.ldexp(areas / areas.sum() @ corners.mean(axis=1), size)

    def improve(self, queries: FloatArray, found: IntArray, tol: float) -> IntArray:
        """Replace exact answers (k,), -1 outside, by triangles that hold the queries (k, 2) within `tol`.

        A triangle that is not degenerate holds what has no barycentric coordinate below -tol; towards a degenerate
        neighbour, below -√tol. Asked are the triangles of the query moved by 8·tol, by less, so that a larger `tol`
        loses nothing, and by 8·√tol, which is beyond degenerate triangles, and their neighbors. Where none does the
        exact answer stays.
        """
        if not len(self._transform):
            return found
        doubtful = self._degenerate[found] & (found >= 0)
        outside = np.flatnonzero(found < 0)
        doubtful[outside] = self._moved(queries[outside], 8.0 * tol) >= 0
        asked = queries[doubtful]
        shares = 0.0, 8.0 * min(tol, INSIDE_TOLERANCE), 8.0 * tol, 8.0 * np.sqrt(tol)
        near = np.column_stack([self._moved(asked, share) for share in shares])
        beside = np.where(near[:, :, None] < 0, -1, self._triangulation.neighbors[near])
        candidates = np.concatenate([near, beside.reshape(-1, 12)], axis=1)
        # Where there is no triangle its place is taken by another candidate of the row.
        candidates = np.where(candidates < 0, candidates.max(axis=1, keepdims=True), candidates)
        lowest = np.where(self._beside_degenerate[candidates], -np.sqrt(tol), -tol)
        holds = np.all(coordinates(self._transform[candidates], asked[:, None]) >= lowest, axis=-1)
        # argmax finds the first that holds, and any tells whether there is one.
        first = np.take_along_axis(candidates, holds.argmax(axis=1)[:, None], axis=1)[:, 0]
        result = found.copy()
        result[doubtful] = np.where(holds.any(axis=1), first, found[doubtful])
        return result

    def _moved(self, queries: FloatArray, share: float) -> IntArray:
        """Triangles of queries that are moved a share of their way to the centroid, all of it at most."""
        moved = (1.0 - min(share, 1.0)) * queries + min(share, 1.0) * self._centroid
        return np.asarray(self._triangulation.find_simplex(moved))


def coordinates(transform: FloatArray, points: FloatArray) -> FloatArray:
    """Barycentric coordinates (..., 3) of points (..., 2) by maps (..., 3, 2)."""
    with np.errstate(over="ignore", invalid="ignore"):  # what is that far away is in no triangle
        first = np.einsum("...ij,...j->...i", transform[..., :2, :], points - transform[..., 2, :])
    return np.concatenate([first, 1.0 - first.sum(axis=-1, keepdims=True)], axis=-1)
