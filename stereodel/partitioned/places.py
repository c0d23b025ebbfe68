"""Places: how a row of a table says where its point is, and columns of Arrow as points."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import FloatArray, Indices, as_directions, as_points
from stereodel._extras import optional
from stereodel.io.formats import wkb
from stereodel.io.formats.names import find_lonlat, listed, spelled
from stereodel.io.located import degrees, numbers, transformed
from stereodel.sphere import lonlat_to_xyz
from stereodel.sphere.latitudes import Latitude

Surface = Literal["sphere", "plane"]
SURFACES: Final[tuple[Surface, ...]] = ("sphere", "plane")

Form = Literal["lonlat", "xyz", "xy", "wkb", "point"]
"""Columns of degrees, of a direction, of the plane; one of geometries, in binary or as pairs of numbers."""

DEGREES: Final = ("EPSG:4326", "OGC:CRS84")
"""Coordinate systems of geometries that are longitude and latitude in degrees without transformation."""


@dataclass(frozen=True)
class Places:
    """Which columns say where a row's point is.

    form: degrees, directions, the plane; geometries of GeoParquet as binary or as pairs of numbers.
    names: names of the columns: two, three, or one of geometries.
    latitude: kind of latitude on the sphere, as in `lonlat_to_xyz`.
    crs: coordinate system of geometries that are not in degrees, in any form that PROJ accepts; sphere only.
    """

    form: Form
    names: tuple[str, ...]
    surface: Surface
    latitude: Latitude
    crs: str | None = None

    @property
    def width(self) -> int:
        """Coordinates of a point: three on the sphere, two in the plane."""
        return 3 if self.surface == "sphere" else 2

    def points(self, table: Any, first: int = 0) -> FloatArray:
        """Points of the rows of a table of Arrow: unit vectors or directions (n, 3), or places of the plane (n, 2).

        table: with the columns `names`, at least.
        first: rows of the file before it.
        Raises ValueError if a row is not a point; the message gives the first such row, counted from 1, and its value.
        Raises TypeError if a column holds no numbers, or no geometries.
        """
        rows = range(first + 1, first + 1 + table.num_rows)
        if self.form in ("wkb", "point"):
            geometries = _whole(table[self.names[0]])
            places = wkb_places(geometries, rows) if self.form == "wkb" else _pairs(geometries, self.names[0], rows)
            columns = list(places.T)
        else:
            columns = [doubles_of(table[name], name, rows) for name in self.names]
        try:
            return self._points(columns)
        except ValueError:
            self._refuse(columns, np.array(rows))
            raise

    def _points(self, columns: Sequence[FloatArray]) -> FloatArray:
        places = np.column_stack(columns)
        if self.surface == "plane":
            return as_points(places, 2, "points")
        if self.form == "xyz":
            return as_directions(places, "points", points=True)
        if self.crs is not None:
            places = transformed(places, self.crs, np.arange(1, len(places) + 1))
        return lonlat_to_xyz(places, latitude=self.latitude, workers=1)

    def _refuse(self, columns: Sequence[FloatArray], rows: Indices) -> None:
        """Say which row is wrong; nothing if all are right, one by one."""
        on_earth = self.surface == "sphere" and self.form != "xyz"
        names: Sequence[str] = self.names if len(self.names) == len(columns) else ("x", "y")
        if on_earth:
            names = ("longitude", "latitude") if self.crs is None else ("easting", "northing")
        advice = "leave such rows out"
        pairs = zip(columns, names, strict=True)
        places = np.column_stack([numbers(column, name, rows, advice=advice) for column, name in pairs])
        if on_earth:
            degrees(places, self.crs, rows)
        zero = np.flatnonzero(~places.any(axis=1))
        if self.form == "xyz" and len(zero):
            raise ValueError(f"row {rows[zero[0]]}: is the zero vector, which has no direction")


def find_places(
    schema: Any, columns: Sequence[str] | None, surface: Surface, latitude: Latitude, *, geometry: bool = True
) -> Places:
    """Which columns of a file are places: those that the caller names, else what the file says, else by their names.

    schema: schema of the first file.
    columns: names that the caller gives: (longitude, latitude) or (x, y, z) on the sphere, (x, y) in the plane; one
    name is that of a column of geometries.
    surface, latitude: as in `Places`.
    geometry: whether the geometries of a GeoParquet file count where no names are given.
    Raises ValueError listing the columns, where a name is not among them, or none or several look like longitude and
    latitude.
    """
    names, geo = list(schema.names), _geo(schema)
    if columns is None and geo and geometry:
        return _of_geometries(schema, geo, geo["primary_column"], surface, latitude)
    given = _guessed(names, surface) if columns is None else tuple(columns)
    missing = [name for name in given if name not in names]
    if missing:
        raise ValueError(f"{spelled('columns')} has {missing[0]!r}, which is not one of the columns {listed(names)}")
    if len(given) == 1 and given[0] in geo.get("columns", {}):
        return _of_geometries(schema, geo, given[0], surface, latitude)
    forms: dict[tuple[Surface, int], Form] = {("sphere", 2): "lonlat", ("sphere", 3): "xyz", ("plane", 2): "xy"}
    if (surface, len(given)) not in forms:
        wanted = "(longitude, latitude) or (x, y, z)" if surface == "sphere" else "(x, y)"
        raise ValueError(f"columns has {len(given)} names, but on the {surface} a place has {wanted}")
    return Places(forms[surface, len(given)], given, surface, latitude)


def _guessed(names: Sequence[str], surface: Surface) -> tuple[str, ...]:
    lower = {name.strip().lower(): name for name in names}
    if surface == "plane":
        if not {"x", "y"} <= lower.keys():
            raise ValueError(f"no columns are named x and y; name two with columns=, the columns are {listed(names)}")
        return lower["x"], lower["y"]
    if {"x", "y", "z"} <= lower.keys():
        others = [name for name in names if name.strip().lower() not in ("x", "y", "z")]
        try:
            return find_lonlat(others)
        except ValueError:
            return lower["x"], lower["y"], lower["z"]
    return find_lonlat(names)


def _geo(schema: Any) -> Mapping[str, Any]:
    """What GeoParquet says in the metadata of a file; empty for plain Parquet."""
    text = (schema.metadata or {}).get(b"geo")
    return json.loads(text) if text else {}


def _of_geometries(schema: Any, geo: Mapping[str, Any], name: str, surface: Surface, latitude: Latitude) -> Places:
    told = geo["columns"][name]
    encoding = str(told.get("encoding", "WKB")).lower()
    if encoding not in ("wkb", "point"):
        raise ValueError(f"the geometries {name!r} are {told['encoding']}, but points are needed; take e.g. centroids")
    crs = _crs_of(told) if surface == "sphere" else None
    return Places("wkb" if encoding == "wkb" else "point", (name,), surface, latitude, crs)


def _crs_of(told: Mapping[str, Any]) -> str | None:
    """A coordinate system other than degrees; GeoParquet's default is OGC:CRS84."""
    crs = told.get("crs")
    if crs is None:
        return None
    known = crs.get("id", {})
    return None if f"{known.get('authority')}:{known.get('code')}" in DEGREES else json.dumps(crs)


