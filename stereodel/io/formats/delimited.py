"""Text tables, read by the csv module: separator and header are detected, columns of numbers become numbers."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import islice
from types import SimpleNamespace
from typing import Final, TextIO

import numpy as np

from stereodel._arrays import Column
from stereodel._tasks.progress import Progress
from stereodel.constants import MOST_COLUMNS, MOST_LINE
from stereodel.io.formats import Content, FileFormat, Wanted
from stereodel.io.formats.columns import NUMBER, OTHER, blanked, check_held, decoded, fields, readings, texts, why_not
from stereodel.io.formats.foreign import SourceFile
from stereodel.io.formats.names import check_different, has_lonlat, left_out, listed, note
from stereodel.io.formats.notation import angle, is_place

SEPARATORS = ",;\t|"
ALONE: Final = "\x1f"  # stands for none, where lines have one field with both coordinates
LOOKED_AT = 50  # number of lines from which the separator is detected
BLOCK = 20_000  # rows that are split in one block
# Comment lines at the top, which begin with a hash.
COMMENTS = re.compile(r"(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|\Z))+")
TITLES: Final = 20  # rows among which the header is looked for
UNIT: Final = 16  # letters that the name of a unit has at most
# What names a row of totals or means, such as Grand Total and Mittelwert:
TOTALS: Final = re.compile(
    r"(?:\w+ )?(?:totale?s?|sums?|summe|gesamt\w*|insgesamt|somme|suma|soma|итого|всего|合计|合計|总计|المجموع|"
    r"mean|average|mittelwert|durchschnitt|moyenne|m[eé]dia|promedio|среднее|平均|المتوسط)(?: \w+)?\W*",
    re.IGNORECASE,
)
SEPARATED: Final = re.compile(r"sep=([^\r\n])\r?\n", re.IGNORECASE)  # by which spreadsheets say what separates fields

Lines = list[list[str]]


def read(file: SourceFile, wanted: Wanted) -> Content:
    """A table of text; columns whose values are all numbers become numeric, but for degrees."""
    text, encoding = decoded(file.content, wanted.encoding)
    start = sum(map(len, text.splitlines(keepends=True)[: wanted.skip_rows])) if wanted.skip_rows else 0
    said = SEPARATED.match(text) or SEPARATED.match(text, start)
    start = max(start, said.end()) if said else start
    comments = COMMENTS.match(text, start)
    start = comments.end() if comments else start
    above, text = len(text[:start].splitlines()), text[start:]
    for begin in range(0, len(text) - MOST_LINE, MOST_LINE):
        if max(text.find(end, begin, begin + MOST_LINE) for end in "\r\n") < 0:
            raise ValueError(f"a line has more than {MOST_LINE} characters, which no line of a table needs")
    separator = said[1] if said else _separator(text)
    last = comments[0].splitlines()[-1].lstrip(" \t#") if comments else ""
    names, first = (line.strip().split(separator) for line in (last, text.partition("\n")[0]))
    if len(names) == len(first) and has_lonlat(names) and not has_lonlat(first):
        note("the last line of comments is read as the header", "skip_rows")
        text, above = f"{last}\n{text}", above - 1
    rows = _rows(text, separator, above, wanted.progress)
    found = tabulated(rows, wanted, comma=separator != ",", above=above)
    named = {None: "blanks", "\t": "tab", ALONE: "none"}.get(separator, separator)
    found.understood = {"encoding": encoding, "separator": named, **found.understood}
    return found


FORMAT = FileFormat((".csv", ".tsv", ".txt"), {}, read)


def tabulated(rows: Iterable[list[str]], wanted: Wanted, *, comma: bool = True, above: int = 0) -> Content:
    """A table of rows of text, after lines `above`: its header found, units and totals left out, numbers typed.

    `comma` says whether a comma may be a decimal mark.
    """
    columns, invalid, header = _split(iter(rows), wanted)
    named = wanted.lon != wanted.lat or (wanted.lon is None and has_lonlat(list(columns)))
    degrees = wanted.axes(list(columns)) if named and wanted.crs is None and wanted.plane is None else ()
    columns = {name: blanked(values, wanted.sentinels) for name, values in columns.items()}
    if not header and [*columns] == ["lon", "lat"] and wanted.lon is None and wanted.plane is None:
        note("there is no header: column_1 is read as the longitude, column_2 as the latitude", "lon")
    count = len(next(iter(columns.values()), ()))
    words = _rows_of_words(columns, wanted.plane or degrees, count)
    for row, what in words.items():
        note(f"{what} is left out: {listed([str(values[row]) for values in columns.values()])}")
    units = 0 in words
    numbers = np.delete(np.arange(1 - units, count + len(invalid) + 1 - units), [row - 1 for row in invalid])
    columns = {name: np.delete(values, [*words]) for name, values in columns.items()} if words else columns
    typed, thousands = typed_columns(columns, comma, degrees, wanted.decimal)
    found = Content(typed, np.delete(numbers, [*words]))
    found.invalid.update({row - units: why for row, why in invalid.items()})
    found.understood |= {"header": above + header if header else None, "thousands": thousands}
    return found


def typed_columns(
    columns: dict[str, Column], comma: bool, degrees: Collection[str], decimal: str | None = None
) -> tuple[dict[str, Column], dict[str, str]]:
    """The columns, and marks between thousands by column: one whose values are all numbers becomes numeric.

    Except `degrees`, whose marks are decimal. Where the marks of a column may be decimal or separate thousands, the
    others decide: `decimal`, degrees, and columns that are numbers with one decimal mark alone. If they have the same
    one it holds, and if they have none a point is decimal; else the column stays text, with a warning.
    """
    result, thousands, doubtful = dict(columns), dict[str, str](), dict[str, dict[str, Column]]()
    text = "\n".join(cell for name in degrees for cell in columns[name].tolist())
    known = {mark for mark in ".," if mark in text and re.search(rf"[0-9][{mark}]", text)}
    comma = comma or "," in known or decimal == ","
    for name in [name for name in columns if name not in degrees]:
        ways = readings(columns[name])
        mark = next(iter(ways), "")
        separated = mark != "" and _first(columns[name], OTHER[mark]) != ""
        if mark == "," and not comma and not separated:
            continue
        if len(ways) == 1:
            known |= {mark} - {""}
        if len(ways) == 1 and not separated and (not decimal or mark in ("", decimal)):
            result[name] = ways[mark]
        elif ways:
            doubtful[name] = ways
    known = {decimal} if decimal else known
    for name, ways in doubtful.items():
        mark = "".join(known) if len(known) == 1 else "" if known or _first(columns[name], ",") else "."
        if mark in ways:
            result[name], cell = ways[mark], _first(columns[name], OTHER[mark])
            if cell:
                thousands[name] = OTHER[mark]
            if cell and not decimal:
                plain = cell.replace(OTHER[mark], "")
                note(f"column {name!r} has marks between thousands: {cell!r} is {plain}", "decimal")
        else:
            cell = _first(columns[name], ",") or _first(columns[name], ".")
            note(f"column {name!r} is kept as text: {cell!r} {why_not(cell, ''.join(known - ways.keys()))}")
    return result, thousands


def _first(values: Column, mark: str) -> str:
    """The first cell that has a mark, "" if none has."""
    return next((cell.strip() for cell in values.tolist() if mark in cell), "")


def _filled(rows: Iterable[list[str]]) -> Lines:
    """Rows that have anything: a line of blanks has one field, or none."""
    return [row for row in rows if any(row) and (len(row) > 1 or row[0].strip())]


def _split(rows: Iterator[list[str]], wanted: Wanted) -> tuple[dict[str, Column], dict[int, str], int]:
    """Columns of a table as text, rows that are left out and why, and the number of the header's row, 0 without."""
    top = list(islice(rows, TITLES))
    header, names, data = _header(top, wanted)
    invalid: dict[int, str] = {}
    # In blocks: a million lists at once would keep the garbage collector busy.
    blocks, block, before = list[list[Column]](), data, 0
    while block or not blocks:
        filled = _filled(block)
        blocks.append(_columns(filled, names, before, invalid, skip=wanted.skip_invalid))
        before += len(filled)
        block = list(islice(rows, BLOCK))
    columns = [np.concatenate(parts) for parts in zip(*blocks, strict=True)]
    # Spreadsheets write columns without a name or a value.
    named = {
        name or f"column_{k}": values
        for k, (name, values) in enumerate(zip(names, columns, strict=True), 1)
        if name or (values != "").any()
    }
    return named, invalid, header


