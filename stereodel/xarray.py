"""Arrays of xarray: values at scattered points or on a grid, interpolated at other points.

``import stereodel.xarray`` gives every DataArray the accessor ``stereodel``. Dask arrays stay lazy.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.interpolation.methods import Method, as_method
from stereodel.interpolation.weights import WeightedInterpolator
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay

with of_extra("grid"):
    import xarray

__all__ = ["StereodelAccessor"]

_WORDS = {
    "lon": ("longitude", ("degrees_east", "degree_east", "degrees_E", "degree_E")),
    "lat": ("latitude", ("degrees_north", "degree_north", "degrees_N", "degree_N")),
}
"""By the CF conventions: standard name and units."""


class StereodelAccessor:
    """The accessor ``array.stereodel``.

    Parameters
    ----------
    values : xarray.DataArray
        With longitudes and latitudes among its coordinates.
    """

    def __init__(self, values: xarray.DataArray) -> None:
        self._values = values

    def interpolate(
        self,
        *,
        lon: npt.ArrayLike | xarray.DataArray,
        lat: npt.ArrayLike | xarray.DataArray,
        method: Method = "linear",
        latitude: Latitude = "spherical",
        source: tuple[Hashable, Hashable] | None = None,
        extrapolate: str | None = None,
        workers: int | None = None,
    ) -> xarray.DataArray:
        """Values at other points of the sphere.

        Parameters
        ----------
        lon, lat : DataArray, number or (k,) array_like
            Query points, in degrees. DataArrays of the same dimension are points, or a curvilinear
            grid if they have two; of different dimensions, and lists of numbers, they are the axes of a grid.
        method : {"linear", "nearest", "natural", "smooth"}, optional
            As for `stereodel.interpolation.griddata`.
        latitude : {"spherical", "geodetic", "authalic"}, optional
            The kind of all latitudes, as in `stereodel.lonlat_to_xyz`.
        source : tuple of two names, optional
            The coordinates that hold longitude and latitude of the values. By default they are recognised by their
            names ("lon", "longitude", …), standard names or units.
        extrapolate : "nearest", optional
            As for `stereodel.interpolation.LinearInterpolator`; not with "nearest".
        workers : int, optional
            Threads of the point location.

        Returns
        -------
        xarray.DataArray
            The dimensions of the values without those of the source, then those of the queries, with the coordinates of
            both; doubles; name and attributes of the values. Lazy, if the values are.

        Raises
        ------
        ValueError
            For values without such coordinates, or with several; for queries with a dimension that the values have too,
            beside those of the source.

        Notes
        -----
        The dimensions of the source's longitude and latitude, at any position, are those of the points: one for
        stations, two for a grid. The triangulation is made once, and so are the weights: each further field, hour or
        level costs a product with a sparse matrix. For "smooth" gradients are estimated for each.

        Examples
        --------
        >>> import numpy as np
        >>> import xarray
        >>> import stereodel.xarray
        >>> stations = {"lon": ("station", [10.0, 2.3, 12.5]), "lat": ("station", [48.4, 48.9, 41.9])}
        >>> celsius = xarray.DataArray([[8.1, 11.4, 15.9], [1.0, 4.0, 8.0]], stations, ("month", "station"))
        >>> grid = celsius.stereodel.interpolate(lon=[8.0, 9.2], lat=[45.5, 46.0], latitude="geodetic")
        >>> grid.dims, grid.sel(month=0, lon=9.2, lat=45.5).round(2).item()
        (('month', 'lat', 'lon'), 12.8)
        """
        sites, places = _places(*self._source(source)), _places(_as_axis(lon, "lon"), _as_axis(lat, "lat"))
        points, wanted = sites.dims, places.dims
        common = set(wanted) & (set(self._values.dims) - set(points))
        if common:
            raise ValueError(f"lon and lat have the dimension {common.pop()!r}, which the values also have; rename it")
        triangulation = SphericalDelaunay.from_lonlat(sites.pairs.reshape(-1, 2), latitude=latitude, workers=workers)
        options = {} if extrapolate is None else {"extrapolate": extrapolate}
        function = _fields(as_method(method), triangulation, places.pairs, options, workers)
        found = xarray.apply_ufunc(
            lambda block: function(block.reshape(*block.shape[: block.ndim - len(points)], -1)),
            self._values,
            input_core_dims=[points],
            output_core_dims=[wanted],
            exclude_dims=set(points),
            keep_attrs=True,
            dask="parallelized",
            output_dtypes=[np.float64],
            dask_gufunc_kwargs={
                "output_sizes": dict(zip(wanted, places.pairs.shape[:-1], strict=True)),
                "allow_rechunk": True,
            },
        )
        return found.assign_coords(places.coords)

    def _source(self, names: tuple[Hashable, Hashable] | None) -> tuple[xarray.DataArray, xarray.DataArray]:
        lon, lat = (self._found("lon"), self._found("lat")) if names is None else names
        for name in (lon, lat):
            if name not in self._values.coords:
                raise ValueError(
                    f"source names {name!r}, but the coordinates are {sorted(map(str, self._values.coords))}"
                )
        return self._values.coords[lon].reset_coords(drop=True), self._values.coords[lat].reset_coords(drop=True)

    def _found(self, kind: str) -> Hashable:
        """The coordinate of longitude or latitude."""
        standard, units = _WORDS[kind]
        names = [
            name
            for name, coord in self._values.coords.items()
            if coord.attrs.get("standard_name") == standard
            or coord.attrs.get("units") in units
            or str(name).lower() in (kind, standard)
        ]
        if len(names) != 1:
            found = f"are several: {', '.join(map(str, names))}" if names else "is none"
            raise ValueError(f"the values need one coordinate of {standard}, but there {found}; name two by source=")
        return names[0]


xarray.register_dataarray_accessor("stereodel")(StereodelAccessor)


class _Places(NamedTuple):
    """Longitudes and latitudes (..., 2), dimensions and coordinates of the leading shape."""

    pairs: FloatArray
    dims: tuple[Hashable, ...]
    coords: dict[Hashable, Any]


def _places(lon: xarray.DataArray, lat: xarray.DataArray) -> _Places:
    """A grid, with the latitude first, if both have different dimensions."""
    two, one = xarray.broadcast(*xarray.align(lat, lon, join="exact"))
    coords: dict[Hashable, Any] = dict(two.coords)
    for given, name in ((lon, "lon"), (lat, "lat")):
        coords[name if given.name is None else given.name] = (given.dims, given.values, given.attrs)
    return _Places(np.stack([one.values, two.values], axis=-1), two.dims, coords)


def _as_axis(values: Any, name: str) -> xarray.DataArray:
    if isinstance(values, xarray.DataArray):
        return values
    array = np.asarray(values)
    if array.ndim > 1:
        raise ValueError(f"{name} has shape {array.shape}; give a DataArray, whose dimensions have names")
    return xarray.DataArray(array, {name: array} if array.ndim else None, (name,)[: array.ndim], name=name)


def _fields(
    kind: Any, triangulation: SphericalDelaunay, lonlat: FloatArray, options: dict[str, Any], workers: int | None
) -> Callable[[FloatArray], FloatArray]:
    """What makes fields (..., n) at the points fields (..., *shape) at the places."""
    if issubclass(kind, WeightedInterpolator):
        unknown = np.zeros(len(triangulation.points))
        weights = kind(triangulation, unknown, **options).weights(lonlat=lonlat, workers=workers)
        return lambda fields: weights.apply(fields, axis=-1)

    def asked(fields: FloatArray) -> FloatArray:
        found = kind(triangulation, np.moveaxis(fields, -1, 0), **options)(lonlat=lonlat, workers=workers)
        return np.moveaxis(found, range(lonlat.ndim - 1), range(1 - lonlat.ndim, 0))

    return asked
