"""Round numbers along scales, how they are written, and the limits of classes."""

from __future__ import annotations

from collections.abc import Sequence
from decimal import Decimal
from math import ceil, floor, log10
from typing import Any, Final, Literal, get_args

import numpy as np

from stereodel._arrays import FloatArray, Indices, as_choice, as_count, as_floats

Kind = Literal["linear", "log", "symlog", "sqrt"]
"""How numbers are spread along a scale."""

Scheme = Literal["equal", "quantiles", "natural"]
"""How numbers are divided into classes: equal widths, equal counts, or natural breaks."""

MOST_TICKS: Final = 7

DIGITS: Final[tuple[tuple[int, ...], ...]] = ((1, 2, 5), (1, 5), (1,))
"""First digits of round numbers, on a logarithmic scale the finest that give few enough of them."""

SPACE: Final = "\N{NO-BREAK SPACE}"
WORDS: Final = ((12, f"{SPACE}tn"), (9, f"{SPACE}bn"), (6, f"{SPACE}M"), (0, ""))
"""Powers of ten that have a word, and the word."""

SUPERSCRIPTS: Final = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _multiples(low: float, high: float, step: Decimal) -> range:
    """Which multiples of a step lie in [low, high]."""
    first, last = (Decimal(repr(end)) / step for end in (float(low), float(high)))
    return range(ceil(first), floor(last) + 1)


def _step(low: float, high: float, most: int) -> Decimal:
    """The smallest of 1, 2, 5, 10 … times a power of ten with at most so many multiples in [low, high]."""
    power = floor(log10((high - low) / most)) - 1
    steps = (Decimal(digit).scaleb(power + k) for k in range(4) for digit in DIGITS[0])
    return next(step for step in steps if len(_multiples(low, high, step)) <= most)


