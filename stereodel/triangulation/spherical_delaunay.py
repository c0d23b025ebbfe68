"""Delaunay triangulation of the sphere: the convex hull of directions, exact on rays (row P2 of the ledger)."""

from __future__ import annotations

import copy
from typing import cast

import numpy as np
import numpy.typing as npt

from stereodel._arrays import BoolArray, FloatArray, IntArray, as_directions
from stereodel._docs import by_name, shared
from stereodel._spaces import SPHERE
from stereodel.predicates import in_bubble
from stereodel.sphere.coordinates import IN_ROWS, LONLAT, as_sites, as_told
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import FAMILY, Triangulation


@shared(**FAMILY)
class SphericalDelaunay(Triangulation, surface=SPHERE):
    """Delaunay triangulation of points on the sphere: the outer bubble of each triangle is empty.

    Parameters
    ----------
    points : (n, 3) array_like
        Directions: non-zero vectors of any length. Copied.
    {options}

    Attributes
    ----------
    points : (n, 3) array
        As given, not normalised.
    simplices : (m, 3) array of int32
        Facets of the hull, m = 2n − 4 for n distinct points; counterclockwise seen from outside the hull, smallest
        index first; rows along a space-filling curve, so that consecutive facets are mostly close to one
        another.
    neighbors : (m, 3) array of int32
        `neighbors[i, k]` is the facet opposite corner k of facet i.
    convex_hull : (h, 2) array of int32
        Directed edges between facets that are not closing, on the left, and closing ones, in lexicographic order.
    {edges}
    circumcenters : (m, 3) array
        Unit vectors to the centres of the empty bubbles.
    duplicates : (k, 2) array of int32
        Pairs [dropped, kept] of points with exactly the same direction; the lowest index is kept, and is the one in
        `simplices`.
    dimension : int
        -1 without points, 0 for one, 1 if all lie on one great circle, 2 otherwise. Below 2 there are no simplices.
    inconclusive : dict
        How many tests each stage left open: "filter" (projected doubles), "curvature" (the form of row P6),
        "double_double", and "exact": exactly zero, decided by the tie rule.

    Raises
    ------
    ValueError, TypeError
        For values that are not finite real numbers, zero vectors, or other shapes; the message names the entry.

    Notes
    -----
    The result is that of exact arithmetic on the rays through the given doubles, square roots included. The paper's
    "smaller bubble is empty" holds unless all points lie in a hemisphere: then the closing facets have empty bubbles
    larger than a hemisphere. Points of one circle are triangulated as if the first of them in the order of their
    directions (x̂, then ŷ, then ẑ) were moved a little outward: a rule on points, so that no order of input changes the
    triangles. `find_simplex` finds triangles that are not closing.

    {changes}

    Source: the paper's one idea, stereographic projection keeps circles (rows P2, P7, P8): divide and conquer in the
    plane by L. Guibas and J. Stolfi (1985), every sign decided on the rays; insertion as in the paper's pseudo-code
    (row P14). `HullInsertion` is the readable form.

    Examples
    --------
    >>> octahedron = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    >>> triangulation = SphericalDelaunay(octahedron)
    >>> print(triangulation.simplices[triangulation.find_simplex([1, 2, 3])])
    [0 1 4]
    >>> triangulation.nearest([1, 2, 3])
    4
    >>> SphericalDelaunay(octahedron[:2] + octahedron[4:5]).closing.tolist()
    [False, True]
    """

    @classmethod
    @by_name(IN_ROWS)
    @shared(**LONLAT)
    def from_lonlat(
        cls,
        lonlat: npt.ArrayLike,
        *,
        latitude: Latitude = "spherical",
        workers: int | None = None,
        neighbors: bool = True,
    ) -> SphericalDelaunay:
        """Triangulate points given by longitude and latitude; queries and results may then use them too.

        Parameters
        ----------
        {lonlat}
        {latitude}
        workers, neighbors
            As for the constructor.

        Returns
        -------
        SphericalDelaunay
            Triangulation of the unit vectors from `lonlat_to_xyz`, which are then taken as exact.

        {lonlat_raises}

        Examples
        --------
        >>> print(SphericalDelaunay.from_lonlat([[0, 0], [90, 0], [7, 90], [180, 0], [-180, 0]]).duplicates)
        [[4 3]]
        >>> stations = SphericalDelaunay.from_lonlat([[2.3, 48.9], [13.4, 52.5], [12.5, 41.9]], latitude="geodetic")
        >>> stations.nearest(lonlat=[[9.2, 45.5], [10.0, 53.6]]).tolist(), stations.find_simplex(lonlat=[9.2, 47.4])
        ([2, 1], 0)
        >>> print(stations.lonlat)
        [[ 2.3 48.9]
         [13.4 52.5]
         [12.5 41.9]]
        """
        xyz, kind = as_sites(None, lonlat, latitude)
        self = cls(xyz, workers=workers, neighbors=neighbors)
        self._latitude = kind
        return self

    @property
    def lonlat(self) -> FloatArray:
        """Longitude and latitude of `points`, (n, 2) in degrees, if the points were given by them."""
        return as_told(self.points, self.latitude)

    @property
    def circumcenters_lonlat(self) -> FloatArray:
        """Longitude and latitude of `circumcenters`, (m, 2) in degrees, if the points were given by them."""
        return as_told(self.circumcenters, self.latitude)

    @property
    def closing(self) -> BoolArray:
        """Facets with det[a, b, c] ≤ 0, (m,): their empty bubble is a hemisphere or more; no spherical triangles.

        They exist if and only if all points lie in a closed hemisphere.
        """
        return cast("BoolArray", self._now().closing)


def planar_part(triangulation: SphericalDelaunay, pole: npt.ArrayLike) -> IntArray:
    """The facets of the hull that are triangles of the plane after stereographic projection from `pole`.

    They are what it has in common with the triangulation of the plane: Theorem 1 of the paper, row P7.

    Parameters
    ----------
    triangulation : SphericalDelaunay
    pole : (3,) array_like
        Direction of the projection pole. It may be one of the points: then its star is left out.

    Returns
    -------
    (k, 3) array of int32
        The simplices whose closed bubble does not contain the pole: in_bubble(a, b, c, pole) < 0.

    Examples
    --------
    >>> octahedron = SphericalDelaunay([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    >>> len(planar_part(octahedron, [1, 1, -1])), len(planar_part(octahedron, [0, 0, -1]))
    (7, 4)
    """
    triangulation = copy.copy(triangulation)  # as it is now, whatever other threads do
    corners = triangulation.points[triangulation.simplices]
    direction = as_directions(pole, "pole")
    outside = np.asarray(in_bubble(corners[:, 0], corners[:, 1], corners[:, 2], direction)) < 0
    return triangulation.simplices[outside]
