"""Columns: text as numbers where no digit is lost, and what their cells are in formats that have fewer types.

A number is what people and programs write in tables: digits, a sign, a decimal point or comma, an exponent, and blanks
or apostrophes between thousands. Other notations that Python accepts, such as 1_000 or digits of other scripts, are
text.

Where a mark may be either, as in 128.928 and 1,234, other numbers decide: a mark is certainly decimal where it cannot
separate thousands, as in 9,9934 or 0.125.
"""

from __future__ import annotations

import json
import re
import warnings
from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Column, FloatArray
from stereodel._extras import MissingExtraError, optional
from stereodel.io.formats.names import DataWarning, listed, spelled

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
WRITTEN: Final = LETTERS | frozenset(" '’\xa0\u202f\u2009\N{MINUS SIGN}")
"""What finite numbers are written with, and also with separators of thousands and the minus sign of printers."""

CODE: Final = re.compile(r"^[-+]?0[0-9]", re.MULTILINE)
"""A value that starts, after an optional sign, with a zero and another digit."""

LIKE_POWER: Final = re.compile(r"[0-9]+E[0-9]+")
"""A code such as 1E3, if all values with an exponent are so and there is no point or sign in the column."""

SPACED: Final = re.compile(r"(?<=[0-9])[ '’\xa0\u202f\u2009](?=[0-9]{3}(?![0-9]))")
THOUSANDS: Final = {
    "": re.compile(r"[-+]?[1-9][0-9]{0,2}(?:[ '’\xa0\u202f\u2009][0-9]{3})+(?:[.,][0-9]+)?"),
    ".": re.compile(r"[-+]?[1-9][0-9]{0,2}(?:\.[0-9]{3})+(?:,[0-9]+)?"),
    ",": re.compile(r"[-+]?[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\.[0-9]+)?"),
}
"""Numbers whose thousands are separated by blanks or apostrophes, points, or commas."""

SENTINELS: Final = frozenset(
    (99.0, 999.0, 9999.0, 99999.0, 999.9, 9999.9, 32767.0, 32768.0, 1e20, 9.969209968386869e36)
)
"""Sizes of numbers by which archives of measurements mark missing ones."""

OTHER: Final = {".": ",", ",": "."}
"""What separates thousands where this is the decimal mark."""

UNWRITABLE: Final = {
    "kml": re.compile("[\x00-\x08\x0b-\x1f\ufffe\uffff\ud800-\udfff]"),
    **dict.fromkeys(("gpkg", "fgb", "shp"), re.compile("[\x00\ud800-\udfff]")),
}
"""Characters that text of a format cannot have: those that XML lacks or changes, and the end of text in GDAL."""

GUESSED_FROM: Final = 1 << 20
"""Bytes from which an encoding is guessed."""

GUESSES: Final = (
    *("cp1250", "cp1251", "cp1252", "cp1253", "cp1254", "cp1255", "cp1256", "koi8_r", "cp866"),
    *("cp932", "euc_jp", "gb18030", "big5", "cp949"),
)
"""Encodings that tables without Unicode have."""

WESTERN: Final = re.compile("[^\x00-\x7f\xb0\xba\xaaà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ\xa0ŒœŠšŽžŸ]|[^\x00-\x7f]{3}")
"""What text in cp1252 hardly has: other signs than letters and quotes, and three of them in a row, as other scripts."""

HALVES: Final = re.compile("[\ud800-\udfff]")
"""Halves of characters, which UTF-8 lacks."""

LARGEST: Final = {"shp": 1e23, "kml": 1.797693134862315e308}
"""From here on a number has more digits than a shapefile's field, or GDAL's 15 digits of it are infinite."""


def decoded(content: bytes, encoding: str | None = None) -> tuple[str, str]:
    """Text and its encoding: the given one, else UTF-8, UTF-16 with a byte order mark, or a guess, which is told.

    ValueError for an encoding that does not exist or does not fit, and where nothing can be guessed.
    """
    marked = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    tried = encoding or ("utf-16" if marked else "utf-8-sig")
    try:
        return content.decode("utf-8-sig" if tried.lower() in ("utf-8", "utf8") else tried), tried
    except LookupError:
        raise ValueError(f"{spelled('encoding')} is {encoding!r}, which does not exist; cp1252 is one") from None
    except UnicodeError as error:
        line = content[: getattr(error, "start", 0)].count(b"\n") + 1
        if encoding is None and not marked and (guess := _guessed(content)):
            warnings.warn(
                f"line {line} is not text in UTF-8; the file is read in the encoding {guess}, which is a guess; "
                f"{spelled('encoding', '=')} says which it is",
                DataWarning,
                stacklevel=2,
            )
            return content.decode(guess), guess
        advice = f"say which encoding the file has with {spelled('encoding', '=')}, such as cp1252"
        raise ValueError(f"line {line} is not text in {'UTF-8' if encoding is None else encoding}; {advice}") from error


