"""Longitude and latitude to unit vectors and back, and the axes (east, north, up) at a point.

Axes: x towards (lon 0, lat 0), y towards (90, 0), z towards the north pole. Angles in degrees, in the order (lon, lat).

An array (n, 2) means the plane. Points of the sphere are directions, (n, 3), or come under the name `lonlat` with the
kind of their latitude. An object made of such points keeps it as its attribute `latitude`, takes queries by ``lonlat=``
and gives results in degrees. All of them use these functions.
"""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np
import numpy.typing as npt

from stereodel import _kernel
from stereodel._arrays import (
    FloatArray,
    IntArray,
    as_choice,
    as_direction_or_lonlat,
    as_directions,
    as_lonlat,
    as_plane_or_sphere,
    as_points,
)
from stereodel._docs import by_name
from stereodel._double_double import DoubleDouble, by_blocks, scaled, shift_exponent, stack, unit
from stereodel._tasks.threads import thread_count
from stereodel.sphere.degrees import angle_degrees, sin_cos_degrees
from stereodel.sphere.latitudes import KINDS, Latitude, latitude_of, sin_cos_on_sphere


@by_name("give longitude and latitude as one pair (lon, lat), or rows of such pairs, np.column_stack([lon, lat])")
def lonlat_to_xyz(lonlat: npt.ArrayLike, *, latitude: Latitude = "spherical", workers: int | None = None) -> FloatArray:
    """Unit vectors of points given by longitude and latitude.

    Parameters
    ----------
    lonlat : array_like, shape (..., 2)
        (lon, lat) in degrees, any finite longitude, latitude in [−90, 90].
    latitude : {"spherical", "geodetic", "authalic"}, optional
        "spherical" takes latitudes unchanged. The others take them as geodetic latitudes on WGS84, which is what
        maps and GPS give, and return the direction from the Earth's centre ("geodetic") or the point on the
        sphere of equal area ("authalic").
    workers : int, optional
        Threads for spherical latitudes, -1 for all processors; by default all from 20 000 points on. The result is
        always the same.

    Returns
    -------
    ndarray, shape (..., 3)
        Each component is cos φ cos λ, cos φ sin λ or sin φ rounded once, φ being the latitude on the sphere: the same
        bits on every machine, mirrored points get mirrored vectors, multiples of 90° give 0 and ±1 exactly, and there
        is no −0.

    Raises
    ------
    ValueError
        For a latitude outside [−90, 90], NaN, infinities, another shape, or another `latitude`.

    Examples
    --------
    >>> print(lonlat_to_xyz([[0, 0], [-90, 0], [30, 90]]))
    [[ 1.  0.  0.]
     [ 0. -1.  0.]
     [ 0.  0.  1.]]
    """
    rows = as_lonlat(lonlat)
    kind = as_choice(latitude, KINDS, "latitude")
    if kind != "spherical":
        return by_blocks(partial(_from_ellipsoid, kind=kind), rows)
    flat = np.ascontiguousarray(rows).reshape(-1, 2)
    return _kernel.lonlat_to_xyz(flat, thread_count(workers, len(flat))).reshape(*rows.shape[:-1], 3)


def _from_ellipsoid(rows: FloatArray, kind: Latitude) -> FloatArray:
    (sin_lon, cos_lon), (sin_lat, cos_lat) = sin_cos_degrees(rows[:, 0]), sin_cos_on_sphere(rows[:, 1], kind)
    return stack([cos_lat * cos_lon, cos_lat * sin_lon, sin_lat]).round() + 0.0


