"""The content of a picture, before rendering: paths, dots, balls and labels in painter's order, hidden parts removed.

Curves are exact up to their approximation by cubic Béziers. Page coordinates have x to the right and y up, in any unit.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np

from stereodel._arrays import FloatArray, Pixels, as_count, as_scalar
from stereodel._extras import of_extra
from stereodel._notebook import Displayed, drawn
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import Item, Label, Polygons
from stereodel.drawing.page.style import PRINT_DPI

LARGEST_SIZE: Final = 2**16 - 1
"""Largest width in pixels, which is that of a canvas of Agg, which draws the labels."""

OUTPUTS: Final = {
    **dict.fromkeys(("save_page", "draw_page"), "stereodel.render.save"),
    **dict.fromkeys(("save_solid", "draw_solid", "to_trimesh"), "stereodel.render.space.save_solid"),
}
"""The module of each function that draws or writes pages and scenes, loaded on use: nothing below imports it."""


def output(work: str) -> Callable[..., Any]:
    """A function of the table `OUTPUTS`."""
    return getattr(import_module(OUTPUTS[work]), work)


@dataclass(frozen=True, eq=False)
class Page(Displayed):
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
        View matrices from which the page was made (rows right, up, toward), kept for tests.
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
    _mimes = drawn(lambda it: it)

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

    def pixels_in_print(self, dpi: float = PRINT_DPI) -> int:
        """Width in pixels of the page in print."""
        return round(self.width / 72 * dpi)

    def pixels_up(self, width_px: int) -> int:
        """Height of a picture of the page that is `width_px` pixels wide."""
        return max(1, round(width_px * self.height / self.width))

    def pixels_across(self, size: int | None) -> int:
        """A width in pixels, by default that of print; ValueError if it cannot be drawn."""
        return self.pixels_in_print() if size is None else as_count(size, "size", high=LARGEST_SIZE)

    @property
    def labels(self) -> tuple[Label, ...]:
        """The text alone."""
        return tuple(item for item in self.items if isinstance(item, Label))

    @property
    def pictured(self) -> tuple[Polygons, ...]:
        """The items that vector files hold as images because they have too many colours."""
        return tuple(item for item in self.items if isinstance(item, Polygons) and item.pictured)

    def shaded(self, strength: float) -> Page:
        """The picture with balls that are shaded less: `strength` from 0, flat, to 1, as they are.

        Each shaded region is drawn twice, flat and, as transparent as it takes, shaded.

        Examples
        --------
        >>> from stereodel.drawing import Scene, View
        >>> [item.ball is None for item in Scene().page(View(0, 0)).shaded(0.5).items if item.name == "ball"]
        [True, False]
        """
        share = as_scalar(strength, "strength", low=0.0, high=1.0)
        return replace(self, items=tuple(part for item in self.items for part in _shaded(item, share)))

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
        transparent: bool = False,
    ) -> Path:
        """Write the page as PNG, SVG or PDF, according to the extension of `path`, and return that.

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
        transparent : bool
            Whether to make the background transparent. A PNG is then drawn twice and held in memory.

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
        with of_extra(picture_extra(Path(path).suffix, renderer)):
            output("save_page")(self, path, size=size, text=text, renderer=renderer, transparent=transparent)
        return Path(path)

    def pixels(self, *, size: int | None = None, text: bool = True, renderer: Literal["gl", "agg"] = "gl") -> Pixels:
        """Draw the page: the pixels that `save` writes as PNG, with its parameters and errors.

        Returns
        -------
        (height, width, 3) uint8 array
            sRGB, rows from the top.

        Examples
        --------
        >>> Page((0.0, 2.0, 0.0, 1.0), background=(1.0, 0.0, 0.0, 1.0)).pixels(size=40)[0, 0].tolist()
        [255, 0, 0]
        """
        with of_extra(picture_extra(".png", renderer)):
            return output("draw_page")(self, size=size, text=text, renderer=renderer)


def _shaded(item: Any, share: float) -> tuple[Item, ...]:
    """An item under a share of its shading: a flat part below, of the opacity that a shaded one of o · share leaves."""
    if getattr(item, "ball", None) is None or share == 1:
        return (item,)
    left = np.array([1.0, 1.0, 1.0, 1.0 - share])
    flat = item.recoloured(lambda rows: rows * left / (1 - share * rows[:, 3:] * [0, 0, 0, 1]))
    return replace(flat, ball=None), item.recoloured(lambda rows: rows * [1, 1, 1, share])


def picture_extra(kind: str, renderer: str = "gl") -> str:
    """The extra that brings all that draws a page into a file of that extension."""
    return "render" if renderer == "gl" and kind.lower() == ".png" else "draw"
