"""
The compiled part of stereodel: predicates, triangulation, location, Voronoi diagrams, graphs, conformal maps, rasters on a globe, triangulations in parts.
"""

from collections.abc import Sequence
from typing import Annotated

import numpy
from numpy.typing import NDArray

from stereodel._kernel import plane as plane, sphere as sphere

def rotation_product(
    then: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]:
    """The product of quaternions, two rows each."""

def rotation_between(
    start: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    end: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]:
    """
    The shortest rotation between unit vectors, two rows each, as a quaternion of any length.
    """

def rotation_matrix(
    quaternion: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """The six rows of a quaternion of two rows."""

def rotated(
    matrix: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    vectors: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C")]:
    """Vectors of any length times a matrix of six rows, rounded once."""

def moebius_product(
    then: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """
    The map `first`, then another: quaternion, magnification and quaternion, nine numbers.
    """

def moebius_element(
    map: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]:
    """
    A map in SL(2, C): both parts as doubles and what they leave, and the square of its vector.
    """

def moebius_decomposed(
    element: Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """The nine numbers of the first four rows of an element."""

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

def authalic_factors(
    squares: Annotated[NDArray[numpy.float64], dict(shape=(None, 2), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None, 4), order="C")]:
    """
    Rows (P, its low part, R, its low part) of squares (value, low part) of sines of geodetic latitudes: sine P and cosine R, over P(1), are those of the authalic latitude; relative errors below 2^-84.
    """

def vector_angles(
    y: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    x: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C")]:
    """
    Angles of vectors (x, y) in radians, in [-pi, pi], within 3.1 * 2^-53 of themselves.
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

def unread_counts(
    unread: Annotated[NDArray[numpy.bool_], dict(shape=(None,), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.int64], dict(shape=(None,), order="C", device="cpu", writable=False)],
) -> Annotated[NDArray[numpy.int32], dict(shape=(None,), order="C")]:
    """
    How many unread leaves each node of a box_tree has, from those of the leaves.
    """

def orient3d(
    a: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    b: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    c: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    d: Annotated[NDArray[numpy.float64], dict(shape=(None, 3), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.int8], dict(shape=(None,), order="C")]:
    """Exact signs of det[b-a c-a d-a] for rows of points of space."""

def raster_levels(
    raster: Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 4), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.float64], dict(shape=(4), order="C", device="cpu", writable=False)],
    workers: int = 1,
) -> Annotated[NDArray[numpy.uint8], dict(shape=(None,), order="C")]:
    """
    Means of a raster (h, w, 4), colour premultiplied, with edges (west, south, east, north) in radians.
    """

def warp_raster(
    raster: Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 4), order="C", device="cpu", writable=False)],
    levels: Annotated[NDArray[numpy.uint8], dict(shape=(None,), order="C", device="cpu", writable=False)],
    edges: Annotated[NDArray[numpy.float64], dict(shape=(4), order="C", device="cpu", writable=False)],
    shifts: Annotated[NDArray[numpy.float64], dict(shape=(None,), order="C", device="cpu", writable=False)],
    first: Annotated[NDArray[numpy.float64], dict(shape=(3, 3), order="C", device="cpu", writable=False)],
    size: float,
    last: Annotated[NDArray[numpy.float64], dict(shape=(3, 3), order="C", device="cpu", writable=False)],
    projection: str,
    reach: float,
    place: Sequence[float],
    pixels: Sequence[int],
    covered: bool = True,
    workers: int = 1,
) -> Annotated[NDArray[numpy.uint8], dict(shape=(None, None, 4), order="C")]:
    """
    Pixels (height, width, 4) of a globe: rotation, fisheye, rotation from page axes to the raster's; projection orthographic, stereographic (discs, of reach tan(angular radius/2)), gnomonic (tangents) or equirectangular (radians); place (left, top, pixel's sides) in its units, pixels (width, height).
    """

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
