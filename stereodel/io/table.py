"""Tables of points: their places on the Earth or in a plane, and their other columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import BoolArray, Column, FloatArray, Indices, as_choice, as_lonlat, as_points, read_only
from stereodel.io.formats.columns import doubles, why_not
from stereodel.io.formats.names import beside, left_out
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

DEGREES: Final = "EPSG:4326"
"""Coordinate system of longitude and latitude."""

AXES: Final = {"sphere": ("lon", "lat"), "plane": ("x", "y")}
"""Names of the coordinates of a surface, unless a table has its own."""


@dataclass(frozen=True, eq=False)
class PointTable:
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
        if name not in self.columns:
            known = ", ".join(self.columns) or "none besides the coordinates"
            raise ValueError(self._said(f"there is no column {name!r}; the columns are {known}"))
        return self.columns[name]

    def numbers(self, name: str) -> FloatArray:
        """A column of numbers, NaN where a cell is empty; ValueError names the first row that holds text."""
        column = self.column(name)
        if column.dtype.kind in "iuf":
            return column.astype(np.float64)
        values, wrong = doubles(column)
        if wrong.any():
            row = np.flatnonzero(wrong)[0]
            said = str(column.tolist()[row]).strip()
            raise ValueError(self._said(f"row {self.rows[row]}: the {name} {said!r} {why_not(said)}"))
        return values

    def values(self, names: Sequence[str], *, skip_missing: bool = False) -> tuple[FloatArray, PointTable]:
        """Columns of numbers (n, number of names) and their points, without incomplete rows if `skip_missing`.

        ValueError names the first row where a number is missing.
        """
        values = np.column_stack([self.numbers(name) for name in names])
        missing = np.argwhere(~np.isfinite(values))
        if len(missing) and not skip_missing:
            row, column = missing[0]
            raise ValueError(self._said(f"row {self.rows[row]}: {names[column]} is missing; {left_out()}"))
        kept = np.ones(len(values), dtype=np.bool_)
        kept[missing[:, 0]] = False
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

    def _said(self, message: str) -> str:
        return f"{self.name}: {message}" if self.name else message
