"""Columns of text: converted to numbers where no digit is lost, otherwise kept unchanged.

A number is what people and programs write in tables: digits, a sign, a decimal point or comma, an exponent. Other
notations that Python accepts, such as 1_000 or digits of other scripts, are text.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from decimal import Decimal
from typing import Any, Final

import numpy as np

from stereodel._arrays import BoolArray, Codes, Column, FloatArray, Texts

MISSING: Final = ("", "na", "n/a", "nan", "null", "none", "<na>", "-")
"""Spellings of a missing value, in any case."""

NUMBER: Final = re.compile(r"[-+]?(?:(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?|inf|infinity)", re.IGNORECASE)

LONG: Final = 24
"""Length in characters above which text is stored as objects if few values are so long; doubles print no longer.

In NumPy's text arrays every row takes 4 bytes for each character of the longest value.
"""

SAFE_DIGITS: Final = 15
"""Number of decimal digits that a double always preserves."""

EXACT_INTEGERS: Final = 2.0**53
"""Up to this number doubles represent every integer."""

_LETTERS: Final = np.frombuffer("0123456789+-.,eE\0".encode("utf-32-le"), dtype=np.uint32)


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


def typed(values: Column, *, comma: bool = False) -> Column:
    """A column of text as integers, or as floats with NaN for missing values, if all its values are numbers.

    The column stays text if a number has more digits than a double can hold, or starts with a zero and another digit,
    as codes do.

    Parameters
    ----------
    values : (n,) array of text
    comma : bool
        Whether a comma is a decimal separator.

    Examples
    --------
    >>> typed(np.array(["1", "2"])), typed(np.array(["1,5", ""]), comma=True)
    (array([1, 2]), array([1.5, nan]))
    >>> typed(np.array(["12345678901234567891"])), typed(np.array(["007"]))
    (array(['12345678901234567891'], dtype='<U20'), array(['007'], dtype='<U3'))
    """
    if values.dtype.kind != "U":
        return values
    text = np.char.strip(values.astype(np.str_, copy=False))
    missing = np.isin(np.char.lower(text), MISSING)
    known = text[~missing]
    if not len(known):
        return np.full(len(text), np.nan) if len(text) and (text == "").all() else values
    points = _letters(known)
    if not np.isin(points, _LETTERS).all() or _has_codes(points):
        return values
    if (points == ord(",")).any():
        if not comma or (points == ord(".")).any():
            return values
        known = np.char.replace(known, ",", ".")
    try:
        if not missing.any():
            return known.astype(np.int64)
    except (ValueError, OverflowError):
        pass
    try:
        numbers = known.astype(np.float64)
    except ValueError:
        return values
    if not _all_held(known, numbers):
        return values
    result = np.full(len(text), np.nan)
    result[~missing] = numbers
    return result


def doubles(values: Column) -> tuple[FloatArray, BoolArray]:
    """Text and numbers as the nearest doubles, NaN where a value is missing; and a mask of values that are not numbers.

    A comma is a decimal separator.
    """
    if values.dtype.kind == "U":
        text = np.char.strip(values.astype(np.str_, copy=False))
        try:
            if np.isin(_letters(text), _LETTERS).all():
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


def _letters(text: Texts) -> Codes:
    """The code points of text, (n, longest), padded with zeros."""
    if not len(text) or not text.dtype.itemsize:
        return np.zeros((len(text), 1), dtype=np.uint32)
    return np.ascontiguousarray(text).view(np.uint32).reshape(len(text), -1)


def _has_codes(points: Codes) -> bool:
    """Whether any value starts, after an optional sign, with a zero and another digit."""
    padded = np.pad(points, ((0, 0), (0, 2)))
    signed = np.isin(padded[:, 0], [ord("+"), ord("-")])
    first, second = (np.where(signed, padded[:, k + 1], padded[:, k]) for k in (0, 1))
    return bool(((first == ord("0")) & (second >= ord("0")) & (second <= ord("9"))).any())


def _all_held(text: Texts, numbers: FloatArray) -> bool:
    """Whether the doubles preserve all digits of the text from which they were read."""
    if not np.isfinite(numbers).all():
        return False
    points = _letters(text)
    digits = np.count_nonzero((points >= ord("0")) & (points <= ord("9")), axis=1)
    unsure = (digits > SAFE_DIGITS) | (np.abs(numbers) < np.finfo(np.float64).tiny)
    for cell, number in zip(text[unsure].tolist(), numbers[unsure].tolist(), strict=True):
        printed = repr(number)
        if cell != printed and Decimal(cell) != Decimal(printed):
            return False
    return True
