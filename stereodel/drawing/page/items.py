"""The seven kinds of items on a page, each with all that differs by kind but its rendering.

A new kind is one class here, and a case in each of the two renderers, `stereodel.render.vector.outlines` (outlines) and
`stereodel.render.tessellation`, where the type checker finds a kind that is missing; and one in
`stereodel.drawing.page.placing.ink` if names avoid it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Final, Literal, Protocol, Self

import numpy as np

from stereodel._arrays import BoolArray, FloatArray, Indices, Pixels
from stereodel._notebook import Displayed
from stereodel.constants import GROUND_PIXEL
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import sides_of
from stereodel.drawing.page.colors import Color, as_color
from stereodel.drawing.page.style import WHITE, DotStyle, LineStyle

Beziers = FloatArray
"""A connected run of cubic Béziers, (k, 4, 2): row i ends where row i + 1 begins; straight: controls at thirds."""

LEGEND: Final = "legend-"
"""Beginning of the name of a sample in a legend, before the name of what it explains and looks like."""

FEW_COLORS: Final = 64
"""Largest number of colours of `Polygons` written as paths in vector files; with more, they become an image."""


_LETTERS = "A-Z_a-z\xc0-\xd6\xd8-\xf6\xf8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c\u200d\u2070-\u218f\u2c00-\u2fef"
_LETTERS += "\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
NO_NAME: Final = re.compile(f"[^-.0-9\xb7\u0300-\u036f\u203f\u2040{_LETTERS}]+")
"""Characters that no name in XML has, of which a colon would be a prefix's (XML 1.0, fifth edition, productions 4)."""

BEZIER_STEPS: Final = np.linspace(0.0, 1.0, 8, endpoint=False)

Recolour = Callable[[FloatArray], FloatArray]
"""New colours (n, 4) of colours (n, 4)."""

Look = LineStyle | DotStyle | Color


def xml_name(text: str) -> str:
    """The name in XML that is closest to a text, such as "_12-c" of "12 °c"; empty if nothing is left."""
    name = NO_NAME.sub("-", text).strip("-")
    return name if re.match(f"[{_LETTERS}]|$", name) else f"_{name}"


@dataclass(frozen=True, eq=False)
class Tags:
    """What the parts of an item, or of a layer, are called in SVG.

    rows: the attributes of each part, such as ``{"id": "Ulm", "data-name": "Ulm"}``.
    owner: the part of each loop, line or dot.
    """

    rows: Sequence[Mapping[str, str]]
    owner: Indices

    @classmethod
    def of(cls, columns: Mapping[str, Iterable[object] | None], count: int) -> Tags | None:
        """Ids by the first column, and data by all, of so many parts, without missing values; None without columns."""
        names = ["id", *(f"data-{xml_name(name.lower())}" for name in columns)]
        texts = [[text_of(value) for value in column] for column in columns.values() if column is not None]
        if not texts:
            return None
        if len(texts[0]) != count:
            raise ValueError(f"ids has {len(texts[0])} entries, but there are {count} to name")
        rows = (zip(names, row, strict=True) for row in zip(texts[0], *texts, strict=True))
        return cls([{name: text for name, text in row if text} for row in rows], np.arange(count))

    def some(self, rows: Indices | BoolArray) -> Tags:
        """Those of some loops, lines or dots."""
        return replace(self, owner=self.owner[rows])


def text_of(value: object) -> str:
    """A value of a table as text; whole numbers without a point, "" for a missing one."""
    if isinstance(value, float):
        return "" if np.isnan(value) else np.format_float_positional(value, trim="-")
    return "" if value is None else str(value)


