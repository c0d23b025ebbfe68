"""The relative neighbourhood graph."""

from __future__ import annotations

import numpy.typing as npt

from stereodel._arrays import IntArray, locked
from stereodel.graphs.proximity import proximity_edges
from stereodel.triangulation.given import Triangulation, as_triangulation


def relative_neighborhood_graph(points: npt.ArrayLike | Triangulation, *, workers: int | None = None) -> IntArray:
    """Pairs of points without a third that is strictly nearer to both than they are to each other.

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
    Points that are equally near forbid nothing: an equilateral triangle has its three sides. Distances on the sphere
    are angles. The graph depends on the points alone. Dropped duplicates have no edges. All decisions are those of
    exact arithmetic on the given doubles.

    Source: G. Toussaint, "The relative neighbourhood graph of a finite planar set" (1980). It is looked for among the
    edges of the Urquhart graph. A third point in the lune of ab is reached from a along Delaunay edges between points
    that are nearer to a than b is, and from b alike; both searches go on in turn until one of them is through.

    Examples
    --------
    >>> from stereodel.graphs import relative_neighborhood_graph
    >>> relative_neighborhood_graph([[0, 0], [4, 0], [1, 2], [4, 3]]).tolist()
    [[0, 2], [1, 3], [2, 3]]
    """
    return locked(proximity_edges(as_triangulation(points), "relative", workers))
