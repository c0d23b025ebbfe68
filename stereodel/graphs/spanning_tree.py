"""The minimum spanning tree."""

from __future__ import annotations

import numpy.typing as npt

from stereodel._arrays import IntArray, locked
from stereodel._spaces import space_of
from stereodel.graphs.proximity import proximity_edges
from stereodel.triangulation.given import Triangulation, as_triangulation


def minimum_spanning_tree(points: npt.ArrayLike | Triangulation, *, workers: int | None = None) -> IntArray:
    """The tree of least total length that joins all points.

    Parameters
    ----------
    points : array_like (n, 2) or (n, 3), PlanarDelaunay or SphericalDelaunay
        Points of the plane, directions, or a triangulation of them.
    workers : int, optional
        Threads; -1 for all processors. By default those of the triangulation. Never changes the result.

    Returns
    -------
    (k - 1, 2) array of int32
        Edges i < j between k different points, in lexicographic order; read-only. None for fewer than two.

    Raises
    ------
    ValueError, TypeError
        For points that cannot be triangulated: see `PlanarDelaunay` and `SphericalDelaunay`.

    Notes
    -----
    Lengths are distances in the plane, angles on the sphere; any function of them that grows, as the chord, has the
    same tree. Edges are compared exactly, equally long ones by their ends: the one with the lexicographically lower
    first end comes first (on the sphere in the order of the unit vectors), then the one with the lower second end. So
    of several trees of the same length one is chosen by the points alone, and no order of the points changes it.
    Dropped duplicates have no edges.

    Source: J. Kruskal, "On the shortest spanning subtree of a graph and the traveling salesman problem" (1956), on the
    edges of the Urquhart graph, which holds every minimum spanning tree (M. Shamos, D. Hoey, "Closest-point problems",
    1975; G. Toussaint, 1980).

    Examples
    --------
    >>> from stereodel.graphs import minimum_spanning_tree
    >>> minimum_spanning_tree([[0, 0], [2, 0], [2, 1], [0, 1]]).tolist()
    [[0, 1], [0, 3], [1, 2]]
    """
    triangulation = as_triangulation(points)
    edges = proximity_edges(triangulation, "urquhart", workers)
    return locked(space_of(triangulation.points).spanning_tree(triangulation.points, edges))
