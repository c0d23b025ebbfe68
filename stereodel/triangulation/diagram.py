"""The combinatorics of Voronoi diagrams, common to plane and sphere. Integers only."""

from __future__ import annotations

from functools import cached_property
from itertools import pairwise
from typing import Final

import numpy as np

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, Indices, IntArray, locked
from stereodel._spaces import space_of
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import Delaunay

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
        """,
}
"""What the docstrings of both diagrams have in common."""


class Diagram:
    """The common part of planar and spherical Voronoi diagrams: cells, ridges and vertices as read-only arrays.

    The cell of a site is a range of entries: its vertices counterclockwise from the lowest, and beside each the site
    beyond the ridge that leaves it. Ridges and polygons are read off these in O(n).
    """

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

    def _set_diagram(self, triangulation: Delaunay) -> FloatArray:
        """Cells, and which triangle has which vertex; returns the vertices."""
        space, points = space_of(self.points), self.points
        arrays = points, triangulation.simplices, triangulation.neighbors
        made = space.voronoi(*arrays, self._threads, True)
        offsets, vertices, neighbors, self._order, simplex_vertex, self._rank, sites, vertex = made
        self._set_cells(offsets, vertices, neighbors)
        self.simplex_vertex = locked(simplex_vertex)
        if sites is None:
            return space.circumcenters(points, triangulation.simplices, simplex_vertex, self._threads, True)
        return space.circumcenters(points, sites, vertex, self._threads, True)

    def _cell_areas(self) -> FloatArray:
        return space_of(self.points).cell_areas(self.points, *self._cells(), self._order, self._threads, True)

    def _cell_centroids(self) -> FloatArray:
        return space_of(self.points).cell_centroids(self.points, *self._cells(), self._order, self._threads, True)

    def _simplices(self) -> IntArray:
        """The triangles, from the topology of the diagram."""
        rows = self.simplex_vertex, self._rank
        return space_of(self.points).delaunay_of(self.points, *self._cells(), *rows, self._threads)

    def _cells(self) -> tuple[Indices, IntArray, IntArray, int]:
        """The diagram as the kernel takes it."""
        return self.region_offsets, self.region_indices, self.region_neighbors, len(self.vertices)

    def _set_cells(self, offsets: Indices, vertices: IntArray, neighbors: IntArray) -> None:
        self.region_offsets, self.region_indices = locked(offsets), locked(vertices)
        self.region_neighbors = locked(neighbors)

    def _set_point_region(self, duplicates: IntArray) -> None:
        region = np.arange(len(self.points), dtype=np.int32)
        region[duplicates[:, 0]] = duplicates[:, 1]
        self.point_region = locked(region)

    @property
    def is_kept(self) -> BoolArray:
        """Whether a point has a cell of its own and is not a dropped duplicate, (n,) bool."""
        return self.point_region == np.arange(len(self.points))

    def _duplicates(self) -> IntArray:
        """Pairs [dropped, kept] of equal points, (k, 2)."""
        dropped = np.flatnonzero(~self.is_kept)
        return np.column_stack([dropped, self.point_region[dropped]]).astype(np.int32)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({len(self.points)} points, {len(self.vertices)} vertices)"


def polygons(offsets: Indices, vertices: IntArray, neighbors: IntArray, count: int) -> list[list[int]]:
    """Sites around each of `count` vertices, counterclockwise from the lowest one."""
    ends, sites = (array.tolist() for array in _kernel.voronoi_polygons(offsets, vertices, neighbors, count))
    return [sites[a:b] for a, b in pairwise(ends)]