def xyz_to_lonlat(xyz: npt.ArrayLike, *, latitude: Latitude = "spherical", workers: int | None = None) -> FloatArray:
    """Longitude and latitude of directions.

    Parameters
    ----------
    xyz : array_like, shape (..., 3)
        Non-zero vectors; only their directions count.
    latitude : {"spherical", "geodetic", "authalic"}, optional
        As in `lonlat_to_xyz`: how the vectors were made. With the last two the result is geodetic latitude on WGS84.
    workers : int, optional
        As in `lonlat_to_xyz`.

    Returns
    -------
    ndarray, shape (..., 2)
        (lon, lat) in degrees, longitude in [−180, 180), latitude in [−90, 90], each within an ulp; longitude 0 at the
        poles.

    Raises
    ------
    ValueError
        For a zero vector, NaN, infinities, another shape, or another `latitude`.

    Examples
    --------
    >>> print(xyz_to_lonlat([[0, 2, 0], [-1, 0, 0], [0, 0, 1]]))
    [[  90.    0.]
     [-180.    0.]
     [   0.   90.]]
    """
    kind = as_choice(latitude, KINDS, "latitude")
    rows = as_directions(xyz, "xyz")
    if kind != "spherical":
        return by_blocks(partial(_on_ellipsoid, kind=kind), rows)
    flat = rows.reshape(-1, 3)
    return _kernel.xyz_to_lonlat(flat, thread_count(workers, len(flat))).reshape(*rows.shape[:-1], 2)


def _on_ellipsoid(rows: FloatArray, kind: Latitude) -> FloatArray:
    vectors, whole = scaled(rows)
    x, y, rho, own = _horizontal(rows)
    lon = angle_degrees(y, x)
    lat = latitude_of(DoubleDouble(vectors[:, 2]), shift_exponent(rho, own - whole), kind)
    return np.stack([np.where(lon == 180.0, -180.0, lon), lat], axis=-1) + 0.0


def _horizontal(rows: FloatArray) -> tuple[DoubleDouble, DoubleDouble, DoubleDouble, IntArray]:
    """x, y and distance from the axis of vectors (..., 3), over a power of two, and its exponent."""
    # Scaled on its own, so that a longitude survives one subnormal step away from the pole.
    horizontal, exponent = scaled(rows[..., :2])
    x, y = DoubleDouble(horizontal[..., 0]), DoubleDouble(horizontal[..., 1])
    return x, y, (x * x + y * y).sqrt(), exponent


def as_direction(point: npt.ArrayLike, name: str = "point") -> FloatArray:
    """The direction (3,) of one point: as given, or of (lon, lat) in degrees; messages call it `name`."""
    values = as_direction_or_lonlat(point, name)
    return lonlat_to_xyz(values) if values.shape == (2,) else values


def as_sphere_points(points: npt.ArrayLike, name: str = "points") -> FloatArray:
    """Directions (n, 3) of points given as rows (lon, lat) in degrees or as vectors; messages call them `name`."""
    rows = as_plane_or_sphere(points, name)
    return rows if rows.shape[1] == 3 else lonlat_to_xyz(as_lonlat(rows, name))


def tangent_frame(point: npt.ArrayLike, name: str = "point") -> DoubleDouble:
    """Rows east, north, up at a point, shape (3, 3), errors below 2⁻⁹⁷; messages call the point `name`.

    At a pole the limit along the longitude of (lon, lat), of a direction along 0: north points to lon + 180°, or lon.
    """
    values = as_direction_or_lonlat(point, name)
    if values.shape == (2,):
        sines, cosines = sin_cos_degrees(values)
        return _frame(sines[0], cosines[0], sines[1], cosines[1])
    up = unit(values)
    x, y, rho, _ = _horizontal(values if values[:2].any() else np.array([1.0, 0.0, 0.0]))
    sin_lon, cos_lon = y / rho, x / rho
    return _frame(sin_lon, cos_lon, up[2], up[0] * cos_lon + up[1] * sin_lon)


def _frame(sin_lon: DoubleDouble, cos_lon: DoubleDouble, sin_lat: DoubleDouble, cos_lat: DoubleDouble) -> DoubleDouble:
    columns = [
        [-sin_lon, -sin_lat * cos_lon, cos_lat * cos_lon],
        [cos_lon, -sin_lat * sin_lon, cos_lat * sin_lon],
        [DoubleDouble(0.0), cos_lat, sin_lat],
    ]
    return stack([stack(column) for column in columns])


