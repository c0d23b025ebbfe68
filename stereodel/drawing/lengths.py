"""Lengths on paper: a number of points, or text with a unit."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final

from stereodel._arrays import as_scalar

LengthLike = float | str
"""A number of points, 1/72 inch, or a text such as "17cm", "8.4 cm", "120mm", "6.5in", "480pt"."""

POINTS: Final[Mapping[str, float]] = {"pt": 1.0, "mm": 72 / 25.4, "cm": 72 / 2.54, "in": 72.0}
"""Units in points."""

_LENGTH: Final = re.compile(r"\s*(?P<number>[\d.]+(?:e[+-]?\d+)?)\s*(?P<unit>[a-z]*)\s*", re.IGNORECASE)


def as_length(value: LengthLike, name: str) -> float:
    """A positive length in points, from points or a number with one of the units pt, mm, cm and in.

    ValueError with the `name` of the argument if the unit is unknown, or the length is not positive and finite.

    >>> as_length("1in", "width"), as_length("2.54 cm", "width"), as_length(72, "width")
    (72.0, 72.0, 72.0)
    """
    if not isinstance(value, str):
        return as_scalar(value, name, low=0.0, open_low=True)
    found = _LENGTH.fullmatch(value)
    unit = found["unit"].lower() or "pt" if found else ""
    try:
        number = float(found["number"]) if found else 0.0
    except ValueError:
        number = 0.0
    if unit not in POINTS or not number > 0:
        raise ValueError(f"{name} is {value!r}; give a length with a unit, {', '.join(POINTS)}, such as 17cm")
    return number * POINTS[unit]
