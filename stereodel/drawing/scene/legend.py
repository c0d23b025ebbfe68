"""Legends: the meaning of lines, dots and tints, and scales of colours and sizes, in rows below a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from stereodel._arrays import FloatArray, as_count
from stereodel.drawing.page import Page
from stereodel.drawing.page.colors import ColorLike, as_color
from stereodel.drawing.page.items import LEGEND, Dots, Item, Label, Look, Stroke, straight
from stereodel.drawing.page.labels import label_box
from stereodel.drawing.page.scales import KEY, ColorScale, SizeScale
from stereodel.drawing.page.style import DARK_GRAY, LABEL_SIZE, DotStyle, LineStyle
from stereodel.drawing.page.ticks import MOST_TICKS
from stereodel.drawing.scene.sketch import Sketch, arc_path

SAMPLE: Final = (18.0, 7.0)
"""Length of a sample, and height of a tint sample, in points."""

ROW: Final = 1.5
"""Height of a row relative to that of type."""

BETWEEN: Final = 30.0
"""Least space between two scales side by side, in points."""

EDGE: Final = 0.5
"""Width in points of the line around a dot by value; the dot's area is that inside it, the line included."""

LEADS: Final = 9.0
"""Length of the lines from circles to their numbers beyond the largest circle, in points."""

LegendEntry = LineStyle | DotStyle | ColorLike | ColorScale | SizeScale
"""Symbols of a legend."""


