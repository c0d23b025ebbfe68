"""Arrays and datasets of xarray: values at scattered points or on a grid, interpolated at other points.

``import stereodel.xarray`` gives every DataArray and Dataset the accessor ``stereodel``. Dask arrays stay lazy.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_choice, as_count
from stereodel._double_double import DoubleDouble
from stereodel._extras import of_extra, optional
from stereodel.interpolation.methods import Method, as_method
from stereodel.interpolation.weights import WeightedInterpolator
from stereodel.sphere.latitudes import Latitude
from stereodel.triangulation.spherical_delaunay import SphericalDelaunay

with of_extra("grid"):
    import xarray

__all__ = ["StereodelAccessor", "healpix"]

WORDS: Final = {
    "lon": ("longitude", ("degrees_east", "degree_east", "degrees_E", "degree_E"), "X", "lon(g|gitude)?|glam"),
    "lat": ("latitude", ("degrees_north", "degree_north", "degrees_N", "degree_N"), "Y", "lat(itude)?|gphi"),
}
"""By the CF conventions: standard name, units and axis; then names, without what models write around them."""

NAMES: Final = r"(nav_|geo_?|[a-z]_?)?({})s?_?(rho|psi|cell|vertex|edge|node|face|[a-z\d]{{0,2}})"
"""As NEMO, ROMS, WRF, MPAS, ICON, POP, MOM and FVCOM name longitudes and latitudes."""


class StereodelAccessor:
    """The accessor ``stereodel`` of arrays and datasets.

    Parameters
    ----------
    values : xarray.DataArray or xarray.Dataset
        With longitudes and latitudes among its coordinates, or among the variables of the dataset.
    """

    def __init__(self, values: xarray.DataArray | xarray.Dataset) -> None:
        self._values = values

    def interpolate(
        self,
        *,
        lon: npt.ArrayLike | xarray.DataArray,
        lat: npt.ArrayLike | xarray.DataArray,
        method: Method = "linear",
        latitude: Latitude = "spherical",
        source: tuple[Hashable | xarray.DataArray, Hashable | xarray.DataArray] | None = None,
        extrapolate: str | None = None,
        workers: int | None = None,
    ) -> Any:
        """Values at other points of the sphere.

        Parameters
        ----------
        lon, lat : DataArray, number or (k,) array_like
            Query points, in degrees; DataArrays also in radians, if their units say so. DataArrays of the same
            dimension are points, or a curvilinear grid if they have two; of different dimensions, and lists of numbers,
            they are the axes of a grid. ``**healpix(nside)`` gives both.
        method : {"linear", "nearest", "natural", "smooth"}, optional
            As for `stereodel.interpolation.griddata`.
        latitude : {"spherical", "geodetic", "authalic"}, optional
            The kind of all latitudes, as in `stereodel.lonlat_to_xyz`.
        source : tuple of two names or DataArrays, optional
            Longitude and latitude of the values. By default they are the coordinates, or variables of the dataset, that
            say so by the CF conventions (standard name, units, axis, the attribute `coordinates`), else those with
            such names: ``lon``, ``nav_lat``, ``XLONG``, ``latCell``, ….
        extrapolate : "nearest", optional
            As for `stereodel.interpolation.LinearInterpolator`; not with "nearest".
        workers : int, optional
            Threads of the point location.

        Returns
        -------
        xarray.DataArray or xarray.Dataset
            The dimensions of the values without those of the source, then those of the queries, with the coordinates of
            both; doubles; name and attributes of the values. Lazy, if the values are. Of a dataset, all variables with
            numbers at the points; those that have nothing to do with them are kept, and a warning names the others.

        Raises
        ------
        ValueError
            For values without such coordinates, or with several; for queries with a dimension that the values have too,
            beside those of the source; for points that move in time.

        Notes
        -----
        The dimensions of the source's longitude and latitude, at any position, are those of the points: one for
        stations, two for a grid. Those along which neither changes, as WRF's Time, are not. The triangulation is made
        once, and so are the weights: each further variable, hour or level costs a product with a sparse matrix. For
        "smooth" gradients are estimated for each.

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
        lon_lat = self._source(source)
        sites, points, _ = _places(*lon_lat)
        places, wanted, coords = _places(_as_axis(lon, "lon"), _as_axis(lat, "lat"))
        common = set(wanted) & (set(self._values.dims) - set(points))
        if common:
            raise ValueError(f"lon and lat have the dimension {common.pop()!r}, which the values also have; rename it")
        values, kept = self._parted(points, [each.name for each in lon_lat])
        triangulation = SphericalDelaunay.from_lonlat(sites.reshape(-1, 2), latitude=latitude, workers=workers)
        options = {} if extrapolate is None else {"extrapolate": extrapolate}
        function = _fields(as_method(method), triangulation, places, options, workers)
        found = xarray.apply_ufunc(
            lambda block: function(block.reshape(*block.shape[: block.ndim - len(points)], -1)),
            values,
            input_core_dims=[points],
            output_core_dims=[wanted],
            exclude_dims=set(points),
            keep_attrs=True,
            dask="parallelized",
            output_dtypes=[np.float64],
            dask_gufunc_kwargs={"output_sizes": dict(zip(wanted, places.shape, strict=False)), "allow_rechunk": True},
        )
        found = found.assign_coords(coords)
        return found.assign(kept) if kept else found

    def _parted(self, points: tuple[Hashable, ...], source: list[Hashable]) -> tuple[Any, dict[Hashable, Any]]:
        """What is interpolated, and what stays as it is."""
        if not isinstance(self._values, xarray.Dataset):
            if set(points) - set(self._values.dims):
                said = f"the source has {_listed(points)}, but the values have {_listed(self._values.dims)}"
                raise ValueError(f"{said}; rename dimensions of one")
            return self._values, {}
        others = self._values.drop_vars(source, errors="ignore").data_vars
        inside = [name for name, each in others.items() if set(points) <= set(each.dims) and each.dtype.kind in "iuf"]
        kept = {name: each for name, each in others.items() if not set(points) & set(each.dims)}
        if not inside:
            raise ValueError(f"no variable has numbers at the points of the source, along {_listed(points)}")
        if left := [name for name in others if name not in inside and name not in kept]:
            warnings.warn(f"left out, without numbers at all points of the source: {_listed(left)}", stacklevel=3)
        return self._values[inside], kept

    def _source(self, given: tuple[Any, Any] | None) -> list[xarray.DataArray]:
        """Longitude and latitude of the values."""
        held = self._values if isinstance(self._values, xarray.Dataset) else self._values.coords
        pair = []
        for each in self._found(held) if given is None else given:
            if not isinstance(each, xarray.DataArray) and each not in held.variables:
                known = _listed(held.variables) or "none; ask the whole dataset, or give two arrays"
                raise ValueError(f"source names {each!r}, but the coordinates are {known}")
            pair.append((each if isinstance(each, xarray.DataArray) else held[each]).reset_coords(drop=True).compute())
        for dim in [dim for dim in pair[0].dims if dim in pair[1].dims and pair[0].ndim > 1]:
            still, timely = all((each == each.isel({dim: 0})).all() for each in pair), "time" in str(dim).lower()
            if still and (timely or pair[0].sizes[dim] > 1 or pair[0].ndim > 2):
                pair = [each.isel({dim: 0}, drop=True) for each in pair]
            elif timely:
                raise ValueError(f"the points of the source move along {dim!r}; take one time, isel({dim}=0)")
        return pair

    def _found(self, held: Any) -> list[Hashable]:
        """The names of longitude and latitude."""
        arrays = list(held.data_vars.values()) if isinstance(held, xarray.Dataset) else [self._values]
        listed = " ".join(str(a.attrs.get("coordinates", a.encoding.get("coordinates", ""))) for a in arrays).split()
        known = [{name: rank for name in held.variables if (rank := _rank(held[name], *WORDS[kind]))} for kind in WORDS]
        dims = [
            set(each.dims) for each in arrays if each is self._values or not any(each.name in names for names in known)
        ]
        pair = []
        for ranks, (standard, *_) in zip(known, WORDS.values(), strict=True):
            found = [name for name in ranks if any(set(held[name].dims) <= each for each in dims)]
            found = [name for name in found if name in listed] or found
            found = [name for name in found if ranks[name] == max(ranks[other] for other in found)]
            if len(found) != 1:
                none = "is none; name two by source=, ask the whole dataset, or add those of pixels by healpix(nside)"
                said = f"are several: {_listed(found)}; name two by source=" if found else none
                raise ValueError(f"the values need one coordinate of {standard}, but there {said}")
            pair += found
        return pair


