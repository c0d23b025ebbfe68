"""Graticules: meridians and parallels as circle arcs (Figures 10 to 12 of the paper)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_lonlat, as_scalar, as_steps
from stereodel.sphere.arcs import SphereArc
from stereodel.sphere.circles import SphereCircle
from stereodel.sphere.coordinates import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

_NORTH = (0.0, 0.0, 1.0)
_SOUTH = (0.0, 0.0, -1.0)


def meridian(lon: float) -> SphereArc:
    """The half great circle at one longitude in degrees, from the south pole to the north pole."""
    return SphereArc(_meridian_circle(lon), np.array(_SOUTH), np.array(_NORTH), np.pi)


def parallel(lat: float, *, latitude: Latitude = "spherical") -> SphereArc:
    """The whole circle of one latitude in degrees, in (−90, 90), eastwards from longitude 0."""
    if latitude == "spherical":
        return SphereArc.whole(_parallel_circle(lat))
    x, _, z = lonlat_to_xyz((0.0, lat), latitude=latitude).tolist()
    return SphereArc.whole(SphereCircle(np.array(_NORTH), z, x))


def graticule(spacing: float = 15.0, *, latitude: Latitude = "spherical") -> list[SphereArc]:
    """Meridians from pole to pole, from longitude −180 eastwards, then parallels from south to north.

    Parameters
    ----------
    spacing : float
        Degrees between neighbouring lines; 180 must be a whole multiple of it.
    latitude : {"spherical", "geodetic", "authalic"}
        The kind of latitude of which the parallels are multiples; see `stereodel.lonlat_to_xyz`.

    Returns
    -------
    list of SphereArc
        360/spacing half great circles and the parallels whose latitudes are multiples of the spacing.

    Examples
    --------
    >>> len(graticule(30.0))
    17
    """
    steps = as_steps(180.0, spacing, "spacing")
    meridians = [meridian(k * 180.0 / steps) for k in range(-steps, steps)]
    half = (steps - 1) // 2
    return meridians + [parallel(k * 180.0 / steps, latitude=latitude) for k in range(-half, half + 1)]


def graticule_patch(center: npt.ArrayLike, half_width: float, spacing: float) -> list[SphereArc]:
    """The grid of a box in longitude and latitude, borders included: pieces of meridians, then of parallels.

    Parameters
    ----------
    center : array_like, shape (2,)
        (lon, lat) in degrees.
    half_width : float
        Degrees from the centre to each border, in both directions; the box must end before the poles.
    spacing : float
        Degrees between lines; the width 2·half_width must be a whole multiple of it.

    Returns
    -------
    list of SphereArc

    Examples
    --------
    >>> len(graticule_patch((0.0, 40.0), 8.0, 2.0))
    18
    """
    lon, lat = (float(value) for value in as_lonlat(center, "center"))
    width = 2 * as_scalar(half_width, "half_width", low=0.0, high=90.0 - abs(lat), open_low=True, open_high=True)
    steps = as_steps(width, spacing, "spacing")
    shifts = np.array([(k / steps - 0.5) * width for k in range(steps + 1)])
    lons, lats = lon + shifts, lat + shifts
    return [_meridian_piece(x, lats, width) for x in lons] + [_parallel_piece(y, lons, width) for y in lats]


def _meridian_piece(lon: float, lats: FloatArray, width: float) -> SphereArc:
    ends = lonlat_to_xyz([[lon, lats[0]], [lon, lats[-1]]])
    return SphereArc(_meridian_circle(lon), ends[0], ends[1], float(np.radians(width)))


def _parallel_piece(lat: float, lons: FloatArray, width: float) -> SphereArc:
    ends = lonlat_to_xyz([[lons[0], lat], [lons[-1], lat]])
    return SphereArc(_parallel_circle(lat), ends[0], ends[1], float(np.radians(width)))


def _meridian_circle(lon: float) -> SphereCircle:
    # Counterclockwise about lon − 90 is northwards at lon.
    return SphereCircle(lonlat_to_xyz((lon - 90.0, 0.0)), 0.0)


def _parallel_circle(lat: float) -> SphereCircle:
    return SphereCircle.around(_NORTH, 90.0 - lat)