def with_legend(page: Page, entries: Mapping[str, LegendEntry], *, columns: int = 1, indent: float = 0.0) -> Page:
    """The page with a legend below the picture.

    A sample that looks like a part of the picture, "coast", is named after it, "legend-coast", and follows it in styles
    applied later; others are named "legend".

    Parameters
    ----------
    page : Page
        Page whose width is kept and which grows downwards.
    entries : mapping of str to LineStyle, DotStyle, color-like, ColorScale or SizeScale
        Texts and their symbols: a short line, a dot or a tinted box, row by row. Scales come last, below their titles:
        of colours as a bar, of sizes as circles inside each other. The description of the page names them, too.
    columns : int
        Number of columns of equal width, at least 1.
    indent : float
        Space to the left of the first column and to the right of the last, in points.

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
    room, row = page.width - 2 * indent, ROW * size * point
    sketch = Sketch()
    scales = {text: style for text, style in entries.items() if isinstance(style, ColorScale | SizeScale)}
    samples = {text: style for text, style in entries.items() if not isinstance(style, ColorScale | SizeScale)}
    parts = [(item._look, item.name) for item in page.items]
    for number, (text, style) in enumerate(samples.items()):
        down, across = divmod(number, count)
        place = np.array([left + indent * point + room * point / count * across, bottom - row * (down + 1)])
        look = style if isinstance(style, LineStyle | DotStyle) else as_color(style)
        alike = [part for other, part in parts if part and other == look]
        part = text if text in alike else next(iter(alike), "")
        _add_sample(sketch, look, place, point, f"{LEGEND}{part}" if part else "legend")
        sketch.add_label(place, text, (SAMPLE[0] + 5.0, 0.0), align="left", size=size, name="legend")
    foot = bottom - row * -(-len(samples) // count)
    blocks = [BLOCKS[type(scale)](text, scale, room, page) for text, scale in scales.items()]
    while blocks:
        many = max(1, int(np.sum(np.cumsum([block[0] + BETWEEN for block in blocks]) <= room + BETWEEN)))
        line, blocks = blocks[:many], blocks[many:]
        start = (left + right - (sum(block[0] + BETWEEN for block in line) - BETWEEN) * point) / 2
        for wide, _, draw in line:
            sketch.add_items(draw(start, foot))
            start += (wide + BETWEEN) * point
        foot -= max(block[1] for block in line) * point
    extent = (left, right, foot - 0.5 * row, top)
    items = (*page.items, *sketch.page(extent, width=page.width).items)
    return described(replace(page, extent=extent, items=items), scales)


def described(page: Page, entries: Mapping[str, LegendEntry]) -> Page:
    """The page with what its scales are in its description."""
    scales = {text: each for text, each in entries.items() if isinstance(each, ColorScale | SizeScale)}
    told = [f"{text}: {each.description}." for text, each in scales.items()]
    return replace(page, description="\n".join(filter(None, [page.description, *told])))


Block = tuple[float, float, Callable[[float, float], Iterator[Item]]]
"""Width and height of a scale in a legend, points, and its items from its left upper corner on the page."""


def _widths(texts: Iterable[str]) -> FloatArray:
    """Widths of texts in points."""
    return np.array([np.ptp(label_box(Label(text, (0.0, 0.0), size=LABEL_SIZE), 1.0)[:, 0]) for text in texts])


def _needed(scale: ColorScale, ticks: Mapping[float, str]) -> float:
    """Width in points at which the texts of ticks have room beside each other, with 6 points between them."""
    shown = {number: text for number, text in ticks.items() if text}
    needs, steps = _widths(shown.values()), np.diff(scale.place(list(shown)))
    return float(np.max(((needs[1:] + needs[:-1]) / 2 + 6.0) / steps, initial=0.0))


def _bar(title: str, scale: ColorScale, room: float, page: Page) -> Block:
    """A bar with as many numbers as have room below it; of classes, wide enough for all limits."""
    high, wide = 0.8 * LABEL_SIZE, 0.4 * page.width
    key = KEY[0] * high + KEY[1] * high if scale.missing_key else 0.0
    if scale.edges:
        wide = min(max(wide, _needed(scale, scale.ticks)), room - key)
    for most in range(max(MOST_TICKS, len(scale.edges)), 0, -1):
        ticks = scale.at_most(most)
        if _needed(scale, ticks) <= wide:
            break
    over = float(max(0.0, _widths([scale.missing_key])[0] - KEY[1] * high) / 2) if key else 0.0

    def draw(left: float, top: float) -> Iterator[Item]:
        point, row = 1 / page.points_per_unit, ROW * LABEL_SIZE / page.points_per_unit
        corner = (left, top - 1.9 * row - high * point / 2)
        yield from scale.legend(corner, (wide * point, high * point), ticks, title=title)

    return wide + key + over, 3.2 * ROW * LABEL_SIZE, draw


def _circles(title: str, scale: SizeScale, _: float, page: Page) -> Block:
    """Circles that touch at their feet, with lines from their tops to their numbers."""
    ticks, row = scale.ticks, ROW * LABEL_SIZE
    sizes = scale(list(ticks))
    wide = float(max(sizes[0] + LEADS + 3 + _widths(ticks.values()).max(), _widths([title])[0]))
    like = next((item.name for item in page.items if isinstance(item, Dots) and item.color == scale.color), "")

    def draw(left: float, top: float) -> Iterator[Item]:
        point, name = 1 / page.points_per_unit, f"{LEGEND}{like}" if like else "legend"
        yield Label(title, (left + wide / 2 * point, top - 1.2 * row * point), valign="baseline", name="legend")
        middle, foot, free = left + sizes[0] / 2 * point, top - (1.7 * row + sizes[0]) * point, np.inf
        for size, text in zip(sizes.tolist(), ticks.values(), strict=True):
            at, head = np.array([middle, foot + size / 2 * point]), foot + size * point
            if scale.color is not None:
                yield Dots(at[None], size / 2, as_color(scale.color), name=name, told=("radius",))
            around = arc_path(at, (size - EDGE) / 2 * point, 0.0, 360.0)
            yield Stroke(around, DARK_GRAY, EDGE, closed=True, name=f"{name}-outline")
            free = min(head, free - LABEL_SIZE * point)
            right = left + sizes[0] * point
            ends = np.array([(middle, head), (right, head), (right + LEADS * point, free)])
            yield Stroke(straight(ends), DARK_GRAY, 0.35, name="legend")
            x, y = ends[-1].tolist()
            yield Label(text, (x, y), (3.0, 0.0), "left", size=LABEL_SIZE, name="legend")

    return wide, 2.2 * row + sizes[0], draw


BLOCKS: Final[Mapping[type, Callable[..., Block]]] = {ColorScale: _bar, SizeScale: _circles}


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
