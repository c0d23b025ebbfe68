"""Input points: tables in files or on stdin, with longitudes and latitudes or plane coordinates."""

from __future__ import annotations

import sys
from collections.abc import Collection
from dataclasses import dataclass
from typing import Final

import numpy as np

from stereodel import lonlat_to_xyz
from stereodel._arrays import BoolArray, Column, FloatArray, Indices
from stereodel.cli.application import reporting
from stereodel.cli.failures import NothingToDoError, naming_options
from stereodel.cli.options import Latitude
from stereodel.io import read_points
from stereodel.io.columns import beside
from stereodel.io.reading import naming, read_plane_points
from stereodel.io.tables import known_crs
from stereodel.io.text import doubles, why_not

Columns = dict[str, Column]

LONLAT = ("lon", "lat")

SECOND: Final = {"lon": "lon", "lat": "lat", "layer": "layer-name", "crs": "crs"}
"""Ends of the names of options that a second table has of its own, by the arguments of `read`."""


@dataclass(frozen=True, eq=False)
class Table:
    """Points and the other columns of their table, as the commands read them.

    A `stereodel.io.PointTable` is what the library reads and writes: checked degrees, without a source. Here places may
    be in the plane, and messages and results need the names of the file and of the axes.
    """

    name: str
    places: FloatArray
    """(n, 2): longitude and latitude in degrees, or plane coordinates."""
    axes: tuple[str, str]
    columns: Columns
    """The other columns by name, (n,) each."""
    rows: Indices
    """(n,): number of each point's row in the table, from 1."""
    crs: str | None = "EPSG:4326"
    """That of plane coordinates, if known."""

    def __len__(self) -> int:
        return len(self.places)

    @property
    def planar(self) -> bool:
        """Whether these are plane coordinates."""
        return self.axes != LONLAT

    def points(self, latitude: Latitude) -> FloatArray:
        """Points of the plane (n, 2), or unit vectors (n, 3)."""
        return self.places if self.planar else lonlat_to_xyz(self.places, latitude=latitude.value)

    def column(self, name: str) -> Column:
        """A column by name, or an error that lists the columns that exist."""
        if name not in self.columns:
            known = ", ".join(self.columns) or "none besides the coordinates"
            raise ValueError(f"{self.name}: there is no column {name!r}; the columns are {known}")
        return self.columns[name]

    def numbers(self, name: str) -> FloatArray:
        """A column of numbers, NaN where a cell is empty; an error names the first row that holds text."""
        column = self.column(name)
        if column.dtype.kind in "iuf":
            return column.astype(np.float64)
        values, wrong = doubles(column)
        if wrong.any():
            row = np.flatnonzero(wrong)[0]
            said = str(column.tolist()[row]).strip()
            raise ValueError(f"{self.name}: row {self.rows[row]}: the {name} {said!r} {why_not(said)}")
        return values

    def values(self, names: list[str], *, skip_missing: bool) -> tuple[FloatArray, Table]:
        """Columns of numbers (n, number of names) and their points, without incomplete rows if `skip_missing`."""
        values = np.column_stack([self.numbers(name) for name in names])
        missing = np.argwhere(~np.isfinite(values))
        if len(missing) and not skip_missing:
            row, column = missing[0]
            raise ValueError(
                f"{self.name}: row {self.rows[row]}: {names[column]} is missing; "
                "leave such rows out with --skip-missing"
            )
        kept = np.ones(len(values), dtype=np.bool_)
        kept[missing[:, 0]] = False
        return values[kept], self.taken(kept)

    def beside(self, results: Columns, *, first: Columns | None = None, taken: Collection[str] = ()) -> Columns:
        """The places, `first`, the other columns of the table, and `results`, all under distinct names.

        Names of places, new columns and those in `taken` are kept; a column of the table with one of them is renamed,
        with a message.
        """
        own: Columns = dict(zip(self.axes, self.places.T, strict=True)) | dict(first or {})
        return own | beside([*own, *results, *taken], self.columns) | results

    def taken(self, which: BoolArray | Indices) -> Table:
        """Some of the points, by index or mask."""
        columns = {name: values[which] for name, values in self.columns.items()}
        return Table(self.name, self.places[which], self.axes, columns, self.rows[which], self.crs)


def read(
    name: str,
    *,
    lon: str | None = None,
    lat: str | None = None,
    plane: tuple[str, str] | None = None,
    layer: str | None = None,
    crs: str | None = None,
    skip_missing: bool = False,
) -> Table:
    """The table in a file, or on stdin if `name` is "-"; raises NothingToDoError for a table without points."""
    shown = "stdin" if name == "-" else name
    source = sys.stdin.buffer if name == "-" else name
    with reporting(f"reading {shown}") as told, naming(shown if name == "-" else None):
        if plane is not None:
            places, columns, rows = read_plane_points(
                source, *plane, layer=layer, skip_missing=skip_missing, progress=told
            )
            table = Table(shown, places, plane, columns, rows, crs and known_crs(crs).to_string())
        else:
            found = read_points(
                source, lon=lon, lat=lat, layer=layer, crs=crs, skip_missing=skip_missing, progress=told
            )
            table = Table(shown, found.lonlat, LONLAT, dict(found.columns), found.rows)
    if len(table) == 0:
        raise NothingToDoError(f"{shown}: there are no points")
    return table


def read_second(
    name: str,
    option: str,
    *,
    lon: str | None,
    lat: str | None,
    layer: str | None,
    crs: str | None,
    first_crs: str | None,
    plane: tuple[str, str] | None,
    skip_missing: bool,
) -> Table:
    """The table that an option such as ``--at`` names, with options of its own: ``--at-lon`` and so on.

    In a plane both tables have the columns that ``--plane`` names, and the coordinate system of the first one where the
    second has none of its own.
    """
    own = {key: f"{option}-{ending}" for key, ending in SECOND.items()}
    crs = crs or (first_crs if plane else None)
    with naming_options(**own):
        return read(name, lon=lon, lat=lat, plane=plane, layer=layer, crs=crs, skip_missing=skip_missing)
