"""Pages on a dark ground: colours of the same hue, with the contrasts that they have on white.

A luminance Y becomes Y' with (Y' + 0.05)(Y + 0.05) = (G + 0.05)(1 + 0.05), G being that of the ground. White becomes
the ground, black becomes white, and the contrast of any two colours stays what it was: it is the quotient of such sums.
The picture is not inverted: hues stay, and the light on a ball, which is no colour of the page, still comes from above.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel.drawing.colorimetry import FLARE, contrast, luminance, with_luminance
from stereodel.drawing.colors import Color
from stereodel.drawing.page import Dots, Fill, Item, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.style import BLACK, WHITE

GROUND: Final[Color] = (0.07, 0.07, 0.07, 1.0)
"""What white becomes. Black has contrast 18.7 on it, of 21 on white; what has less than 18.7 keeps its contrast."""


def dark_page(page: Page) -> Page:
    """A page on a dark ground; one whose ground is dark stays as it is.

    Pictures, such as rasters on a globe, keep their pixels.
    """
    ground = dark_color((*page.background[:3], 1.0))
    if contrast(page.background[:3], WHITE[:3]) > contrast(page.background[:3], BLACK[:3]):
        return page
    return replace(page, background=ground, items=tuple(map(_dark_item, page.items)))


def dark_color(color: Color) -> Color:
    """What a colour on white becomes.

    Examples
    --------
    >>> [round(part, 2) for part in dark_color((1.0, 1.0, 1.0, 1.0))]
    [0.07, 0.07, 0.07, 1.0]
    """
    red, green, blue, opacity = dark_colors(np.array([color]))[0].tolist()
    return (red, green, blue, opacity)


def dark_colors(colors: FloatArray) -> FloatArray:
    """What colours (n, 4) on white become, (n, 4); opacity stays.

    What is see-through looks on the dark ground as what it looks on white becomes, as far as there is such a colour.
    """
    several, which = np.unique(colors, axis=0, return_inverse=True)
    opacity = several[:, 3:]
    over_white = 1 - opacity * (1 - several[:, :3])
    ground = luminance(GROUND[:3]) + FLARE
    target = ground * (1 + FLARE) / (luminance(over_white) + FLARE) - FLARE
    seen = with_luminance(over_white, np.clip(target, 0.0, 1.0))
    own = (seen - (1 - opacity) * np.array(GROUND[:3])) / np.where(opacity > 0, opacity, 1.0)
    found = np.concatenate([np.clip(own, 0.0, 1.0), opacity], axis=1)
    return np.asarray(found[which.ravel()])


def _dark_item(item: Item) -> Item:
    match item:
        case Dots():
            return replace(item, color=dark_color(item.color), rim=dark_color(item.rim))
        case Label():
            return replace(item, color=dark_color(item.color), halo_color=dark_color(item.halo_color))
        case Polygons():
            return replace(item, colors=dark_colors(item.colors))
        case Stroke() | Polylines() | Fill():
            return replace(item, color=dark_color(item.color))
        case Picture():
            return item
