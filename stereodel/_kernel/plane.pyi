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
        inconclusive: dict | None = None,
        checked: bool = False,
    ) -> None:
        """
        The triangulation of `points`, as `triangulate` gives it. Copies everything. While one thread changes it, the others wait, without the interpreter's lock.
        """

    def insert(
        self,
        points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
        workers: int = 1,
        anew: int = 0,
    ) -> int:
        """
        Append points. Returns the number of the first. anew: all are triangulated anew if so many times the new ones are more than the old ones.
        """

    def remove(
        self,
        indices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
        workers: int = 1,
        anew: int = 0,
    ) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
        """
        Take points out, number the others anew in the same order. Returns old -> new, -1 = removed. anew: as for `insert`, of those removed and of those left.
        """

    def read(self, workers: int = 1) -> tuple:
        """
        All of one state, in arrays that nobody changes: changes so far, points, then what `triangulate` gives; pairs [dropped, kept] by dropped.
        """

    @property
    def changes(self) -> int:
        """Number of changes that have come to their end."""

    @property
    def size(self) -> int:
        """Number of points, duplicates included."""

def part_of(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    axis: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    value: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    The leaf of a k-d tree that each point belongs to. axis, value: of the inner nodes, in the order of a heap, any number of them: node k has the children 2k + 1 (coordinates up to the value) and 2k + 2, and what comes after the inner nodes is leaf 0, 1, ... Directions of any length are taken as unit vectors.
    """

def blocks(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)], size: int
) -> tuple:
    """
    Rows in the order of blocks of at most `size` points (more only if all are equal), where each block begins and the last one ends (blocks + 1), low and high corners of boxes that hold them; on the sphere those of the unit vectors, rounded outward.
    """

def box_tree(
    lows: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    highs: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
) -> tuple:
    """
    Low and high corners of all nodes of a tree over boxes, which stand first, and the first node of each level and one beyond.
    """

def near_blocks(
    chosen: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)],
    reach: float,
    lows: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    highs: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    unread: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C")]:
    """
    Which unread blocks are near chosen ones: the gap along each axis is at most `reach` times the smaller diagonal. lows, highs, first: of box_tree; unread: of unread_counts.
    """

def open_bubbles(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    faces: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    lows: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    highs: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    unread: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    wanted: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)] | None = None,
) -> tuple:
    """
    Whether each triangle's closed bubble may touch an unread block, never false where it does; and for each block how deep an open bubble reaches into it, 0 if none does. Triangles are counterclockwise; in the plane (u, v, -1) is an edge of the hull that has all points on its left. wanted: which points' triangles matter.
    """

def open_discs(
    centers: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    rims: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    lows: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    highs: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    unread: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> tuple:
    """
    The same for the closed discs around centers through the points beside them.
    """

def open_targets(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    lows: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    highs: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    unread: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    natural: bool = False,
    checked: bool = False,
) -> tuple:
    """
    The same for what the answer at each target rests on: triangles that hold it, or the one or the hull's edge that it lies beyond; natural: also all triangles whose bubbles hold it, and those that it would have at itself.
    """

def final_cells(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    ids: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    rows: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    checked: bool = False,
) -> tuple:
    """
    Of ascending rows whose triangles are final: the lowest id of equal points, degree, area (both 0 where that id is another one), the id of the nearest other point (the lowest of several, -1 if there is none), its distance (radians on the sphere). ids: of all rows, in any order. There must be simplices.
    """

def final_triangles(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    ids: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    final: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> tuple:
    """
    Triangles by ids (m, 3), the lowest first, counterclockwise, of which that point is final, and their rows among the simplices. final: of each row; of equal points the one of lowest id counts.
    """

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
