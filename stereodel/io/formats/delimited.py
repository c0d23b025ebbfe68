"""Text tables, read by the csv module: separator and header are detected, columns of numbers become numbers."""

from __future__ import annotations

import csv
import io
import re
import warnings
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from itertools import islice
from types import SimpleNamespace
from typing import Any, TextIO

import numpy as np

from stereodel._arrays import Column, Indices
from stereodel._tasks.progress import Progress
from stereodel.constants import MOST_COLUMNS, MOST_LINE
from stereodel.io.formats import Content, FileFormat, Input, Wanted
from stereodel.io.formats.columns import (
    EXACT_INTEGERS,
    NUMBER,
    as_text,
    check_held,
    decimal_mark,
    decoded,
    objects,
    plain_cells,
    texts,
    typed,
    why_not,
)
from stereodel.io.formats.names import DataWarning, has_lonlat, listed

SEPARATORS = ",;\t|"
LOOKED_AT = 50
"""Number of lines from which the separator is detected."""
BLOCK = 20_000
"""Rows that are split in one block."""
COMMENTS = re.compile(r"(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|\Z))+")
"""Comment lines at the top, which begin with a hash."""

Lines = list[list[str]]


def read(file: Input, wanted: Wanted) -> Content:
    """A table of text; columns whose values are all numbers become numeric, but for degrees."""
    named = [name for name in wanted.plane or (wanted.lon, wanted.lat) if name is not None]
    columns, rows, comma = split_columns(decoded(file.content), named, wanted.progress)
    degrees = wanted.axes(list(columns)) if wanted.crs is None and wanted.plane is None else ()
    return Content(typed_columns(columns, comma, degrees), rows)


FORMAT = FileFormat((".csv", ".tsv", ".txt"), {}, read)


def typed_columns(columns: dict[str, Column], comma: bool, degrees: Collection[str]) -> dict[str, Column]:
    """The columns; one whose values are all numbers becomes numeric, except `degrees`, whose marks are decimal.

    Numbers whose marks may separate thousands stay text, with a warning, if the table has another decimal mark, or if
    their mark is a comma, which may be decimal where `comma`, and no other number has it.
    """
    result = dict(columns)
    marks = {name: decimal_mark(columns[name]) for name in degrees}
    for name in [name for name in columns if name not in marks]:
        result[name] = typed(columns[name], comma=comma)
        if result[name].dtype.kind == "f":
            marks[name] = decimal_mark(columns[name])
    decimal = {mark for name, (mark, sure) in marks.items() if sure or name in degrees} - {""}
    for name in [name for name, (mark, sure) in marks.items() if mark and not sure and name not in degrees]:
        mark = marks[name][0]
        if decimal - {mark} or (mark == "," and not decimal):
            result[name] = columns[name]
            cell = next(cell.strip() for cell in columns[name].tolist() if mark in cell)
            warnings.warn(f"column {name!r} is kept as text: {cell!r} {why_not(cell)}", DataWarning, stacklevel=2)
    return result


def split_columns(
    text: str, wanted: Collection[str], progress: Progress | None
) -> tuple[dict[str, Column], Indices, bool]:
    """Columns of a table as text, numbers of the rows, and whether commas are decimal marks.

    A first line that contains one of the names `wanted` is a header.
    """
    comments = COMMENTS.match(text)
    above = text[: comments.end()] if comments else ""
    text = text[len(above) :]
    for begin in range(0, len(text) - MOST_LINE, MOST_LINE):
        if max(text.find(end, begin, begin + MOST_LINE) for end in "\r\n") < 0:
            raise ValueError(f"a line has more than {MOST_LINE} characters, which no line of a table needs")
    mark = _separator(text)
    stream, lines = io.StringIO(text, newline=""), len(above.splitlines())
    rows = (row for row in _rows(stream, mark, lines) if any(row) and (len(row) > 1 or row[0].strip()))
    first = next(rows, None)
    if first is None:
        raise ValueError("the table is empty: there is not even a line with the names of the columns")
    if len(first) > MOST_COLUMNS:
        raise ValueError(f"the first line has {len(first)} columns; {MOST_COLUMNS} are the most that are read")
    names, data = _header(first, wanted)
    # In blocks: a million lists at once would keep the garbage collector busy.
    blocks, before = [_columns(data, len(names), 0)], len(data)
    while block := list(islice(rows, BLOCK)):
        blocks.append(_columns(block, len(names), before))
        before += len(block)
        if progress is not None:
            progress("reading", stream.tell(), len(text))
    columns = [np.concatenate(parts) for parts in zip(*blocks, strict=True)]
    # Spreadsheets write columns without a name or a value.
    named = {
        name or f"column_{k}": values
        for k, (name, values) in enumerate(zip(names, columns, strict=True), 1)
        if name or (values != "").any()
    }
    return named, np.arange(1, before + 1), mark != ","


