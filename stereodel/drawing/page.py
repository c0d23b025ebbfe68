"""The content of a picture, before rendering: paths, dots, balls and labels in painter's order.

A `Page` is flat. Hidden parts have been removed analytically (`stereodel.drawing.scene`), curves are exact up to cubic
Béziers, and every item carries its colour and its width in points. The vector backend writes it as SVG and PDF, the
raster backend as triangles for OpenGL; the golden tests store `Page.arrays()`. Page coordinates: x right, y up, any
unit; `width` says how many points the extent is wide.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Final, Literal, Protocol

import numpy as np
import numpy.typing as npt

from stereodel._arrays import FloatArray, Indices, Pixels, as_scalar
from stereodel._extras import of_extra
from stereodel.curves.ragged import Ragged
from stereodel.drawing.colors import Color

Beziers = FloatArray
"""A connected run of cubic Béziers, (k, 4, 2): row i ends where row i + 1 begins; straight: controls at thirds."""

FEW_COLORS: Final = 64
"""Colours of `Polygons` that are paths on paper; with more, they are one picture."""


@dataclass(frozen=True, eq=False)
class Stroke:
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
    """What it is, in the words of the figure: "delaunay", "voronoi", "limb" …; becomes its id in SVG."""


@dataclass(frozen=True)
class Ball:
    """The light of a ball as a function of the position on the page: its surface is darker where it turns away.

    The brightness at a position is that of the near side of the ball, whose normal it determines; it is between 0.64
    and 1, brightest in the upper left. Pixels are lit in this way, SVG and PDF by the closest radial gradient.

    Parameters
    ----------
    center : tuple of float
        Page coordinates of its centre.
    radius : float
        In page units, positive.
    """

    center: tuple[float, float]
    radius: float


@dataclass(frozen=True, eq=False)
class Fill:
    """A filled region, bounded by one or more closed runs (even-odd rule), which may lie on a ball."""

    paths: tuple[Beziers, ...]
    color: Color
    name: str = ""
    ball: Ball | None = None


@dataclass(frozen=True, eq=False)
class Dots:
    """Round dots of one kind, radius in points, with a rim of `rim_width` points (0: none) drawn inside the radius."""

    centers: FloatArray
    radius: float
    color: Color
    rim: Color = (1.0, 1.0, 1.0, 1.0)
    rim_width: float = 0.0
    name: str = ""


class Painter(Protocol):
    """What a `Picture` shows: made at the resolution at which it is drawn, and only where it is drawn."""

    def paint(self, place: tuple[float, float, float, float], pixels: tuple[int, int]) -> Pixels:
        """Pixels (rows, columns, 4) from the top: sRGB and opacity, not premultiplied.

        `place` is the left and upper edge, and the width and height of a pixel, in page units; `pixels` are columns and
        rows. What lies beyond the outline by more than a pixel may be anything.
        """

    def arrays(self) -> dict[str, npt.NDArray[np.generic]]:
        """What defines it, for the golden tests."""


@dataclass(frozen=True, eq=False)
class Picture:
    """A region painted pixel by pixel: a raster on a globe.

    Where it is transparent, lower items show through. The raster backend gives each pixel that it draws one of the
    painter's; the vector backend embeds a picture, cut along `outline`.
    """

    outline: tuple[Beziers, ...]
    painter: Painter
    name: str = ""


@dataclass(frozen=True, eq=False)
class Polylines:
    """Many lines of straight pieces, of one style: coastlines, borders.

    Line i is ``points[offsets[i]:offsets[i + 1]]``, closed where its ends are equal; joins and ends are round. A point
    alone is a dot.
    """

    points: FloatArray
    """(n, 2)."""
    offsets: Indices
    """(m + 1,)."""
    color: Color
    width: float
    """In points."""
    name: str = ""


@dataclass(frozen=True, eq=False)
class Polygons:
    """Many regions of straight pieces, which may lie on a ball: land, the cells of a diagram.

    Loop i is ``points[offsets[i]:offsets[i + 1]]``, its first point again at its end, counterclockwise about what it
    bounds and clockwise about holes; a region is filled by the nonzero rule. Regions of different colours do not
    overlap. On paper the regions of a colour are a path, or all of them a picture where there are more than
    `FEW_COLORS`.
    """

    points: FloatArray
    """(n, 2)."""
    offsets: Indices
    """(m + 1,)."""
    owner: Indices
    """(m,): the region of each loop."""
    colors: FloatArray
    """(k, 4): of each region, sRGB and opacity."""
    ball: Ball | None = None
    name: str = ""

    @property
    def loops(self) -> Ragged:
        """The loops."""
        return Ragged(self.points, self.offsets)

    @cached_property
    def by_color(self) -> tuple[FloatArray, Indices]:
        """The different colours of what is drawn (c, 4), and the number of that of each loop (m,)."""
        colors, number = np.unique(self.colors[self.owner], axis=0, return_inverse=True)
        return colors, number.ravel()

    @property
    def pictured(self) -> bool:
        """Whether there are so many colours that only pixels hold them."""
        return len(self.by_color[0]) > FEW_COLORS


@dataclass(frozen=True, eq=False)
class Label:
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
    """Width of a line round the letters, points."""
    halo_color: Color = (1.0, 1.0, 1.0, 1.0)
    font: tuple[str, ...] = ()
    """Families or files of fonts, see `stereodel.drawing.fonts.as_font`; STIX for what they lack."""
    formulas: bool = True
    """Whether what stands between two dollar signs is a formula of matplotlib's mathtext; else they are dollars."""


