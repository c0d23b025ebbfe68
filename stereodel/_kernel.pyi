"""
The compiled part of stereodel: predicates, divide and conquer, insertion and removal, location.
"""

from typing import Annotated

import numpy
from numpy.typing import NDArray

def sin_cos_degrees(
    angles: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]:
    """
    Rows (sine, its low part, cosine, its low part) of angles in degrees; relative errors below 2^-101.
    """

def lonlat_to_xyz(
    lonlat: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """
    Unit vectors of rows (lon, lat) in degrees, each component rounded once.
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

def orient2d(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def incircle(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def compare_distances(
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def orient_numbered(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
) -> tuple[Annotated[NDArray[numpy.int8], dict(shape=(None,))], tuple[int, int, int, int]]: ...
def incircle_numbered(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    displaced: bool,
) -> tuple[Annotated[NDArray[numpy.int8], dict(shape=(None,))], tuple[int, int, int, int]]: ...
def common_granularity(
    points: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
) -> float: ...
def bubble(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def in_bubble(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
    first: int = -1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def bubble_numbered(
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    displaced: bool,
    unit: bool | None = None,
) -> tuple[Annotated[NDArray[numpy.int8], dict(shape=(None,))], tuple[int, int, int, int]]: ...
def turn(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def turn_queries(
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    numbers: Annotated[NDArray[numpy.int32], dict(shape=(None, None), order="C", device="cpu", writable=False)],
    queries: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def compare_directions(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    unit: bool | None = None,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def compare_component(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    unit: bool | None = None,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def compare_angles(
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def all_unit(
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
) -> bool: ...
def project(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, None))]: ...
def project_double_double(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, None))]: ...
def compare_projected(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    q: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
    coordinate: int,
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
def compare_to_line(
    p: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    axis: int,
    sign: int,
    coordinate: int,
    hi: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    lo: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    stage: str = "all",
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,))]: ...
