"""Plane and sphere as spaces of the kernel: the same functions for points (n, 2) and for directions (n, 3).

Code that works on either chooses its space once, with ``space_of(points)``.
"""

from __future__ import annotations

from typing import Protocol

from stereodel import _kernel
from stereodel._arrays import BoolArray, FloatArray, IntArray, LongArray, SignArray

Triangulated = tuple[IntArray, IntArray | None, IntArray, int, dict[str, int]]
"""Simplices, neighbors or None, duplicates, dimension, inconclusive tests."""
Diagram = tuple[LongArray, IntArray, IntArray, IntArray, IntArray, IntArray | None, IntArray | None, IntArray | None]
"""Offsets of the cells, vertices and neighbors of their entries, sites along a curve, the vertex of each triangle;
where triangles share vertices its rank there, rows of three sites, and the vertex of each row."""


class Mesh(Protocol):
    """A triangulation that points can be added to and taken from; see the stub of the kernel."""

    @property
    def duplicates(self) -> IntArray: ...
    @property
    def is_flat(self) -> bool: ...
    @property
    def changes(self) -> int: ...
    @property
    def inconclusive(self) -> dict[str, int]: ...
    def insert(self, points: FloatArray) -> IntArray: ...
    def remove(self, indices: IntArray) -> IntArray: ...
    def arrays(self) -> tuple[IntArray, IntArray]: ...


class Space(Protocol):
    """The functions that `_kernel.plane` and `_kernel.sphere` have in common, as far as both are asked alike."""

    @property
    def stages(self) -> tuple[str, ...]: ...

    def Mesh(  # a class of the kernel
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        duplicates: IntArray | None = None,
        checked: bool = False,
    ) -> Mesh: ...
    def triangulate(self, points: FloatArray, workers: int = 1, neighbors: bool = True) -> Triangulated: ...
    def circumcenters(
        self,
        points: FloatArray,
        triangles: IntArray,
        place: IntArray | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> FloatArray: ...
    def flat_order(self, points: FloatArray, checked: bool = False) -> IntArray: ...
    def find_simplex(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        queries: FloatArray,
        closing: BoolArray | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> IntArray: ...
    def nearest(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        queries: FloatArray,
        closing: BoolArray | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> IntArray: ...
    def k_nearest(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        duplicates: IntArray,
        queries: FloatArray,
        k: int,
        closing: BoolArray | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> IntArray: ...
    def nearest_flat(
        self,
        points: FloatArray,
        order: IntArray,
        duplicates: IntArray,
        queries: FloatArray,
        k: int,
        workers: int = 1,
        checked: bool = False,
    ) -> IntArray: ...
    def voronoi(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        workers: int = 1,
        checked: bool = False,
    ) -> tuple[
        LongArray, IntArray, IntArray, IntArray, IntArray, IntArray | None, IntArray | None, IntArray | None
    ]: ...
    def delaunay_of(
        self,
        points: FloatArray,
        offsets: LongArray,
        vertices: IntArray,
        neighbors: IntArray,
        vertex_count: int,
        simplex_vertex: IntArray,
        rank: IntArray | None = None,
        workers: int = 1,
    ) -> IntArray: ...
    def cell_areas(
        self,
        points: FloatArray,
        offsets: LongArray,
        vertices: IntArray,
        neighbors: IntArray,
        vertex_count: int,
        order: IntArray,
        workers: int = 1,
        checked: bool = False,
    ) -> FloatArray: ...
    def cell_centroids(
        self,
        points: FloatArray,
        offsets: LongArray,
        vertices: IntArray,
        neighbors: IntArray,
        vertex_count: int,
        order: IntArray,
        workers: int = 1,
        checked: bool = False,
    ) -> FloatArray: ...
    def proximity(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        graph: str,
        workers: int = 1,
        checked: bool = False,
    ) -> IntArray: ...
    def spanning_tree(self, points: FloatArray, edges: IntArray) -> IntArray: ...
    def part_of(self, points: FloatArray, axis: IntArray, value: FloatArray) -> IntArray: ...
    def blocks(self, points: FloatArray, size: int) -> tuple[IntArray, LongArray, FloatArray, FloatArray]: ...
    def box_tree(self, lows: FloatArray, highs: FloatArray) -> tuple[FloatArray, FloatArray, LongArray]: ...
    def near_blocks(
        self,
        chosen: BoolArray,
        reach: float,
        lows: FloatArray,
        highs: FloatArray,
        first: LongArray,
        unread: IntArray,
    ) -> BoolArray: ...
    def open_bubbles(
        self,
        points: FloatArray,
        faces: IntArray,
        lows: FloatArray,
        highs: FloatArray,
        first: LongArray,
        unread: IntArray,
        wanted: BoolArray | None = None,
    ) -> tuple[BoolArray, FloatArray]: ...
    def open_discs(
        self,
        centers: FloatArray,
        rims: FloatArray,
        lows: FloatArray,
        highs: FloatArray,
        first: LongArray,
        unread: IntArray,
    ) -> tuple[BoolArray, FloatArray]: ...
    def open_targets(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        queries: FloatArray,
        lows: FloatArray,
        highs: FloatArray,
        first: LongArray,
        unread: IntArray,
        closing: BoolArray | None = None,
        natural: bool = False,
        checked: bool = False,
    ) -> tuple[BoolArray, FloatArray]: ...
    def final_cells(
        self,
        points: FloatArray,
        simplices: IntArray,
        neighbors: IntArray,
        duplicates: IntArray,
        ids: LongArray,
        rows: IntArray,
        checked: bool = False,
    ) -> tuple[LongArray, IntArray, FloatArray, LongArray, FloatArray]: ...
    def final_triangles(
        self,
        points: FloatArray,
        simplices: IntArray,
        duplicates: IntArray,
        ids: LongArray,
        final: BoolArray,
    ) -> tuple[LongArray, IntArray]: ...
    def turn(self, a: FloatArray, b: FloatArray, c: FloatArray, workers: int = 1) -> SignArray: ...


def space_of(points: FloatArray) -> Space:
    """The plane for points (n, 2), the sphere for directions (n, 3)."""
    return _kernel.plane if points.shape[1] == 2 else _kernel.sphere
