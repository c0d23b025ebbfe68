"""The title of a page: drawn above the picture and stored in files for search and screen readers."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from stereodel.drawing.colors import ColorLike, as_color
from stereodel.drawing.label import label_box
from stereodel.drawing.page import Label, Page
from stereodel.drawing.style import BLACK

TITLE_SIZE: Final = 12.0
"""Type size of a title in points."""

GAP: Final = 5.0
"""Space above and below the title in points."""


def with_title(page: Page, title: str, *, ink: ColorLike = BLACK, size: float = TITLE_SIZE) -> Page:
    """The page with a title above the picture and in its metadata; unchanged if the title is empty.

    Parameters
    ----------
    page : Page
        Page whose width is kept and which grows upwards.
    title : str
        One line; text between two dollar signs is a formula.
    ink : color-like
    size : float
        Type size in points.

    Examples
    --------
    >>> page = with_title(Page((0.0, 2.0, 0.0, 1.0), width=200.0), "Nothing")
    >>> page.title, page.items[0].text, round(float(page.height), 1)
    ('Nothing', 'Nothing', 120.8)
    """
    if not title:
        return page
    left, right, bottom, top = page.extent
    label = Label(title, ((left + right) / 2, top), (0.0, GAP), "center", "bottom", size, as_color(ink, "ink"))
    extent = (left, right, bottom, top + title_height(title, size) / page.points_per_unit)
    return replace(page, extent=extent, items=(*page.items, replace(label, name="title")), title=title)


def title_height(title: str, size: float = TITLE_SIZE) -> float:
    """Points that a page grows by for a title.

    >>> title_height(""), round(title_height("Nothing"), 1)
    (0.0, 20.8)
    """
    if not title:
        return 0.0
    (_, low), (_, high) = label_box(Label(title, (0.0, 0.0), (0.0, GAP), "center", "bottom", size), 1.0)
    return float(high - low) + 2 * GAP
