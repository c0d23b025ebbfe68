"""Plane and sphere, `PLANE` and `SPHERE`: what differs between them, for code that works on either.

Triangulations and diagrams hold one of the two as `surface`; for points alone it is ``surface_of(points)``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import FloatArray, as_directions, as_points, as_vectors
from stereodel.sphere.arcs import angular_distance, solid_angle

if TYPE_CHECKING:
    from stereodel._kernel.space import Space


class _Surface:
    """What both have, beside the methods of the plane.

    name: as arguments and tables have it.
    width: numbers that make a point: (n, 2), or directions (n, 3).
    kernel: the kernel's functions.
    delaunay, voronoi: the classes of triangulations and diagrams, which enter themselves.
    """

    name: ClassVar[str]
    width: ClassVar[int]
    kernel: Space
    delaunay: Any
    voronoi: Any

    def __reduce__(self) -> str:  # copies and pickles are the value itself
        return self.name.upper()


class _Plane(_Surface):
    name, width, kernel = "plane", 2, _kernel.plane

    def as_points(self, values: npt.ArrayLike, lonlat_door: str) -> FloatArray:
        """Checked points (n, width); the message about those of the plane names the door for longitude and latitude."""
        return as_points(values, 2, instead="triangulate directions by SphericalDelaunay")

    def as_queries(self, values: npt.ArrayLike) -> FloatArray:
        """Checked queries of any leading shape."""
        return as_vectors(values, 2, "queries", instead="the points of this object are of the plane")

    def distances(self, a: FloatArray, b: FloatArray) -> FloatArray:
        """Between points row by row; on the sphere in degrees."""
        return np.hypot(*np.moveaxis(b - a, -1, 0))

    def areas(self, a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        """Of triangles row by row, positive where counterclockwise; on the sphere in steradians."""
        (dx, dy), (ex, ey) = (b - a).T, (c - a).T
        return (dx * ey - dy * ex) / 2


class _Sphere(_Surface):
    name, width, kernel = "sphere", 3, _kernel.sphere
    distances, areas = staticmethod(angular_distance), staticmethod(solid_angle)

    def as_points(self, values: npt.ArrayLike, lonlat_door: str) -> FloatArray:
        return as_directions(values, "points", points=True, instead=f"for longitude and latitude use {lonlat_door}")

    def as_queries(self, values: npt.ArrayLike) -> FloatArray:
        return as_directions(values, "queries", instead="for longitude and latitude write lonlat=…")


PlaneOrSphere = _Plane | _Sphere
PLANE, SPHERE = _Plane(), _Sphere()


def surface_of(points: FloatArray) -> PlaneOrSphere:
    """The plane for points (n, 2), the sphere for directions (n, 3)."""
    return PLANE if points.shape[1] == 2 else SPHERE


def space_of(points: FloatArray) -> Space:
    """The kernel's functions for points (n, 2), or for directions (n, 3)."""
    return surface_of(points).kernel
