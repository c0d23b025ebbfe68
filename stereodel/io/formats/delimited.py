"""Text tables, read by the csv module: separator and header are detected, columns of numbers become numbers."""

from __future__ import annotations

import csv
import io
import re
import warnings
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import islice
from types import SimpleNamespace
from typing import Any, Final, TextIO

import numpy as np

from stereodel._arrays import Column
from stereodel._tasks.progress import Progress
from stereodel.constants import MOST_COLUMNS, MOST_LINE
from stereodel.io.formats import Content, FileFormat, Input, Wanted
from stereodel.io.formats.columns import (
    EXACT_INTEGERS,
    NUMBER,
    as_text,
    blanked,
    check_held,
    decimal_mark,
    decoded,
    grouped,
    objects,
    plain_cells,
    texts,
    typed,
    why_not,
)
from stereodel.io.formats.names import DataWarning, has_lonlat, left_out, listed, spelled
from stereodel.io.formats.notation import angle

SEPARATORS = ",;\t|"
LOOKED_AT = 50
"""Number of lines from which the separator is detected."""
BLOCK = 20_000
"""Rows that are split in one block."""
COMMENTS = re.compile(r"(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|\Z))+")
"""Comment lines at the top, which begin with a hash."""

TITLES: Final = 20
"""Rows among which the header is looked for."""

UNIT: Final = 16
"""Letters that the name of a unit has at most."""

TOTALS: Final = frozenset(
    "total totals sum summe gesamt insgesamt somme suma soma totale итого всего 合计 合計 总计 المجموع".split()  # noqa: SIM905
)
"""Words that begin a row of totals."""

SEPARATED: Final = re.compile(r"sep=([^\r\n])\r?\n", re.IGNORECASE)
"""The line by which spreadsheets say what separates the fields."""

Lines = list[list[str]]


class Cells:
    """Rows of text, as of a sheet."""

    separator: str | None = "\t"
    above = 0

    def __init__(self, rows: Iterable[list[str]]) -> None:
        self._cells = rows

    def __iter__(self) -> Iterator[list[str]]:
        return iter(self._cells)

    def told(self, progress: Progress | None) -> None:
        """Say how much is read; here, all."""


class Lined(Cells):
    """The rows of a text table as lists of fields, what separates them, and the number of lines above."""

    def __init__(self, text: str, above: int = 0) -> None:
        said, start = SEPARATED.match(text), 0
        if said:
            start, above = said.end(), above + 1
        if comments := COMMENTS.match(text, start):
            start, above = comments.end(), above + len(comments[0].splitlines())
        text = text[start:] if start else text
        for begin in range(0, len(text) - MOST_LINE, MOST_LINE):
            if max(text.find(end, begin, begin + MOST_LINE) for end in "\r\n") < 0:
                raise ValueError(f"a line has more than {MOST_LINE} characters, which no line of a table needs")
        self.separator = said[1] if said else _separator(text)
        self.above, self._text, self._stream = above, text, io.StringIO(text, newline="")

    def __iter__(self) -> Iterator[list[str]]:
        rows = _rows(self._stream, self.separator, self.above)
        return (row for row in rows if any(row) and (len(row) > 1 or row[0].strip()))

    def told(self, progress: Progress | None) -> None:
        """Say how many characters are read."""
        if progress is not None:
            progress("reading", self._stream.tell(), len(self._text))


def read(file: Input, wanted: Wanted) -> Content:
    """A table of text; columns whose values are all numbers become numeric, but for degrees."""
    text, encoding = decoded(file.content, wanted.encoding)
    passed = text.splitlines(keepends=True)[: wanted.skip_rows] if wanted.skip_rows else []
    return tabulated(Lined(text[sum(map(len, passed)) :], len(passed)), wanted, encoding)


FORMAT = FileFormat((".csv", ".tsv", ".txt"), {}, read)


