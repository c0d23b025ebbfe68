"""Pages for other media than a page of print: a column of a journal, a slide.

The picture is laid out anew for the size at which it is seen. What is measured in page units becomes smaller or larger
with the page, what is measured in points (lines, dots, type) less so, and type finds its place again
(`stereodel.drawing.type_room`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from stereodel.drawing.page import Dots, Item, Label, Page, Polylines, Stroke
from stereodel.drawing.type_room import Box, clear_labels, set_anew

CENTIMETRE: Final = 72.0 / 2.54
"""In points."""

ROUNDS: Final = 12
"""How often a picture is made smaller for the type beside it, at most."""


@dataclass(frozen=True)
class Medium:
    """Where a picture is seen, and how what is measured in points changes with the scale s of the picture.

    Parameters
    ----------
    width : float
        Of the page in points.
    height : float, optional
        Of the page in points; by default what the picture needs.
    margin : float
        About the picture, points.
    line, type_size : (float, float)
        Factor a and power p: widths of lines and radii of dots, and sizes of type, are multiplied by a sᵖ.
    least_type : float
        Below which no type is, points.
    """

    width: float
    height: float | None
    margin: float
    line: tuple[float, float]
    type_size: tuple[float, float]
    least_type: float


COLUMN: Final = Medium(8.4 * CENTIMETRE, None, 0.0, (1.0, 1 / 3), (1.0, 1 / 2), 7.0)
"""A column of a journal. A line of a picture that is 17 cm wide gets 0.79 of its width, type of 9 points 7."""

SLIDE: Final = Medium(33.87 * CENTIMETRE, 19.05 * CENTIMETRE, 24.0, (1.25, 1.0), (1.15, 1.0), 12.0)
"""A slide of 16 to 9, seen from afar."""


def page_for(page: Page, medium: Medium) -> Page:
    """A page laid out for a medium, the picture in its middle.

    Parameters
    ----------
    page : Page
    medium : Medium

    Returns
    -------
    Page
        As wide as the medium and as high, or as high as the picture needs. Labels that have no room are not on it.
    """
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
    """An extent with the same middle, at least so wide and high."""
    left, right, bottom, top = extent
    across, up = max(0.0, width - (right - left)) / 2, max(0.0, height - (top - bottom)) / 2
    return (left - across, right + across, bottom - up, top + up)


def _scaled(item: Item, medium: Medium, scale: float) -> Item:
    """An item with what it measures in points changed."""
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
