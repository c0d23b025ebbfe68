"""Places: which columns or geometries say where a point is, and what is said of rows that have none."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from stereodel._arrays import Column, FloatArray, Indices
from stereodel._extras import optional
from stereodel.io.formats import Content, Wanted
from stereodel.io.formats.columns import EXACT_INTEGERS, doubles, why_not
from stereodel.io.formats.names import left_out, spelled
from stereodel.io.table import PointTable


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
        raise ValueError(
            f"{spelled('crs')} is {crs!r}, which PROJ does not know; give one such as EPSG:25832"
        ) from error


def transformed(places: FloatArray, crs: str, rows: Sequence[int] | Indices) -> FloatArray:
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
    advice: str = "",
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
            + ((advice or left_out()) if missing else "correct or drop such rows first")
        )
    return result


def _more(places: Sequence[int] | Indices) -> str:
    return f" (and {len(places) - 1} more rows like it)" if len(places) > 1 else ""
