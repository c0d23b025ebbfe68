"""
The compiled part of stereodel: predicates, divide and conquer, insertion and removal, location, Voronoi diagrams, rasters on a globe.
"""

from collections.abc import Sequence
from typing import Annotated

import numpy
from numpy.typing import NDArray

def moebius_images(
    xyz: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    left: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    magnification: float,
    right: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> tuple[Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")], bool]:
    """
    Images of directions as unit vectors, and whether all were finite and not zero.
    """

def moebius_lonlat(
    lonlat: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    left: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    magnification: float,
    right: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> tuple[Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")], bool]:
    """
    Images (lon, lat) of (lon, lat) in degrees, and whether all were points.
    """

def moebius_scales(
    xyz: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    left: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    magnification: float,
    right: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> tuple[Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")], bool]:
    """Local scales at directions, and whether all were finite and not zero."""

def sin_cos_degrees(
    angles: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]:
    """
    Rows (sine, its low part, cosine, its low part) of angles in degrees; relative errors below 2^-101.
    """

def vector_angles(
    y: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    x: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """
    Angles of vectors (x, y) in radians, in [-pi, pi], within 2.5 * 2^-53 of themselves.
    """

def lonlat_to_xyz(
    lonlat: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """
    Unit vectors of rows (lon, lat) in degrees, each component rounded once.
    """

def xyz_to_lonlat(
    xyz: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]:
    """
    Rows (lon, lat) in degrees, each within an ulp, of non-zero directions of any length.
    """

def triangulate_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
    neighbors: bool = True,
) -> tuple:
    """
    Simplices, neighbors or None, duplicates, dimension and inconclusive tests of points of the plane.
    """

def triangulate_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
    neighbors: bool = True,
    axis: int = 0,
    sign: int = -1,
) -> tuple:
    """
    The same of directions; `sign` times axis number `axis` is the pole of the projection.
    """

def closing(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C")]:
    """Whether det[a b c] <= 0, for each facet."""

def proximity_plane(
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

def proximity_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    graph: str,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
    """The same for directions."""

def spanning_tree_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
    """
    The shortest forest among the edges, equally long ones in the order of their ends; sorted.
    """

def spanning_tree_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C")]:
    """The same for directions."""

def compare_lengths_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """Sign of |ab| - |cd| for rows a b c d of numbers."""

def compare_lengths_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """The same of angles between directions."""

def diametral_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """
    1 where p lies outside the circle with diameter ab, 0 on it, -1 inside, for rows a b p of numbers.
    """

def diametral_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """The same for directions; 0 for opposite a and b."""

def natural_neighbors_plane(
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

def natural_neighbors_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    units: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    rests: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    values: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    query_units: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    query_rests: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    gradients: bool = False,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, None, None), order="C")]:
    """
    The same for directions, which come as unit vectors in double-double too: units + rests.
    """

def find_simplex_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    The lowest triangle that holds each query, -1 outside. checked: the kernel made the arrays.
    """

def find_simplex_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    The same for directions; `closing` tells the triangles that hold none (none if not given).
    """

def nearest_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    The nearest point of each query, the lowest of several. There must be simplices.
    """

def nearest_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """The same for directions."""

def k_nearest_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    k: int,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C")]:
    """
    The k nearest points of each query, duplicates among them, by distance, equally near ones by number.
    """

def k_nearest_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    k: int,
    closing: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)]
    | None = None,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C")]:
    """The same for directions."""

def nearest_flat_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    k: int,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C")]:
    """
    The k nearest points of one line, as k_nearest_plane; `order`: of line_order.
    """

def nearest_flat_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    duplicates: Annotated[NDArray[numpy.int32], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    k: int,
    workers: int = 1,
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C")]:
    """The same for directions of one great circle; `order`: of circle_order."""

class PlaneMesh:
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

class SphereMesh:
    """
    Delaunay triangulation of directions that points can be added to and taken from.
    """

    def __init__(
        self,
        points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
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
        self, points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)]
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

def orient2d(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def incircle(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def orient3d(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def compare_distances(
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def orient_numbered(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> tuple[Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")], tuple[int, int, int, int]]: ...
def incircle_numbered(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    displaced: bool,
) -> tuple[Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")], tuple[int, int, int, int]]: ...
def common_granularity(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
) -> float: ...
def sign_of_roots(terms: Sequence[tuple[Sequence[int], Sequence[int]]]) -> int: ...
def round_quotient(numerator: Sequence[int], denominator: Sequence[int], exponent: int) -> float: ...
def root_is_close(square: Sequence[int], bits: int) -> bool: ...
def evaluate_balls(values: Sequence[float], formula: str) -> tuple[float, float, float, int]: ...
def bubble(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def bubble_plane_filter(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def in_bubble(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
    first: int = -1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def bubble_numbered(
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    displaced: bool,
    unit: bool | None = None,
) -> tuple[Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")], tuple[int, int, int, int]]: ...
def turn(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def turn_queries(
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def compare_directions(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def compare_component(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    unit: bool | None = None,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def compare_angles(
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def all_unit(
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
) -> bool: ...
def project(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]: ...
def project_double_double(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]: ...
def projected(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]: ...
def projected_estimates(
    fours: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 5), order="C")]: ...
def compare_projected(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
    coordinate: int,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def compare_to_line(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
    coordinate: int,
    hi: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    lo: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]: ...
def raster_levels(
    raster: Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 4), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.float64], dict(shape=(4), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.uint8], dict(shape=(None,), order="C")]:
    """
    Means of a raster (h, w, 4), colour premultiplied, with edges (west, south, east, north) in radians.
    """

def trace_page(
    first: Annotated[NDArray[numpy.float64], dict(shape=(3, 3), order="C", device="cpu", writable=False)],
    size: float,
    last: Annotated[NDArray[numpy.float64], dict(shape=(3, 3), order="C", device="cpu", writable=False)],
    reach: float,
    place: Sequence[float],
    count: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 7), order="C")]:
    """
    Of page points in a row, place (x, y, step right, up): lon, lat, their changes over steps, the bend.
    """

def warp_raster(
    raster: Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 4), order="C", device="cpu", writable=False)],
    levels: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.float64], dict(shape=(4), order="C", device="cpu", writable=False)],
    shifts: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.float64], dict(shape=(3, 3), order="C", device="cpu", writable=False)],
    size: float,
    last: Annotated[NDArray[numpy.float64], dict(shape=(3, 3), order="C", device="cpu", writable=False)],
    reach: float,
    place: Sequence[float],
    pixels: Sequence[int],
    covered: bool = True,
    workers: int = 1,
) -> Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 4), order="C")]:
    """
    Pixels (height, width, 4) of a globe: rotation, fisheye, rotation from view axes to the raster's; place (left, top, pixel's sides) in radii, pixels (width, height).
    """

def orient2d_signs(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """
    Exact signs (n,) for rows of points; one row alone stands for as many as the others have.
    """

def incircle_signs(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """The same for four points of the plane."""

def orient3d_signs(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """The same for four points of space."""

def in_bubble_signs(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """The same for four directions."""

def voronoi_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> tuple:
    """
    Offsets of the cells, vertices and neighbours of their entries, the sites along a curve, the vertex of each triangle; if triangles share vertices, its rank there, rows of three sites and the vertex of each row.
    """

def voronoi_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    simplices: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
    checked: bool = False,
) -> tuple:
    """The same for directions."""

def voronoi_ridges(
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    workers: int = 1,
) -> tuple:
    """
    Sites i < j and vertices of the ridges of a diagram, in lexicographic order.
    """

def voronoi_polygons(
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    workers: int = 1,
) -> tuple:
    """Offsets and sites of the polygons around the vertices of a diagram."""

def delaunay_of_plane(
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

def delaunay_of_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    simplex_vertex: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    rank: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)] | None = None,
    workers: int = 1,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C")]:
    """The same for directions."""

def line_order(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """Different points of a line along it."""

def circle_order(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    checked: bool = False,
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    Different directions of a great circle around it, the three lowest counterclockwise. checked: they are known to lie on one.
    """

def line_diagram(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> tuple:
    """
    Offsets, vertices and neighbours of the cells of points on a line, and the sites of their ridges.
    """

def circle_diagram(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> tuple:
    """
    Offsets, vertices and neighbours of the cells of directions on a great circle, and the vertices.
    """

def circle_areas(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """Areas of these cells, steradians."""

def circle_centroids(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """Unit vectors; NaN for empty cells."""

def bisector_normals(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """
    Unit vectors of p/|p| - q/|q| for rows of different directions, however close.
    """

def cell_areas_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """Areas of the cells; infinite where unbounded."""

def cell_areas_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """Areas of the cells, steradians."""

def cell_centroids_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]:
    """Centroids of the cells; NaN where there is none."""

def cell_centroids_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    offsets: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertices: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    neighbors: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    vertex_count: int,
    order: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """Unit vectors; NaN for empty cells."""

def circumcenters_plane(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    triangles: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    place: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)] | None = None,
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C")]:
    """
    Circumcentres of triangles by number, that of row k at place[k]; infinite where they exceed doubles.
    """

def circumcenters_sphere(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    triangles: Annotated[NDArray[numpy.int32], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    place: Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C", device="cpu", writable=False)] | None = None,
    workers: int = 1,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """
    The same for directions: unit normals on the side seen counterclockwise.
    """
