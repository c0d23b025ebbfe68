"""Labels: their boxes, their inks and halos on the ground below them, and the title of a page."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import of_extra
from stereodel.drawing.page.colors import Color, contrast
from stereodel.drawing.page.fonts import face_of, families_of, font_properties, quiet_fonts, set_text
from stereodel.drawing.page.items import Label, painted
from stereodel.drawing.page.page import Page
from stereodel.drawing.page.style import BLACK, HALO_OPACITY, TYPE, WHITE, with_opacity

ACROSS, UP = 9, 3
"""Places in the box of a label at which the ground is sampled."""

MOST: Final = 0.85
"""Share of these places that must have one colour for the halo to have it: on more of another, it would be a patch."""

VEIL: Final = 0.6
"""Opacity of a halo on several colours: black type on a white one has contrast 7.4 even where the ground is black."""

LEGIBLE, LEGIBLE_ON_SEVERAL = 7.0, 4.5
"""Least contrast of type with one ground, and with each of several (Web Content Accessibility Guidelines, AAA, AA)."""

TITLE_SIZE, TITLE_GAP = 12.0, 5.0
"""Type size of a title, and the space above and below it, in points."""


def label_box(label: Label, points_per_unit: float) -> FloatArray:
    """Lower left and upper right corner of an unrotated label, in points, (2, 2)."""
    width, height = _measured(*set_text(label), tuple(families_of(label)), label.size, face_of(label.font))
    left = {"left": 0.0, "center": -width / 2, "right": -width}[label.align]
    low = {"bottom": 0.0, "baseline": 0.0, "center": -height / 2, "top": -height}[label.valign]
    corner = points_per_unit * np.array(label.anchor) + np.array(label.offset) + np.array([left, low])
    return np.stack([corner, corner + np.array([width, height])])


@lru_cache(maxsize=4096)
def _measured(text: str, math: bool, families: tuple[str, ...], size: float, face: str) -> tuple[float, float]:
    """Width and height of type in points."""
    with of_extra("draw"):
        from matplotlib import rc_context
        from matplotlib.textpath import text_to_path

    with rc_context({"mathtext.fontset": TYPE["mathtext.fontset"]}), quiet_fonts():
        width, height, _ = text_to_path.get_text_width_height_descent(
            text, font_properties(families, size, face), ismath=math
        )
    return width, height


def haloed(page: Page) -> Page:
    """A page on which the ground, all other items, decides inks of labels that have several, and halos `on_ground`.

    The ink is the one that contrasts most with the ground under the words; halos have its colour, or where it has
    several, as at a coast, their mean, lighter or darker as type needs it. A faint ink has a faint halo.
    """
    unit, items = page.points_per_unit, list(page.items)
    asking = {
        row: np.meshgrid(*map(np.linspace, *(label_box(item, unit) / unit), (ACROSS, UP)))
        for row, item in enumerate(items)
        if isinstance(item, Label) and (item.inks or (item.on_ground and item.halo))
    }
    if asking:
        places = np.moveaxis(np.array(list(asking.values())), 1, -1).reshape(-1, 2)
        found = painted(page.items, places, page.background).round(3)
        for row, ground in zip(asking, np.split(found, len(asking)), strict=True):
            items[row] = _tinted(items[row], ground)
    return replace(page, items=tuple(items))


def _tinted(label: Any, found: FloatArray) -> Label:
    """A label on a ground of colours (n, 3)."""
    if label.inks:
        ink = max(label.inks, key=lambda ink: float(np.log(contrast(found, ink[:3])).mean()))
        label = replace(label, color=with_opacity(ink, ink[3] * label.color[3]))
    if not (label.on_ground and label.halo):
        return label
    colors, counts = np.unique(found, axis=0, return_counts=True)
    opacity, ground, least = VEIL, found.mean(axis=0), LEGIBLE_ON_SEVERAL
    if counts.max() >= MOST * len(found):
        opacity, ground, least = HALO_OPACITY, colors[counts.argmax()], LEGIBLE
        found = ground[None]
    red, green, blue = legible(ground, label.color, found, opacity, least).tolist()
    return replace(label, halo_color=(red, green, blue, opacity * label.color[3]))


def legible(halo: FloatArray, ink: Color, ground: FloatArray, opacity: float, least: float) -> FloatArray:
    """A colour of a halo mixed with white or black, whichever is farther from the ink, until type on it is legible.

    The halo lies on a ground of colours (n, 3), and contrasts are to be at least `least`.
    """
    away = max(WHITE[:3], BLACK[:3], key=lambda far: float(contrast(far, ink[:3])))
    mixed: FloatArray = halo + np.linspace(0.0, 1.0, 21)[:, None] * (away - halo)
    enough = (contrast(ground + opacity * (mixed[:, None] - ground), ink[:3]) >= least).all(axis=1)
    return mixed[enough.argmax() if enough.any() else -1]


def with_title(page: Page, title: str) -> Page:
    """The page with a title above the picture and in its metadata; unchanged if the title is empty.

    Parameters
    ----------
    page : Page
        Page whose width is kept and which grows upwards.
    title : str
        One line; text between two dollar signs is a formula.

    Examples
    --------
    >>> page = with_title(Page((0.0, 2.0, 0.0, 1.0), width=200.0), "Nothing")
    >>> page.title, page.items[0].text, round(float(page.height), 1)
    ('Nothing', 'Nothing', 120.8)
    """
    if not title:
        return page
    left, right, bottom, top = page.extent
    label = Label(title, ((left + right) / 2, top), (0.0, TITLE_GAP), "center", "bottom", TITLE_SIZE, BLACK)
    extent = (left, right, bottom, top + title_height(title) / page.points_per_unit)
    return replace(page, extent=extent, items=(*page.items, replace(label, name="title")), title=title)


def title_height(title: str) -> float:
    """Points that a page grows by for a title."""
    if not title:
        return 0.0
    (_, low), (_, high) = label_box(Label(title, (0.0, 0.0), valign="bottom", size=TITLE_SIZE), 1.0)
    return float(high - low) + 2 * TITLE_GAP
