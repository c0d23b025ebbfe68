"""Tables as text, by the csv module: separators and headers are found out, columns of numbers become numbers."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TextIO

import numpy as np
import numpy.typing as npt

from stereodel.io.columns import find_lonlat
from stereodel.io.tables import MISSING, Column, PointTable, table_of

SEPARATORS = ",;\t|"
LOOKED_AT = 50
"""Lines from which the separator is found."""

Rows = list[list[str]]


def read_csv(text: str, *, lon: str | None = None, lat: str | None = None) -> PointTable:
    """Points of a table as text, its columns separated by commas, semicolons, tabs, bars or blanks."""
    table, numbers = split_columns(text)
    where = find_lonlat(list(table), lon, lat)
    columns = {name: typed(values) for name, values in table.items() if name not in where}
    return table_of(table[where[0]], table[where[1]], columns, numbers)


def split_columns(text: str) -> tuple[dict[str, Column], npt.NDArray[np.intp]]:
    """Columns of a table as text by name, and the numbers of its rows."""
    rows = [row for row in _split(text) if any(field.strip() for field in row)]
    if not rows:
        raise ValueError("the table is empty: there is not even a line with the names of the columns")
    names, rows = _header(rows)
    numbers = np.arange(1, len(rows) + 1)
    wrong = next((k for k, row in enumerate(rows) if len(row) != len(names)), None)
    if wrong is not None:
        raise ValueError(f"row {numbers[wrong]} has {len(rows[wrong])} fields, but there are {len(names)} columns")
    fields = map(np.array, zip(*rows, strict=True)) if rows else (np.zeros(0) for _ in names)
    return dict(zip(names, fields, strict=True)), numbers


def _split(text: str) -> Iterable[list[str]]:
    """Rows of fields: by the separator that gives all the first lines the same number, the largest one."""
    lines = text.splitlines()[:LOOKED_AT]
    lengths = {mark: _lengths(lines, mark) for mark in SEPARATORS}
    several = [mark for mark in SEPARATORS if max(lengths[mark], default=0) > 1]
    even = [mark for mark in several if len(lengths[mark]) == 1]
    blanks = {len(line.split()) for line in lines if line.strip()}
    if not several or (not even and len(blanks) == 1 and blanks != {1}):
        return (line.split() for line in text.splitlines())
    mark = max(even or several, key=lambda mark: max(lengths[mark]))
    return csv.reader(io.StringIO(text, newline=""), delimiter=mark)


def _lengths(lines: list[str], mark: str) -> set[int]:
    """How many fields lines have, without the last one, which may end amid a quoted field."""
    lengths = [len(row) for row in csv.reader(lines, delimiter=mark) if row]
    return set(lengths[:-1] or lengths)


def _header(rows: Rows) -> tuple[list[str], Rows]:
    """Names of the columns and the rows of data; two columns of numbers without names are longitude and latitude."""
    first = [field.strip() for field in rows[0]]
    if any(_NUMBER.fullmatch(field) for field in first):
        names = [f"column_{k}" for k in range(1, len(first) + 1)]
        return (["lon", "lat"] if len(first) == 2 else names), rows
    repeated = sorted({name for name in first if first.count(name) > 1})
    if repeated:
        raise ValueError(f"there are several columns with the name {', '.join(map(repr, repeated))}")
    return first, rows[1:]


_NUMBER = re.compile(r"[-+]?(\d+[.,]?\d*|[.,]\d+)([eE][-+]?\d+)?")
_CODE = re.compile(r"[-+]?0\d")


def typed(values: Sequence[str] | Column) -> Column:
    """A column of text as integers or floating-point numbers, where all values are; empty ones are NaN.

    Digits after a leading zero are a code, not a number.
    """
    text = np.char.strip(np.asarray(values, dtype=np.str_))
    if any(map(_CODE.match, text.tolist())):
        return text
    try:
        return text.astype(np.int64)
    except (ValueError, OverflowError):
        pass
    try:
        return np.where(np.isin(np.char.lower(text), MISSING), "nan", text).astype(np.float64)
    except ValueError:
        return text


def write_csv(columns: Mapping[str, Column], stream: TextIO) -> None:
    """Columns with a line of their names, numbers with as many digits as it takes to read the same ones back."""
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(np.asarray(values).tolist() for values in columns.values()), strict=True))
