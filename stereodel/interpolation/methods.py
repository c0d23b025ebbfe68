"""Interpolators by name, and interpolation in one call."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice, as_floats
from stereodel.interpolation.interpolator import Interpolator
from stereodel.interpolation.smooth import SmoothInterpolator
from stereodel.interpolation.weighted import LinearInterpolator, NaturalNeighborInterpolator, NearestInterpolator
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.delaunay import as_triangulation

Method = Literal["nearest", "linear", "natural", "smooth"]

METHODS: Final[MappingProxyType[Method, type[Interpolator]]] = MappingProxyType(
    {
        "nearest": NearestInterpolator,
        "linear": LinearInterpolator,
        "natural": NaturalNeighborInterpolator,
        "smooth": SmoothInterpolator,
    }
)
"""Interpolators by name."""


def as_method(method: str) -> type[Interpolator]:
    """The interpolator of this name."""
    return METHODS[as_choice(method, tuple(METHODS), "method")]


def griddata(
    points: npt.ArrayLike,
    values: npt.ArrayLike,
    xi: npt.ArrayLike,
    *,
    method: Method = "linear",
    fill_value: float = np.nan,
    latitude: Latitude | None = None,
) -> FloatArray:
    """Values between scattered points in one call, as `scipy.interpolate.griddata`.

    Parameters
    ----------
    points : (n, 2) or (n, 3) array_like, or tuple of (n,) arrays
        Points of the plane, or directions; with `latitude`, (longitude, latitude) in degrees. A tuple holds separate
        coordinates: x and y, or longitude and latitude.
    values : (n, ...) array_like
        A number or an array of numbers for each point; NaN or masked where missing.
    xi : (..., 2) or (..., 3) array_like, or tuple of arrays
        Query points, in the form of `points`; the arrays of a tuple are broadcast against each other, so that
        ``np.ix_``, ``np.mgrid`` and ``np.meshgrid`` give grids.
    method : {"linear", "nearest", "natural", "smooth"}, optional
        `LinearInterpolator`, `NearestInterpolator`, `NaturalNeighborInterpolator` or `SmoothInterpolator`.
    fill_value : float, optional
        Value outside all triangles; not used by "nearest".
    latitude : {"spherical", "geodetic", "authalic"}, optional
        If given, `points` and `xi` are longitude and latitude, with this kind of latitude, as in `lonlat_to_xyz`.

    Returns
    -------
    array of the leading shape of `xi`, then the shape of one value
        NaN where a missing value takes part.

    Raises
    ------
    ValueError, TypeError
        As for the interpolators; if `method` is unknown.

    Notes
    -----
    For several fields or sets of queries, create the interpolator once; for time series use its `weights`.

    Examples
    --------
    >>> from stereodel.interpolation import griddata
    >>> x, y = np.mgrid[0:2, 0:3]
    >>> griddata([[0, 0], [4, 0], [0, 4], [4, 4]], [0.0, 4.0, 8.0, 12.0], (x, y)).tolist()
    [[0.0, 2.0, 4.0], [1.0, 3.0, 5.0]]
    >>> stations, celsius = [(10.0, 48.4), (2.3, 48.9), (12.5, 41.9)], [8.1, 11.4, 15.9]
    >>> print(griddata(stations, celsius, [(9.2, 45.5), (0.0, 0.0)], latitude="geodetic", fill_value=-99).round(2))
    [ 12.8 -99. ]
    """
    kind = as_method(method)
    sites, places = _joined(points, "points"), _joined(xi, "xi")
    triangulation = (
        as_triangulation(sites) if latitude is None else as_triangulation(None, lonlat=sites, latitude=latitude)
    )
    function = kind(triangulation, values)
    found = function(places) if latitude is None else function(lonlat=places)
    if kind is not NearestInterpolator and not np.isnan(fill := float(fill_value)):
        inside = triangulation.find_simplex(places) if latitude is None else triangulation.find_simplex(lonlat=places)
        found[np.asarray(inside) < 0] = fill
    return found


def _joined(coordinates: Any, name: str) -> npt.ArrayLike:
    """Separate coordinates in a tuple, as rows."""
    if not isinstance(coordinates, tuple) or np.ndim(coordinates[0]) == 0:
        return coordinates
    columns = [as_floats(column, f"{name}[{k}]") for k, column in enumerate(coordinates)]
    return np.stack(np.broadcast_arrays(*columns), axis=-1)
