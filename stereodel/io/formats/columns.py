"""Columns: text as numbers where no digit is lost, and what their cells are in formats that have fewer types.

A number is what people and programs write in tables: digits, a sign, a decimal point or comma, an exponent, and blanks
or apostrophes between thousands. Other notations that Python accepts, such as 1_000 or digits of other scripts, are
text.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from datetime import timedelta
from decimal import Decimal
from itertools import compress
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Column, FloatArray
from stereodel._extras import MissingExtraError, optional
from stereodel.io.formats.names import WORDS, listed, note, spelled

MISSING: Final = tuple(WORDS["missing"])  # spellings of a missing value
NUMBER: Final = re.compile(r"[-+]?(?:(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?|inf|infinity)", re.IGNORECASE)

GROUPED: Final = re.compile(r"[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}")  # its mark is decimal, or between thousands
# Length of text above which it is stored as objects if few values are so long, as every row of NumPy's text arrays
# takes 4 bytes for each character of the longest value. Doubles print no longer.
LONG: Final = 24
SAFE_DIGITS: Final = 15  # number of decimal digits that a double always preserves
TINY: Final = float(np.finfo(np.float64).tiny)  # below it, doubles have fewer digits
EXACT_INTEGERS: Final = 2.0**53  # up to this number doubles represent every integer
LETTERS: Final = frozenset("0123456789+-.,eE\n")
# What finite numbers are written with, and also with separators of thousands and the minus sign of printers.
WRITTEN: Final = LETTERS | frozenset(" '’\xa0\u202f\u2009\N{MINUS SIGN}")
CODE: Final = re.compile(r"^[-+]?0[0-9]", re.MULTILINE)  # a sign, if any, zero and a digit
LIKE_POWER: Final = re.compile(r"[0-9]+E[0-9]+")  # a code, if all of a column are so, with no point or sign
SPACED: Final = re.compile(r"(?<=[0-9])[ '’\xa0\u202f\u2009](?=[0-9]{3}(?![0-9]))")
# Numbers whose thousands are separated by blanks or apostrophes, points, or commas.
THOUSANDS: Final = {
    mark: re.compile(rf"[-+]?[1-9][0-9]{{0,2}}(?:[{between}][0-9]{{3}})+(?:[{decimal}][0-9]+)?")
    for mark, between, decimal in (("", " '’\xa0\u202f\u2009", ".,"), (".", ".", ","), (",", ",", "."))
}
# Sizes of numbers by which archives of measurements mark missing ones.
SENTINELS: Final = {99.0, 999.0, 9999.0, 99999.0, 999.9, 9999.9, 32767.0, 32768.0, 1e20, 9.969209968386869e36}
OTHER: Final = {".": ",", ",": "."}  # what separates thousands where this is the decimal mark
# Characters that text of a format cannot have: those that XML lacks or changes, and the end of text in GDAL.
UNWRITABLE: Final = {
    **dict.fromkeys(("kml", "xlsx"), re.compile("[\x00-\x08\x0b-\x1f\ufffe\uffff\ud800-\udfff]")),
    **dict.fromkeys(("gpkg", "fgb", "shp", "nc"), re.compile("[\x00\ud800-\udfff]")),
}
GUESSED_FROM: Final = 1 << 20  # bytes from which an encoding is guessed
# Encodings that tables without Unicode have.
GUESSES: Final = (*(f"cp125{k}" for k in range(7)), "koi8_r", "cp866", "cp932", "euc_jp", "gb18030", "big5", "cp949")
# What text in cp1252 hardly has: other signs than letters and quotes, and three of them in a row, as other scripts.
WESTERN: Final = re.compile(rf"[^\x00-\x7f{WORDS['western']}]|[^\x00-\x7f]{{3}}")
HALVES: Final = re.compile("[\ud800-\udfff]")  # halves of characters, which UTF-8 lacks
# From here on a number has more digits than a shapefile's field, GDAL's 15 digits of it are infinite, or Excel's.
LARGEST: Final = {"shp": 1e23, "kml": 1.797693134862315e308, "xlsx": 1e308}


def decoded(content: bytes, encoding: str | None = None) -> tuple[str, str]:
    """Text and its encoding: the given one, else UTF-8, UTF-16 with a byte order mark, or a guess, which is told.

    ValueError for an encoding that does not exist or does not fit, and where nothing can be guessed.
    """
    marked = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    at = content[:2].find(b"\0")  # as the first letter of a table has one
    zeros = ("utf-8-sig", "utf-16-be", "utf-16-le")[at + 1]
    tried = encoding or ("utf-16" if marked else zeros)
    try:
        return content.decode("utf-8-sig" if tried.lower() in ("utf-8", "utf8") else tried), tried
    except LookupError:
        raise ValueError(f"{spelled('encoding')} is {encoding!r}, which does not exist; cp1252 is one") from None
    except UnicodeError as error:
        line = content[: getattr(error, "start", 0)].count(b"\n") + 1
        if encoding is None and not marked and (guess := _guessed(content)):
            said = f"line {line} is not text in UTF-8; the file is read in the encoding {guess}, which is a guess"
            note(f"{said}; {spelled('encoding', '=')} says which it is")
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
    longest, total = max(map(len, cells), default=0), sum(map(len, cells))
    alike = longest <= LONG or longest * len(cells) <= 4 * total
    return np.array(cells, dtype=np.str_) if alike else objects(cells)


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
    fits = kinds == {bool} or (kinds == {int} and all(-(2**63) <= cell < 2**63 for cell in known))
    if fits and len(known) == len(cells):
        return np.array(cells, dtype=np.bool_ if kinds == {bool} else np.int64)
    if not kinds or not kinds <= {int, float}:
        return objects(cells)
    if any(isinstance(cell, int) and abs(cell) > EXACT_INTEGERS for cell in known):
        return objects(cells)
    return np.array([np.nan if cell is None else cell for cell in cells], dtype=np.float64)


def of_objects(values: Any) -> Column:
    """Objects as a column, see `column`; other arrays as they are."""
    array = np.asarray(values)
    return column(array.tolist()) if array.dtype.kind == "O" and len(array) else array


def readings(values: Column) -> dict[str, Column]:
    """A column of text as integers or floats, by each decimal mark with which all its values are numbers, "" without.

    Missing values are NaN. Blanks and apostrophes separate thousands, and so does the mark that is not decimal. There
    is no reading if a number has more digits than a double can hold, or is a code: if it starts with a zero and another
    digit, or all exponents are like 1E3 and no number has a point or sign.
    """
    cells = [cell.strip() for cell in values.tolist()] if values.dtype.kind == "U" else []
    there = [cell.lower() not in MISSING for cell in cells]
    known = list(compress(cells, there))
    if not known:
        return {"": np.full(len(cells), np.nan)} if cells and not any(cells) else {}
    joined = "\n".join(known)
    used = set(joined)
    if not used <= WRITTEN or joined.count("\n") >= len(known):
        return {}
    if not used <= LETTERS:
        plain = joined.replace("\N{MINUS SIGN}", "-").split("\n")
        joined = "\n".join(SPACED.sub("", cell) if THOUSANDS[""].fullmatch(cell) else cell for cell in plain)
        used = set(joined)
    codes = "E" in used and used.isdisjoint("+-.,") and all(map(LIKE_POWER.fullmatch, re.findall(".*E.*", joined)))
    if codes or CODE.search(joined):
        return {}
    result = {}
    for decimal, mark in OTHER.items() if "." in used or "," in used else [("", "")]:
        having = [cell for cell in joined.split("\n") if mark in cell] if mark in used else []
        if not all(map(THOUSANDS[mark].fullmatch, having)):
            continue
        numbers = _held((joined.replace(mark, "") if mark else joined).replace(",", ".").split("\n"), all(there))
        if numbers is not None:
            result[decimal] = numbers if all(there) else np.full(len(cells), np.nan)
            result[decimal][there] = numbers
    return result


def _held(text: list[str], whole: bool) -> Column | None:
    """Text as integers, where `whole` says that they may be, or as doubles that preserve all digits; else None."""
    try:
        if whole:
            return np.array(list(map(int, text)), dtype=np.int64)
    except (ValueError, OverflowError):
        pass
    try:
        numbers = list(map(float, text))
    except ValueError:
        return None
    for cell, number in zip(text, numbers, strict=True):
        unsure = (len(cell) > SAFE_DIGITS or not TINY <= abs(number) < np.inf) and cell != repr(number)
        if unsure and Decimal(cell) != Decimal(repr(number)):
            return None
    return np.array(numbers)


def blanked(values: Column, missing: Iterable[str]) -> Column:
    """A column without the values that stand for missing ones: as text or, of numbers, by what they are."""
    said = [each.strip() for each in missing]
    if not said or values.dtype.kind not in "iufUO":
        return values
    amounts = {float(each.replace(",", ".")) for each in said if NUMBER.fullmatch(each)}
    if values.dtype.kind in "iuf":
        gone = np.isin(values, list(amounts))
        return np.where(gone, np.nan, values) if gone.any() else values
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
    known, result = values[np.isfinite(values)], {}
    for end in (float(known.min()), float(known.max())) if len(known) else ():
        others = known[known != end]
        times = 1.0 if abs(end) in SENTINELS else 10.0
        if len(others) > 1 and np.abs(others - end).min() > times * np.ptp(others) > 0.0:
            result[end] = int((known == end).sum())
    return result


def why_not(cell: str, decimal: str = "") -> str:
    """Why text is not taken for a number, where another mark may be said to be decimal, as the end of a message."""
    if decimal:
        return f"is not a number with the decimal mark {decimal!r}"
    if not GROUPED.fullmatch(cell):
        return "is not a number"
    digits = cell.replace(",", ".")
    return f"may be {digits} or {digits.replace('.', '')}; say which mark is decimal with {spelled('decimal', '=')}"


def doubles(values: Column, *, decimal: bool = False) -> tuple[FloatArray, BoolArray]:
    """Text and numbers as the nearest doubles, NaN where a value is missing; and a mask of values that are not numbers.

    Points and commas are decimal marks. Unless `decimal` says that all are, one that may separate thousands makes its
    number wrong, if the other numbers of the column do not have the same mark, and no other.
    """
    given = values.tolist()
    cells = ["" if cell is None else str(cell).strip() for cell in given]
    if decimal and LETTERS.issuperset("".join(cells)):
        try:
            return np.array(list(map(float, cells))), np.zeros(len(cells), dtype=np.bool_)
        except ValueError:
            pass
    numbers = [NUMBER.fullmatch(cell) is not None for cell in cells]
    unsure = [not decimal and isinstance(cell, str) and GROUPED.fullmatch(cell.strip()) is not None for cell in given]
    sure = [cell for cell, number, doubt in zip(cells, numbers, unsure, strict=True) if number and not doubt]
    marks = {mark for mark in ".," if any(mark in cell for cell in sure)}
    good = [n and not (d and marks != set(cell) & set(".,")) for cell, n, d in zip(cells, numbers, unsure, strict=True)]
    result = [float(cell.replace(",", ".")) if known else np.nan for cell, known in zip(cells, good, strict=True)]
    wrong = [not known and cell.lower() not in MISSING for cell, known in zip(cells, good, strict=True)]
    return np.array(result, dtype=np.float64), np.array(wrong, dtype=np.bool_)


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
    return cell.isoformat() if hasattr(cell, "isoformat") and not isinstance(cell, timedelta) else str(cell)


def as_text(cell: Any) -> Any:
    """A plain value as text, lists and mappings as JSON; None stays."""
    if isinstance(cell, list | dict):
        return json.dumps(cell, ensure_ascii=False, allow_nan=False)
    return cell if cell is None else str(cell)


def fields(values: Column) -> list[Any]:
    """What stands in the fields of a column of text tables; doubles that are all integers are written as these."""
    if values.dtype.kind != "f":
        return [as_text(cell) for cell in plain_cells(values)] if values.dtype.kind not in "biu" else values.tolist()
    known = np.isfinite(values.astype(np.float64))
    numbers = values[known].astype(np.float64)
    whole = (np.abs(numbers) < EXACT_INTEGERS).all() and (numbers == np.round(numbers)).all()
    signed = (np.signbit(numbers) & (numbers == 0)).any()  # the integer 0 has no sign
    cells = objects([None] * len(values))
    cells[known] = list(map(int, numbers.tolist())) if whole and not signed else numbers.tolist()
    return cells.tolist()


def check_held(columns: Mapping[str, Any], kind: str) -> None:
    """Raise ValueError that names the column for text or numbers that a format cannot hold."""
    pattern = UNWRITABLE.get(kind, HALVES)
    for name in filter(pattern.search, columns):
        raise ValueError(f"the column name {listed([name])} has a character that .{kind} cannot hold")
    for name, values in columns.items():
        array = np.asarray(values)
        for cell in array.ravel().tolist() if array.dtype.kind in "UO" else ():
            if type(cell) is str and pattern.search(cell):
                said = f"column {name!r} has the text {listed([cell])}, with a character that .{kind} cannot hold"
                raise ValueError(f"{said}; replace it, or choose another format")
        if kind in LARGEST and array.dtype.kind == "f":
            sizes = np.abs(array.astype(np.float64))
            beyond = np.isfinite(sizes) & (sizes >= LARGEST[kind])
            if beyond.any():
                said = f"column {name!r} has the number {array[beyond][0]}, which .{kind} cannot hold"
                raise ValueError(f"{said}; choose another format")