def tabulated(lined: Cells, wanted: Wanted, encoding: str = "") -> Content:
    """A table of rows of text: its header found, rows of units and totals left out, numbers typed."""
    named = [name for name in wanted.plane or (wanted.lon, wanted.lat) if name is not None]
    columns, invalid, titles = _split(lined, named, wanted)
    if titles:
        _note(f"{titles} {'rows' if titles > 1 else 'row'} above the header left out", "skip_rows")
    places: tuple[str, ...] = wanted.plane or ()
    decimals: tuple[str, ...] = ()
    alike = wanted.lon is not None and wanted.lon == wanted.lat
    if wanted.crs is None and wanted.plane is None and not alike and (named or has_lonlat(list(columns))):
        places = decimals = wanted.axes(list(columns))
    columns = {name: blanked(values, wanted.missing) for name, values in columns.items()}
    count = len(next(iter(columns.values()), ()))
    words = _rows_of_words(columns, places, count)
    for row, what in words.items():
        _note(f"{what} is left out: {listed([str(values[row]) for values in columns.values()])}")
    rows = np.setdiff1d(np.arange(1, count + len(invalid) + 1), [*invalid])
    if words:
        kept = np.setdiff1d(np.arange(count), [*words])
        columns, rows = {name: values[kept] for name, values in columns.items()}, rows[kept] - (0 in words)
    typed_ones, thousands = typed_columns(columns, lined.separator != ",", decimals, wanted.decimal)
    found = Content(typed_ones, rows)
    found.invalid.update(invalid)
    found.understood |= {
        "encoding": encoding,
        "separator": encoding and {None: "blanks", "\t": "tab"}.get(lined.separator, lined.separator),
        "header": lined.above + titles + 1,
        "thousands": thousands,
        **dict.fromkeys(words.values(), True),
    }
    return found


def typed_columns(
    columns: dict[str, Column], comma: bool, degrees: Collection[str], decimal: str | None = None
) -> tuple[dict[str, Column], dict[str, str]]:
    """The columns, and marks between thousands by column: one whose values are all numbers becomes numeric.

    Except `degrees`, whose marks are decimal. Numbers whose marks separate thousands are numbers where these are known:
    by `decimal`, by the marks that are certainly decimal in the table, or by what stands in the column. Those that may
    separate thousands stay text, with a warning, if the table has another decimal mark, or if their mark is a comma,
    which may be decimal where `comma`, and no other number has it.
    """
    result, thousands = dict(columns), dict[str, str]()
    marks = {name: decimal_mark(columns[name]) for name in degrees}
    for name in [name for name in columns if name not in marks]:
        result[name] = typed(columns[name], comma=comma)
        if result[name].dtype.kind == "f":
            marks[name] = decimal_mark(columns[name])
    known = {mark for name, (mark, sure) in marks.items() if sure or name in degrees} - {""}
    known = {decimal} if decimal else known
    for name in [name for name in columns if name not in degrees]:
        mark, sure = marks.get(name, ("", True))
        if decimal and mark and mark != decimal:
            result[name], sure = columns[name], True  # text, unless its thousands are separated
        elif sure and result[name].dtype.kind != "U":
            continue
        separator = grouped(columns[name], known.copy().pop() if len(known) == 1 else "")
        if separator:
            plain = texts(cell.replace(separator, "") for cell in columns[name].tolist())
            result[name], thousands[name] = typed(plain, comma=separator == "."), separator
            cell = next(cell.strip() for cell in columns[name].tolist() if separator in cell)
            if not decimal:
                _note(
                    f"column {name!r} has marks between thousands: {cell!r} is {cell.replace(separator, '')}", "decimal"
                )
        elif mark and not sure and (known - {mark} or (mark == "," and not known)):
            result[name] = columns[name]
            cell = next(cell.strip() for cell in columns[name].tolist() if mark in cell)
            _note(f"column {name!r} is kept as text: {cell!r} {why_not(cell)}")
    return result, thousands


