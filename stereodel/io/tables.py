"""Tables of points: longitude, latitude and their other columns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from stereodel._arrays import Column, FloatArray, Indices, as_lonlat, as_points, read_only
from stereodel._extras import optional
from stereodel.io.text import EXACT_INTEGERS, doubles, why_not


@dataclass(frozen=True, eq=False)
class PointTable:
    """Points on the Earth and their other columns, as returned by `read_points` and accepted by `write`.

    Parameters
    ----------
    lonlat : (n, 2) array_like
        Longitude and latitude in degrees, latitude in [−90, 90].
    columns : mapping of str to (n,) array_like, optional
        The other columns by name.
    rows : (n,) array_like of int, optional
        Row number of each point in its source, for messages; the first row of data is 1.

    Attributes
    ----------
    lonlat, columns, rows
        Read-only arrays; `columns` is a read-only mapping.

    Raises
    ------
    ValueError, TypeError
        If a latitude is out of range, a coordinate is not a finite real number, or a column has the wrong length.

    Examples
    --------
    >>> table = PointTable([[13.4, 52.5], [2.4, 48.9]], {"name": ["Berlin", "Paris"]})
    >>> print(len(table), table.columns["name"], table.rows)
    2 ['Berlin' 'Paris'] [1 2]
    """

    lonlat: FloatArray
    columns: Mapping[str, Column] = field(default_factory=dict)
    rows: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))

    def __post_init__(self) -> None:
        lonlat = read_only(as_lonlat(as_points(self.lonlat, 2, "lonlat")))
        given = np.asarray(self.rows, dtype=np.intp)
        rows = given if given.size else np.arange(1, len(lonlat) + 1)
        columns = {str(name): read_only(np.asarray(values)) for name, values in self.columns.items()}
        for name, values in {**columns, "rows": rows}.items():
            if values.ndim < 1 or len(values) != len(lonlat):
                raise ValueError(f"column {name!r} has shape {values.shape}, but there are {len(lonlat)} points")
        object.__setattr__(self, "lonlat", lonlat)
        object.__setattr__(self, "columns", MappingProxyType(columns))
        object.__setattr__(self, "rows", read_only(rows))

    def __len__(self) -> int:
        return len(self.lonlat)

    def __reduce__(self) -> tuple[Any, ...]:  # a read-only mapping cannot be pickled or copied
        return type(self), (self.lonlat, dict(self.columns), self.rows)


def table_of(
    lon: Column,
    lat: Column,
    columns: Mapping[str, Column],
    rows: Indices,
    *,
    crs: str | None = None,
    skip_missing: bool = False,
) -> PointTable:
    """A table from two columns of coordinates, as numbers or text, in degrees or in `crs`, easting first.

    ValueError gives the first row that lacks a place, or has none on the Earth; `skip_missing` leaves out the former.
    """
    names = ("longitude", "latitude") if crs is None else ("easting", "northing")
    pair = list(zip(names, (lon, lat), strict=True))
    lonlat, columns, rows = located(pair, columns, rows, skip_missing=skip_missing, decimal=crs is None)
    return PointTable(degrees(lonlat, crs, rows), columns, rows)


def located(
    pair: Sequence[tuple[str, Column]],
    columns: Mapping[str, Column],
    rows: Indices,
    *,
    skip_missing: bool,
    decimal: bool = False,
) -> tuple[FloatArray, dict[str, Column], Indices]:
    """Two columns of coordinates, each with its name for messages, as places (n, 2), and the other columns.

    With `skip_missing`, rows without a place are left out; for `decimal`, see `doubles`.
    """
    places = np.column_stack([numbers(values, name, rows, gaps=skip_missing, decimal=decimal) for name, values in pair])
    there = ~np.isnan(places).any(axis=1)
    return places[there], {name: np.asarray(values)[there] for name, values in columns.items()}, rows[there]


def degrees(places: FloatArray, crs: str | None, rows: Indices) -> FloatArray:
    """Places in degrees, transformed if `crs` is given; ValueError names the first row with a wrong one."""
    lonlat = places if crs is None else transformed(places, crs, rows)
    endless = np.flatnonzero(~np.isfinite(lonlat).all(axis=1))
    if len(endless):
        raise ValueError(f"row {rows[endless[0]]}: a coordinate is not finite{_more(endless)}")
    outside = np.flatnonzero(np.abs(lonlat[:, 1]) > 90.0)
    if len(outside):
        raise ValueError(
            f"row {rows[outside[0]]}: latitude {lonlat[outside[0], 1]} is outside [-90, 90]{_more(outside)}; "
            "is it the longitude, or not in degrees?"
        )
    return lonlat


def known_crs(crs: str) -> Any:
    """The coordinate system of this name; ValueError if PROJ does not know it."""
    pyproj = optional("pyproj", "geo")
    try:
        return pyproj.CRS(crs)
    except pyproj.exceptions.CRSError as error:
        raise ValueError(f"crs is {crs!r}, which PROJ does not know; give one such as EPSG:25832") from error


def transformed(places: FloatArray, crs: str, rows: Indices) -> FloatArray:
    """Coordinates in another system, easting first, as longitude and latitude."""
    transformer = optional("pyproj", "geo").Transformer.from_crs(known_crs(crs), "EPSG:4326", always_xy=True)
    lonlat = np.column_stack(transformer.transform(*places.T)) if len(places) else places
    lost = np.flatnonzero(~np.isfinite(lonlat).all(axis=1))
    if len(lost):
        x, y = places[lost[0]]
        raise ValueError(f"row {rows[lost[0]]}: ({x}, {y}) has no longitude and latitude in {crs}{_more(lost)}")
    return lonlat


def numbers(
    values: Column,
    name: str,
    rows: Sequence[int] | Indices,
    *,
    gaps: bool = False,
    decimal: bool = False,
    advice: str = "leave such rows out with skip_missing=True",
) -> FloatArray:
    """A column as finite numbers, with NaN for missing ones if `gaps`; ValueError names the first invalid row."""
    array = np.asarray(values)
    if array.dtype.kind in "iuf":
        result = array.astype(np.float64)
        large = np.flatnonzero(np.abs(result) >= EXACT_INTEGERS).tolist() if array.dtype.kind in "iu" else []
        rounded = [place for place in large if int(array[place]) != int(result[place])]
        if rounded:
            said = f"row {rows[rounded[0]]}: the {name} {array[rounded[0]]} is not a double{_more(rounded)}"
            raise ValueError(f"{said}; subtract an origin that all share, or round it yourself")
    else:
        result, wrong = doubles(array, decimal=decimal)
        if wrong.any():
            places = np.flatnonzero(wrong)
            said = str(array[places[0]]).strip()
            raise ValueError(f"row {rows[places[0]]}: the {name} {said!r} {why_not(said)}{_more(places)}")
    bad = np.flatnonzero(np.isinf(result) if gaps else ~np.isfinite(result))
    if len(bad):
        missing = bool(np.isnan(result[bad[0]]))
        what = "is missing" if missing else f"is {result[bad[0]]}, but must be finite"
        raise ValueError(
            f"row {rows[bad[0]]}: the {name} {what}{_more(bad)}; "
            + (advice if missing else "correct or drop such rows first")
        )
    return result


def _more(places: Sequence[int] | Indices) -> str:
    return f" (and {len(places) - 1} more rows like it)" if len(places) > 1 else ""
