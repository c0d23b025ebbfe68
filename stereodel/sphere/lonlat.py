"""Longitude and latitude as arguments and results: an object made from them remembers the kind of latitude.

An array (n, 2) means the plane. Points of the sphere are directions, (n, 3), or come under the name `lonlat` with the
kind of their latitude. An object made of such points keeps it as its attribute `latitude`, takes queries by ``lonlat=``
and gives results in degrees. All of them use these functions.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy.typing as npt

from stereodel._arrays import FloatArray, as_plane_or_sphere, as_points
from stereodel.sphere.coordinates import lonlat_to_xyz, xyz_to_lonlat
from stereodel.sphere.latitudes import Latitude

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
        lonlat : (..., 2) array_like, optional
            In place of `queries`: (longitude, latitude) in degrees, with the points' kind of latitude.
        """,
}
"""What docstrings say of it."""


IN_ROWS: Final = "give rows (longitude, latitude), as np.column_stack([lon, lat]) makes them"
"""The end of messages about other shapes and calls."""

BY_NAME: Final = "give longitude and latitude by name, lonlat=np.column_stack([lon, lat])"
"""The same of queries."""


class Sites(NamedTuple):
    """Points of the plane, (n, 2), or directions, (n, 3), and their kind of latitude if they were given by one."""

    points: FloatArray
    latitude: Latitude | None


def as_sites(points: npt.ArrayLike | None, lonlat: npt.ArrayLike | None, latitude: Latitude | None) -> Sites:
    """What is given as `points`, or in their place as `lonlat` of some `latitude`."""
    if points is not None:
        refuse_lonlat(lonlat, latitude)
        return Sites(as_plane_or_sphere(points), None)
    if lonlat is None:
        raise TypeError("points are missing; give points, or longitude and latitude by lonlat=")
    kind: Latitude = "spherical" if latitude is None else latitude
    return Sites(lonlat_to_xyz(as_points(lonlat, 2, "lonlat", hint=IN_ROWS), latitude=kind), kind)


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