def _note(what: str, option: str = "") -> None:
    advice = f"; {spelled(option, '=')} says it if that is wrong" if option else ""
    warnings.warn(f"{what}{advice}", DataWarning, stacklevel=2)


def _split(lined: Cells, wanted: Collection[str], how: Wanted) -> tuple[dict[str, Column], dict[int, str], int]:
    """Columns of a table as text, rows that are left out and why, and the number of rows above the header.

    A first line that contains one of the names `wanted` is a header.
    """
    rows = iter(lined)
    top = list(islice(rows, TITLES))
    if not top:
        raise ValueError("the table is empty: there is not even a line with the names of the columns")
    if len(top[0]) > MOST_COLUMNS:
        raise ValueError(f"the first line has {len(top[0])} columns; {MOST_COLUMNS} are the most that are read")
    titles = 0 if how.skip_rows else _titles(top, wanted)
    names, data = _header(top[titles], wanted)
    data += top[titles + 1 :]
    invalid: dict[int, str] = {}
    # In blocks: a million lists at once would keep the garbage collector busy.
    blocks, before = [_columns(data, len(names), 0, invalid, skip=how.skip_invalid)], len(data)
    while block := list(islice(rows, BLOCK)):
        blocks.append(_columns(block, len(names), before, invalid, skip=how.skip_invalid))
        before += len(block)
        lined.told(how.progress)
    columns = [np.concatenate(parts) for parts in zip(*blocks, strict=True)]
    # Spreadsheets write columns without a name or a value.
    named = {
        name or f"column_{k}": values
        for k, (name, values) in enumerate(zip(names, columns, strict=True), 1)
        if name or (values != "").any()
    }
    return named, invalid, titles


def _titles(top: Lines, wanted: Collection[str]) -> int:
    """The number of rows above the header: before the first one with names of coordinates, else those of one field."""

    def names_places(row: list[str]) -> bool:
        return bool(set(wanted) & {field.strip() for field in row}) or has_lonlat([field for field in row if field])

    def is_heading(row: list[str]) -> bool:
        return names_places(row) and not any(NUMBER.fullmatch(field.strip()) for field in row)

    if names_places(top[0]):
        return 0
    heading = next((k for k, row in enumerate(top) if is_heading(row)), 0)
    alone = next((k for k, row in enumerate(top) if sum(map(bool, map(str.strip, row))) > 1), 0)
    return heading or alone


def _rows_of_words(columns: Mapping[str, Column], places: Collection[str], count: int) -> dict[int, str]:
    """The first row if it has units, and the last one if it has totals, where the columns of places are known."""
    found: dict[int, str] = {}
    if not places or count < 2:
        return found
    first, second, last = ([str(values[row]).strip() for values in columns.values()] for row in (0, 1, count - 1))
    here = [k for k, name in enumerate(columns) if name in places]
    units = all(first[k] and len(first[k]) <= UNIT and angle(second[k]) for k in here)
    if units and not any(angle(cell) or NUMBER.fullmatch(cell) for cell in first):
        found[0] = "a row of units"
    if not any(last[k] for k in here) and any(cell.casefold().rstrip(":") in TOTALS for cell in last):
        found[count - 1] = "a row of totals"
    return found


def _columns(rows: Lines, width: int, before: int, invalid: dict[int, str], *, skip: bool) -> list[Column]:
    """Rows of text as columns, after `before` others; `invalid` takes those with too many or too few fields."""
    wrong = [k for k, row in enumerate(rows) if len(row) != width]
    for k in wrong:
        if len(rows[k]) > width and not any(rows[k][width:]):
            rows[k] = rows[k][:width]  # of separators at the end
            continue
        said = f"has {len(rows[k])} fields, but there are {width} columns"
        if not skip:
            raise ValueError(f"row {before + k + 1} {said}; {left_out('skip_invalid')}")
        invalid[before + k + 1] = said
    good = rows if not wrong else [row for row in rows if len(row) == width]
    return [texts(column) for column in zip(*good, strict=True)] or [np.zeros(0, dtype="<U1")] * width


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
