"""Values on regular grids of longitude and latitude or of a plane: NetCDF, GeoTIFF, tables, xarray."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import (
    FloatArray,
    as_bounds,
    as_choice,
    as_floats,
    as_lonlat,
    as_scalar,
    as_steps,
    as_vectors,
    read_only,
)
from stereodel._extras import optional
from stereodel._notebook import Displayed, tabular
from stereodel.constants import GRID_ROUNDING, MOST_PLACES
from stereodel.earth import EQUATORIAL_RADIUS_KM, INVERSE_FLATTENING
from stereodel.io.formats.names import DataWarning, beside, spelled
from stereodel.io.table import AXES, DEGREES, PointTable, known_crs

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

LONLAT: Final = {
    "X": {"units": "degrees_east", "standard_name": "longitude", "long_name": "longitude", "axis": "X"},
    "Y": {"units": "degrees_north", "standard_name": "latitude", "long_name": "latitude", "axis": "Y"},
}
"""Its axes, as pyproj describes those of other systems."""

EMPTY: Final = 90.0
"""Degrees without a point from which on a grid leads across the 180th meridian, if that makes it smaller.

Places all over the Earth have a widest gap somewhere, too, and their grid is better one of the usual map.
"""


@dataclass(frozen=True, eq=False)
class Grid(Displayed):
    """Values at the nodes of a regular grid of longitude and latitude, or of a plane, or at the centres of its cells.

    Parameters
    ----------
    lon, lat : (w,), (h,) array_like
        Degrees in equal steps from west to east, above 180 where the grid crosses the 180th meridian, and from south to
        north, in [−90, 90]; in the plane x and y.
    values, units : mapping of str to (h, w) array_like, and of str to str, optional
        Values by name, rows from south to north, NaN where one is missing; and the units of some or all.
    centers : bool
        Whether values belong to cells, with the nodes at their centres.
    surface, axes, crs
        What the grid is on, the names of its coordinates and their coordinate reference system, as in `PointTable`.

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
    >>> Grid.regular(0.5, of=PointTable([[3.2, 50.9], [4.4, 51.1]])).lon.tolist()
    [3.0, 3.5, 4.0, 4.5]
    """

    lon: FloatArray
    lat: FloatArray
    values: Mapping[str, FloatArray] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    centers: bool = False
    surface: Literal["sphere", "plane"] = "sphere"
    axes: tuple[str, ...] = ()
    crs: str | None = None
    _mimes = tabular(
        lambda it: len(it.lat) * len(it.lon),
        lambda it, k: (
            dict(zip(it.axes, (it.lon[k % len(it.lon)], it.lat[k // len(it.lon)]), strict=True))
            | {name: values[k // len(it.lon), k % len(it.lon)] for name, values in it.values.items()}
        ),
    )

    def __post_init__(self) -> None:
        axes = tuple(self.axes) or AXES[as_choice(self.surface, tuple(AXES), "surface")]
        for name in ("lon", "lat"):
            axis = read_only(as_floats(getattr(self, name), name))
            object.__setattr__(self, name, axis)
            if axis.ndim != 1 or not len(axis):
                raise ValueError(f"{name} must have shape (n,) with at least one entry, got {axis.shape}")
            steps = np.diff(axis)
            if len(steps) and (steps.min() <= 0 or np.ptp(steps) > GRID_ROUNDING * steps.max()):
                raise ValueError(f"{name} must grow by equal steps, which go from {steps.min()} to {steps.max()}")
        if self.surface == "sphere":
            as_lonlat(np.column_stack([np.zeros(len(self.lat)), self.lat]), "lat")
            object.__setattr__(self, "crs", DEGREES)
        values = {str(name): read_only(np.asarray(array, dtype=np.float64)) for name, array in self.values.items()}
        for name, array in values.items():
            if array.shape != (shape := (len(self.lat), len(self.lon))):
                raise ValueError(f"values[{name!r}] must have shape {shape}, got {array.shape}")
        unknown = sorted(set(self.units) - set(values))
        if values and unknown:
            raise ValueError(f"units are given for {', '.join(map(repr, unknown))}, which are not among the values")
        object.__setattr__(self, "axes", axes)
        object.__setattr__(self, "values", MappingProxyType(values))

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled or copied
        given = self.lon, self.lat, dict(self.values), self.units, self.centers, self.surface, self.axes, self.crs
        return type(self), given

    @classmethod
    def regular(
        cls,
        spacing: float,
        bounds: npt.ArrayLike | Literal["world"] | None = None,
        *,
        of: PointTable | None = None,
        centers: bool = False,
    ) -> Grid:
        """A grid without values.

        Parameters
        ----------
        spacing : float
            Degrees between neighbours, for the whole Earth a divisor of 180; or units of the plane.
        bounds : (4,) array_like or "world", optional
            (west, south, east, north) in degrees, east below west across the 180th meridian; in the plane (xmin, ymin,
            xmax, ymax). The grid starts at the southwest corner and extends as far as it fits. By default the extent
            of `of`, up to the next multiples of `spacing`; without `of`, "world", the whole Earth.
        of : PointTable, optional
            Points whose plane or sphere, names of coordinates and coordinate system the grid takes.
        centers : bool
            Whether `bounds` are the outer edges of cells, half a step beyond their centres.

        Notes
        -----
        The extent of points of the sphere crosses the 180th meridian where that makes it smaller and at least 90° of
        longitude are empty; a `DataWarning` says so. No meridian is twice in it, and no latitude beyond a pole.
        """
        known: dict[str, Any] = {} if of is None else {"surface": of.surface, "axes": of.axes, "crs": of.crs}
        plane, name, half = known.get("surface") == "plane", spelled("bounds"), 0.5 if centers else 0.0
        if isinstance(bounds, str) or (bounds is None and of is None):
            if as_choice(bounds or "world", ("world",), name) and plane:
                raise ValueError(f"{name} is 'world', which no plane has; give (xmin, ymin, xmax, ymax)")
            steps = as_steps(180.0, spacing, spelled("spacing"))
            step, rows = 180.0 / steps, steps if centers else steps + 1
            _check_places(spacing, 2 * steps, rows)
            lon, lat = (np.arange(low, high, dtype=np.float64) + half for low, high in ((-steps, steps), (0, rows)))
            return cls(lon * step, lat * step - 90.0, centers=centers, **known)
        given: Any = bounds if bounds is not None or of is None else _extent(of, spacing, centers=centers)
        west, south, east, north = as_bounds(given, name) if plane else as_vectors(given, 4, name).tolist()
        if not plane:
            as_lonlat([[west, south], [east, north]], name)
            if not south < north:
                raise ValueError(f"{name} is {(west, south, east, north)}, but south must be below north")
            east = east if east > west else east + 360.0
        sides = ((west, east), (south, north))
        shorter = min(high - low for low, high in sides)
        step = as_scalar(spacing, spelled("spacing"), low=0.0, high=shorter, open_low=True)
        most = 2.0 * MOST_PLACES
        counts = [int(min((high - low) / step + GRID_ROUNDING, most)) + (0 if centers else 1) for low, high in sides]
        _check_places(step, *counts)
        unit, begin = _decimal(step), Decimal(half)
        lon, lat = (
            np.minimum(np.array([float(_decimal(low) + (k + begin) * unit) for k in range(count)]), high)
            for (low, high), count in zip(sides, counts, strict=True)
        )
        return cls(lon, lat, centers=centers, **known)

    @property
    def places(self) -> FloatArray:
        """Coordinates of the nodes, (h, w, 2), rows from south to north."""
        return np.stack(np.meshgrid(self.lon, self.lat), axis=-1)

    @property
    def lonlat(self) -> FloatArray:
        """The same in degrees; ValueError for a grid of a plane."""
        if self.surface == "plane":
            raise ValueError("the grid is one of a plane, not of the sphere; use places")
        return self.places

    def located(self) -> dict[str, FloatArray]:
        """Columns of a table with a row for each node, starting in the southwest."""
        columns = dict(zip(self.axes, self.places.reshape(-1, 2).T, strict=True))
        return columns | {name: values.ravel() for name, values in beside(columns, self.values).items()}

    @property
    def steps(self) -> tuple[float, float]:
        """Distances of neighbours along both axes; along an axis with one node, the size of its cell."""
        lon, lat = (float(axis[-1] - axis[0]) / max(len(axis) - 1, 1) for axis in (self.lon, self.lat))
        return lon or lat or 1.0, lat or lon or 1.0

    def to_xarray(self) -> Any:
        """The values as an xarray.Dataset with the names and units of the CF conventions.

        Examples
        --------
        >>> grid = Grid([0, 1], [0, 1], {"depth": [[1, 2], [3, 4]]}, {"depth": "m"})
        >>> grid.to_xarray()["depth"].attrs["units"]
        'm'
        """
        system, described = WGS84, LONLAT
        if self.surface == "plane":
            crs = self.crs and known_crs(self.crs)
            system = crs.to_cf() if crs else {}
            described = {each.get("axis", ""): each for each in crs.cs_to_cf()} if crs else {}
        coordinates: dict[str, Any] = {}
        variables: dict[str, Any] = {"crs": ((), np.int32(0), system)} if system else {}
        axes = (self.axes[1], self.lat, self.steps[1], "Y"), (self.axes[0], self.lon, self.steps[0], "X")
        for name, places, step, letter in axes:
            attributes = {**described.get(letter, {"axis": letter})}
            if self.centers:
                attributes["bounds"] = f"{name}_bnds"
                edges = np.stack([places - step / 2, places + step / 2], axis=1)
                variables[f"{name}_bnds"] = ((name, "bnds"), edges)
            coordinates[name] = (name, places, attributes)
        named = beside([*variables, *coordinates, "crs", "bnds"], self.values)
        for (given, values), name in zip(self.values.items(), named, strict=True):
            own = {"long_name": given, "grid_mapping": "crs" if system else None, "units": self.units.get(given)}
            variables[name] = (self.axes[::-1], values, {key: each for key, each in own.items() if each is not None})
        dataset = optional("xarray", "grid").Dataset(variables, coordinates, {"Conventions": "CF-1.8"})
        for name, variable in dataset.variables.items():  # in files, values can be missing, and nothing else
            variable.encoding["_FillValue"] = np.nan if name in named else None
        return dataset


def _decimal(value: float) -> Decimal:
    """The number as it is written: multiples of 0.1 are then the doubles nearest to 0.2, 0.3 and so on."""
    return Decimal(repr(float(value)))


def _extent(points: PointTable, spacing: float, *, centers: bool) -> list[float]:
    """Bounds around points, up to the next multiples of a spacing: no meridian twice, no parallel beyond a pole."""
    if not len(points):
        raise ValueError(f"there are no points, whose extent would be that of the grid; give {spelled('bounds')}")
    plane, across = points.surface == "plane", False
    unit = _decimal(as_scalar(spacing, spelled("spacing"), low=0.0, high=np.inf if plane else 180.0, open_low=True))
    low, high = points.places.min(axis=0), points.places.max(axis=0)
    if not plane:
        lon = points.places[:, 0]
        lon = np.sort(np.where(np.abs(lon) > 180.0, (lon + 180.0) % 360.0 - 180.0, lon))
        gaps = np.append(np.diff(lon), 0.0)
        k = int(np.argmax(gaps))
        across = bool(gaps[k] >= EMPTY and gaps[k] > 360.0 - (lon[-1] - lon[0]))
        low[0], high[0] = (lon[k + 1], lon[k] + 360.0) if across else (lon[0], lon[-1])
    west, south = ((_decimal(value) / unit).to_integral_value(ROUND_FLOOR) * unit for value in low)
    east, north = ((_decimal(value) / unit).to_integral_value(ROUND_CEILING) * unit for value in high)
    east, north = max(east, west + unit), max(north, south + unit)
    if not plane:
        east = min(east, west + 360 - (0 if centers else unit))
        north = min(north, Decimal(90))
        south = max(min(south, north - unit), Decimal(-90))
    bounds = [float(west), float(south), float(east), float(north)]
    if across and east > 180:
        bounds[2] -= 360.0
        same = f"{spelled('bounds')}={','.join(f'{end:.15g}' for end in bounds)} says the same"
        said = f"the points lie on both sides of the 180th meridian, and so does the grid; {same}"
        warnings.warn(said, DataWarning, stacklevel=3)
    return bounds


def _check_places(spacing: float, columns: int, rows: int) -> None:
    """A ValueError for a grid that no memory holds."""
    if columns * rows > MOST_PLACES:
        made = f"a grid of {columns} × {rows} places; {MOST_PLACES} are the most"
        raise ValueError(f"{spelled('spacing')} is {spacing:g}, which makes {made}")


def write_geotiff(grid: Any, path: Path) -> None:
    """Write a grid as a GeoTIFF, one band for each name; rows from north to south, as in images."""
    if not isinstance(grid, Grid):
        raise TypeError(f"thing must be a Grid for a GeoTIFF, not {type(grid).__name__}")
    rasterio = optional("rasterio", "raster")
    (dx, dy), bands = grid.steps, list(grid.values.items())
    if not bands:
        raise ValueError("the grid has no values to write")
    transform = rasterio.Affine(dx, 0.0, grid.lon[0] - dx / 2, 0.0, -dy, grid.lat[-1] + dy / 2)
    profile = {"driver": "GTiff", "dtype": "float64", "nodata": np.nan, "crs": grid.crs, "transform": transform}
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
