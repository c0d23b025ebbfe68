"""Points, or a triangulation of them: what functions on triangulations take."""

from __future__ import annotations

import copy

import numpy.typing as npt

from stereodel._arrays import BoolArray, IntArray
from stereodel.sphere.latitudes import Latitude
from stereodel.sphere.lonlat import as_sites, refuse_lonlat
from stereodel.triangulation.planar_delaunay import PlanarDelaunay
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay

Triangulation = PlanarDelaunay | SphericalDelaunay


def as_triangulation(
    points: npt.ArrayLike | Triangulation | None,
    *,
    lonlat: npt.ArrayLike | None = None,
    latitude: Latitude | None = None,
) -> Triangulation:
    """The triangulation given, as it is now, or that of points of the plane, of directions, or of `lonlat`."""
    if isinstance(points, PlanarDelaunay | SphericalDelaunay):
        refuse_lonlat(lonlat, latitude)
        return copy.copy(points)
    array, kind = as_sites(points, lonlat, latitude)
    if array.shape[1] == 2:
        return PlanarDelaunay(array)
    triangulation = SphericalDelaunay(array)
    triangulation._latitude = kind
    return triangulation


def threads_of(triangulation: Triangulation, workers: int | None, size: int | None = None) -> int:
    """How many threads a task of `size` points takes, by default of all points; without `workers` as for the points."""
    return triangulation._thread_count(workers, size)


def flat_order(triangulation: Triangulation) -> IntArray:
    """Without triangles: the distinct points in the order along their line or great circle."""
    return triangulation._now().flat_order


def open_triangles(triangulation: Triangulation) -> BoolArray:
    """Whether a query can lie in a triangle, (m,): all but the closing ones of the sphere."""
    return triangulation._now().open
