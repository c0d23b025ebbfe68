"""The Gabriel graph."""

from __future__ import annotations

import numpy.typing as npt

from stereodel._arrays import IntArray, locked
from stereodel.graphs.proximity import proximity_edges
from stereodel.triangulation.given import Triangulation, as_triangulation


def gabriel_graph(points: npt.ArrayLike | Triangulation, *, workers: int | None = None) -> IntArray:
    """Edges whose diametral circle holds no other point, neither inside nor on it.

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
    The diametral circle of an edge ab has it as diameter; on the sphere it is the smallest circle through a and b, and
    holds p exactly if (â − p̂)·(b̂ − p̂) ≤ 0. Opposite directions have none and are joined only if they are the only
    ones. The disk is closed: a point on the circle forbids the edge, so a square has its sides and no diagonal. Hence
    the graph is a part of every Delaunay triangulation of the points, however ties are decided, and no order of the
    points changes it. Dropped duplicates have no edges. All decisions are those of exact arithmetic on the given
    doubles.

    Source: K. Gabriel, R. Sokal, "A new statistical approach to geographic variation analysis" (1969); D. Matula,
    R. Sokal, "Properties of Gabriel graphs relevant to geographic variation research and the clustering of points in
    the plane" (1980): of a Delaunay edge the opposite corners alone decide.

    Examples
    --------
    >>> from stereodel.graphs import gabriel_graph
    >>> gabriel_graph([[0, 0], [2, 0], [2, 2], [0, 2]]).tolist()
    [[0, 1], [0, 3], [1, 2], [2, 3]]
    >>> gabriel_graph([[0, 0], [3, 0], [0, 4]]).tolist()
    [[0, 1], [0, 2]]
    """
    return locked(proximity_edges(as_triangulation(points), "gabriel", workers))