@dataclass(frozen=True, eq=False)
class Mark(Displayed):
    """What every item of a page can do; kinds override what differs."""

    tags: Tags | None = field(default=None, kw_only=True)
    """Its parts with names of their own in SVG, if there are any."""

    _kind: ClassVar[Literal["lines", "dots", "fills", "labels", ""]]
    """Table of a style file with its looks; "" if it has none."""
    _inks: ClassVar[tuple[str, ...]] = ("color",)
    """Its fields that are colours."""

    def recoloured(self, change: Recolour) -> Self:
        """The same in other colours."""
        if not self._inks:
            return self
        changed = change(np.array([getattr(self, ink) for ink in self._inks]))
        inks: dict[str, Any] = dict(zip(self._inks, map(tuple, changed.tolist()), strict=True))
        return replace(self, **inks)

    def restyled(self, looks: Mapping[str, Any]) -> Self:
        """The same with other values of its fields, those of its kind in a style file."""
        return replace(self, **{key: value for key, value in looks.items() if key not in getattr(self, "told", ())})

    def colors_at(self, places: FloatArray) -> FloatArray | None:
        """Colours (n, 4) at places (n, 2) of the page, with opacity 0 outside; None if it covers no area."""
        return None

    def parts(self) -> Iterator[tuple[Mapping[str, str], Self]]:
        """Each part that has a name of its own: its attributes, and the part alone."""
        if self.tags:
            for part in np.unique(self.tags.owner).tolist():
                yield self.tags.rows[part], self.some(self.tags.owner == part)

    def some(self, rows: BoolArray) -> Self:
        """The same of some of its loops, lines or dots."""
        raise NotImplementedError

    @property
    def _look(self) -> Look | None:
        """The entry of a legend that looks like it, if there is one."""
        return None


@dataclass(frozen=True, eq=False)
class Stroke(Mark):
    """A line of constant width on the page; round joins, and round or flat ends. A line of length zero is not drawn."""

    path: Beziers
    color: Color
    width: float
    """In points."""
    dash: tuple[float, float] | None = None
    """Length of dash and gap in points."""
    cap: Literal["round", "butt"] = "round"
    closed: bool = False
    name: str = ""
    """Name of what is drawn: "delaunay", "voronoi", "limb" …; becomes its id in SVG."""

    _kind = "lines"

    @property
    def _look(self) -> LineStyle:
        return LineStyle(self.color, self.width, self.dash)


@dataclass(frozen=True)
class Ball:
    """The shading of a ball as a function of the position on the page.

    The brightness depends on the normal of the near side at this position; it is between 0.64 and 1, brightest in the
    upper left. Pixels are shaded exactly, SVG and PDF by the closest radial gradient.

    Parameters
    ----------
    center : tuple of float
        Page coordinates of its centre.
    radius : float
        Radius in page units, positive.
    """

    center: tuple[float, float]
    radius: float


@dataclass(frozen=True, eq=False)
class Fill(Mark):
    """A filled region, bounded by one or more closed runs (even-odd rule), which may lie on a ball."""

    paths: tuple[Beziers, ...]
    color: Color
    name: str = ""
    ball: Ball | None = None

    _kind = "fills"

    def colors_at(self, places: FloatArray) -> FloatArray:
        """Its colour inside, by the even-odd rule."""
        return np.where((winding(self.paths, places) % 2 != 0)[:, None], self.color, 0.0)

    @property
    def _look(self) -> Color:
        return self.color


@dataclass(frozen=True, eq=False)
class Dots(Mark):
    """Round dots of one kind, radius in points, with a rim of `rim_width` points (0: none) drawn inside the radius."""

    centers: FloatArray
    radius: float
    color: Color
    rim: Color = WHITE
    rim_width: float = 0.0
    name: str = ""
    told: tuple[str, ...] = ()
    """Its fields that tell a value, which styles keep."""

    _kind = "dots"
    _inks = ("color", "rim")

    def some(self, rows: BoolArray) -> Self:
        """The same of some dots."""
        return replace(self, centers=self.centers[rows], tags=self.tags and self.tags.some(rows))

    @property
    def _look(self) -> DotStyle:
        return DotStyle(self.color, self.radius, self.rim, self.rim_width)