xarray.register_dataarray_accessor("stereodel")(StereodelAccessor)
xarray.register_dataset_accessor("stereodel")(StereodelAccessor)


def healpix(nside: int, *, order: str = "nested", dim: str = "cell") -> dict[str, xarray.DataArray]:
    """Longitude and latitude of the centres of all pixels of HEALPix, as `interpolate` and ``assign_coords`` take them.

    Parameters
    ----------
    nside : int
        Pixels along a side of each of the twelve base pixels; a power of two for nested order.
    order : {"nested", "ring"}, optional
        How pixels are numbered.
    dim : str, optional
        Name of their dimension, of size 12 nside².

    Returns
    -------
    dict of str to xarray.DataArray
        ``"lon"`` and ``"lat"`` in degrees.

    Examples
    --------
    >>> import xarray
    >>> from stereodel.xarray import healpix
    >>> sky = xarray.DataArray(range(48), dims="cell").assign_coords(healpix(2))
    >>> round(sky.stereodel.interpolate(lon=45.0, lat=0.0).item(), 6)
    17.5
    """
    side, nest = as_count(nside, "nside"), as_choice(order, ("nested", "ring"), "order") == "nested"
    if nest and side & (side - 1):
        raise ValueError(f'nside is {side}, but must be a power of two for nested order; or give order="ring"')
    places = optional("hpgeom", "healpix").pixel_to_angle(side, np.arange(12 * side**2), nest=nest)
    return {
        name: xarray.DataArray(each, dims=dim, name=name, attrs={"standard_name": standard, "units": f"degrees_{way}"})
        for name, each, standard, way in zip(WORDS, places, ("longitude", "latitude"), ("east", "north"), strict=True)
    }


