"""The combinatorics of Voronoi diagrams, common to plane and sphere. Integers only."""

from __future__ import annotations

import copy
from functools import cached_property
from itertools import pairwise
from typing import ClassVar, Final, Generic, TypeVar, cast

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray, locked
from stereodel._notebook import Displayed
from stereodel._spaces import SPHERE, PlaneOrSphere
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import Triangulation, state_of, threads_of

_Mesh = TypeVar("_Mesh", bound=Triangulation)

FAMILY: Final = {
    "flat_regions": """
        region_indices, region_offsets : arrays of int
            The same as flat arrays: cell i is ``region_indices[region_offsets[i]:region_offsets[i + 1]]``.
        """,
    "ridge_points": """
        ridge_points : (r, 2) array of int32
            Sites i < j on both sides of each ridge, in lexicographic order.
        """,
    "numbers": """
        point_region : (n,) array of int32
            Region of each point; for a duplicate, that of the kept point.
        simplex_vertex : (m,) array of int32
            Voronoi vertex of each Delaunay triangle.
        is_kept : (n,) array of bool
            Whether a point has a cell of its own and is not a dropped duplicate.
        surface : object
            The plane or the sphere; its `name` is "plane" or "sphere".
        """,
}
"""What the docstrings of both diagrams have in common."""


class Diagram(Generic[_Mesh], Displayed):
    """The common part of planar and spherical Voronoi diagrams: cells, ridges and vertices as read-only arrays.

    The cell of a site is a range of entries: its vertices counterclockwise from the lowest, and beside each the site
    beyond the ridge that leaves it. Ridges and polygons are read off these in O(n).
    """

    surface: ClassVar[PlaneOrSphere]

    _mimes = "stereodel.drawing.scene.diagrams"
    points: FloatArray
    vertices: FloatArray
    region_indices: IntArray
    region_offsets: Indices
    region_neighbors: IntArray
    point_region: IntArray
    simplex_vertex: IntArray
    latitude: Latitude | None = None
    _order: IntArray  # of sites with cells, along the curve of the triangles
    _rank: IntArray | None  # of triangles that share a vertex, by their corners
    _threads: int
    _dimension: int

    def __init_subclass__(cls, *, surface: PlaneOrSphere | None = None) -> None:
        super().__init_subclass__()
        if surface is not None:
            cls.surface, surface.voronoi = surface, cls

    def __init__(self, points: npt.ArrayLike | _Mesh, *, workers: int | None = None) -> None:
        kind = self.surface.delaunay
        if given := isinstance(points, kind):
            triangulation = copy.copy(cast("_Mesh", points))
        else:
            checked = self.surface.as_points(cast("npt.ArrayLike", points), f"{type(self).__name__}.from_lonlat")
            triangulation = kind(checked, workers=workers)
        self.points, self.latitude = triangulation.points, triangulation.latitude
        self._dimension = triangulation.dimension
        self._threads = threads_of(triangulation, workers if given else None)
        region = np.arange(len(self.points), dtype=np.int32)
        region[triangulation.duplicates[:, 0]] = triangulation.duplicates[:, 1]
        self.point_region = locked(region)
        if self._dimension == 2:
            vertices = self._set_diagram(triangulation)
        else:
            self._order, self.simplex_vertex = state_of(triangulation).flat_order, locked(np.zeros(0, dtype=np.int32))
            vertices = self._set_flat()
        if self.surface is SPHERE and len(vertices) == 2:
            vertices[1] = 0.0 - vertices[0]
        self.vertices = locked(vertices)

    def _set_flat(self) -> FloatArray:
        """Cells of points without triangles, in the order along their line or great circle; returns the vertices."""
        raise NotImplementedError

    @cached_property
    def regions(self) -> list[list[int]]:
        """Vertices of each cell, counterclockwise (on the sphere: seen from outside); empty for duplicates."""
        members, ends = self.region_indices.tolist(), self.region_offsets.tolist()
        return [members[a:b] for a, b in pairwise(ends)]

    @property
    def ridge_points(self) -> IntArray:
        """Sites i < j on both sides of each ridge, (r, 2) int32, in lexicographic order."""
        return self._ridges[0]

    @property
    def ridge_vertices(self) -> IntArray:
        """Start and end of each ridge, (r, 2) int32, with site i on its left; -1 at infinity."""
        return self._ridges[1]

    @cached_property
    def _ridges(self) -> tuple[IntArray, IntArray]:
        points, vertices = _kernel.voronoi_ridges(*self._cells(), self._threads)
        return locked(points), locked(vertices)

    def _set_diagram(self, triangulation: _Mesh) -> FloatArray:
        """Cells, and which triangle has which vertex; returns the vertices."""
        space, points = self.surface.kernel, self.points
        arrays = points, triangulation.simplices, triangulation.neighbors
        made = space.voronoi(*arrays, self._threads, True)
        offsets, vertices, neighbors, self._order, simplex_vertex, self._rank, sites, vertex = made
        self._set_cells(offsets, vertices, neighbors)
        self.simplex_vertex = locked(simplex_vertex)
        if sites is None:
            return space.circumcenters(points, triangulation.simplices, simplex_vertex, self._threads, True)
        return space.circumcenters(points, sites, vertex, self._threads, True)

    def _cell_areas(self) -> FloatArray:
        return self.surface.kernel.cell_areas(self.points, *self._cells(), self._order, self._threads, True)

    def _cell_centroids(self) -> FloatArray:
        return self.surface.kernel.cell_centroids(self.points, *self._cells(), self._order, self._threads, True)

    def delaunay(self) -> _Mesh:
        """The triangulation, from the topology of the diagram alone, in O(n).

        The sites around a vertex are a triangle, or a polygon whose diagonals the tie rule draws: the first point is
        cut off as an ear. Equal to the direct triangulation, row by row: `simplex_vertex` belongs to its `simplices`.
        """
        if self._dimension < 2:
            triangulation = self.surface.delaunay(self.points)
        else:
            rows = self.simplex_vertex, self._rank
            simplices = self.surface.kernel.delaunay_of(self.points, *self._cells(), *rows, self._threads)
            dropped = np.flatnonzero(~self.is_kept)
            duplicates = np.column_stack([dropped, self.point_region[dropped]]).astype(np.int32)
            triangulation = self.surface.delaunay._from_simplices(self.points, simplices, duplicates)
        triangulation._latitude = self.latitude
        return cast("_Mesh", triangulation)

    def _cells(self) -> tuple[Indices, IntArray, IntArray, int]:
        """The diagram as the kernel takes it."""
        return self.region_offsets, self.region_indices, self.region_neighbors, len(self.vertices)

    def _set_cells(self, offsets: Indices, vertices: IntArray, neighbors: IntArray) -> None:
        self.region_offsets, self.region_indices = locked(offsets), locked(vertices)
        self.region_neighbors = locked(neighbors)

    @property
    def is_kept(self) -> BoolArray:
        """Whether a point has a cell of its own and is not a dropped duplicate, (n,) bool."""
        return self.point_region == np.arange(len(self.points))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self.points)} points, {len(self.vertices)} vertices)"


def polygons(offsets: Indices, vertices: IntArray, neighbors: IntArray, count: int) -> list[list[int]]:
    """Sites around each of `count` vertices, counterclockwise from the lowest one."""
    ends, sites = (array.tolist() for array in _kernel.voronoi_polygons(offsets, vertices, neighbors, count))
    return [sites[a:b] for a, b in pairwise(ends)]