def wkb_places(column: Any, rows: Sequence[int] | None = None) -> FloatArray:
    """Coordinates (n, 2) of points in well-known binary.

    Raises ValueError for a row without a geometry, or with another than a point.
    Raises TypeError for a column of something else.

    >>> import pyarrow, struct
    >>> wkb_places(pyarrow.array([struct.pack("<BIdd", 1, 1, 8.5, 47.4)])).tolist()
    [[8.5, 47.4]]
    """
    numbered = range(1, len(column) + 1) if rows is None else rows
    pyarrow = optional("pyarrow", "partitioned")
    if not (pyarrow.types.is_binary(column.type) or pyarrow.types.is_large_binary(column.type)):
        raise TypeError(f"the geometries are {column.type}, not well-known binary")
    _refuse_gaps(column, numbered)
    if not len(column):
        return np.empty((0, 2))
    plain = column.cast(pyarrow.large_binary())
    _, offsets, values = plain.buffers()
    starts = np.frombuffer(offsets, np.int64)[plain.offset : plain.offset + len(plain) + 1]
    return wkb.xy(np.frombuffer(values, np.uint8), starts, numbered)


def _pairs(column: Any, name: str, rows: Sequence[int]) -> FloatArray:
    """Coordinates of points that are stored as structures or lists of two numbers."""
    types = optional("pyarrow", "partitioned").types
    _refuse_gaps(column, rows)
    if types.is_struct(column.type):
        return np.column_stack([doubles_of(column.field(axis), f"{name}.{axis}", rows) for axis in ("x", "y")])
    if not types.is_fixed_size_list(column.type) or column.type.list_size < 2:
        raise TypeError(f"the geometries {name!r} are {column.type}, not points")
    flat = column.flatten()
    size = column.type.list_size
    return np.column_stack([doubles_of(flat[axis::size], name, rows) for axis in range(2)])


def _refuse_gaps(column: Any, rows: Sequence[int]) -> None:
    if column.null_count:
        row = rows[int(np.flatnonzero(column.is_null().to_numpy(zero_copy_only=False))[0])]
        raise ValueError(f"row {row}: a Point is needed, not no geometry; leave such rows out")


def _whole(column: Any) -> Any:
    """A column without chunks."""
    return column.combine_chunks() if hasattr(column, "chunks") else column


def doubles_of(column: Any, name: str, rows: Sequence[int], *, gaps: bool = False) -> FloatArray:
    """A column of numbers as doubles, NaN where there is none; all of them may be missing if `gaps`.

    Raises TypeError for what NumPy would make numbers of: booleans, times, text, bytes.
    Raises ValueError for a whole number that no double equals, naming its row.
    """
    types, column = optional("pyarrow", "partitioned").types, _whole(column)
    if types.is_dictionary(column.type):
        column = column.dictionary_decode()
    if types.is_floating(column.type):
        return np.asarray(column.to_numpy(zero_copy_only=False), dtype=np.float64)
    if types.is_decimal(column.type) or (gaps and types.is_null(column.type)):
        return np.array([np.nan if cell is None else float(cell) for cell in column.to_pylist()])
    if not types.is_integer(column.type):
        raise TypeError(f"the column {name!r} holds {column.type}, not numbers")
    there = column.is_valid().to_numpy(zero_copy_only=False)
    return np.where(there, numbers(column.fill_null(0).to_numpy(), name, rows), np.nan)