def _guessed(content: bytes) -> str | None:
    """That of Western spreadsheets where it gives letters between others, else what charset_normalizer finds."""
    head = content[:GUESSED_FROM].rpartition(b"\n")[0] or content
    if not WESTERN.search(head.decode("cp1252", "replace")):
        return "cp1252"
    try:
        found = optional("charset_normalizer", "cli").from_bytes(head, cp_isolation=[*GUESSES]).best()
    except MissingExtraError:
        return None
    return None if found is None else str(found.encoding)


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
    if not LETTERS.issuperset(joined.replace("\n", "")):
        if not WRITTEN.issuperset(joined.replace("\n", "")):
            return values
        known = [
            SPACED.sub("", cell) if THOUSANDS[""].fullmatch(cell) else cell
            for cell in joined.replace("\N{MINUS SIGN}", "-").split("\n")
        ]
        joined = "\n".join(known)
    codes = "E" in joined and not set("+-.,") & set(joined) and all(LIKE_POWER.fullmatch(c) for c in known if "E" in c)
    if codes or CODE.search(joined):
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


def grouped(values: Column, decimal: str = "") -> str:
    """The mark that separates thousands in a column of text, "" if none is sure to do so.

    It does where a number has it several times, or has a decimal mark after it, or where another is known to be the
    `decimal` mark; and all numbers with the mark have it in these places.
    """
    cells = [cell.strip() for cell in values.tolist() if cell.strip().lower() not in MISSING]
    for mark, other in OTHER.items():
        having = [cell for cell in cells if mark in cell]
        sure = decimal == other or any(cell.count(mark) > 1 or other in cell for cell in having)
        if having and sure and decimal != mark and all(THOUSANDS[mark].fullmatch(cell) for cell in having):
            plain = [cell.replace(mark, "") for cell in cells]
            if all(NUMBER.fullmatch(cell) for cell in plain):
                return mark
    return ""


def blanked(values: Column, missing: Iterable[str]) -> Column:
    """A column without the values that stand for missing ones: as text or, of numbers, by what they are."""
    said = [each.strip() for each in missing]
    if not said:
        return values
    amounts = {float(each.replace(",", ".")) for each in said if NUMBER.fullmatch(each)}
    if values.dtype.kind in "iuf":
        gone = np.isin(values, list(amounts))
        return np.where(gone, np.nan, values) if gone.any() else values
    if values.dtype.kind not in "UO":
        return values
    cells = values.tolist()
    for row, cell in enumerate(cells):
        text = str(cell).strip()
        if text in said or (NUMBER.fullmatch(text) and float(text.replace(",", ".")) in amounts):
            cells[row] = "" if isinstance(cell, str) else None
    return texts(cells) if values.dtype.kind == "U" else objects(cells)


def far(values: FloatArray) -> dict[float, int]:
    """The least and greatest numbers that lie far outside all others, as -9999 does, and how many there are of each.

    Far is ten times as far from the next one as the others are from each other; of numbers that stand for missing
    ones, once.
    """
    known = values[np.isfinite(values)]
    result = {}
    for end, sign in ((known.min(), 1.0), (known.max(), -1.0)) if len(known) else ():
        others = known[known != end]
        if len(others) > 1 and (spread := float(np.ptp(others))) > 0.0:
            gap = float(np.min(sign * (others - end)))
            times = 1.0 if abs(float(end)) in SENTINELS else 10.0
            if gap > times * spread:
                result[float(end)] = int((known == end).sum())
    return result


def why_not(cell: str) -> str:
    """Why text is not taken for a number, as the end of a message."""
    if not GROUPED.fullmatch(cell):
        return "is not a number"
    digits = cell.replace(",", ".")
    return f"may be {digits} or {digits.replace('.', '')}; say which mark is decimal with {spelled('decimal', '=')}"


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
