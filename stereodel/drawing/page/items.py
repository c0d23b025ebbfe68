"""The seven kinds of items on a page, each with all that differs by kind but its rendering.

A new kind is one class here, and a case in each of the two renderers, `stereodel.render.vector.outlines` (outlines) and
`stereodel.render.tessellation`, where the type checker finds a kind that is missing.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Final, Literal, Protocol, Self

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices, Pixels
from stereodel._notebook import Displayed
from stereodel.constants import GROUND_PIXEL
from stereodel.curves.ragged import Ragged
from stereodel.drawing.page.colors import Color, as_color
from stereodel.drawing.page.style import WHITE, DotStyle, LineStyle

Beziers = FloatArray
"""A connected run of cubic Béziers, (k, 4, 2): row i ends where row i + 1 begins; straight: controls at thirds."""

LEGEND: Final = "legend-"
"""Beginning of the name of a sample in a legend, before the name of what it explains and looks like."""

FEW_COLORS: Final = 64
"""Largest number of colours of `Polygons` written as paths in vector files; with more, they become an image."""


BEZIER_STEPS: Final = np.linspace(0.0, 1.0, 8, endpoint=False)

Arrays = dict[str, npt.NDArray[np.generic]]

Recolour = Callable[[FloatArray], FloatArray]
"""New colours (n, 4) of colours (n, 4)."""

Look = LineStyle | DotStyle | Color


@dataclass(frozen=True, eq=False)
class Mark(Displayed):
    """What every item of a page can do; kinds override what differs."""

    _kind: ClassVar[Literal["lines", "dots", "fills", "labels", ""]]
    """Table of a style file with its looks; "" if it has none."""
    _inks: ClassVar[tuple[str, ...]] = ("color",)
    """Its fields that are colours."""

    def arrays(self) -> Arrays:
        """Everything that is drawn, for the regression tests."""
        raise NotImplementedError

    def recoloured(self, change: Recolour) -> Self:
        """The same in other colours."""
        if not self._inks:
            return self
        changed = change(np.array([getattr(self, ink) for ink in self._inks]))
        return replace(self, **dict(zip(self._inks, map(tuple, changed.tolist()), strict=True)))

    def restyled(self, looks: Mapping[str, Any]) -> Self:
        """The same with other values of its fields, those of its kind in a style file."""
        return replace(self, **{key: value for key, value in looks.items() if key not in getattr(self, "told", ())})

    def colors_at(self, places: FloatArray) -> FloatArray | None:
        """Colours (n, 4) at places (n, 2) of the page, with opacity 0 outside; None if it covers no area."""
        return None

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

    def arrays(self) -> Arrays:
        """Path and style, for the regression tests."""
        dash = self.dash or (0.0, 0.0)
        style = np.array([*self.color, self.width, *dash, self.cap == "round", self.closed])
        return {"path": self.path, "style": style}

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

    def arrays(self) -> Arrays:
        """Paths, colour and ball, for the regression tests."""
        sizes, style = np.array([len(path) for path in self.paths]), np.array(self.color)
        return {"path": np.concatenate(self.paths), "sizes": sizes, "style": style, **_light(self.ball)}

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

    def arrays(self) -> Arrays:
        """Centres and style, for the regression tests."""
        return {"centers": self.centers, "style": np.array([self.radius, *self.color, *self.rim, self.rim_width])}

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

    def arrays(self) -> Arrays:
        """The arrays that define it, for the regression tests."""


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

    def arrays(self) -> Arrays:
        """Outline, and what defines the painter, for the regression tests."""
        return {"outline": np.concatenate(self.outline), **self.painter.arrays()}

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

    def arrays(self) -> Arrays:
        """Points and style, for the regression tests."""
        return {"points": self.points, "offsets": self.offsets, "style": np.array([*self.color, self.width])}

    @property
    def _look(self) -> LineStyle:
        return LineStyle(self.color, self.width)


@dataclass(frozen=True, eq=False)
class Polygons(Mark):
    """Many polygonal regions, which may lie on a ball, such as land and the cells of a diagram.

    Loop i is ``points[offsets[i]:offsets[i + 1]]``, with its first point repeated at the end; outer loops are
    counterclockwise, holes clockwise, and regions are filled by the nonzero rule. Regions of different colours do not
    overlap. In vector files the regions of a colour are one path; with more than `FEW_COLORS` colours, all regions are
    one image.
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
        return len(self.by_color[0]) > FEW_COLORS

    _kind = "fills"

    def arrays(self) -> Arrays:
        """Loops, colours and ball, for the regression tests."""
        loops = {"points": self.points, "offsets": self.offsets, "owner": self.owner}
        return {**loops, "colors": self.colors, **_light(self.ball)}

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
    font: tuple[str, ...] = ()
    """Font families or files, see `stereodel.drawing.page.fonts.as_font`; STIX supplies missing characters."""
    formulas: bool = True
    """Whether text between two dollar signs is a formula in matplotlib's mathtext; otherwise they are literal."""

    _kind = "labels"
    _inks = ("color", "halo_color")

    def arrays(self) -> Arrays:
        """Place, text and style, for the regression tests."""
        halo = [self.halo] if self.halo else []
        if self.halo and self.halo_color != Label.halo_color:
            halo += self.halo_color
        numbers = [*self.anchor, *self.offset, self.size, *self.color, self.rotation, *halo]
        told = [self.text, self.align, self.valign, *self.font, *([] if self.formulas else ["plain"])]
        return {"place": np.array(numbers), "text": np.array(told)}

    def restyled(self, looks: Mapping[str, Any]) -> Self:
        """With other values; a halo with a colour of its own no longer takes that of the ground."""
        return replace(self, **looks, on_ground=self.on_ground and "halo_color" not in looks)


def straight(corners: FloatArray) -> Beziers:
    """The path from corner to corner (k + 1, 2)."""
    path: Beziers = corners[:-1, None] + np.diff(corners, axis=0)[:, None] * np.linspace(0.0, 1.0, 4)[:, None]
    path[1:, 0] = path[:-1, 3]
    return path


Item = Stroke | Polylines | Polygons | Fill | Dots | Picture | Label


def _light(ball: Ball | None) -> Arrays:
    return {} if ball is None else {"ball": np.array([*ball.center, ball.radius])}


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
    last = np.zeros(len(loops.values), dtype=bool)
    last[loops.offsets[1:] - 1] = True
    # Only edges at the heights of the places can wind around one.
    low, high = places[:, 1].min(), places[:, 1].max()
    start, end = loops.values, np.roll(loops.values, -1, axis=0)
    near = ~last & (np.minimum(start[:, 1], end[:, 1]) <= high) & (np.maximum(start[:, 1], end[:, 1]) >= low)
    owner = owner[loops.row[near]]
    regions, number = np.unique(owner, return_inverse=True)
    found = np.zeros((len(places), 4))
    for k, place in enumerate(places):
        turns = np.bincount(number, _crossings(start[near], end[near], place), minlength=len(regions))
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
