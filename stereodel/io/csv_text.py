"""Tables as text, by the csv module: separators and headers are found out, columns of numbers become numbers."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from typing import TextIO

import numpy as np

from stereodel._arrays import Column, Indices
from stereodel.io.columns import find_lonlat
from stereodel.io.tables import MISSING, PointTable, table_of

SEPARATORS = ",;\t|"
LOOKED_AT = 50
"""Lines from which the separator is found."""
BLOCK = 20_000
"""Rows that are taken apart at once."""

Rows = list[list[str]]


def read_csv(text: str, *, lon: str | None = None, lat: str | None = None) -> PointTable:
    """Points of a table as text, its columns separated by commas, semicolons, tabs, bars or blanks."""
    table, numbers = split_columns(text)
    where = find_lonlat(list(table), lon, lat)
    columns = {name: typed(values) for name, values in table.items() if name not in where}
    return table_of(table[where[0]], table[where[1]], columns, numbers)


def split_columns(text: str) -> tuple[dict[str, Column], Indices]:
    """Columns of a table as text by name, and the numbers of its rows."""
    rows = (row for row in _split(text) if any(row) and (len(row) > 1 or row[0].strip()))
    first = next(rows, None)
    if first is None:
        raise ValueError("the table is empty: there is not even a line with the names of the columns")
    names, data = _header(first)
    # In blocks: a million lists at once keep the interpreter's collector of garbage busy.
    blocks = [_columns(data, len(names), 0)]
    while block := list(islice(rows, BLOCK)):
        blocks.append(_columns(block, len(names), sum(len(columns[0]) for columns in blocks)))
    table = {name: np.concatenate(parts) for name, parts in zip(names, zip(*blocks, strict=True), strict=True)}
    return table, np.arange(1, len(table[names[0]]) + 1)


def _columns(rows: Rows, width: int, before: int) -> list[Column]:
    """Rows of text as columns; `before` is how many rows of data came earlier."""
    for number, row in enumerate(rows, before + 1):
        if len(row) != width:
            raise ValueError(f"row {number} has {len(row)} fields, but there are {width} columns")
    return [np.array(column) for column in zip(*rows, strict=True)] or [np.zeros(0, dtype="<U1")] * width


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


def _header(row: list[str]) -> tuple[list[str], Rows]:
    """Names of the columns, and the row if it is data; two columns without names are longitude and latitude."""
    first = [field.strip() for field in row]
    if any(_NUMBER.fullmatch(field) for field in first):
        names = [f"column_{k}" for k in range(1, len(first) + 1)]
        return (["lon", "lat"] if len(first) == 2 else names), [row]
    repeated = sorted({name for name in first if first.count(name) > 1})
    if repeated:
        raise ValueError(f"there are several columns with the name {', '.join(map(repr, repeated))}")
    return first, []


_NUMBER = re.compile(r"[-+]?(\d+[.,]?\d*|[.,]\d+)([eE][-+]?\d+)?")


def typed(values: Sequence[str] | Column) -> Column:
    """A column of text as integers or floating-point numbers, where all values are; empty ones are NaN.

    Digits after a leading zero are a code, not a number.
    """
    text = np.asarray(values, dtype=np.str_)
    if not _has_codes(text):
        for kind in (np.int64, np.float64):
            try:
                return text.astype(kind)
            except (ValueError, OverflowError):
                continue
    text = np.char.strip(text)
    if _has_codes(text):
        return text
    try:
        return np.where(np.isin(np.char.lower(text), MISSING), "nan", text).astype(np.float64)
    except ValueError:
        return text


def _has_codes(text: Column) -> bool:
    """Whether a value begins with a zero and another digit, a sign before them or not."""
    if not text.size or text.dtype.itemsize < 8:
        return False
    letters = np.ascontiguousarray(text).view("<U1").reshape(len(text), -1)
    signed = np.isin(letters[:, 0], ["+", "-"])
    first = np.where(signed, letters[:, 1], letters[:, 0])
    second = np.where(signed, letters[:, min(2, letters.shape[1] - 1)], letters[:, 1])
    return bool(((first == "0") & (second >= "0") & (second <= "9")).any())


def write_csv(columns: Mapping[str, Column], stream: TextIO) -> None:
    """Columns with a line of their names, numbers with as many digits as it takes to read the same ones back."""
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(np.asarray(values).tolist() for values in columns.values()), strict=True))
