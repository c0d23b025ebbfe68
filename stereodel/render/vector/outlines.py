"""A page as filled, stroked or image shapes, the common source for SVG, PDF and matplotlib's Agg.

Curves remain cubics, adjacent items of one style become one path, and regions of many colours become a clipped image.
All coordinates are page coordinates; `Paper` converts them to points.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import groupby
from typing import Final, Literal, assert_never

import numpy as np

from stereodel._arrays import Bytes, FloatArray, Pixels
from stereodel.constants import FINEST_PLACE, FINEST_POINTS, PIXEL_ROUNDING
from stereodel.curves.fill import union
from stereodel.curves.ragged import Ragged, thinned
from stereodel.drawing.page import Ball, Beziers, Dots, Fill, Label, Page, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.page.colors import Color, as_color
from stereodel.drawing.page.items import Ramp, alike

STRAIGHTENED: Final = 4
"""Number of passes that drop every other point of a loop where it lies on the line of its neighbours."""

MOVE, LINE, CURVE, CLOSE = 1, 2, 4, 79
"""Kinds of points of an outline, as in `matplotlib.path.Path`; three points in a row make a curve."""

RECTANGLE: Final = np.array([MOVE, LINE, LINE, LINE, CLOSE], dtype=np.uint8)


@dataclass(frozen=True, eq=False)
class Outlines:
    """Runs of straight lines and cubics.

    points: (n, 2).
    kinds: (n,) uint8, `MOVE` where a run begins, `LINE`, `CURVE` for two controls and an end; the point of a `CLOSE`
        means nothing.
    """

    points: FloatArray
    kinds: Bytes

    def __add__(self, other: Outlines) -> Outlines:
        """The runs of both."""
        return Outlines(np.concatenate([self.points, other.points]), np.concatenate([self.kinds, other.kinds]))


@dataclass(frozen=True, eq=False)
class Filled:
    """A region in one colour (even-odd or nonzero rule), or shaded as a ball, or in the colours of a ramp."""

    outline: Outlines
    color: Color
    name: str = ""
    light: Ball | Ramp | None = None
    even_odd: bool = False


@dataclass(frozen=True, eq=False)
class Discs(Filled):
    """Discs of one colour and radius in points, for formats that describe them more briefly than by outlines."""

    centers: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
    radius: float = 0.0


@dataclass(frozen=True, eq=False)
class Drawn:
    """Lines of one style, width and dash in points."""

    outline: Outlines
    color: Color
    width: float
    dash: tuple[float, float] | None = None
    cap: Literal["round", "butt"] = "round"
    name: str = ""


@dataclass(frozen=True, eq=False)
class Shown:
    """An image clipped to an outline; `extent` has its left, right, bottom and top."""

    pixels: Pixels
    extent: tuple[float, float, float, float]
    outline: Outlines
    name: str = ""


Shape = Filled | Drawn | Shown


def shapes(page: Page, dpi: float, pictures: Iterable[Pixels] = (), *, gradients: bool = True) -> Iterator[Shape]:
    """The shapes of a page without its labels, in painter's order.

    dpi: pixels per inch of each `Picture`.
    pictures: an image of the whole page for each of `page.pictured`.
    gradients: whether ramps are regions, not images.
    """
    rest, scale = iter(pictures), page.points_per_unit
    for _, group in groupby(page.without_labels().items, key=alike):
        items = list(group)
        match items[0]:
            case Stroke() as first:
                seen = (item for item in items if isinstance(item, Stroke) and has_length(item, scale))
                if runs := [(item.path, item.closed) for item in seen]:
                    shut = CLOSE if first.cap == "butt" else LINE
                    yield Drawn(outline(runs, scale, shut), first.color, first.width, first.dash, first.cap, first.name)
            case Polylines() as lines:
                yield from _lines(lines, scale)
            case Polygons() as polygons if polygons.pictured:
                border = thinned_loops(union(polygons.loops), FINEST_POINTS / scale)
                yield Shown(next(rest), page.extent, _polygonal(border), polygons.name)
            case Polygons() as polygons:
                colors, number = polygons.by_color
                for k, color in enumerate(colors):
                    loops = thinned_loops(polygons.loops.take(number == k), FINEST_POINTS / scale)
                    yield Filled(_polygonal(loops), as_color(color), polygons.name, polygons.ball)
            case Fill() as fill:
                runs = [(path, True) for path in fill.paths]
                yield Filled(outline(runs, scale), fill.color, fill.name, fill.ball, even_odd=True)
            case Picture(painter=Ramp() as ramp) as picture if gradients:
                bar = outline([(path, True) for path in picture.outline], scale)
                yield Filled(bar, as_color(ramp.colors[0].tolist()), picture.name, ramp)
            case Picture() as picture:
                yield _painted(picture, page, dpi)
            case Dots() as dots:
                yield from _dots(dots, scale)
            case Label():
                pass  # set over everything else
            case other:
                assert_never(other)


def ground(page: Page) -> Iterator[Filled]:
    """The background, unless it is transparent."""
    if page.background[3]:
        left, right, bottom, top = page.extent
        corners = np.array([(left, top), (right, top), (right, bottom), (left, bottom), (left, top)])
        yield Filled(Outlines(corners, RECTANGLE), page.background, "ground")


def has_length(stroke: Stroke, points_per_unit: float) -> bool:
    """Whether a line is longer than a point on paper; the rest of a line that touches the limb from behind is not."""
    return bool(np.ptp(stroke.path.reshape(-1, 2), axis=0).max() * points_per_unit > FINEST_PLACE)


def outline(runs: Iterable[tuple[Beziers, bool]], points_per_unit: float, shut: int = CLOSE) -> Outlines:
    """Runs of Bézier curves, each closed, by a piece of the kind `shut`, or open; straight ones become lines.

    Agg, and PDFium, which is built on it, hollow out closed lines that are smaller than they are wide. With round ends
    a line back to the start is the same ink.
    """
    # A piece deviates by at most three quarters of the deviation of its control points.
    bend = FINEST_PLACE / 4 / points_per_unit
    points: list[FloatArray] = []
    kinds: list[int] = []
    for path, closed in runs:
        thirds = path[:, :1] + np.array([[[1 / 3], [2 / 3]]]) * (path[:, 3:] - path[:, :1])
        close = np.abs(path[:, 1:3] - thirds) <= bend
        points.append(path[:1, 0])
        kinds.append(MOVE)
        for piece, straight in zip(path, np.logical_and.reduce(close, axis=(1, 2)), strict=True):
            points.append(piece[3:] if straight else piece[1:])
            kinds += [LINE] if straight else [CURVE] * 3
        if closed:
            points.append(path[:1, 0])
            kinds.append(shut)
    return Outlines(np.concatenate([np.zeros((0, 2)), *points]), np.array(kinds, dtype=np.uint8))


def _lines(lines: Polylines, points_per_unit: float) -> Iterator[Shape]:
    """Lines, with a disc for each single point or very short line: some programs do not draw lines of length zero."""
    rows = Ragged(lines.points, lines.offsets)
    rows = rows.take(rows.sizes > 0)
    if len(rows) == 0:
        return
    high, low = (extreme.reduceat(rows.values, rows.offsets[:-1]) for extreme in (np.maximum, np.minimum))
    extended = (high - low).max(axis=1) * points_per_unit > FINEST_PLACE
    alone, long = rows.values[rows.offsets[:-1][~extended]], rows.take(extended)
    if len(long):
        # Ends are round, so closed lines need not be closed: see `outline`.
        yield Drawn(_polygonal(long, LINE), lines.color, lines.width, name=lines.name)
    if len(alone):
        yield _discs(alone, lines.width / 2, points_per_unit, lines.color, lines.name)


def thinned_loops(loops: Ragged, spacing: float) -> Ragged:
    """Loops with at most one point per interval of length `spacing`, without those that then enclose nothing.

    Points off a straight line by less than a twentieth of `spacing` go too: arcs of the limb have very many chords.
    """
    loops = thinned(loops, spacing)
    for _ in range(STRAIGHTENED):
        points, row = loops.values, loops.row
        place = np.arange(len(points)) - loops.offsets[row]
        odd = np.flatnonzero((place % 2 == 1) & (place < loops.sizes[row] - 1))
        a, b = points[odd - 1], points[odd + 1] - points[odd - 1]
        step = points[odd] - a
        across, ahead = np.abs(b[:, 0] * step[:, 1] - b[:, 1] * step[:, 0]), np.sum(step * b, axis=1)
        kept = np.ones(len(points), dtype=bool)
        # The tip of a spike lies beyond its neighbours.
        between = (ahead >= 0) & (ahead <= np.sum(b**2, axis=1))
        kept[odd] = ~between | (across >= spacing / (20 * STRAIGHTENED) * np.hypot(*b.T))
        loops = loops.kept(kept)
    return loops.take(loops.sizes > 3)


def _polygonal(rows: Ragged, last: int = CLOSE) -> Outlines:
    """Straight lines from point to point, and a point of a kind at the end of each row."""
    kinds = np.full(len(rows.values), LINE, dtype=np.uint8)
    kinds[rows.offsets[1:] - 1], kinds[rows.offsets[:-1]] = last, MOVE
    return Outlines(rows.values, kinds)


def _painted(picture: Picture, page: Page, dpi: float) -> Shown:
    """A picture within its outline, on whole pixels of the page's grid, which coincide with those of Agg."""
    side = 72 / (dpi * page.points_per_unit)
    corner = np.array([page.extent[0], page.extent[3]])
    cells = (np.concatenate(picture.outline).reshape(-1, 2) - corner) / (side, -side)
    left, top = np.floor(cells.min(axis=0) + PIXEL_ROUNDING)
    right, bottom = np.ceil(cells.max(axis=0) - PIXEL_ROUNDING)
    place = (corner[0] + left * side, corner[1] - top * side, side, side)
    extent = (place[0], corner[0] + right * side, corner[1] - bottom * side, place[1])
    pixels = picture.painter.paint(place, (int(right - left), int(bottom - top)))
    border = outline([(path, True) for path in picture.outline], page.points_per_unit)
    return Shown(pixels, extent, border, picture.name)


def _dots(dots: Dots, points_per_unit: float) -> Iterator[Discs]:
    """A disc for each dot, with a smaller one on top if it has a rim."""
    if dots.rim_width:
        yield _discs(dots.centers, dots.radius, points_per_unit, dots.rim, dots.name)
    yield _discs(dots.centers, dots.radius - dots.rim_width, points_per_unit, dots.color, dots.name)


def _discs(centers: FloatArray, radius: float, points_per_unit: float, color: Color, name: str) -> Discs:
    """Discs of a radius in points, as circles of eight cubics."""
    t = np.arange(9) * (np.pi / 4)
    ends = np.stack([np.cos(t), np.sin(t)], axis=1)
    ends[-1] = ends[0]
    reach = 4 / 3 * np.tan(np.pi / 16) * np.stack([-ends[:, 1], ends[:, 0]], axis=1)
    unit = np.stack([ends[:-1], ends[:-1] + reach[:-1], ends[1:] - reach[1:], ends[1:]], axis=1)
    circles = [(center + radius / points_per_unit * unit, True) for center in centers]
    return Discs(outline(circles, points_per_unit), color, name, centers=centers, radius=radius)
