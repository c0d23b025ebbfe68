"""Points of the plane, (n, 2)."""

from typing import Annotated

import numpy
from numpy.typing import NDArray

stages: tuple = ("filter", "double_double", "exact")

def triangulate(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
    neighbors: bool = True,
) -> tuple:
    """
    Simplices, neighbors or None, duplicates, dimension and inconclusive tests.
    """

def proximity(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    graph: str,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
    """
    Edges of the graph "gabriel", "urquhart" or "relative" of a triangulation, sorted.
    """

def spanning_tree(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
    """
    The shortest forest among the edges, equally long ones in the order of their ends; sorted.
    """

def compare_lengths(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """
    Sign of |ab| - |cd| for rows a b c d of numbers; of angles between directions.
    """

def diametral(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """
    1 where p lies outside the circle with diameter ab, 0 on it, -1 inside, for rows a b p of numbers; 0 for opposite directions a and b.
    """

def natural_neighbors(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    values: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    gradients: bool = False,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, None, None), order="C")]:
    """
    Sibson's interpolant of values (n, k) at the queries, (m, 1, k), or its gradients, (m, 2, k).
    """

def natural_neighbor_weights(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> tuple:
    """
    Sibson's weights at the queries, row after row: offsets (m + 1,), points and their weights.
    """

def find_simplex(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    The lowest triangle that holds each query, -1 outside. closing: triangles that hold none. checked: the kernel made the arrays.
    """

def nearest(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    The nearest point of each query, the lowest of several. There must be simplices.
    """

def k_nearest(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    k: int,
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C")]:
    """
    The k nearest points of each query, duplicates among them, by distance, equally near ones by number.
    """

def nearest_flat(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    k: int,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C")]:
    """
    The same for points that are taken to lie on one line or great circle; order: what flat_order gives.
    """

class Mesh:
    """
    Delaunay triangulation of the plane that points can be added to and taken from.
    """

    def __init__(
        self,
        points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
        simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
        neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
        duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)]
        | None = None,
        checked: bool = False,
    ) -> None:
        """
        The triangulation of `points`, as `triangulate_...` gives it; at least one triangle. Copies everything.
        """

    def insert(
        self, points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)]
    ) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
        """
        Append points. Returns the pairs [dropped, kept] of those that repeat an earlier one.
        """

    def remove(
        self, indices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)]
    ) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
        """
        Take points out, number the others anew in the same order. Returns old -> new, -1 = removed.
        """

    def arrays(self) -> tuple:
        """
        Simplices, smallest index first, and neighbors, -1 for none, as new arrays.
        """

    @property
    def duplicates(self) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
        """All pairs [dropped, kept], by dropped; the lowest index is kept."""

    @property
    def is_flat(self) -> bool:
        """Whether no triangles are left: then points can only be removed."""

    @property
    def size(self) -> int:
        """Number of points, duplicates included."""

    @property
    def changes(self) -> int:
        """Number of changes that have begun, failed ones too."""

    @property
    def inconclusive(self) -> dict:
        """Tests that each stage left open, in changes so far."""

def turn(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """
    Exact signs (n,) for rows of points: 1 counterclockwise, -1 clockwise, 0 on one line. One row alone stands for as many as the others have.
    """

def in_circle(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """
    The same: 1 if d lies inside the circle of a counterclockwise triangle a b c.
    """

def voronoi(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> tuple:
    """
    Offsets of the cells, vertices and neighbours of their entries, the sites along a curve, the vertex of each triangle; if triangles share vertices, its rank there, rows of three sites and the vertex of each row.
    """

def delaunay_of(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    simplex_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    rank: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)] | None = None,
    workers: int = 1,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C")]:
    """Triangles of a diagram's sites, in the order of `simplex_vertex`."""

def circumcenters(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    triangles: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    place: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)] | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]:
    """Centres of triangles by number, that of row k at place[k]."""

def flat_order(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """Different points of a line along it."""

def flat_diagram(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> tuple:
    """
    Offsets, vertices and neighbours of the cells of points, and the sites of their ridges. They are taken to lie on one line, in this order.
    """

def cell_areas(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """Areas of the cells, infinite where unbounded; steradians."""

def cell_centroids(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]:
    """Centroids of the cells; NaN where there is none."""
