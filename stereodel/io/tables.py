"""Tables of points: longitude, latitude and whatever else came with them."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

from stereodel._arrays import Column, FloatArray, Indices, as_lonlat, as_points, read_only


@dataclass(frozen=True, eq=False)
class PointTable:
    """Points of the Earth with their other columns, as `read_points` gives them and `write` takes them.

    Parameters
    ----------
    lonlat : (n, 2) array_like
        Longitude and latitude in degrees, latitude in [−90, 90].
    columns : mapping of str to (n,) array_like, optional
        The other columns by name.
    rows : (n,) array_like of int, optional
        The number of each point's row in its source, for messages; the first row of data is 1.

    Attributes
    ----------
    lonlat, columns, rows
        Read-only arrays; `columns` a read-only mapping.

    Raises
    ------
    ValueError, TypeError
        For latitudes out of range, values that are not finite real numbers, and columns of another length.

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


def table_of(lon: Column, lat: Column, columns: Mapping[str, Column], rows: Indices) -> PointTable:
    """A table of two columns of coordinates, numbers or text; what is wrong is told with the number of its row.

    Raises
    ------
    ValueError
        Naming the first row whose longitude or latitude is missing, not a number, or out of range.
    """
    lonlat = np.column_stack([numbers(lon, "longitude", rows), numbers(lat, "latitude", rows)])
    outside = np.flatnonzero(np.abs(lonlat[:, 1]) > 90.0)
    if len(outside):
        raise ValueError(
            f"row {rows[outside[0]]}: latitude {lonlat[outside[0], 1]} is outside [-90, 90]{_more(outside)}; "
            "is it the longitude, or not in degrees?"
        )
    return PointTable(lonlat, columns, rows)


def numbers(values: Column, name: str, rows: Indices) -> FloatArray:
    """A column as finite numbers, or a ValueError that names the first row that has none."""
    array = np.asarray(values)
    if array.dtype.kind not in "iuf":
        array = _parsed(array, name, rows)
    result = array.astype(np.float64)
    bad = np.flatnonzero(~np.isfinite(result))
    if len(bad):
        what = "is missing" if np.isnan(result[bad[0]]) else f"is {result[bad[0]]}, but must be finite"
        raise ValueError(f"row {rows[bad[0]]}: the {name} {what}{_more(bad)}; drop or fill such rows first")
    return result


def _parsed(array: Column, name: str, rows: Indices) -> FloatArray:
    """Text as numbers, NaN where it is empty; a comma may be the decimal sign."""
    if array.dtype.kind == "U":
        with suppress(ValueError):
            return array.astype(np.float64)
    text = np.array(["" if value is None else str(value).strip() for value in array.tolist()], dtype=np.str_)
    text = np.where(np.isin(np.char.lower(text), MISSING), "nan", text)
    for form in (text, np.char.replace(text, ",", ".")):
        try:
            return form.astype(np.float64)
        except ValueError:
            continue
    wrong = np.array([not _is_number(value) for value in text.tolist()]).nonzero()[0]
    raise ValueError(f"row {rows[wrong[0]]}: the {name} {str(text[wrong[0]])!r} is not a number{_more(wrong)}")


MISSING = ["", "na", "n/a", "nan", "null", "none", "<na>", "-"]
"""What stands for no value, in any case."""


def _is_number(text: str) -> bool:
    try:
        float(text.replace(",", "."))
    except ValueError:
        return False
    return True


def _more(places: Column) -> str:
    return f" (and {len(places) - 1} more rows like it)" if len(places) > 1 else ""