Item = Stroke | Polylines | Polygons | Fill | Dots | Picture | Label


@dataclass(frozen=True, eq=False)
class Page:
    """A picture.

    Parameters
    ----------
    extent : tuple of float
        (left, right, bottom, top) in page coordinates.
    items : tuple of Item
        In painter's order: later ones cover earlier ones. Labels come last, wherever they are in the tuple.
    width : float
        Width of the extent in points (1/72 inch); the height follows, page units being square. 17 cm are 481.89 points.
    background : Color
    views : tuple of (3, 3) arrays
        The view matrices that made it (rows right, up, toward), kept for the golden tests.
    title, description : str
        What it shows, in a line and in plain paragraphs. They are not drawn: files contain them for search
        and for readers who cannot see the picture.

    Raises
    ------
    ValueError
        For an extent without area, and a width that is not positive.
    """

    extent: tuple[float, float, float, float]
    items: tuple[Item, ...] = ()
    width: float = 481.89
    background: Color = (1.0, 1.0, 1.0, 1.0)
    views: tuple[FloatArray, ...] = field(default=())
    title: str = ""
    description: str = ""

    def __post_init__(self) -> None:
        left, right, bottom, top = self.extent
        as_scalar(right - left, "extent[1] - extent[0]", low=0.0, open_low=True)
        as_scalar(top - bottom, "extent[3] - extent[2]", low=0.0, open_low=True)
        as_scalar(self.width, "width", low=0.0, open_low=True)

    @property
    def points_per_unit(self) -> float:
        """Scale of the page."""
        return self.width / (self.extent[1] - self.extent[0])

    @property
    def height(self) -> float:
        """In points."""
        return (self.extent[3] - self.extent[2]) * self.points_per_unit

    @property
    def labels(self) -> tuple[Label, ...]:
        """The text alone."""
        return tuple(item for item in self.items if isinstance(item, Label))

    @property
    def pictured(self) -> tuple[Polygons, ...]:
        """The items that vector files hold as pictures, because they have too many colours."""
        return tuple(item for item in self.items if isinstance(item, Polygons) and item.pictured)

    def without_labels(self) -> Page:
        """The picture without its text, which is what pixel tests compare."""
        return replace(self, items=tuple(item for item in self.items if not isinstance(item, Label)))

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        size: int | None = None,
        text: bool = True,
        renderer: Literal["gl", "agg"] = "gl",
        platform: str | None = None,
        transparent: bool = False,
    ) -> Path:
        """Write the page as PNG, SVG or PDF, according to the extension of `path`.

        SVG and PDF hold true curves, within a thousandth of a point, text as text, in embedded fonts, and
        the light of balls as gradients; the same page always gives the same bytes. All three contain title and
        description. Lines, dots and text are measured in points: more pixels show the same page more finely. A poster
        with thinner lines is a page with more points, ``dataclasses.replace(page, width=...)``.

        Parameters
        ----------
        path : path-like
            Written under a temporary name in the same folder first; an existing file is replaced.
        size : int, optional
            Width in pixels of a PNG, at most 65 535; by default that of print at 300 dpi, 2008 for 17 cm.
        text : bool
            Whether labels are drawn.
        renderer : {"gl", "agg"}
            Renderer of a PNG: OpenGL, or matplotlib, which needs no OpenGL, but does not shade balls and refuses
            regions in more colours than vector files hold as paths.
        platform : {"osmesa", "egl"}, optional
            See `stereodel.render.gl`.
        transparent : bool
            Whether the ground of the page is left out, so that what lies under the picture shows through. A PNG is then
            drawn twice, and held in memory.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        ValueError
            For another extension or renderer, and for a size that is out of range.
        OSError
            If the file cannot be written, or there is no OpenGL, which PNG needs, and cells in vector files.

        Notes
        -----
        Browsers use the fonts embedded in an SVG. librsvg and Inkscape do not: they show the font of that name where it
        is installed (STIX), or else another serif font. For print, and to place a picture in a document, use the PDF.

        The light in SVG and PDF is off by 0.8 levels of 255 in the mean and by 4 at most, at the edge of a white ball.

        A PNG 16 384 pixels wide and high is drawn in less than a gigabyte; in one piece, its pixels alone would take
        that much.

        Examples
        --------
        >>> import tempfile
        >>> from stereodel.drawing import Scene, View
        >>> page = Page((-1.1, 1.1, -1.1, 1.1), Scene().layout(View(0, 0)))
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page.save(Path(folder, "ball.png"), size=50).stat().st_size > 1000
        True
        """
        # Loaded on use, as matplotlib loads what draws its figures: all else of this room knows nothing of rendering.
        with of_extra("render" if renderer == "gl" and Path(path).suffix.lower() == ".png" else "draw"):
            from stereodel.render.save import save_page

            save_page(self, path, size=size, text=text, renderer=renderer, platform=platform, transparent=transparent)
        return Path(path)

    def pixels(
        self,
        *,
        size: int | None = None,
        text: bool = True,
        renderer: Literal["gl", "agg"] = "gl",
        platform: str | None = None,
    ) -> Pixels:
        """Draw the page: the pixels that `save` writes as PNG.

        Parameters
        ----------
        size, text, renderer, platform
            As for `save`.

        Returns
        -------
        (height, width, 3) uint8 array
            sRGB, rows from the top.

        Raises
        ------
        ValueError
            For another renderer, and for a size that is out of range.
        stereodel.render.gl.OpenGLError
            If there is no usable OpenGL.

        Examples
        --------
        >>> Page((0.0, 2.0, 0.0, 1.0), background=(1.0, 0.0, 0.0, 1.0)).pixels(size=40)[0, 0].tolist()
        [255, 0, 0]
        """
        with of_extra("render" if renderer == "gl" else "draw"):
            from stereodel.render.save import draw_page

            return draw_page(self, size=size, text=text, renderer=renderer, platform=platform)

    def arrays(self) -> dict[str, npt.NDArray[np.generic]]:
        """Everything drawn as named arrays, for the golden tests: a number per thing that a reader could see change."""
        named: dict[str, npt.NDArray[np.generic]] = {
            "page": np.array([*self.extent, self.width, *self.background]),
            "views": np.array(self.views).reshape(-1, 3, 3),
        }
        for number, item in enumerate(self.items):
            prefix = f"{number:04d}_{type(item).__name__.lower()}_{item.name}"
            named.update({f"{prefix}_{key}": value for key, value in _arrays_of(item).items()})
        return named


