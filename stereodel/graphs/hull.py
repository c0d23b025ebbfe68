"""The corners of the convex hull, in the plane and on the sphere."""

from __future__ import annotations

from typing import cast

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, IntArray, locked
from stereodel._spaces import space_of
from stereodel.graphs.proximity import Indices, short_steps
from stereodel.triangulation.given import Triangulation, as_triangulation
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay


def hull(points: npt.ArrayLike | Triangulation) -> IntArray:
    """Corners of the convex hull, counterclockwise.

    Parameters
    ----------
    points : array_like (n, 2) or (n, 3), PlanarDelaunay or SphericalDelaunay
        Points of the plane, directions, or a triangulation of them.

    Returns
    -------
    (h,) array of int32
        Indices of the corners, the smallest first, counterclockwise (seen from outside the sphere); read-only. One
        corner for one point, the two ends for points of a line or of an arc. On the sphere none if the points do not
        lie in an open hemisphere.

    Raises
    ------
    ValueError, TypeError
        For points that cannot be triangulated: see `PlanarDelaunay` and `SphericalDelaunay`.

    Notes
    -----
    The hull on the sphere is bounded by arcs of great circles; there is one if and only if the points lie in an open
    hemisphere. Points within a side are no corners, unlike the ends of the edges of `convex_hull`, which points split.
    A dropped duplicate is never a corner. All decisions are those of exact arithmetic on the given doubles.

    Examples
    --------
    >>> from stereodel import lonlat_to_xyz
    >>> from stereodel.graphs import hull
    >>> hull([[1, 0], [0, 0], [2, 0], [2, 2], [1, 1], [0, 2]]).tolist()
    [1, 2, 3, 5]
    >>> hull(lonlat_to_xyz([[0, 40], [20, 40], [20, 60], [10, 50], [0, 60]])).tolist()
    [0, 1, 2, 4]
    >>> hull([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]]).tolist()
    []
    """
    triangulation = as_triangulation(points)
    if triangulation.dimension == 2:
        return locked(_corners(triangulation))
    return locked(_ends(triangulation).astype(np.int32))


def _corners(triangulation: Triangulation) -> IntArray:
    if isinstance(triangulation, SphericalDelaunay) and not _in_open_hemisphere(triangulation):
        return np.zeros(0, dtype=np.int32)
    cycle = _cycle(triangulation.convex_hull)
    before, here, after = (triangulation.points[np.roll(cycle, shift)] for shift in (1, 0, -1))
    corners = cycle[space_of(triangulation.points).turn(before, here, after) != 0]
    return np.roll(corners, -int(np.argmin(corners)))


def _cycle(edges: IntArray) -> IntArray:
    """Directed edges, one from each vertex, as one cycle of vertices, (h,)."""
    after = dict(edges.tolist())
    cycle = [int(edges[0, 0])]
    while (vertex := after[cycle[-1]]) != cycle[0]:
        cycle.append(vertex)
    return np.array(cycle, dtype=np.int32)


def _in_open_hemisphere(triangulation: SphericalDelaunay) -> bool:
    """Whether the hull of the vectors' tips has a facet with the centre strictly on its outer side."""
    closing = triangulation.simplices[triangulation.closing]
    a, b, c = (triangulation.points[closing[:, k]] for k in range(3))
    return bool((_kernel.sphere.turn(a, b, c) < 0).any())


def _ends(triangulation: Triangulation) -> Indices:
    """The hull of points of one line or great circle."""
    order, points = triangulation._flat_order, triangulation.points
    if len(order) < 2:
        return order.copy()
    if isinstance(triangulation, SphericalDelaunay):
        return _ends_of_arc(points, order)
    return np.sort(order[[0, -1]])


def _ends_of_arc(points: FloatArray, circle: Indices) -> Indices:
    """The ends of the one step of more than a half-turn, if there is one."""
    none = np.zeros(0, dtype=np.int32)
    if len(circle) == 2:
        a, b = points[circle]
        return none if _are_opposite(a, b) else np.sort(circle)
    steps = short_steps(points, circle)
    if len(steps) != len(circle) - 1:
        return none
    ends = np.setxor1d(*steps.T)
    return none if _are_opposite(*points[ends]) else cast(Indices, ends)


def _are_opposite(a: FloatArray, b: FloatArray) -> bool:
    return bool(_kernel.sphere.compare(a[None], -b[None])[0] == 0)
