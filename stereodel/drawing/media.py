"""Pages for media other than print at full width: a journal column, a slide.

The picture is laid out again for the size at which it is viewed. Lengths in page units scale with the page, lengths in
points (lines, dots, type) scale less, and labels are placed again (`stereodel.drawing.type_room`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from stereodel.drawing.page import Dots, Item, Label, Page, Polylines, Stroke
from stereodel.drawing.type_room import Box, clear_labels, set_anew

CENTIMETRE: Final = 72.0 / 2.54
"""Units in points."""

ROUNDS: Final = 12
"""Largest number of times that a picture is reduced to make room for type."""


@dataclass(frozen=True)
class Medium:
    """A medium, and how lengths in points change with the scale s of the picture.

    width, height: of the page in points; without height it has that of the picture.
    margin: around the picture in points.
    line, type_size: factor a and power p: widths of lines and radii of dots, and sizes of type, are multiplied by a sᵖ.
    least_type: smallest size of type in points.
    """

    width: float
    height: float | None
    margin: float
    line: tuple[float, float]
    type_size: tuple[float, float]
    least_type: float


COLUMN: Final = Medium(8.4 * CENTIMETRE, None, 0.0, (1.0, 1 / 3), (1.0, 1 / 2), 7.0)
"""A journal column. Lines of a picture 17 cm wide get 0.79 of their width, 9-point type becomes 7-point."""

SLIDE: Final = Medium(33.87 * CENTIMETRE, 19.05 * CENTIMETRE, 24.0, (1.25, 1.0), (1.15, 1.0), 12.0)
"""A 16:9 slide, viewed from a distance."""


def page_for(page: Page, medium: Medium) -> Page:
    """A page laid out for a medium, with the picture centred; labels without room are left out."""
    free = medium.width - 2 * medium.margin
    high = None if medium.height is None else medium.height - 2 * medium.margin
    scale = free / page.width if high is None else min(free / page.width, high / page.height)
    clear = clear_labels(page)
    items = tuple(_scaled(item, medium, scale) for item in page.items)
    unit = scale * page.points_per_unit
    for _ in range(ROUNDS):
        room = _spread(page.extent, free / unit, 0.0)
        placed, extent = set_anew(items, page.extent, unit, (room[0], room[1]), clear)
        needed = max(
            unit * (extent[1] - extent[0]) / free, 0.0 if high is None else unit * (extent[3] - extent[2]) / high
        )
        if needed <= 1:
            break
        unit /= needed
    extent = _spread(extent, medium.width / unit, 0.0 if medium.height is None else medium.height / unit)
    return replace(page, items=placed, extent=extent, width=medium.width)


def _spread(extent: Box, width: float, height: float) -> Box:
    """An extent with the same centre, at least this wide and high."""
    left, right, bottom, top = extent
    across, up = max(0.0, width - (right - left)) / 2, max(0.0, height - (top - bottom)) / 2
    return (left - across, right + across, bottom - up, top + up)


def _scaled(item: Item, medium: Medium, scale: float) -> Item:
    """An item with its lengths in points scaled for a medium."""
    (line, line_power), (type_size, type_power) = medium.line, medium.type_size
    weight = line * scale**line_power
    match item:
        case Stroke():
            dash = item.dash and (weight * item.dash[0], weight * item.dash[1])
            return replace(item, width=weight * item.width, dash=dash)
        case Polylines():
            return replace(item, width=weight * item.width)
        case Dots():
            return replace(item, radius=weight * item.radius, rim_width=weight * item.rim_width)
        case Label():
            size = max(medium.least_type, type_size * scale**type_power * item.size)
            ratio = size / item.size
            offset = (ratio * item.offset[0], ratio * item.offset[1])
            return replace(item, size=size, offset=offset, halo=ratio * item.halo)
        case _:
            return item
