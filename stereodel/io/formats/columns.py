"""Columns: text as numbers where no digit is lost, and what their cells are in formats that have fewer types.

A number is what people and programs write in tables: digits, a sign, a decimal point or comma, an exponent. Other
notations that Python accepts, such as 1_000 or digits of other scripts, are text, and so are thousands with separators.

Where a mark may be either, as in 128.928 and 1,234, other numbers decide: a mark is certainly decimal where it cannot
separate thousands, as in 9,9934 or 0.125.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Column, FloatArray
from stereodel.io.formats.names import listed

MISSING: Final = ("", "na", "n/a", "nan", "null", "none", "<na>", "-")
"""Spellings of a missing value, in any case."""

NUMBER: Final = re.compile(r"[-+]?(?:(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?|inf|infinity)", re.IGNORECASE)

GROUPED: Final = re.compile(r"[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}")
"""A number whose mark may be decimal or separate thousands."""

LONG: Final = 24
"""Length in characters above which text is stored as objects if few values are so long; doubles print no longer.

In NumPy's text arrays every row takes 4 bytes for each character of the longest value.
"""

SAFE_DIGITS: Final = 15
"""Number of decimal digits that a double always preserves."""

TINY: Final = float(np.finfo(np.float64).tiny)
"""Below it, doubles have fewer digits."""

EXACT_INTEGERS: Final = 2.0**53
"""Up to this number doubles represent every integer."""

LETTERS: Final = frozenset("0123456789+-.,eE")
"""What finite numbers are written with."""

CODE: Final = re.compile(r"^[-+]?0[0-9]", re.MULTILINE)
"""A value that starts, after an optional sign, with a zero and another digit."""

UNWRITABLE: Final = {
    **dict.fromkeys(("kml", "xlsx"), re.compile("[\x00-\x08\x0b-\x1f\ufffe\uffff\ud800-\udfff]")),
    **dict.fromkeys(("gpkg", "fgb", "shp", "nc"), re.compile("[\x00\ud800-\udfff]")),
}
"""Characters that text of a format cannot have: those that XML lacks or changes, and the end of text in GDAL."""

HALVES: Final = re.compile("[\ud800-\udfff]")
"""Halves of characters, which UTF-8 lacks."""

LARGEST: Final = {"shp": 1e23, "kml": 1.797693134862315e308, "xlsx": 1e308}
"""From here on a number has more digits than a shapefile's field, GDAL's 15 digits of it are infinite, or Excel's."""


def decoded(content: bytes) -> str:
    """Text in UTF-8, or in UTF-16 with a byte order mark; ValueError names the first line that is neither."""
    marked = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        return content.decode("utf-16" if marked else "utf-8-sig")
    except UnicodeDecodeError as error:
        line = content[: error.start].count(b"\n") + 1
        raise ValueError(f"line {line} is not text in UTF-8; save the file in that encoding") from error


def texts(values: Iterable[str]) -> Column:
    """Strings as an array of text, or of objects if a few long strings would make the text array large."""
    cells = list(values)
    lengths = [len(cell) for cell in cells]
    longest = max(lengths, default=0)
    if longest <= LONG or longest * len(cells) <= 4 * sum(lengths):
        return np.array(cells, dtype=np.str_)
    return objects(cells)


def objects(values: Iterable[Any]) -> Column:
    """Any values as an array of objects, one per entry."""
    cells = list(values)
    array = np.empty(len(cells), dtype=object)
    array[:] = cells
    return array


def column(values: Iterable[Any]) -> Column:
    """Python values as a column: integers, floats or text if all values are, else objects.

    Among numbers that doubles can represent, None becomes NaN.
    """
    cells = list(values)
    known = [cell for cell in cells if cell is not None]
    kinds = {type(cell) for cell in known}
    if kinds == {str} and len(known) == len(cells):
        return texts(cells)
    if not kinds or not kinds <= {int, float}:
        return np.array(cells) if kinds == {bool} and len(known) == len(cells) else objects(cells)
    if kinds == {int} and len(known) == len(cells) and all(-(2**63) <= cell < 2**63 for cell in cells):
        return np.array(cells, dtype=np.int64)
    if any(isinstance(cell, int) and abs(cell) > EXACT_INTEGERS for cell in known):
        return objects(cells)
    return np.array([np.nan if cell is None else cell for cell in cells], dtype=np.float64)


def of_objects(values: Any) -> Column:
    """Objects as a column, see `column`; other arrays as they are."""
    array = np.asarray(values)
    return column(array.tolist()) if array.dtype.kind == "O" and len(array) else array


def typed(values: Column, *, comma: bool = False) -> Column:
    """A column of text as integers, or as floats with NaN for missing values, if all its values are numbers.

    The column stays text if a number has more digits than a double can hold, or starts with a zero and another digit,
    as codes do. `comma` says whether a comma may be a decimal mark.
    """
    if values.dtype.kind != "U":
        return values
    text = [cell.strip() for cell in values.tolist()]
    known = [cell for cell in text if cell.lower() not in MISSING]
    if not known:
        return np.full(len(text), np.nan) if len(text) and not any(text) else values
    joined = "\n".join(known)
    if not LETTERS.issuperset(joined.replace("\n", "")) or CODE.search(joined):
        return values
    if "," in joined:
        if not comma or "." in joined:
            return values
        known = [cell.replace(",", ".") for cell in known]
    try:
        if len(known) == len(text):
            return np.array(list(map(int, known)), dtype=np.int64)
    except (ValueError, OverflowError):
        pass
    try:
        numbers = np.array(list(map(float, known)))
    except ValueError:
        return values
    if not _all_held(known, numbers):
        return values
    result = np.full(len(text), np.nan)
    result[[cell.lower() not in MISSING for cell in text]] = numbers
    return result