class Painter(Protocol):
    """The content of a `Picture`, computed at the resolution and in the region in which it is drawn."""

    def paint(self, place: tuple[float, float, float, float], pixels: tuple[int, int]) -> Pixels:
        """Pixels (rows, columns, 4) from the top: sRGB and opacity, not premultiplied.

        `place` is the left and upper edge, then the width and height of a pixel, in page units; `pixels` are columns
        and rows. Pixels more than one pixel outside the outline are arbitrary.
        """


@dataclass(frozen=True, eq=False)
class Ramp:
    """A painter whose colour changes evenly from left to right, as the bar of a scale; a gradient in vector files."""

    ends: tuple[float, float]
    """Left and right, in page units."""
    colors: FloatArray
    """(n, 4): sRGB and opacity in the middles of steps of equal width, which pixels show."""

    def paint(self, place: tuple[float, float, float, float], pixels: tuple[int, int]) -> Pixels:
        """Pixels as `Painter` has them: the rows are alike."""
        along = (place[0] + place[2] * (np.arange(pixels[0]) + 0.5) - self.ends[0]) / (self.ends[1] - self.ends[0])
        step = np.clip(along * len(self.colors), 0, len(self.colors) - 1).astype(np.intp)
        return np.tile(np.floor(255 * self.colors[step] + 0.5).astype(np.uint8), (pixels[1], 1, 1))

    @property
    def stops(self) -> tuple[tuple[float, Color], ...]:
        """The fewest of its colours, with their places from 0 to 1, between which all are linear to half a level."""

        def after(first: int, last: int) -> list[int]:
            linear = np.linspace(self.colors[first], self.colors[last], last - first + 1)
            off = np.abs(self.colors[first : last + 1] - linear).max(axis=1)
            worst = int(off.argmax())
            return [last] if off[worst] <= 0.5 / 255 else after(first, first + worst) + after(first + worst, last)

        count = len(self.colors)
        return tuple(((k + 0.5) / count, as_color(self.colors[k].tolist())) for k in [0, *after(0, count - 1)])


@dataclass(frozen=True, eq=False)
class Picture(Mark):
    """A region painted pixel by pixel: a raster on a globe.

    Lower items show through transparent pixels. The raster backend draws one pixel of the painter for each of its own;
    the vector backend embeds an image, clipped to `outline`.
    """

    outline: tuple[Beziers, ...]
    painter: Painter
    name: str = ""

    _kind = ""
    _inks = ()

    def recoloured(self, change: Recolour) -> Self:
        """With other colours of a ramp; rasters keep theirs."""
        ramp = self.painter
        return replace(self, painter=replace(ramp, colors=change(ramp.colors))) if isinstance(ramp, Ramp) else self

    def colors_at(self, places: FloatArray) -> FloatArray:
        """The pixels painted inside the outline."""
        windows = [(x, y, GROUND_PIXEL, GROUND_PIXEL) for x, y in places.tolist()]
        pixels = [self.painter.paint(window, (1, 1))[0, 0] / 255 for window in windows]
        return np.where((winding(self.outline, places) != 0)[:, None], pixels, 0.0)


@dataclass(frozen=True, eq=False)
class Polylines(Mark):
    """Many polylines of one style, such as coastlines and borders.

    Line i is ``points[offsets[i]:offsets[i + 1]]``, closed if its ends are equal; joins and ends are round. A single
    point is a dot.
    """

    points: FloatArray
    """(n, 2)."""
    offsets: Indices
    """(m + 1,)."""
    color: Color
    width: float
    """In points."""
    name: str = ""
    told: tuple[str, ...] = ()

    _kind = "lines"

    def some(self, rows: BoolArray) -> Self:
        """The same of some lines."""
        lines = Ragged(self.points, self.offsets).take(rows)
        return replace(self, points=lines.values, offsets=lines.offsets, tags=self.tags and self.tags.some(rows))

    @property
    def _look(self) -> LineStyle:
        return LineStyle(self.color, self.width)


