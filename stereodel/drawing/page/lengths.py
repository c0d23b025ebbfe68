"""Lengths on paper, a number of points or text with a unit, and pixels of pages in print."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Final

from stereodel._arrays import as_count, as_scalar
from stereodel.drawing.page.page import Page
from stereodel.drawing.page.style import PRINT_DPI

LengthLike = float | str
"""A number of points, 1/72 inch, or a text such as "17cm", "8.4 cm", "120mm", "6.5in", "480pt"."""

POINTS: Final[Mapping[str, float]] = {"pt": 1.0, "mm": 72 / 25.4, "cm": 72 / 2.54, "in": 72.0}
"""Units in points."""

LARGEST_SIZE: Final = 2**16 - 1
"""Largest width in pixels, which is that of a canvas of Agg, which draws the labels."""

_LENGTH: Final = re.compile(r"\s*(?P<number>[\d.]+(?:e[+-]?\d+)?)\s*(?P<unit>[a-z]*)\s*", re.IGNORECASE)


def as_length(value: LengthLike, name: str) -> float:
    """A positive length in points, from points or a number with one of the units pt, mm, cm and in.

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


def print_pixels(page: Page, dpi: float = PRINT_DPI) -> int:
    """Width in pixels of a page in print."""
    return round(page.width / 72 * dpi)


def pixel_height(page: Page, width_px: int) -> int:
    """Height of a picture of a page that is `width_px` pixels wide."""
    return max(1, round(width_px * page.height / page.width))


def as_width(page: Page, size: int | None) -> int:
    """A width in pixels, by default that of print; ValueError if it cannot be drawn."""
    return print_pixels(page) if size is None else as_count(size, "size", high=LARGEST_SIZE)