def round_numbers(low: float, high: float, kind: Kind, threshold: float | None, most: int) -> list[float]:
    """Round numbers in [low, high], at most so many, evenly spread along a scale."""
    if kind == "log" and len(found := _powers(low, high, most)) > 1:
        return found
    if kind == "symlog" and threshold and max(high, -low) > threshold:
        sizes = _powers(threshold, max(high, -low), most if low >= 0 or high <= 0 else max(1, most // 2))
        found = [each for each in (*(-size for size in sizes[::-1]), 0.0, *sizes) if low <= each <= high]
        if len(found) > 1:
            return found
    step = _step(low, high, most)
    return [float(k * step) for k in _multiples(low, high, step)]


def _powers(low: float, high: float, most: int) -> list[float]:
    """1, 2, 5, or 1, 5, or 1, times powers of ten, or each second, third … power, in [low, high]."""
    powers = range(floor(log10(low)), ceil(log10(high)) + 1)
    for digits, stride in (*((digits, 1) for digits in DIGITS), *((DIGITS[-1], k) for k in range(2, len(powers) + 2))):
        numbers = [float(f"{digit}e{power}") for power in powers if power % stride == 0 for digit in digits]
        found = [number for number in numbers if low <= number <= high]
        if len(found) <= most:
            break
    return found


def rounded_ends(low: float, high: float, kind: Kind) -> tuple[float, float]:
    """The nearest round numbers that enclose [low, high]."""
    if kind == "log":
        powers = [floor(log10(end)) for end in (low, high)]
        ends = [float(f"{digit}e{power}") for power in (*powers, powers[1] + 1) for digit in DIGITS[0]]
        return max(end for end in ends if end <= low), min(end for end in ends if end >= high)
    step = _step(low, high, MOST_TICKS - 2)
    first, last = (Decimal(repr(end)) / step for end in (low, high))
    return float(floor(first) * step), float(ceil(last) * step)


def written(numbers: Sequence[float], kind: Kind = "linear") -> list[str]:
    """Numbers as texts with their thousands apart: 500, 1 000, 5 M; on a linear scale all in one unit: 0.5 M, 1 M.

    >>> print(*written([0.0, 500000.0, 1e6]), *written([500.0, 2e4, 1e6], "log"))
    0 0.5 M 1 M 500 20 000 1 M
    """
    largest = max(map(abs, numbers), default=0.0)
    return [_written(number, largest if kind in ("linear", "sqrt") else abs(number)) for number in numbers]


def _written(number: float, like: float) -> str:
    if not number:
        return "0"
    shown, power = Decimal(repr(number)), Decimal(repr(like)).adjusted() if like else 0
    minus = "\N{MINUS SIGN}" if number < 0 else ""
    if not -5 <= power < 15:
        own = shown.adjusted()
        factor = f"{abs(shown.scaleb(-own)).normalize():f}"
        ten = f"10{str(own).translate(SUPERSCRIPTS)}"
        return minus + (ten if factor == "1" else f"{factor}·{ten}")
    unit, word = next(each for each in WORDS if power >= each[0] or not each[0])
    whole = f"{abs(shown.scaleb(-unit)).normalize():,f}".replace(",", SPACE)
    return f"{minus}{whole}{word}"


def to_digits(numbers: Sequence[float], digits: int = 3) -> list[float]:
    """Numbers rounded to three digits, or as many as keep them apart."""
    found = [float(f"{number:.{digits}g}") for number in numbers]
    return found if len(set(found)) == len(set(numbers)) or digits > 15 else to_digits(numbers, digits + 1)


def class_limits(values: FloatArray, scheme: Scheme | Sequence[float], count: int) -> FloatArray:
    """Limits of classes, each of which contains its lower one, the last both; fewer where several would be equal.

    Quantiles and natural breaks are rounded as far as they still part the same values.
    """
    if not isinstance(scheme, str):
        limits = as_floats(scheme, "scheme")
        if limits.ndim != 1 or len(limits) < 2 or (np.diff(limits) <= 0).any():
            raise ValueError(f"scheme is {scheme!r}, but limits of classes are two or more numbers that increase")
        return limits
    as_choice(scheme, get_args(Scheme), "scheme")
    as_count(count, "count")
    known = np.unique(values)
    if len(known) < 2:
        raise ValueError("values has no two different numbers, which classes need; give a ColorScale with its limits")
    if scheme == "equal":
        return np.linspace(known[0], known[-1], count + 1)
    if scheme == "natural":
        first = natural_breaks(values, min(count, len(known)))
    else:
        first = np.searchsorted(known, np.quantile(values, np.arange(1, count) / count))
        first = np.unique(first[first > 0])
    inner = [_simplest(known[k - 1], known[k], known[-1]) for k in first.tolist()]
    return np.unique([known[0], *inner, known[-1]])


def _simplest(above: float, up_to: float, below: float) -> float:
    """A number of few digits that parts two neighbouring values, and is less than a third."""
    ends = ((above + up_to) / 2, up_to)
    rounded = (float(f"{end:.{digits}g}") for digits in range(1, 18) for end in ends)
    return next((number for number in rounded if above < number <= up_to and number < below), up_to)


def natural_breaks(values: FloatArray, count: int) -> Indices:
    """Where, among different values in order, each class but the first begins, (count − 1,), of natural breaks.

    They have the least sum of squared deviations from the means of the classes (Fisher 1958, Jenks 1977). The least
    sums for the first j numbers in k classes follow from those in k − 1. As the best start of the last class only moves
    up with j, the middle number of a range leaves less to its two halves: O(count · n · log n).
    """
    known, weight = np.unique(values, return_counts=True)
    from_mean = known - np.mean(values)
    sums = np.array([np.concatenate([[0.0], np.cumsum(weight * from_mean**power)]) for power in range(3)])
    starts = np.zeros((count, len(known)), dtype=np.intp)
    best = _deviations(sums, np.zeros(1, dtype=np.intp), np.arange(1, len(known) + 1))
    for k in range(1, count):
        before, best = best, np.full(len(known), np.inf)
        ranges = [(k, len(known) - 1, k, len(known) - 1)]
        while ranges:
            low, high, first, last = ranges.pop()
            middle = (low + high) // 2
            start = np.arange(first, min(middle, last) + 1)
            found = before[start - 1] + _deviations(sums, start, middle + 1)
            at = int(np.argmin(found))
            best[middle], starts[k, middle] = found[at], start[at]
            ranges += [(low, middle - 1, first, start[at])] if low < middle else []
            ranges += [(middle + 1, high, start[at], last)] if middle < high else []
    begins = [len(known)]
    for k in range(count - 1, 0, -1):
        begins.append(int(starts[k, begins[-1] - 1]))
    return np.array(begins[:0:-1], dtype=np.intp)


def _deviations(sums: FloatArray, start: Any, stop: Any) -> FloatArray:
    """Sums of squared deviations from their mean of the numbers from start to before stop, from sums of powers."""
    count, total, squares = sums[:, np.atleast_1d(stop)] - sums[:, start]
    return np.asarray(squares - total**2 / count)
