"""Values on regular grids of longitude and latitude: NetCDF, GeoTIFF, tables, xarray."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, as_floats, as_lonlat, as_scalar, as_steps, as_vectors, read_only
from stereodel._extras import optional
from stereodel._notebook import Shown, tabular
from stereodel.constants import GRID_ROUNDING, MOST_PLACES
from stereodel.earth import EQUATORIAL_RADIUS_KM, INVERSE_FLATTENING
from stereodel.io.formats.names import beside, spelled

WGS84: Final = {
    "grid_mapping_name": "latitude_longitude",
    "longitude_of_prime_meridian": 0.0,
    "semi_major_axis": 1000 * EQUATORIAL_RADIUS_KM,
    "inverse_flattening": INVERSE_FLATTENING,
    "crs_wkt": (
        'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],'
        'AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],'
        'UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]'
    ),
}
"""The coordinate system of longitude and latitude in terms of the CF conventions (1.8, appendix F) and GDAL."""


@dataclass(frozen=True, eq=False)
class Grid(Shown):
    """Values at the nodes of a regular grid of longitude and latitude, or at the centres of its cells.

    Parameters
    ----------
    lon : (w,) array_like
        Degrees, from west to east in equal steps; above 180 where the grid crosses the 180th meridian.
    lat : (h,) array_like
        Degrees in [−90, 90], from south to north in equal steps.
    values : mapping of str to (h, w) array_like
        Values by name, rows from south to north; NaN marks a missing value.
    units : mapping of str to str, optional
        Units by name, for some or all of the values.
    centers : bool
        Whether values belong to cells, with the nodes at their centres.

    Raises
    ------
    ValueError, TypeError
        If steps are unequal, latitudes out of range, or values of the wrong shape.

    Examples
    --------
    >>> grid = Grid.regular(90)
    >>> grid.lon.tolist(), grid.lat.tolist(), grid.lonlat.shape
    ([-180.0, -90.0, 0.0, 90.0], [-90.0, 0.0, 90.0], (3, 4, 2))
    >>> Grid.regular(90, centers=True).lat.tolist()
    [-45.0, 45.0]
    """

    lon: FloatArray
    lat: FloatArray
    values: Mapping[str, FloatArray] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    centers: bool = False
    _mimes = tabular(
        lambda it: len(it.lat) * len(it.lon),
        lambda it, k: (
            {"lon": it.lon[k % len(it.lon)], "lat": it.lat[k // len(it.lon)]}
            | {name: values[k // len(it.lon), k % len(it.lon)] for name, values in it.values.items()}
        ),
    )

    def __post_init__(self) -> None:
        lon, lat = (read_only(as_floats(axis, name)) for axis, name in ((self.lon, "lon"), (self.lat, "lat")))
        for axis, name in ((lon, "lon"), (lat, "lat")):
            if axis.ndim != 1 or not len(axis):
                raise ValueError(f"{name} must have shape (n,) with at least one entry, got {axis.shape}")
            steps = np.diff(axis)
            if len(steps) and (steps.min() <= 0 or np.ptp(steps) > GRID_ROUNDING * steps.max()):
                raise ValueError(f"{name} must grow by equal steps, which go from {steps.min()} to {steps.max()}")
        as_lonlat(np.column_stack([np.zeros(len(lat)), lat]), "lat")
        values = {str(name): read_only(np.asarray(array, dtype=np.float64)) for name, array in self.values.items()}
        for name, array in values.items():
            if array.shape != (len(lat), len(lon)):
                raise ValueError(f"values[{name!r}] must have shape {(len(lat), len(lon))}, got {array.shape}")
        unknown = sorted(set(self.units) - set(values))
        if values and unknown:
            raise ValueError(f"units are given for {', '.join(map(repr, unknown))}, which are not among the values")
        for name, value in (("lon", lon), ("lat", lat)):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "values", MappingProxyType(values))

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled or copied
        return type(self), (self.lon, self.lat, dict(self.values), self.units, self.centers)

    @classmethod
    def regular(cls, spacing: float, bounds: npt.ArrayLike | None = None, *, centers: bool = False) -> Grid:
        """A grid without values, for the whole Earth or part of it.

        Parameters
        ----------
        spacing : float
            Degrees between neighbouring nodes; for the whole Earth a divisor of 180.
        bounds : (4,) array_like, optional
            (west, south, east, north) in degrees; east is less than west if the grid crosses the 180th meridian. The
            grid starts at the southwest corner and extends as far as it fits.
        centers : bool
            Whether `bounds` are the outer edges of cells, half a step beyond their centres.
        """
        half = 0.5 if centers else 0.0
        if bounds is None:
            steps = as_steps(180.0, spacing, spelled("spacing"))
            step, rows = 180.0 / steps, steps if centers else steps + 1
            _check_places(spacing, 2 * steps, rows)
            lon, lat = (np.arange(low, high, dtype=np.float64) + half for low, high in ((-steps, steps), (0, rows)))
            return cls(lon * step, lat * step - 90.0, centers=centers)
        name = spelled("bounds")
        west, south, east, north = as_vectors(bounds, 4, name).tolist()
        as_lonlat([[west, south], [east, north]], name)
        if not south < north:
            raise ValueError(f"{name} is {(west, south, east, north)}, but south must be below north")
        east = east if east > west else east + 360.0
        sides = ((west, east), (south, north))
        step = as_scalar(
            spacing, spelled("spacing"), low=0.0, high=min(high - low for low, high in sides), open_low=True
        )
        counts = [int(np.floor((high - low) / step + GRID_ROUNDING)) + (0 if centers else 1) for low, high in sides]
        _check_places(step, *counts)
        lon, lat = (
            np.minimum(low + step * (np.arange(count) + half), high)
            for (low, high), count in zip(sides, counts, strict=True)
        )
        return cls(lon, lat, centers=centers)

    @property
    def lonlat(self) -> FloatArray:
        """Coordinates of the nodes, (h, w, 2) in degrees, rows from south to north."""
        return np.stack(np.meshgrid(self.lon, self.lat), axis=-1)

    def located(self) -> dict[str, FloatArray]:
        """Columns of a table with a row for each node, starting in the southwest."""
        columns = dict(zip(("lon", "lat"), self.lonlat.reshape(-1, 2).T, strict=True))
        return columns | {name: values.ravel() for name, values in beside(columns, self.values).items()}

    @property
    def steps(self) -> tuple[float, float]:
        """Degrees between neighbours in longitude and latitude; along an axis with one node, the size of its cell."""
        lon, lat = (
            float(axis[-1] - axis[0]) / (len(axis) - 1) if len(axis) > 1 else 0.0 for axis in (self.lon, self.lat)
        )
        return lon or lat or 1.0, lat or lon or 1.0

    def to_xarray(self) -> Any:
        """The values as an xarray.Dataset with the names and units of the CF conventions.

        Examples
        --------
        >>> grid = Grid([0, 1], [0, 1], {"depth": [[1, 2], [3, 4]]}, {"depth": "m"})
        >>> grid.to_xarray()["depth"].attrs["units"]
        'm'
        """
        coordinates: dict[str, Any] = {}
        variables: dict[str, Any] = {"crs": ((), np.int32(0), WGS84)}
        axes = (
            ("lat", self.lat, self.steps[1], "degrees_north", "latitude", "Y"),
            ("lon", self.lon, self.steps[0], "degrees_east", "longitude", "X"),
        )
        for name, places, step, units, meaning, letter in axes:
            attributes = {"units": units, "standard_name": meaning, "long_name": meaning, "axis": letter}
            if self.centers:
                attributes["bounds"] = f"{name}_bnds"
                edges = np.stack([places - step / 2, places + step / 2], axis=1)
                variables[f"{name}_bnds"] = ((name, "bnds"), edges)
            coordinates[name] = (name, places, attributes)
        named = beside([*variables, *coordinates, "bnds"], self.values)
        for (given, values), name in zip(self.values.items(), named, strict=True):
            unit = {"units": self.units[given]} if given in self.units else {}
            variables[name] = (("lat", "lon"), values, {"long_name": given, "grid_mapping": "crs"} | unit)
        dataset = optional("xarray", "grid").Dataset(variables, coordinates, {"Conventions": "CF-1.8"})
        for variable in dataset.variables.values():  # in files, values can be missing, and nothing else
            variable.encoding["_FillValue"] = np.nan if "grid_mapping" in variable.attrs else None
        return dataset


def _check_places(spacing: float, columns: int, rows: int) -> None:
    """A ValueError for a grid that no memory holds."""
    if columns * rows > MOST_PLACES:
        made = f"a grid of {columns} × {rows} places; {MOST_PLACES} are the most"
        raise ValueError(f"{spelled('spacing')} is {spacing:g}, which makes {made}")


def write_geotiff(grid: Grid, path: Path) -> None:
    """Write a grid as a GeoTIFF in EPSG:4326, one band for each name; rows from north to south, as in images."""
    rasterio = optional("rasterio", "raster")
    (dx, dy), bands = grid.steps, list(grid.values.items())
    if not bands:
        raise ValueError("the grid has no values to write")
    transform = rasterio.Affine(dx, 0.0, grid.lon[0] - dx / 2, 0.0, -dy, grid.lat[-1] + dy / 2)
    profile = {"driver": "GTiff", "dtype": "float64", "nodata": np.nan, "crs": "EPSG:4326", "transform": transform}
    shape = {"count": len(bands), "height": len(grid.lat), "width": len(grid.lon)}
    # In memory first: GDAL does not report a full disk.
    with rasterio.MemoryFile() as memory:
        with memory.open(**profile, **shape, compress="deflate", predictor=3) as file:
            file.update_tags(AREA_OR_POINT="Area" if grid.centers else "Point")
            for number, (name, values) in enumerate(bands, 1):
                file.write(values[::-1], number)
                file.set_band_description(number, name)
                if name in grid.units:
                    file.set_band_unit(number, grid.units[name])
        path.write_bytes(memory.getbuffer())
