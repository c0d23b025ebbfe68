"""Tables of points: their places on the Earth or in a plane, their other columns, and what is said of wrong rows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import BoolArray, Column, FloatArray, Indices, as_choice, as_lonlat, as_points, read_only
from stereodel._extras import optional
from stereodel._notebook import Shown, tabular
from stereodel.io.formats import Content, Wanted
from stereodel.io.formats.columns import EXACT_INTEGERS, doubles, why_not
from stereodel.io.formats.names import beside, left_out, naming, spelled
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

DEGREES: Final = "EPSG:4326"
"""Coordinate system of longitude and latitude."""

AXES: Final = {"sphere": ("lon", "lat"), "plane": ("x", "y")}
"""Names of the coordinates of a surface, unless a table has its own."""


@dataclass(frozen=True, eq=False)
class PointTable(Shown):
    """Points of the Earth or of a plane and their other columns, from `read_points` and for `write`.

    Parameters
    ----------
    places : (n, 2) array_like
        Longitude and latitude in degrees, latitude in [−90, 90]; or coordinates of the plane.
    columns : mapping of str to (n,) array_like, optional
        The other columns by name.
    rows : (n,) array_like of int, optional
        Row number of each point in its source, for messages; the first row of data is 1.
    surface : {"sphere", "plane"}
        What the points are on.
    axes : tuple of str, optional
        Names of the two coordinates, by default lon and lat, or x and y.
    crs : str, optional
        Coordinate reference system of the plane, if it is known. Degrees are those of EPSG:4326.
    name : str
        Name of the source, for messages.

    Attributes
    ----------
    places, columns, rows
        Read-only arrays; `columns` is a read-only mapping.
    surface, axes, crs, name
        As given.

    Raises
    ------
    ValueError, TypeError
        If a latitude is out of range, a coordinate is not a finite real number, or a column has the wrong length.

    Examples
    --------
    >>> table = PointTable([[13.4, 52.5], [2.4, 48.9]], {"name": ["Berlin", "Paris"]})
    >>> print(len(table), table.columns["name"], table.rows)
    2 ['Berlin' 'Paris'] [1 2]
    >>> PointTable([[3500.0, 5400.0]], surface="plane", axes=("east", "north"), crs="EPSG:31467").points()
    array([[3500., 5400.]])
    """

    places: FloatArray
    columns: Mapping[str, Column] = field(default_factory=dict)
    rows: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    surface: Literal["sphere", "plane"] = "sphere"
    axes: tuple[str, ...] = ()
    crs: str | None = None
    name: str = ""
    _mimes = tabular(len, lambda it, k: {"row": it.rows[k]} | {name: its[k] for name, its in it.located().items()})

    def __post_init__(self) -> None:
        axes = self.axes or AXES[as_choice(self.surface, tuple(AXES), "surface")]
        places = as_points(self.places, 2, "places")
        if self.surface == "sphere":
            places = as_lonlat(places, "places")
            if self.crs not in (None, DEGREES):
                raise ValueError(f"crs is {self.crs!r}, but points of the sphere are in degrees, {DEGREES}")
            object.__setattr__(self, "crs", DEGREES)
        given = np.asarray(self.rows, dtype=np.intp)
        rows = given if given.size else np.arange(1, len(places) + 1)
        columns = {str(name): read_only(np.asarray(values)) for name, values in self.columns.items()}
        for name, values in {**columns, "rows": rows}.items():
            if values.ndim < 1 or len(values) != len(places):
                raise ValueError(f"column {name!r} has shape {values.shape}, but there are {len(places)} points")
        object.__setattr__(self, "axes", tuple(axes))
        object.__setattr__(self, "places", read_only(places))
        object.__setattr__(self, "columns", MappingProxyType(columns))
        object.__setattr__(self, "rows", read_only(rows))

    def __len__(self) -> int:
        return len(self.places)

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled or copied
        given = self.places, dict(self.columns), self.rows, self.surface, self.axes, self.crs, self.name
        return type(self), given

    @property
    def lonlat(self) -> FloatArray:
        """(n, 2): longitude and latitude in degrees; ValueError for points of a plane."""
        if self.surface == "plane":
            raise ValueError("the points are those of a plane, not of the sphere; use places")
        return self.places

    def points(self, latitude: Latitude = "spherical") -> FloatArray:
        """Unit vectors (n, 3), or points of the plane (n, 2), as triangulations and diagrams take them.

        Parameters
        ----------
        latitude : {"spherical", "geodetic", "authalic"}
            Kind of latitude on the sphere, see `lonlat_to_xyz`.

        Returns
        -------
        (n, 3) or (n, 2) array
        """
        return self.places if self.surface == "plane" else lonlat_to_xyz(self.places, latitude=latitude)

    def located(self) -> dict[str, Column]:
        """Both coordinates by their names, followed by the other columns; those whose names are taken are renamed."""
        own: dict[str, Column] = dict(zip(self.axes, self.places.T, strict=True))
        return own | beside(own, self.columns)

    def column(self, name: str) -> Column:
        """A column by name; ValueError lists the columns that exist."""
        with naming(self.name):
            if name not in self.columns:
                known = ", ".join(self.columns) or "none besides the coordinates"
                raise ValueError(f"there is no column {name!r}; the columns are {known}")
        return self.columns[name]

    def numbers(self, name: str, *, gaps: bool = True) -> FloatArray:
        """A column of finite numbers, NaN where a cell is empty if `gaps`; ValueError names the first other row."""
        with naming(self.name):
            return numbers(self.column(name), name, self.rows, gaps=gaps)

    def values(self, names: Sequence[str], *, skip_missing: bool = False) -> tuple[FloatArray, PointTable]:
        """Columns of numbers (n, number of names) and their points, without incomplete rows if `skip_missing`."""
        values = np.column_stack([self.numbers(name, gaps=skip_missing) for name in names])
        kept = np.flatnonzero(~np.isnan(values).any(axis=1))
        return values[kept], self.taken(kept)

    def beside(self, results: Mapping[str, Column], *, first: Mapping[str, Column] | None = None) -> PointTable:
        """The same points with more columns: `first` before the others, `results` after them.

        A column of the table whose name is that of a coordinate or of a new column is renamed, with a
        `RenamedColumnWarning`.
        """
        before = dict(first or {})
        columns = before | beside([*self.axes, *before, *results], self.columns) | dict(results)
        return replace(self, columns=columns)

    def taken(self, which: BoolArray | Indices) -> PointTable:
        """Some of the points, by index or mask."""
        columns = {name: values[which] for name, values in self.columns.items()}
        return replace(self, places=self.places[which], columns=columns, rows=self.rows[which])


def located(found: Content, wanted: Wanted, name: str = "") -> PointTable:
    """A table of what was read: places from its geometries, else from two columns, of degrees, `crs` or a plane.

    ValueError gives the first row that lacks a place, or has none on the Earth; `skip_missing` leaves out the former.
    """
    pair = None if wanted.plane else found.places(skip_missing=wanted.skip_missing)
    columns, crs = found.columns(), found.crs
    if pair is None:
        axes, crs = wanted.axes(list(columns)), wanted.crs
        pair = columns[axes[0]], columns[axes[1]]
        columns = {key: values for key, values in columns.items() if key not in axes}
    named = wanted.plane or (("longitude", "latitude") if crs is None else ("easting", "northing"))
    rows = np.arange(1, len(pair[0]) + 1) if found.rows is None else found.rows
    decimal, gaps = wanted.plane is None and crs is None, wanted.skip_missing
    both = zip(named, pair, strict=True)
    places = np.column_stack([numbers(each, axis, rows, gaps=gaps, decimal=decimal) for axis, each in both])
    there = ~np.isnan(places).any(axis=1)
    places, rows = places[there], rows[there]
    kept = {key: np.asarray(values)[there] for key, values in columns.items()}
    if wanted.plane is not None:
        return PointTable(places, kept, rows, "plane", wanted.plane, crs and known_crs(crs).to_string(), name)
    return PointTable(degrees(places, crs, rows), kept, rows, name=name)


def degrees(places: FloatArray, crs: str | None, rows: Sequence[int] | Indices) -> FloatArray:
    """Places in degrees, transformed if `crs` is given; ValueError names the first row with a wrong one."""
    lonlat = places if crs is None else transformed(places, crs, rows)
    _refuse(~np.isfinite(lonlat).all(axis=1), rows, lambda k: "a coordinate is not finite")
    advice = "is it the longitude, or not in degrees?"
    _refuse(np.abs(lonlat[:, 1]) > 90.0, rows, lambda k: f"latitude {lonlat[k, 1]} is outside [-90, 90]", advice)
    return lonlat


def known_crs(crs: str) -> Any:
    """The coordinate system of this name; ValueError if PROJ does not know it."""
    pyproj = optional("pyproj", "geo")
    try:
        return pyproj.CRS(crs)
    except pyproj.exceptions.CRSError as error:
        raise ValueError(
            f"{spelled('crs')} is {crs!r}, which PROJ does not know; give one such as EPSG:25832"
        ) from error


def transformed(places: FloatArray, crs: str, rows: Sequence[int] | Indices) -> FloatArray:
    """Coordinates in another system, easting first, as longitude and latitude."""
    transformer = optional("pyproj", "geo").Transformer.from_crs(known_crs(crs), "EPSG:4326", always_xy=True)
    lonlat = np.column_stack(transformer.transform(*places.T)) if len(places) else places
    lost = ~np.isfinite(lonlat).all(axis=1)
    _refuse(lost, rows, lambda k: f"({places[k, 0]}, {places[k, 1]}) has no longitude and latitude in {crs}")
    return lonlat


def numbers(
    values: Column,
    name: str,
    rows: Sequence[int] | Indices,
    *,
    gaps: bool = False,
    decimal: bool = False,
    advice: str = "",
) -> FloatArray:
    """A column as finite numbers, with NaN for missing ones if `gaps`; ValueError names the first invalid row."""
    array = np.asarray(values)
    if array.dtype.kind in "iuf":
        result = array.astype(np.float64)
        rounded = np.zeros(len(array), dtype=np.bool_)
        for k in np.flatnonzero(np.abs(result) >= EXACT_INTEGERS).tolist() if array.dtype.kind in "iu" else []:
            rounded[k] = int(array[k]) != int(result[k])
        remedy = "subtract an origin that all share, or round it yourself"
        _refuse(rounded, rows, lambda k: f"the {name} {array[k]} is not a double", remedy)
    else:
        result, wrong = doubles(array, decimal=decimal)
        _refuse(wrong, rows, lambda k: f"the {name} {str(array[k]).strip()!r} {why_not(str(array[k]).strip())}")
    remedy = "correct or drop such rows first"
    _refuse(np.isinf(result), rows, lambda k: f"the {name} is {result[k]}, but must be finite", remedy)
    if not gaps:
        _refuse(np.isnan(result), rows, lambda k: f"the {name} is missing", advice or left_out())
    return result


def _refuse(wrong: Any, rows: Sequence[int] | Indices, said: Callable[[int], str], advice: str = "") -> None:
    """A ValueError for the first row that is wrong, how many more there are, and what to do about them."""
    places = np.flatnonzero(wrong)
    if len(places):
        more = f" (and {len(places) - 1} more rows like it)" if len(places) > 1 else ""
        raise ValueError(f"row {rows[places[0]]}: {said(places[0])}{more}{advice and '; '}{advice}")
