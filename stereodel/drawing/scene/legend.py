"""Legends: the meaning of lines, dots and tints, in rows below a picture."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray, as_count
from stereodel.drawing.page import Page
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.items import LEGEND, Look
from stereodel.drawing.page.scales import ColorScale
from stereodel.drawing.page.style import LABEL_SIZE, DotStyle, LineStyle
from stereodel.drawing.scene.sketch import Sketch

SAMPLE: Final = (18.0, 7.0)
"""Length of a sample, and height of a tint sample, in points."""

GAP: Final = 5.0
"""Space between a sample and its text, in points."""

ROW: Final = 1.5
"""Height of a row relative to that of type."""

BAR: Final = (0.4, 0.8)
"""Width of a scale's bar relative to the page, and its height relative to type."""

BAR_ROWS: Final = 3.2
"""Height of a scale with its title and numbers, in rows."""

LegendEntry = LineStyle | DotStyle | ColorLike | ColorScale
"""Symbols of a legend."""


def with_legend(page: Page, entries: Mapping[str, LegendEntry], *, columns: int = 1, indent: float = 0.0) -> Page:
    """The page with a legend below the picture.

    A sample that looks like a part of the picture, "coast", is named after it, "legend-coast", and follows it in styles
    applied later; others are named "legend".

    Parameters
    ----------
    page : Page
        Page whose width is kept and which grows downwards.
    entries : mapping of str to LineStyle, DotStyle, color-like or ColorScale
        Texts and their symbols: a short line, a dot or a tinted box, row by row. Scales come last, each as a bar below
        its title.
    columns : int
        Number of columns of equal width, at least 1.
    indent : float
        Space to the left of the first column and to the right of the last, in points.

    Raises
    ------
    ValueError
        If `columns` is less than 1, or a colour is invalid.

    Examples
    --------
    >>> from stereodel.drawing import LineStyle
    >>> page = with_legend(Page((0.0, 2.0, 0.0, 1.0), width=200.0), {"coast": LineStyle("blue", 0.5)})
    >>> [item.name for item in page.items], page.height > 100.0
    (['legend', 'legend'], True)
    """
    count, size = as_count(columns, "columns"), LABEL_SIZE
    left, right, bottom, top = page.extent
    point = 1 / page.points_per_unit
    row, step = ROW * size * point, (page.width - 2 * indent) * point / count
    sketch = Sketch()
    scales = {text: style for text, style in entries.items() if isinstance(style, ColorScale)}
    samples = {text: style for text, style in entries.items() if not isinstance(style, ColorScale)}
    parts = [(item._look, item.name) for item in page.items]
    for number, (text, style) in enumerate(samples.items()):
        down, across = divmod(number, count)
        place = np.array([left + indent * point + step * across, bottom - row * (down + 1)])
        look = style if isinstance(style, LineStyle | DotStyle) else as_color(style)
        alike = [part for other, part in parts if part and other == look]
        part = text if text in alike else next(iter(alike), "")
        _add_sample(sketch, look, place, point, f"{LEGEND}{part}" if part else "legend")
        sketch.add_label(place, text, (SAMPLE[0] + GAP, 0.0), align="left", size=size, name="legend")
    foot = bottom - row * -(-len(samples) // count)
    for text, scale in scales.items():
        wide, high = BAR[0] * (right - left), BAR[1] * size * point
        corner = ((left + right - wide) / 2, foot - 1.9 * row - high / 2)
        sketch.add_items(scale.legend(corner, (wide, high), scale.ticks, title=text))
        foot -= BAR_ROWS * row
    extent = (left, right, foot - 0.5 * row, top)
    return replace(page, extent=extent, items=(*page.items, *sketch.page(extent, width=page.width).items))


def _add_sample(sketch: Sketch, style: Look, place: FloatArray, point: float, name: str) -> None:
    """A short line, a dot or a box, with the midpoint of its left side at `place`."""
    length, height = (point * size for size in SAMPLE)
    end = place + np.array([length, 0.0])
    if isinstance(style, LineStyle):
        sketch.add_segment(place, end, name=name, style=style)
    elif isinstance(style, DotStyle):
        sketch.add_points((place + end) / 2, name=name, style=style)
    else:
        up = np.array([0.0, height / 2])
        sketch.add_polygon([place - up, end - up, end + up, place + up], name=name, color=style)
