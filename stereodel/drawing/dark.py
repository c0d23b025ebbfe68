"""Pages on a dark background: colours keep their hue and the contrast that they have on white.

A luminance Y becomes Y' with (Y' + 0.05)(Y + 0.05) = (G + 0.05)(1 + 0.05), where G is the luminance of the background.
White becomes the background, black becomes white, and the contrast of any two colours, a quotient of such sums, is
unchanged. The picture is not inverted: hues are kept, and the shading of a ball, which is not a colour of the page,
still comes from above.
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
"""The dark background. White has contrast 18.7 on it, against 21 of black on white; lower contrasts are kept."""


def dark_page(page: Page) -> Page:
    """A page on a dark background; a page that is already dark is unchanged.

    Images, such as rasters on a globe, keep their pixels.
    """
    ground = dark_color((*page.background[:3], 1.0))
    if contrast(page.background[:3], WHITE[:3]) > contrast(page.background[:3], BLACK[:3]):
        return page
    return replace(page, background=ground, items=tuple(map(_dark_item, page.items)))


def dark_color(color: Color) -> Color:
    """The dark counterpart of a colour on white.

    >>> [round(part, 2) for part in dark_color((1.0, 1.0, 1.0, 1.0))]
    [0.07, 0.07, 0.07, 1.0]
    """
    red, green, blue, opacity = dark_colors(np.array([color]))[0].tolist()
    return (red, green, blue, opacity)


def dark_colors(colors: FloatArray) -> FloatArray:
    """The dark counterparts (n, 4) of colours (n, 4) on white; opacity is unchanged.

    A transparent colour composited on the dark background equals the counterpart of its composite on white, as far as
    such a colour exists.
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
