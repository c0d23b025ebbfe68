"""Theorem 1 of the paper (row P7 of the ledger), checked exactly, for points whose lift to the sphere is exact.

The paper: a map that sends circles to circles and interiors to interiors keeps the Delaunay triangulation.
Stereographic projection sends interiors to interiors except for the bubbles that contain the projection pole, whose
images are the outsides of circles. So the triangulation of the plane is the hull of the lifted points *without* the
facets whose bubble contains the pole. The bubble counts as closed: points on a circle with the pole are collinear in
the plane. Equivalently: the hull of the lifted points and the pole, without the star of the pole. The two differ where
the lifted points lie on one great circle: their own hull has no facets, with the pole it has.
Both sides agree up to the diagonals of cocircular polygons; the polygons are compared.

The lift (x, y) → (2x, 2y, 1 − x² − y²)/(1 + x² + y²) would round. On rays its denominator does not matter, so that the
lift of a point is exact whenever 1 − x² − y² is a double: for at most 26 significant bits, for example.
"""

from __future__ import annotations

import copy

import numpy as np
import numpy.typing as npt

from stereodel import PlanarDelaunay, SphericalDelaunay
from stereodel._arrays import FloatArray, as_points
from stereodel._double_double import two_prod, two_sum
from stereodel.triangulation import planar_part
from stereodel.triangulation.diagram import polygons
from stereodel.triangulation.topology import neighbors_of

PROJECTION_POLE = (0.0, 0.0, -1.0)
"""The point of the sphere that `exact_lift` sends nothing to: the plane touches the opposite one."""

Polygons = frozenset[tuple[int, ...]]


def exact_lift(points: npt.ArrayLike) -> FloatArray:
    """Rays through the inverse stereographic images of points of the plane, without rounding.

    Parameters
    ----------
    points : (n, 2) array_like
        Coordinates in the plane that touches the sphere of diameter 1 at the north pole (row P8), or any multiple.

    Returns
    -------
    (n, 3) array
        (2x, 2y, 1 − x² − y²); the length is 1 + x² + y². Seen from outside, counterclockwise stays counterclockwise.

    Raises
    ------
    ValueError
        If 1 − x² − y² cannot be computed without rounding.

    Examples
    --------
    >>> print(exact_lift([[0, 0], [1, 0], [0.5, 2]]))
    [[ 0.    0.    1.  ]
     [ 2.    0.    0.  ]
     [ 1.    4.   -3.25]]
    """
    xy = as_points(points, 2)
    squares, lost = two_prod(xy, xy)
    total, lost_sum = two_sum(squares[:, 0], squares[:, 1])
    height, lost_height = two_sum(np.ones(len(xy)), -total)
    inexact = lost.any(axis=1) | (lost_sum != 0) | (lost_height != 0) | ((squares == 0) & (xy != 0)).any(axis=1)
    if inexact.any():
        k = int(np.argmax(inexact))
        raise ValueError(
            f"points[{k}] = {xy[k].tolist()} has no exact lift: 1 - x² - y² must be a double; "
            "scale the points to sizes near 1 and round them to 25 bits, e.g. with np.round(points * 2**20) / 2**20"
        )
    return np.column_stack([2 * xy, height])


def merged_polygons(
    triangulation: PlanarDelaunay | SphericalDelaunay, simplices: npt.ArrayLike | None = None
) -> Polygons:
    """The subdivision without the diagonals of cocircular polygons, which only the tie rule determines.

    Parameters
    ----------
    triangulation : PlanarDelaunay or SphericalDelaunay
    simplices : (k, 3) array_like of int, optional
        Some of its simplices, e.g. from `planar_part`; by default all.

    Returns
    -------
    frozenset of tuples of int
        Corners of each polygon, counterclockwise, beginning with the lowest.

    Examples
    --------
    >>> sorted(merged_polygons(PlanarDelaunay([[0, 0], [1, 0], [1, 1], [0, 1], [3, 0]])))
    [(0, 1, 2, 3), (1, 4, 2)]
    """
    triangulation = copy.copy(triangulation)  # as it is now, whatever other threads do
    chosen = triangulation.simplices if simplices is None else np.asarray(simplices, dtype=np.int32).reshape(-1, 3)
    if len(chosen) == 0:
        return frozenset()
    found = triangulation.surface.kernel.voronoi(triangulation.points, chosen, neighbors_of(chosen))
    offsets, vertices, across, _, vertex, *_ = found
    return frozenset(map(tuple, polygons(offsets, vertices, across, int(vertex.max()) + 1)))


def theorem_1_holds(points: npt.ArrayLike) -> bool:
    """Whether the triangulation of points in the plane is the planar part of the hull of their lift.

    Parameters
    ----------
    points : (n, 2) array_like
        With an exact lift (`exact_lift`).

    Returns
    -------
    bool
        True, according to the theorem. The merged polygons of the plane are compared with those of the planar part of
        two hulls: of the lift and the pole, and of the lift alone unless it lies on one great circle.

    Raises
    ------
    ValueError
        For points without an exact lift.

    Examples
    --------
    >>> theorem_1_holds([[0, 0], [3, 0], [2, 1], [0, 4], [-1, -2], [0.5, 0.25]])
    True
    """
    lift = exact_lift(points)
    expected = merged_polygons(PlanarDelaunay(points))
    alone, with_pole = SphericalDelaunay(lift), SphericalDelaunay(np.vstack([lift, PROJECTION_POLE]))
    hulls = [alone, with_pole] if alone.dimension == 2 else [with_pole]
    return all(merged_polygons(hull, planar_part(hull, PROJECTION_POLE)) == expected for hull in hulls)
