"""What a triangulation of the sphere has in common with that of the plane (Theorem 1 of the paper, row P7)."""

from __future__ import annotations

import copy

import numpy as np
import numpy.typing as npt

from stereodel._arrays import IntArray, as_directions
from stereodel.predicates import in_bubble
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay


def planar_part(triangulation: SphericalDelaunay, pole: npt.ArrayLike) -> IntArray:
    """The facets of the hull that are triangles of the plane after stereographic projection from `pole`.

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