def decimal_mark(values: Column) -> tuple[str, bool]:
    """The decimal mark of numbers that are given as text, "" if there is none, and whether it is sure to be one."""
    mark = ""
    for cell in values.tolist():
        found = "." if "." in cell else "," if "," in cell else ""
        if found and not GROUPED.fullmatch(cell.strip()):
            return found, True
        mark = mark or found
    return mark, False


def why_not(cell: str) -> str:
    """Why text is not taken for a number, as the end of a message."""
    if not GROUPED.fullmatch(cell):
        return "is not a number"
    digits = cell.replace(",", ".")
    return f"may be {digits} or {digits.replace('.', '')}; write thousands without a separator"


def doubles(values: Column, *, decimal: bool = False) -> tuple[FloatArray, BoolArray]:
    """Text and numbers as the nearest doubles, NaN where a value is missing; and a mask of values that are not numbers.

    Points and commas are decimal marks. Unless `decimal` says that all are, one that may separate thousands makes its
    number wrong, if the other numbers of the column do not have the same mark, and no other.
    """
    result, wrong = _doubles(values)
    if decimal or values.dtype.kind not in "UO":
        return result, wrong
    numbers = [str(cell).strip() for cell in values[~wrong].tolist()]
    unsure = np.array([GROUPED.fullmatch(cell) is not None for cell in numbers], dtype=np.bool_)
    marks = {mark for cell, doubt in zip(numbers, unsure, strict=True) for mark in ".," if not doubt and mark in cell}
    unsure &= np.array([marks != {"." if "." in cell else ","} for cell in numbers], dtype=np.bool_)
    wrong[~wrong] = unsure
    return np.where(wrong, np.nan, result), wrong


def _doubles(values: Column) -> tuple[FloatArray, BoolArray]:
    if values.dtype.kind == "U":
        text = np.char.strip(values.astype(np.str_, copy=False))
        try:
            if LETTERS.issuperset("".join(text.tolist())):
                return text.astype(np.float64), np.zeros(len(text), dtype=np.bool_)
        except ValueError:
            pass
    result, wrong = np.full(len(values), np.nan), np.zeros(len(values), dtype=np.bool_)
    for row, cell in enumerate(values.tolist()):
        said = "" if cell is None else str(cell).strip()
        if NUMBER.fullmatch(said):
            result[row] = float(said.replace(",", "."))
        else:
            wrong[row] = said.lower() not in MISSING
    return result, wrong


def _all_held(text: list[str], numbers: FloatArray) -> bool:
    """Whether the doubles preserve all digits of the text from which they were read."""
    if not np.isfinite(numbers).all():
        return False
    for cell, number in zip(text, numbers.tolist(), strict=True):
        unsure = (len(cell) > SAFE_DIGITS or abs(number) < TINY) and cell != repr(number)
        if unsure and Decimal(cell) != Decimal(repr(number)):
            return False
    return True


def plain_cells(values: Any) -> list[Any]:
    """The values of a column as JSON has them, None for missing and infinite ones."""
    array = np.asarray(values)
    return [plain(cell) for cell in (array if array.dtype.kind in "mM" else array.tolist())]


def plain(cell: Any) -> Any:
    """One value: dates are text as in ISO 8601, bytes are hexadecimal, durations and other objects as `str` says."""
    if cell is None or isinstance(cell, bool | int | str):
        return cell
    if isinstance(cell, float | np.floating):
        return float(cell) if np.isfinite(cell) else None
    if isinstance(cell, np.datetime64 | np.timedelta64):
        return None if np.isnat(cell) else str(cell)
    if isinstance(cell, np.bool_ | np.integer):
        return cell.item()
    if isinstance(cell, bytes):
        return cell.hex().upper()
    if isinstance(cell, Mapping):
        return {str(name): plain(part) for name, part in cell.items()}
    if isinstance(cell, list | tuple | set | np.ndarray):
        return [plain(part) for part in cell]
    if type(cell).__name__ == "NAType" or cell != cell:  # missing values of pandas and NumPy
        return None
    return cell.isoformat() if hasattr(cell, "isoformat") else str(cell)


def as_text(cell: Any) -> Any:
    """A plain value as text, lists and mappings as JSON; None stays."""
    if isinstance(cell, list | dict):
        return json.dumps(cell, ensure_ascii=False, allow_nan=False)
    return cell if cell is None else str(cell)


def check_held(columns: Mapping[str, Any], kind: str) -> None:
    """Raise ValueError that names the column for text or numbers that a format cannot hold."""
    pattern = UNWRITABLE.get(kind, HALVES)
    wrong = [name for name in columns if pattern.search(name)]
    if wrong:
        raise ValueError(f"the column name {listed(wrong[:1])} has a character that .{kind} cannot hold")
    for name, values in columns.items():
        array = np.asarray(values)
        if array.dtype.kind in "UO":
            said = next((cell for cell in array.ravel().tolist() if type(cell) is str and pattern.search(cell)), None)
            if said is not None:
                raise ValueError(
                    f"column {name!r} has the text {listed([said])}, with a character that .{kind} cannot hold; "
                    "replace it, or choose another format"
                )
        if kind in LARGEST and array.dtype.kind == "f":
            sizes = np.abs(array.astype(np.float64))
            beyond = np.isfinite(sizes) & (sizes >= LARGEST[kind])
            if beyond.any():
                raise ValueError(
                    f"column {name!r} has the number {array[beyond][0]}, which .{kind} cannot hold; "
                    "choose another format"
                )
