"""What `plane` and `sphere` have in common, for points (n, 2) and for directions (n, 3)."""

from typing import Protocol

import numpy
from numpy.typing import NDArray

class Mesh(Protocol):
    def insert(self, points: NDArray[numpy.float64], workers: int = 1, anew: int = 0) -> int: ...
    def remove(self, indices: NDArray[numpy.int32], workers: int = 1, anew: int = 0) -> NDArray[numpy.int32]: ...
    def read(self, workers: int = 1) -> tuple: ...
    @property
    def changes(self) -> int: ...
    @property
    def size(self) -> int: ...

class Space(Protocol):
    @property
    def stages(self) -> tuple[str, ...]: ...
    def Mesh(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        duplicates: NDArray[numpy.int32] | None = None,
        inconclusive: dict | None = None,
        checked: bool = False,
    ) -> Mesh: ...
    def triangulate(self, points: NDArray[numpy.float64], workers: int = 1, neighbors: bool = True) -> tuple: ...
    def proximity(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        graph: str,
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.int32]: ...
    def spanning_tree(self, points: NDArray[numpy.float64], edges: NDArray[numpy.int32]) -> NDArray[numpy.int32]: ...
    def compare_lengths(self, points: NDArray[numpy.float64], numbers: NDArray[numpy.int32]) -> NDArray[numpy.int8]: ...
    def diametral(self, points: NDArray[numpy.float64], numbers: NDArray[numpy.int32]) -> NDArray[numpy.int8]: ...
    def find_simplex(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        queries: NDArray[numpy.float64],
        closing: NDArray[numpy.bool_] | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.int32]: ...
    def nearest(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        queries: NDArray[numpy.float64],
        closing: NDArray[numpy.bool_] | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.int32]: ...
    def k_nearest(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        duplicates: NDArray[numpy.int32],
        queries: NDArray[numpy.float64],
        k: int,
        closing: NDArray[numpy.bool_] | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.int32]: ...
    def nearest_flat(
        self,
        points: NDArray[numpy.float64],
        order: NDArray[numpy.int32],
        duplicates: NDArray[numpy.int32],
        queries: NDArray[numpy.float64],
        k: int,
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.int32]: ...
    def part_of(
        self, points: NDArray[numpy.float64], axis: NDArray[numpy.int32], value: NDArray[numpy.float64]
    ) -> NDArray[numpy.int32]: ...
    def blocks(self, points: NDArray[numpy.float64], size: int) -> tuple: ...
    def box_tree(self, lows: NDArray[numpy.float64], highs: NDArray[numpy.float64]) -> tuple: ...
    def near_blocks(
        self,
        chosen: NDArray[numpy.bool_],
        reach: float,
        lows: NDArray[numpy.float64],
        highs: NDArray[numpy.float64],
        first: NDArray[numpy.int64],
        unread: NDArray[numpy.int32],
    ) -> NDArray[numpy.bool_]: ...
    def open_bubbles(
        self,
        points: NDArray[numpy.float64],
        faces: NDArray[numpy.int32],
        lows: NDArray[numpy.float64],
        highs: NDArray[numpy.float64],
        first: NDArray[numpy.int64],
        unread: NDArray[numpy.int32],
        wanted: NDArray[numpy.bool_] | None = None,
    ) -> tuple: ...
    def open_discs(
        self,
        centers: NDArray[numpy.float64],
        rims: NDArray[numpy.float64],
        lows: NDArray[numpy.float64],
        highs: NDArray[numpy.float64],
        first: NDArray[numpy.int64],
        unread: NDArray[numpy.int32],
    ) -> tuple: ...
    def open_targets(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        queries: NDArray[numpy.float64],
        lows: NDArray[numpy.float64],
        highs: NDArray[numpy.float64],
        first: NDArray[numpy.int64],
        unread: NDArray[numpy.int32],
        closing: NDArray[numpy.bool_] | None = None,
        natural: bool = False,
        checked: bool = False,
    ) -> tuple: ...
    def final_cells(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        duplicates: NDArray[numpy.int32],
        ids: NDArray[numpy.int64],
        rows: NDArray[numpy.int32],
        checked: bool = False,
    ) -> tuple: ...
    def final_triangles(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        duplicates: NDArray[numpy.int32],
        ids: NDArray[numpy.int64],
        final: NDArray[numpy.bool_],
    ) -> tuple: ...
    def turn(
        self, a: NDArray[numpy.float64], b: NDArray[numpy.float64], c: NDArray[numpy.float64], workers: int = 1
    ) -> NDArray[numpy.int8]: ...
    def voronoi(
        self,
        points: NDArray[numpy.float64],
        simplices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        workers: int = 1,
        checked: bool = False,
    ) -> tuple: ...
    def delaunay_of(
        self,
        points: NDArray[numpy.float64],
        offsets: NDArray[numpy.int64],
        vertices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        vertex_count: int,
        simplex_vertex: NDArray[numpy.int32],
        rank: NDArray[numpy.int32] | None = None,
        workers: int = 1,
    ) -> NDArray[numpy.int32]: ...
    def circumcenters(
        self,
        points: NDArray[numpy.float64],
        triangles: NDArray[numpy.int32],
        place: NDArray[numpy.int32] | None = None,
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.float64]: ...
    def flat_order(self, points: NDArray[numpy.float64], checked: bool = False) -> NDArray[numpy.int32]: ...
    def flat_diagram(self, points: NDArray[numpy.float64], order: NDArray[numpy.int32]) -> tuple: ...
    def cell_areas(
        self,
        points: NDArray[numpy.float64],
        offsets: NDArray[numpy.int64],
        vertices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        vertex_count: int,
        order: NDArray[numpy.int32],
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.float64]: ...
    def cell_centroids(
        self,
        points: NDArray[numpy.float64],
        offsets: NDArray[numpy.int64],
        vertices: NDArray[numpy.int32],
        neighbors: NDArray[numpy.int32],
        vertex_count: int,
        order: NDArray[numpy.int32],
        workers: int = 1,
        checked: bool = False,
    ) -> NDArray[numpy.float64]: ...