LONLAT: Final = {
    "lonlat": """
        lonlat : (n, 2) array_like
            (longitude, latitude) in degrees; any finite longitude, latitude in [-90, 90].
        """,
    "latitude": """
        latitude : {"spherical", "geodetic", "authalic"}, optional
            As in `lonlat_to_xyz`: "spherical" takes latitudes unchanged; the others take them as geodetic
            latitudes on WGS84 and use the direction from the Earth's centre, or the point on the sphere of equal area.
            It is remembered.
        """,
    "lonlat_raises": """
        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, latitudes out of range, other shapes, or another `latitude`.
        """,
    "instead": """
        lonlat : (n, 2) array_like, optional
            In place of `points`: (longitude, latitude) in degrees on the sphere.
        latitude : {"spherical", "geodetic", "authalic"}, optional
            The kind of latitude of `lonlat`, as in `lonlat_to_xyz`; "spherical" by default.
        """,
    "asked": """
        Parameters
        ----------
        queries : array_like of shape (..., 2) or (..., 3)
            Points of the plane, or directions.
        lonlat : (..., 2) array_like, optional
            In place of `queries`: (longitude, latitude) in degrees, with the points' kind of latitude.
        workers : int, optional
            Threads; -1 for all processors. By default those of the triangulation, for many queries.
        """,
    "asked_raises": """
        Raises
        ------
        ValueError, TypeError
            For values that are not finite real numbers, zero vectors, or another last axis; for `lonlat` where the
            points were not given by longitude and latitude.
        """,
}
"""What docstrings say of it."""


IN_ROWS: Final = "give rows (longitude, latitude), as np.column_stack([lon, lat]) makes them"
"""The end of messages about other shapes and calls."""

BY_NAME: Final = "give longitude and latitude by name, lonlat=np.column_stack([lon, lat])"
"""The same of queries."""


def as_sites(
    points: npt.ArrayLike | None, lonlat: npt.ArrayLike | None, latitude: Latitude | None
) -> tuple[FloatArray, Latitude | None]:
    """Points of the plane, (n, 2), or directions, (n, 3), and their kind of latitude if given by `lonlat`."""
    if points is not None:
        refuse_lonlat(lonlat, latitude)
        return as_plane_or_sphere(points), None
    if lonlat is None:
        raise TypeError("points are missing; give points, or longitude and latitude by lonlat=")
    kind: Latitude = "spherical" if latitude is None else latitude
    return lonlat_to_xyz(as_points(lonlat, 2, "lonlat", hint=IN_ROWS), latitude=kind), kind


def refuse_lonlat(lonlat: npt.ArrayLike | None, latitude: Latitude | None) -> None:
    """Beside points there is no `lonlat`, and without it no `latitude`."""
    if lonlat is not None:
        raise TypeError("points and lonlat= were both given; give one of them")
    if latitude is not None:
        raise TypeError(
            f"latitude={latitude!r} is the kind of latitude of lonlat=, but points were given; "
            f"for longitude and latitude write lonlat=…, latitude={latitude!r}"
        )


def as_asked(
    queries: npt.ArrayLike | None, lonlat: npt.ArrayLike | None, latitude: Latitude | None, name: str = "queries"
) -> npt.ArrayLike:
    """The queries, or in their place the directions of `lonlat`, of the latitude that was remembered."""
    if lonlat is None:
        if queries is None:
            raise TypeError(f"{name} are missing; give {name}, or longitude and latitude by lonlat=")
        return queries
    if queries is not None:
        raise TypeError(f"{name} and lonlat= were both given; give one of them")
    if latitude is None:
        raise ValueError(
            "lonlat= is for points that were given by longitude and latitude, but these were not; make the object by "
            f"from_lonlat, or give {name} as its points were given"
        )
    return lonlat_to_xyz(lonlat, latitude=latitude)


def as_told(xyz: FloatArray, latitude: Latitude | None) -> FloatArray:
    """Longitude and latitude of directions (n, 3), (n, 2) in degrees, of the latitude that was remembered."""
    if latitude is None:
        raise AttributeError(
            "longitude and latitude are available if points were given by them (from_lonlat, lonlat=); "
            "for directions, compute them by xyz_to_lonlat(…, latitude=…)"
        )
    return xyz_to_lonlat(xyz, latitude=latitude)
