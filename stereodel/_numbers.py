"""Numbers of every type as doubles; values that are not real, or that would be rounded silently, are rejected."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from itertools import chain
from typing import Any

import numpy as np
import numpy.typing as npt

_WHOLE = 2**53
"""Up to this number every integer is a double."""


def as_doubles(values: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    """Real numbers of any shape, NaN and infinities among them."""
    refuse_masked(values, name)
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name} is ragged: its rows must all have the same length") from error
    if isinstance(values, list | tuple) and array.dtype.kind in "iuf" and _may_hide_others(array, values):
        array = np.asarray(values, dtype=object)
    if array.dtype.kind not in "iuf":
        array = _from_objects(array, name)
    elif array.dtype.kind != "f" or array.dtype.itemsize > 8:
        array = _from_wide(array, name)
    return np.asarray(array, dtype=np.float64, order="C")


def is_masked(values: npt.ArrayLike) -> bool:
    """Whether some of the values of a masked array are masked."""
    # There are no masked arrays before numpy.ma is loaded, and loading it would take a tenth of our import time. It has
    # no such class yet while another thread loads it.
    masked = sys.modules.get("numpy.ma")
    kind = getattr(masked, "MaskedArray", None)
    return kind is not None and isinstance(values, kind) and bool(np.any(getattr(values, "mask", False)))


def refuse_masked(values: npt.ArrayLike, name: str) -> None:
    if is_masked(values):
        masked = sys.modules["numpy.ma"]
        where = entry(name, tuple(int(i) for i in np.argwhere(masked.getmaskarray(values))[0]))
        raise ValueError(f"{where} is masked; drop such rows first, e.g. with np.ma.compress_rows({name})")


def _may_hide_others(array: npt.NDArray[Any], values: list[Any] | tuple[Any, ...]) -> bool:
    """Whether numbers that NumPy made of lists may have been larger whole numbers, or booleans, or long doubles."""
    if array.ndim > 1 and all(isinstance(row, np.ndarray) for row in values):
        return any(row.dtype != np.float64 for row in values)
    numbers: Iterable[Any] = values
    for _ in range(array.ndim - 1):
        numbers = chain.from_iterable(numbers)
    kinds = set(map(type, numbers))
    if kinds == {float} or (kinds == {int} and array.dtype.kind in "iu"):
        return False
    return not kinds <= {float, int, np.float64} or bool((np.abs(array) >= _WHOLE).any())


def _from_wide(array: npt.NDArray[Any], name: str) -> npt.NDArray[np.float64]:
    """Integers and long doubles as the doubles that equal them."""
    with np.errstate(over="ignore"):
        doubles = array.astype(np.float64)
    if array.dtype.kind == "f":
        _refuse_rounded((doubles.astype(array.dtype) != array) & (array == array), array, name)
    elif array.dtype.itemsize == 8 and array.size and (array.max() > _WHOLE or array.min() < -_WHOLE):
        # Both halves are doubles, and so is the error of their rounded sum (Dekker).
        high, low = (array >> 32).astype(np.float64) * 2.0**32, (array & 0xFFFFFFFF).astype(np.float64)
        _refuse_rounded(low - (doubles - high) != 0, array, name)
    return doubles


def _from_objects(array: npt.NDArray[Any], name: str) -> npt.NDArray[np.float64]:
    """Real numbers in an object array (Fraction, Decimal, huge int) as doubles; anything else is a TypeError."""
    if array.dtype.kind != "O":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}")
    # An array without dimensions can be converted to a double whatever it holds: what counts is what that is.
    numbers = [each[()] if isinstance(each, np.ndarray) and each.ndim == 0 else each for each in array.flat]
    kinds = set(map(type, numbers))
    wrong = tuple(kind for kind in kinds if not _is_real(kind))
    if wrong:
        first = next(k for k, number in enumerate(numbers) if isinstance(number, wrong))
        where = entry(name, tuple(int(i) for i in np.unravel_index(first, array.shape)))
        raise TypeError(
            f"{where} is {numbers[first]!r}, which is not a real number but a {type(numbers[first]).__name__}"
        )
    try:
        doubles = np.array([_nearest_double(number) for number in numbers], dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name} holds values that are not real numbers: {error}") from error
    rounded = np.zeros(len(numbers), dtype=np.bool_)
    for k in np.flatnonzero(np.abs(doubles) >= _WHOLE) if np.longdouble not in kinds else range(len(numbers)):
        rounded[k] = not _equal(numbers[k], float(doubles[k]))
    _refuse_rounded(rounded.reshape(array.shape), array, name)
    return doubles.reshape(array.shape)


def _is_real(kind: type) -> bool:
    """Whether objects of a type are real numbers: not booleans, strings or times, which NumPy would convert."""
    if issubclass(kind, np.generic):
        return issubclass(kind, np.integer | np.floating) and not issubclass(kind, np.timedelta64)
    return kind is not bool and (hasattr(kind, "__float__") or hasattr(kind, "__index__"))


def _nearest_double(number: Any) -> float:
    try:
        return float(number)
    except OverflowError:
        return np.inf if number > 0 else -np.inf


def _equal(number: Any, double: float) -> bool:
    """Whether a whole number or a long double equals a double; other numbers may be rounded."""
    if isinstance(number, int | np.integer):
        return abs(double) < np.inf and int(number) == int(double)
    return not isinstance(number, np.longdouble) or bool(np.longdouble(double) == number or number != number)


def _refuse_rounded(rounded: npt.NDArray[np.bool_], array: npt.NDArray[Any], name: str) -> None:
    if rounded.any():
        index = tuple(int(i) for i in np.argwhere(rounded)[0])
        raise ValueError(
            f"{entry(name, index)} is {array[index]!s}, which no double equals; subtract an origin that all share, or "
            f"round with np.asarray({name}).astype(float)"
        )


def entry(name: str, index: tuple[int, ...]) -> str:
    """How a message names one value of an argument: `points[3, 0]`, or `magnification` for a single number."""
    return f"{name}[{', '.join(map(str, index))}]" if index else name
