"""The content of a picture, before rendering: paths, dots, balls and labels in painter's order.

A `Page` is flat. Hidden parts have been removed analytically (`stereodel.drawing.scene`), curves are exact up to their
approximation by cubic Béziers, and every item carries its colour and its width in points. The vector backend writes SVG
and PDF, the raster backend draws triangles with OpenGL; the regression tests store `Page.arrays()`. Page coordinates
have x to the right and y up, in any unit; `width` is the width of the extent in points.
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
"""Largest number of colours of `Polygons` written as paths in vector files; with more, they become an image."""


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
    """Name of what is drawn: "delaunay", "voronoi", "limb" …; becomes its id in SVG."""


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
    """The content of a `Picture`, computed at the resolution and in the region in which it is drawn."""

    def paint(self, place: tuple[float, float, float, float], pixels: tuple[int, int]) -> Pixels:
        """Pixels (rows, columns, 4) from the top: sRGB and opacity, not premultiplied.

        `place` is the left and upper edge, then the width and height of a pixel, in page units; `pixels` are columns
        and rows. Pixels more than one pixel outside the outline are arbitrary.
        """

    def arrays(self) -> dict[str, npt.NDArray[np.generic]]:
        """The arrays that define it, for the regression tests."""


@dataclass(frozen=True, eq=False)
class Picture:
    """A region painted pixel by pixel: a raster on a globe.

    Lower items show through transparent pixels. The raster backend draws one pixel of the painter for each of its own;
    the vector backend embeds an image, clipped to `outline`.
    """

    outline: tuple[Beziers, ...]
    painter: Painter
    name: str = ""


@dataclass(frozen=True, eq=False)
class Polylines:
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


@dataclass(frozen=True, eq=False)
class Polygons:
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
    """Width in points of a line around the letters."""
    halo_color: Color = (1.0, 1.0, 1.0, 1.0)
    on_ground: bool = False
    """Whether the halo takes the colour of the ground below, see `stereodel.drawing.ground`."""
    font: tuple[str, ...] = ()
    """Font families or files, see `stereodel.drawing.fonts.as_font`; STIX supplies missing characters."""
    formulas: bool = True
    """Whether text between two dollar signs is a formula in matplotlib's mathtext; otherwise they are literal."""


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
        View matrices from which the page was made (rows right, up, toward), kept for the regression tests.
    title, description : str
        Title in one line, and description in plain paragraphs. They are not drawn: files contain them for search and
        for readers who cannot see the picture.

    Raises
    ------
    ValueError
        If the extent has no area, or the width is not positive.
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
        """The items that vector files hold as images because they have too many colours."""
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

        SVG and PDF contain exact curves, within a thousandth of a point, text as text in embedded fonts, and the
        shading of balls as gradients; the same page always gives the same bytes. All three formats contain title and
        description. Lines, dots and text are measured in points: more pixels give a finer image of the same page. For a
        poster with thinner lines, make the page wider: ``dataclasses.replace(page, width=...)``.

        Parameters
        ----------
        path : path-like
            File to write, first under a temporary name in the same folder; an existing file is replaced.
        size : int, optional
            Width of a PNG in pixels, at most 65 535; by default 300 dpi, which is 2008 for 17 cm.
        text : bool
            Whether to draw labels.
        renderer : {"gl", "agg"}
            Renderer of a PNG: OpenGL, or matplotlib, which needs no OpenGL but does not shade balls and rejects regions
            in more than `FEW_COLORS` colours.
        platform : {"osmesa", "egl"}, optional
            See `stereodel.render.gl`.
        transparent : bool
            Whether to make the background transparent. A PNG is then drawn twice and held in memory.

        Returns
        -------
        Path
            The file.

        Raises
        ------
        ValueError
            If the extension or renderer is unknown, or `size` is out of range.
        OSError
            If the file cannot be written, or OpenGL, needed for PNG and for images in vector files, is missing.

        Notes
        -----
        Browsers use the fonts embedded in an SVG. librsvg and Inkscape do not: they use the font of that name (STIX) if
        it is installed, otherwise another serif font. For print and for documents, use PDF.

        The shading in SVG and PDF is off by 0.8 levels of 255 on average and at most by 4, at the edge of a white ball.

        A PNG of 16 384 × 16 384 pixels is drawn in less than a gigabyte of memory, which its pixels alone would take at
        once.

        Examples
        --------
        >>> import tempfile
        >>> from stereodel.drawing import Scene, View
        >>> page = Page((-1.1, 1.1, -1.1, 1.1), Scene().layout(View(0, 0)))
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page.save(Path(folder, "ball.png"), size=50).stat().st_size > 1000
        True
        """
        # Imported on use, as matplotlib does with its backends: the rest of this package is independent of rendering.
        with of_extra(picture_extra(Path(path).suffix, renderer)):
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
            If the renderer is unknown, or `size` is out of range.
        stereodel.render.gl.OpenGLError
            If there is no usable OpenGL.

        Examples
        --------
        >>> Page((0.0, 2.0, 0.0, 1.0), background=(1.0, 0.0, 0.0, 1.0)).pixels(size=40)[0, 0].tolist()
        [255, 0, 0]
        """
        with of_extra(picture_extra(".png", renderer)):
            from stereodel.render.save import draw_page

            return draw_page(self, size=size, text=text, renderer=renderer, platform=platform)

    def arrays(self) -> dict[str, npt.NDArray[np.generic]]:
        """Everything drawn as named arrays, for the regression tests: every visible change alters a number."""
        named: dict[str, npt.NDArray[np.generic]] = {
            "page": np.array([*self.extent, self.width, *self.background]),
            "views": np.array(self.views).reshape(-1, 3, 3),
        }
        for number, item in enumerate(self.items):
            prefix = f"{number:04d}_{type(item).__name__.lower()}_{item.name}"
            named.update({f"{prefix}_{key}": value for key, value in _arrays_of(item).items()})
        return named


def picture_extra(kind: str, renderer: str = "gl") -> str:
    """The extra that brings all that draws a page into a file of that extension."""
    return "render" if renderer == "gl" and kind.lower() == ".png" else "draw"


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