def _header(top: Lines, wanted: Wanted) -> tuple[int, list[str], Lines]:
    """The number of the header's row among the first ones, 0 without; names of the columns; and the rows below.

    It is the first row with names of coordinates, else the first one of several fields; or else it is the first data,
    if most of its fields are numbers. Two columns without names are longitude and latitude, unless others are said.
    """
    known = {*(wanted.plane or ()), wanted.lon, wanted.lat}
    rows = {k: [field.strip() for field in row] for k, row in enumerate(top) if _filled([row])}
    if not rows:
        raise ValueError("the table is empty: there is not even a line with the names of the columns")
    first = next(iter(rows))
    if len(rows[first]) > MOST_COLUMNS:
        raise ValueError(f"the first line has {len(top[0])} columns; {MOST_COLUMNS} are the most that are read")
    places = [k for k, row in rows.items() if not known.isdisjoint(row) or has_lonlat(list(filter(None, row)))]
    worded = [k for k in places if k == first or not any(map(NUMBER.fullmatch, rows[k]))]
    several = [k for k, row in rows.items() if sum(map(bool, row)) > 1]
    header = first if wanted.skip_rows else (worded or several or [first])[0]
    titles = sum(k < header for k in rows)
    if titles:
        note(f"{titles} {'rows' if titles > 1 else 'row'} above the header left out", "skip_rows")
    names = rows[header]
    if header not in places and 2 * sum(map(bool, map(NUMBER.fullmatch, names))) > sum(map(bool, names)):
        numbered = [f"column_{k + 1}" for k in range(len(names))]
        return 0, ["lon", "lat"] if len(names) == 2 and known.isdisjoint(numbered) else numbered, top[header:]
    check_different(filter(None, names))
    return header + 1, names, top[header + 1 :]


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
    if any(map(TOTALS.fullmatch, last)) and all(_sums_up(columns[name]) for name in places):
        found[count - 1] = "a row of totals"
    return found


