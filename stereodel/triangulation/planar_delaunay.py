"""Delaunay triangulation of the plane, exact (row P1 of the ledger)."""

from __future__ import annotations

import numpy.typing as npt

from stereodel._arrays import FloatArray, IntArray, as_points, as_vectors
from stereodel.triangulation.circumcenters import planar_circumcenters
from stereodel.triangulation.delaunay import Delaunay
from stereodel.triangulation.location import Side, nearest_in_plane, plane_side


class PlanarDelaunay(Delaunay):
    """Delaunay triangulation of points of the plane: no point lies inside a triangle's circle.

    Parameters
    ----------
    points : (n, 2) array_like
        Finite numbers of any size; y up. Copied.
    workers : int, optional
        Threads, at least 1. Never changes the result; this engine uses one.
    neighbors : bool, optional
        Whether to compute `neighbors` at once; otherwise when first asked for.

    Attributes
    ----------
    points : (n, 2) array
    simplices : (m, 3) array of int32
        Triangles, counterclockwise, smallest index first, rows in lexicographic order.
    neighbors : (m, 3) array of int32
        `neighbors[i, k]` is the triangle opposite corner k of triangle i; -1 where there is none.
    convex_hull : (h, 2) array of int32
        Directed edges of the hull, counterclockwise, in lexicographic order; points on the hull's sides split them.
    edges : (e, 2) array of int32
        Edges with i < j, in lexicographic order.
    circumcenters : (m, 2) array
        Centres of the triangles' circles, rounded from the exact ones.
    duplicates : (k, 2) array of int32
        Pairs [dropped, kept] of exactly equal points (-0 equals 0); the lowest index is kept, and is the one in
        `simplices`.
    dimension : int
        -1 without points, 0 for one, 1 if all are collinear, 2 otherwise. Below 2 there are no simplices.
    inconclusive : dict
        "filter": tests whose sign floating point left open and integers decided; "exact": those that were exactly zero
        and decided by the tie rule.

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, or other shapes; naming the entry.

    Notes
    -----
    The answer is that of exact arithmetic on the given doubles. Cocircular points are triangulated as if the first of
    them in lexicographic order were lifted a little above the paraboloid z = x² + y²: a rule on points, so that no
    order of input changes the triangles. Arrays are read-only; `insert` and `remove` replace them.

    Source: the paper's Theorem 1 and its pseudo-code, with the projection pole as a ghost vertex (rows P1, P7, P14).

    Examples
    --------
    >>> triangulation = PlanarDelaunay([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]])
    >>> triangulation.simplices.tolist()
    [[0, 1, 4], [0, 4, 3], [1, 2, 4], [2, 3, 4]]
    >>> triangulation.neighbors[0].tolist()
    [2, 1, -1]
    >>> triangulation.find_simplex([[1.5, 1], [1, 1], [3, 3]]).tolist()
    [2, 0, -1]
    """

    @staticmethod
    def _as_points(points: npt.ArrayLike) -> FloatArray:
        return as_points(points, 2)

    @staticmethod
    def _check_queries(queries: npt.ArrayLike) -> FloatArray:
        return as_vectors(queries, 2, "xy")

    @staticmethod
    def _places(points: FloatArray) -> FloatArray:
        return points

    @staticmethod
    def _circumcenters(triangles: FloatArray) -> FloatArray:
        return planar_circumcenters(triangles)

    @staticmethod
    def _nearest(points: FloatArray, queries: FloatArray) -> IntArray:
        return nearest_in_plane(points, queries)

    def _side(self, queries: FloatArray) -> Side:
        return plane_side(self.points, queries)