@dataclass(frozen=True, eq=False)
class Polygons(Mark):
    """Many polygonal regions, which may lie on a ball, such as land and the cells of a diagram.

    Loop i is ``points[offsets[i]:offsets[i + 1]]``, with its first point repeated at the end; outer loops are
    counterclockwise, holes clockwise, and regions are filled by the nonzero rule. Regions of different colours do not
    overlap. In vector files the regions of a colour are one path; with more than `FEW_COLORS` colours, all regions are
    one image. Regions with names (`tags`) are never an image, and in SVG each is a path.
    """

    points: FloatArray
    """(n, 2)."""
    offsets: Indices
    """(m + 1,)."""
    owner: Indices
    """(m,): the region of each loop."""
    colors: FloatArray
    """(k, 4): sRGB and opacity of each region."""
    ball: Ball | None = None
    name: str = ""
    told: tuple[str, ...] = ()

    @property
    def loops(self) -> Ragged:
        """The loops."""
        return Ragged(self.points, self.offsets)

    @cached_property
    def by_color(self) -> tuple[FloatArray, Indices]:
        """The distinct colours drawn (c, 4), and the index of each loop's colour (m,)."""
        colors, number = np.unique(self.colors[self.owner], axis=0, return_inverse=True)
        return colors, number.ravel()

    @property
    def pictured(self) -> bool:
        """Whether there are so many colours that vector files hold the regions as an image."""
        return self.tags is None and len(self.by_color[0]) > FEW_COLORS

    def some(self, rows: BoolArray) -> Self:
        """The same of some loops."""
        loops, owner, tags = self.loops.take(rows), self.owner[rows], self.tags and self.tags.some(rows)
        return replace(self, points=loops.values, offsets=loops.offsets, owner=owner, tags=tags)

    _kind = "fills"

    def recoloured(self, change: Recolour) -> Self:
        """With other colours of all regions."""
        return replace(self, colors=change(self.colors))

    def restyled(self, looks: Mapping[str, Any]) -> Self:
        """In another colour; several colours, such as those of cells, are kept."""
        if not looks or self._look is None or self.told:
            return self
        return replace(self, colors=np.tile(looks["color"], (len(self.colors), 1)))

    def colors_at(self, places: FloatArray) -> FloatArray:
        """The colour of the region around each place."""
        return colors_within(self.loops, self.owner, self.colors, places)

    @property
    def _look(self) -> Color | None:
        colors = self.by_color[0]
        return as_color(colors[0].tolist()) if len(colors) == 1 else None


@dataclass(frozen=True, eq=False)
class Label(Mark):
    """Text, anchored at a page point and moved by `offset` points."""

    text: str
    anchor: tuple[float, float]
    offset: tuple[float, float] = (0.0, 0.0)
    align: Literal["left", "center", "right"] = "center"
    valign: Literal["bottom", "center", "top", "baseline"] = "center"
    size: float = 9.0
    color: Color = (0.0, 0.0, 0.0, 1.0)
    rotation: float = 0.0
    name: str = "label"
    halo: float = 0.0
    """Width in points of a line around the letters."""
    halo_color: Color = WHITE
    on_ground: bool = False
    """Whether the halo takes the colour of the ground below, see `stereodel.drawing.page.labels.haloed`."""
    inks: tuple[Color, ...] = ()
    """Colours of which the ground decides; without any, the ink is `color`."""
    font: tuple[str, ...] = ()
    """Font families or files, see `stereodel.drawing.page.fonts.as_font`; STIX supplies missing characters."""
    formulas: bool = True
    """Whether text between two dollar signs is a formula in matplotlib's mathtext; otherwise they are literal."""

    _kind = "labels"
    _inks = ("color", "halo_color")

    def restyled(self, looks: Mapping[str, Any]) -> Self:
        """With other values; the ground no longer decides a colour that they name."""
        inks = () if "color" in looks else self.inks
        return replace(self, **looks, inks=inks, on_ground=self.on_ground and "halo_color" not in looks)

    def recoloured(self, change: Recolour) -> Self:
        """With other colours of all kinds."""
        changed = super().recoloured(change)
        return replace(changed, inks=tuple(map(tuple, change(np.array(self.inks)).tolist()))) if self.inks else changed


