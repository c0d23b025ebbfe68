"""Pixel dimensions of pictures of pages."""

from __future__ import annotations

from typing import Final

from stereodel._arrays import as_count
from stereodel.drawing.page import Page
from stereodel.drawing.style import PRINT_DPI

LARGEST_SIZE: Final = 2**16 - 1
"""Largest width in pixels, which is that of a canvas of Agg, which draws the labels."""


def print_pixels(page: Page, dpi: float = PRINT_DPI) -> int:
    """Width in pixels of a page in print."""
    return round(page.width / 72 * dpi)


def pixel_height(page: Page, width_px: int) -> int:
    """Height of a picture of a page that is `width_px` pixels wide."""
    return max(1, round(width_px * page.height / page.width))


def as_width(page: Page, size: int | None) -> int:
    """A width in pixels, by default that of print; ValueError if it cannot be drawn."""
    return print_pixels(page) if size is None else as_count(size, "size", high=LARGEST_SIZE)