def _light(ball: Ball | None) -> dict[str, npt.NDArray[np.generic]]:
    return {} if ball is None else {"ball": np.array([*ball.center, ball.radius])}


def _arrays_of(item: Item) -> dict[str, npt.NDArray[np.generic]]:
    match item:
        case Stroke():
            dash = item.dash or (0.0, 0.0)
            style = np.array([*item.color, item.width, *dash, item.cap == "round", item.closed])
            return {"path": item.path, "style": style}
        case Polylines():
            return {"points": item.points, "offsets": item.offsets, "style": np.array([*item.color, item.width])}
        case Polygons():
            loops = {"points": item.points, "offsets": item.offsets, "owner": item.owner}
            return {**loops, "colors": item.colors, **_light(item.ball)}
        case Fill():
            return {
                "path": np.concatenate(item.paths),
                "sizes": np.array([len(p) for p in item.paths]),
                "style": np.array(item.color),
                **_light(item.ball),
            }
        case Dots():
            return {"centers": item.centers, "style": np.array([item.radius, *item.color, *item.rim, item.rim_width])}
        case Picture():
            return {"outline": np.concatenate(item.outline), **item.painter.arrays()}
        case Label():
            halo = [item.halo] if item.halo else []
            if item.halo and item.halo_color != Label.halo_color:
                halo += item.halo_color
            numbers = [*item.anchor, *item.offset, item.size, *item.color, item.rotation, *halo]
            told = [item.text, item.align, item.valign, *item.font, *([] if item.formulas else ["plain"])]
            return {"place": np.array(numbers), "text": np.array(told)}