def straight(corners: FloatArray) -> Beziers:
    """The path from corner to corner (k + 1, 2)."""
    path: Beziers = corners[:-1, None] + np.diff(corners, axis=0)[:, None] * np.linspace(0.0, 1.0, 4)[:, None]
    path[1:, 0] = path[:-1, 3]
    return path


Item = Stroke | Polylines | Polygons | Fill | Dots | Picture | Label


def alike(item: Item) -> Hashable:
    """Key of adjacent items that can be drawn as one path: opaque strokes of one style; other overlaps are darker."""
    if isinstance(item, Stroke) and item.color[3] == 1:
        return (item.color, item.width, item.dash, item.cap, item.name)
    return id(item)


def painted(items: Iterable[Item], places: FloatArray, background: Color = WHITE) -> FloatArray:
    """Colours, sRGB (n, 3), of regions and images at places of a page (n, 2), without lines and shading."""
    colors = np.tile(np.array(WHITE[:3]), (len(places), 1))
    covers = (item.colors_at(places) for item in items)
    for over in (np.tile(np.array(background), (len(places), 1)), *covers):
        if over is not None:
            colors += over[:, 3:] * (over[:, :3] - colors)
    return colors


def colors_within(loops: Ragged, owner: Indices, colors: FloatArray, places: FloatArray) -> FloatArray:
    """The colour of the region that contains each place, (n, 4); opacity 0 if none does."""
    first, sides = sides_of(loops)
    start, end, owner = loops.values[first], loops.values[first + 1], owner[sides.row]
    low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
    found = np.zeros((len(places), 4))
    for height in np.unique(places[:, 1]):  # only edges that cross it can wind around a place there
        near = np.flatnonzero((low <= height) & (high > height))
        regions, number = np.unique(owner[near], return_inverse=True)
        for k in np.flatnonzero(places[:, 1] == height):
            turns = np.bincount(number, _crossings(start[near], end[near], places[k]), minlength=len(regions))
            for region in regions[np.flatnonzero(turns)]:
                found[k] = colors[region]
    return found


def winding(paths: Iterable[FloatArray], places: FloatArray) -> FloatArray:
    """Winding numbers of closed runs of cubics (k, 4, 2) about places (n, 2)."""
    found = np.zeros(len(places))
    for corners in map(corners_along, paths):
        following = np.roll(corners, -1, axis=0)
        found += [_crossings(corners, following, place).sum() for place in places]
    return found


def _crossings(start: FloatArray, end: FloatArray, place: FloatArray) -> FloatArray:
    """For each edge: +1 if it goes up on the right of a place, −1 if it goes down there, else 0."""
    up = (start[:, 1] <= place[1]) & (end[:, 1] > place[1])
    down = (start[:, 1] > place[1]) & (end[:, 1] <= place[1])
    a, b = start - place, end - place
    side = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return np.where(up & (side > 0), 1.0, 0.0) - np.where(down & (side < 0), 1.0, 0.0)


def corners_along(path: FloatArray) -> FloatArray:
    """Points along a path of Bézier curves, close enough to determine its interior."""
    return along(path[:, None], BEZIER_STEPS[None, :, None]).reshape(-1, 2)


def along(cubics: FloatArray, s: FloatArray) -> FloatArray:
    """Points of cubics (..., 4, 2) at parameters (..., 1)."""
    p0, p1, p2, p3 = (cubics[..., i, :] for i in range(4))
    return (1 - s) ** 3 * p0 + 3 * s * (1 - s) ** 2 * p1 + 3 * s**2 * (1 - s) * p2 + s**3 * p3
