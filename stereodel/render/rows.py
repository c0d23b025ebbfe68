"""A page without its labels as rows of pixels, from the top: through OpenGL, or through matplotlib's Agg.

OpenGL draws the picture twice as large with four samples per pixel, which are then averaged: sixteen samples. Averages
are taken of sRGB values directly, as in OpenGL's own multisampling and matplotlib, so that thin dark lines keep their
weight.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Pixels, as_choice
from stereodel._extras import of_extra
from stereodel.drawing.colors import Color
from stereodel.drawing.page import Page
from stereodel.render import gl
from stereodel.render.canvas import drawn, matplotlib_settings, pixel_grid
from stereodel.render.sizes import pixel_height
from stereodel.render.triangles import triangulate

with of_extra("draw"):
    from matplotlib.backends.backend_agg import FigureCanvasAgg

Renderer = Literal["gl", "agg"]

SUPERSAMPLING: Final = 2
"""Pixels drawn per pixel of the picture, in each direction."""

AT_ONCE: Final = 2**25
"""Largest number of pixels that Agg draws at once: with a copy they take 256 MB."""


def bare_rows(page: Page, width: int, renderer: Renderer, platform: str | None = None) -> Iterator[Pixels]:
    """A picture of a page, `width` pixels wide, without its labels, in blocks of rows (k, width, 3)."""
    bare = page.without_labels()
    if as_choice(renderer, ("gl", "agg"), "renderer") == "agg":
        return agg_rows(bare, width)
    return gl_rows(bare, width, platform)


def gl_rows(page: Page, width: int, platform: str | None = None) -> Iterator[Pixels]:
    """All but the labels of a page, by OpenGL."""
    ground = over_white(page.background)
    large = SUPERSAMPLING * width, SUPERSAMPLING * pixel_height(page, width)
    triangles = triangulate(page, *large)
    return gl.bands(triangles.within, *large, background=ground, platform=platform, finish=averaged)


def agg_rows(page: Page, width: int) -> Iterator[Pixels]:
    """A page with its labels, by Agg."""
    dpi, (width, height) = pixel_grid(page, width)
    left, right, low, high = page.extent
    rows = max(1, AT_ONCE // width)
    for top in range(0, height, rows):
        bottom = min(height, top + rows)
        # In this form a page drawn at once keeps its exact numbers.
        lower, upper = (low * (row / height) + high * (1 - row / height) for row in (bottom, top))
        part = replace(page, extent=(left, right, lower, upper))
        with matplotlib_settings():
            canvas = drawn(part, dpi, (width, bottom - top))
            canvas.set_facecolor(page.background)
            agg: Any = FigureCanvasAgg(canvas)
            agg.draw()
            yield np.array(agg.buffer_rgba(), dtype=np.uint8)[..., :3]


def averaged(large: Pixels) -> Pixels:
    """Averages of blocks of SUPERSAMPLING² pixels, rounded half up."""
    n = SUPERSAMPLING
    # Plane by plane: a sum over two axes of a reshaped array takes ten times as long.
    total = np.full((large.shape[0] // n, large.shape[1] // n, 3), n * n // 2, dtype=np.uint16)
    for row, column in np.ndindex(n, n):
        total += large[row::n, column::n]
    return (total // np.uint16(n * n)).astype(np.uint8)


class PixelDigest:
    """SHA-256 of a picture of known shape whose rows are added from the top; equal to `pixel_hash` of the whole."""

    def __init__(self, shape: tuple[int, ...], dtype: npt.DTypeLike = np.uint8) -> None:
        self._digest = hashlib.sha256(f"{shape} {np.dtype(dtype).str}\n".encode())

    def add(self, rows: npt.NDArray[Any]) -> None:
        """Add the next rows."""
        self._digest.update(np.ascontiguousarray(rows).data)

    def passed(self, rows: Iterable[Pixels]) -> Iterator[Pixels]:
        """The rows of a picture unchanged, each added as it passes."""
        for part in rows:
            self.add(part)
            yield part

    def __str__(self) -> str:
        return self._digest.hexdigest()


def pixel_hash(picture: npt.NDArray[Any]) -> str:
    """SHA-256 of decoded pixels: shape, type and values in row order.

    >>> pixel_hash(np.zeros((2, 3, 3), dtype=np.uint8))[:16]
    '541ff73e8d70c4c6'
    """
    digest = PixelDigest(picture.shape, picture.dtype)
    digest.add(picture)
    return str(digest)


def over_white(color: Color) -> Color:
    """A colour composited on white paper, opaque, in 8 bits."""
    red, green, blue = (np.floor(255 * (1 - color[3] * (1 - value)) + 0.5) / 255 for value in color[:3])
    return (red, green, blue, 1.0)