def _rank(array: xarray.DataArray, standard: str, units: tuple[str, ...], axis: str, stem: str) -> int:
    """2 for what is a coordinate by the CF conventions, 1 by its name, 0 for others."""
    attributes = array.attrs
    if attributes.get("standard_name", standard) != standard:  # as of rotated grids
        return 0
    plain = attributes.get("axis") == axis and attributes.get("units") in ("degree", "degrees")
    if "standard_name" in attributes or plain or attributes.get("units") in units:
        return 2
    return int(re.fullmatch(NAMES.format(stem), str(array.name).lower()) is not None)


def _listed(names: Any) -> str:
    return ", ".join(map(str, names))


def _places(
    lon: xarray.DataArray, lat: xarray.DataArray
) -> tuple[FloatArray, tuple[Hashable, ...], dict[Hashable, Any]]:
    """Longitudes and latitudes (..., 2), dimensions and coordinates of the leading shape.

    A grid, with the latitude first, if both have different dimensions.
    """
    two, one = xarray.broadcast(*xarray.align(lat, lon, join="exact"))
    coords: dict[Hashable, Any] = dict(two.coords)
    for given, name in ((lon, "lon"), (lat, "lat")):
        coords[name if given.name is None else given.name] = (given.dims, given.values, given.attrs)
    return np.stack([_in_degrees(one), _in_degrees(two)], axis=-1), two.dims, coords


def _in_degrees(angles: xarray.DataArray) -> npt.NDArray[Any]:
    if str(angles.attrs.get("units", "")).lower() not in ("rad", "radian", "radians"):
        return np.asarray(angles.values)
    degrees = DoubleDouble(*map(float.fromhex, ("0x1.ca5dc1a63c1f8p+5", "-0x1.1e7ab456405f9p-49")))  # of a radian
    return (DoubleDouble(angles.values.astype(np.float64)) * degrees).round()


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
        unknown = kind(triangulation, np.zeros(len(triangulation.points)), **options)
        return partial(unknown.weights(lonlat=lonlat, workers=workers).apply, axis=-1)

    def asked(fields: FloatArray) -> FloatArray:
        found = kind(triangulation, np.moveaxis(fields, -1, 0), **options)(lonlat=lonlat, workers=workers)
        return np.moveaxis(found, range(lonlat.ndim - 1), range(1 - lonlat.ndim, 0))

    return asked
