"""The Urquhart graph."""

from __future__ import annotations

import numpy.typing as npt

from stereodel._arrays import IntArray, locked
from stereodel.graphs.proximity import proximity_edges
from stereodel.triangulation.given import Triangulation, as_triangulation


def urquhart_graph(points: npt.ArrayLike | Triangulation, *, workers: int | None = None) -> IntArray:
    """Delaunay edges that are not strictly the longest edge of a triangle.

    Parameters
    ----------
    points : array_like (n, 2) or (n, 3), PlanarDelaunay or SphericalDelaunay
        Points of the plane, directions, or a triangulation of them.
    workers : int, optional
        Threads; -1 for all processors. By default those of the triangulation. Never changes the result.

    Returns
    -------
    (e, 2) array of int32
        Edges i < j, in lexicographic order; read-only.

    Raises
    ------
    ValueError, TypeError
        For points that cannot be triangulated: see `PlanarDelaunay` and `SphericalDelaunay`.

    Notes
    -----
    A triangle with two or three equally longest edges loses none of them: so the relative neighbourhood graph is always
    a part. All facets count on the sphere, those that are closing too. The graph depends on the triangulation where
    more than three points lie on one empty circle; their triangulation depends on the points alone, so no order of the
    points changes it. Without triangles it is the Gabriel graph. Dropped duplicates have no edges. All decisions are
    those of exact arithmetic on the given doubles.

    Source: R. Urquhart, "Algorithms for computation of relative neighbourhood graph" (1980): close to the relative
    neighbourhood graph, and found in linear time.

    Examples
    --------
    >>> from stereodel.graphs import urquhart_graph
    >>> urquhart_graph([[0, 0], [4, 0], [1, 2], [4, 3]]).tolist()
    [[0, 2], [1, 3], [2, 3]]
    """
    return locked(proximity_edges(as_triangulation(points), "urquhart", workers))