def _sums_up(values: Column) -> bool:
    """Whether the last coordinate is missing, or the sum or mean of all others."""
    *others, last = (found.degrees if (found := angle(cell)) else np.nan for cell in values.tolist())
    return bool(np.isnan(last) or np.isclose(last, [np.sum(others), np.mean(others)]).any())


def _columns(rows: Lines, names: list[str], before: int, invalid: dict[int, str], *, skip: bool) -> list[Column]:
    """Rows of text as columns, after `before` others; `invalid` takes those with too many or too few fields."""
    width, named = len(names), max((k for k, name in enumerate(names, 1) if name), default=0)
    for k in [k for k, row in enumerate(rows) if len(row) != width]:
        if not any(rows[k][width:]) and len(rows[k]) >= named:  # separators at the end, or of the header alone
            rows[k] = [*rows[k], *[""] * width][:width]
            continue
        said = f"has {len(rows[k])} {'field' if len(rows[k]) == 1 else 'fields'}, but there are {width} columns"
        if not skip:
            advice = f"put fields with separators in quotation marks, or {left_out('skip_invalid')}"
            raise ValueError(f"row {before + k + 1} {said}; {advice}")
        invalid[before + k + 1] = said
    good = [row for row in rows if len(row) == width] if invalid else rows
    return [texts(column) for column in zip(*good, strict=True)] or [np.zeros(0, dtype="<U1")] * width


def _separator(text: str) -> str | None:
    """The separator that splits most of the first lines into one number of fields, the largest; None for blanks."""
    # One field may be as long as the table; by default, csv refuses fields of 131 072 characters for the whole process.
    csv.field_size_limit(max(csv.field_size_limit(), len(text)))
    lines = list(islice(io.StringIO(text, newline=""), LOOKED_AT))
    # If need be but for the last line, which may end inside a quoted field or be a footnote.
    rows = {mark: [len(row) for row in csv.reader(lines, delimiter=mark) if row] for mark in SEPARATORS}
    lengths = {mark: set(each[:-1] or each) for mark, each in rows.items()}
    several = [mark for mark in SEPARATORS if max(lengths[mark], default=0) > 1]
    even = [mark for mark in several if len({*rows[mark]}) == 1] or [m for m in several if len(lengths[m]) == 1]
    blanks = {len(line.split()) for line in lines if line.strip()}
    found = None
    if several and (even or len(blanks) != 1 or blanks == {1}):
        # Under a title no mark is even: decimal commas are in most lines, the separator is in the header, too.
        found = max(even or several, key=lambda mark: max((rows[mark].count(n), n) for n in lengths[mark] if n > 1))
    head, *below = [line for line in lines if line.strip()] or [""]
    return ALONE if below and len(head.split(found)) == 1 and all(map(is_place, below)) else found


def _rows(text: str, mark: str | None, above: int, progress: Progress | None) -> Iterator[list[str]]:
    """Fields of each row; an unclosed quotation mark is an error and does not swallow the rest of the table."""
    stream, begun = io.StringIO(text, newline=""), 0
    lines = stream if mark else (" ".join(line.split()) for line in stream)
    reader = csv.reader(lines, delimiter=mark or " ", strict=True)
    try:
        for number, row in enumerate(reader, 1):
            begun = reader.line_num
            if progress is not None and number % BLOCK == 0:
                progress("reading", stream.tell(), len(text))
            yield row
        if progress is not None:
            progress("reading", len(text), len(text))
    except csv.Error as error:
        said = f"line {above + begun + 1}: a field begins with a quotation mark but does not end with one ({error})"
        raise ValueError(f"{said}; inside such a field write it twice") from error


def write_csv(columns: Mapping[str, Column], stream: TextIO) -> None:
    """Write columns under a header line; numbers have as many digits as needed to read the same values back.

    Missing and infinite numbers are empty fields; a column of doubles that are all integers is written as integers.
    """
    check_held(columns, "csv")
    # The module's own lines end with a carriage return, so that it quotes fields with one; they are written without.
    writer = csv.writer(SimpleNamespace(write=lambda line: stream.write(f"{line[:-2]}\n")))
    writer.writerow(columns)
    writer.writerows(zip(*(fields(np.asarray(values)) for values in columns.values()), strict=True))