def _columns(rows: Lines, width: int, before: int) -> list[Column]:
    """Rows of text as columns; `before` is the number of earlier rows of data."""
    for number, row in enumerate(rows, before + 1):
        if len(row) != width:
            raise ValueError(f"row {number} has {len(row)} fields, but there are {width} columns")
    return [texts(column) for column in zip(*rows, strict=True)] or [np.zeros(0, dtype="<U1")] * width


def _separator(text: str) -> str | None:
    """The separator that splits the first lines into the same, largest number of fields; None for blanks."""
    # One field may be as long as the table; by default, csv refuses fields of 131 072 characters for the whole process.
    csv.field_size_limit(max(csv.field_size_limit(), len(text)))
    lines = list(islice(io.StringIO(text, newline=""), LOOKED_AT))
    lengths = {mark: _lengths(lines, mark) for mark in SEPARATORS}
    several = [mark for mark in SEPARATORS if max(lengths[mark], default=0) > 1]
    even = [mark for mark in several if len(lengths[mark]) == 1]
    blanks = {len(line.split()) for line in lines if line.strip()}
    if not several or (not even and len(blanks) == 1 and blanks != {1}):
        return None
    return max(even or several, key=lambda mark: max(lengths[mark]))


def _lengths(lines: list[str], mark: str) -> set[int]:
    """Numbers of fields of the lines, except the last line, which may end inside a quoted field."""
    lengths = [len(row) for row in csv.reader(lines, delimiter=mark) if row]
    return set(lengths[:-1] or lengths)


def _rows(lines: TextIO, mark: str | None, above: int) -> Iterator[list[str]]:
    """Fields of each row; an unclosed quotation mark is an error and does not swallow the rest of the table."""
    if mark is None:
        yield from (line.split() for line in lines)
        return
    reader = csv.reader(lines, delimiter=mark, strict=True)
    while True:
        line = above + reader.line_num + 1
        try:
            row = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            raise ValueError(
                f"line {line}: a field begins with a quotation mark but does not end with one ({error}); "
                "inside such a field write it twice"
            ) from error
        yield row


def _header(row: list[str], wanted: Collection[str]) -> tuple[list[str], Lines]:
    """Names of the columns, empty where there is none, and the first row if it is data.

    The row is data if most of its fields are numbers, unless names of coordinates are among them. Two columns without
    names are longitude and latitude.
    """
    first = [field.strip() for field in row]
    numbers = sum(NUMBER.fullmatch(field) is not None for field in first)
    if 2 * numbers > sum(map(bool, first)) and not (set(wanted) & set(first) or has_lonlat(first)):
        return (["lon", "lat"] if len(first) == 2 else [f"column_{k}" for k in range(1, len(first) + 1)]), [row]
    repeated = sorted(name for name, times in Counter(first).items() if name and times > 1)
    if repeated:
        raise ValueError(f"there are several columns with the name {listed(repeated)}")
    return first, []


def write_csv(columns: Mapping[str, Column], stream: TextIO) -> None:
    """Write columns under a header line; numbers have as many digits as needed to read the same values back.

    Missing and infinite numbers are empty fields; a column of doubles that are all integers is written as integers.
    """
    check_held(columns, "csv")
    # The module's own lines end with a carriage return, so that it quotes fields with one; they are written without.
    writer = csv.writer(SimpleNamespace(write=lambda line: stream.write(f"{line[:-2]}\n")))
    writer.writerow(columns)
    writer.writerows(zip(*(_fields(np.asarray(values)) for values in columns.values()), strict=True))


def _fields(values: Column) -> list[Any]:
    """What stands in a column's fields."""
    if values.dtype.kind != "f":
        return [as_text(cell) for cell in plain_cells(values)] if values.dtype.kind not in "biu" else values.tolist()
    known = np.isfinite(values.astype(np.float64))
    numbers = values[known].astype(np.float64)
    whole = (np.abs(numbers) < EXACT_INTEGERS).all() and (numbers == np.round(numbers)).all()
    signed = (np.signbit(numbers) & (numbers == 0)).any()  # the integer 0 has no sign
    cells = objects([None] * len(values))
    cells[known] = list(map(int, numbers.tolist())) if whole and not signed else numbers.tolist()
    return cells.tolist()
