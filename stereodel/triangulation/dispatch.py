"""Points, or a triangulation of them: what functions on triangulations take."""

from __future__ import annotations

import copy

import numpy.typing as npt

from stereodel._arrays import BoolArray, IntArray, as_plane_or_sphere
from stereodel.triangulation.planar_delaunay import PlanarDelaunay
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay

Triangulation = PlanarDelaunay | SphericalDelaunay


def as_triangulation(points: npt.ArrayLike | Triangulation) -> Triangulation:
    """The triangulation given, as it is now, or that of points (n, 2) of the plane or of directions (n, 3)."""
    if isinstance(points, PlanarDelaunay | SphericalDelaunay):
        return copy.copy(points)
    array = as_plane_or_sphere(points)
    return SphericalDelaunay(array) if array.shape[1] == 3 else PlanarDelaunay(array)


def threads_of(triangulation: Triangulation, workers: int | None, size: int | None = None) -> int:
    """How many threads a task of `size` points takes, by default of all points; without `workers` as for the points."""
    return triangulation._thread_count(workers, size)


def flat_order(triangulation: Triangulation) -> IntArray:
    """Without triangles: the different points in the order along their line or great circle."""
    return triangulation._flat_order


def open_triangles(triangulation: Triangulation) -> BoolArray:
    """Whether a query can lie in a triangle, (m,): all but the closing ones of the sphere."""
    return triangulation._open
