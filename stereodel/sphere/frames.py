"""The axes (east, north, up) at a point of the sphere, in double-double."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from stereodel._arrays import as_direction_or_lonlat
from stereodel._double_double import DoubleDouble, unit
from stereodel.sphere.coordinates import scaled
from stereodel.sphere.degrees import sin_cos_degrees


def tangent_frame(point: npt.ArrayLike, name: str = "point") -> DoubleDouble:
    """Rows east, north, up at a point, shape (3, 3), errors below 2⁻⁹⁷.

    At a pole the axes are the limit along the longitude of (lon, lat), for a direction along longitude 0: at the north
    pole north points toward lon + 180°, at the south pole toward lon. Error messages call the point `name`.
    """
    values = as_direction_or_lonlat(point, name)
    if values.shape == (2,):
        sines, cosines = sin_cos_degrees(values)
        return _frame(sines[0], cosines[0], sines[1], cosines[1])
    up = unit(values)
    horizontal = scaled(values[:2])[0]
    if not horizontal.any():
        horizontal = np.array([1.0, 0.0])
    x, y = DoubleDouble(horizontal[0]), DoubleDouble(horizontal[1])
    rho = (x * x + y * y).sqrt()
    sin_lon, cos_lon = y / rho, x / rho
    return _frame(sin_lon, cos_lon, up[2], up[0] * cos_lon + up[1] * sin_lon)


def _frame(sin_lon: DoubleDouble, cos_lon: DoubleDouble, sin_lat: DoubleDouble, cos_lat: DoubleDouble) -> DoubleDouble:
    zero = DoubleDouble(0.0)
    rows = [
        [-sin_lon, cos_lon, zero],
        [-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat],
        [cos_lat * cos_lon, cos_lat * sin_lon, sin_lat],
    ]
    return DoubleDouble(
        np.array([[float(c.hi) for c in row] for row in rows]), np.array([[float(c.lo) for c in row] for row in rows])
    )
