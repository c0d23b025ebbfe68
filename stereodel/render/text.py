"""The labels of a page as pixels, some rows at a time.

Text is drawn by matplotlib's Agg, whose canvas is as large as its picture. Here the canvas has the rows that are asked
for and the text keeps its place on the page, a whole number of pixels above or below them: the pixels are those of a
canvas for the whole page.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from matplotlib.backends import backend_agg
from matplotlib.text import Text
from matplotlib.transforms import Affine2D

from stereodel._arrays import FloatArray
from stereodel.drawing.page import Page
from stereodel.render.vector import drawn, matplotlib_settings, pixel_grid

Pixels = npt.NDArray[np.uint8]

INK_PER_POINT: Final = 10
"""Pixels per point at which ink is measured: a twentieth of a point is less than a reader can see."""

ROWS: Final = 16
"""Rows over which labels are laid at once: that takes 32 bytes a pixel."""


class LabelLayer:
    """The labels of a page on a transparent ground.

    Parameters
    ----------
    page : Page
    width_px : int
        Width of the picture in pixels.

    Examples
    --------
    >>> from stereodel.drawing import Label
    >>> page = Page((0.0, 2.0, 0.0, 2.0), (Label("high", (1.0, 1.9)),), width=100.0)
    >>> layer = LabelLayer(page, 100)
    >>> [bool(layer.rows(top, top + 50)[..., 3].any()) for top in (0, 50)]
    [True, False]
    """

    def __init__(self, page: Page, width_px: int) -> None:
        self._dpi, (self.width, self.height) = pixel_grid(page, width_px)
        self._canvas: Any = None
        self._placed: list[tuple[Text, float, float]] = []
        if page.labels:
            with matplotlib_settings():
                canvas = drawn(replace(page, items=page.labels), self._dpi, (self.width, self.height))
                ruler = _canvas(1, 1, self._dpi)
                self._placed = [(text, *_rows_of(text, ruler, self.height)) for text in canvas.axes[0].texts]

    def over(self, rows: Pixels, top: int = 0) -> Pixels:
        """Rows (k, width, 3) of the picture, the first of them row `top`, with the labels on them; rounded half up."""
        if not self._texts(top, top + len(rows)):
            return rows
        layer = self._drawn(top, top + len(rows))
        composed = rows.copy()
        for first in range(0, len(rows), ROWS):
            part = slice(first, first + ROWS)
            composed[part] = _laid_over(rows[part], layer[part])
        return composed

    def rows(self, top: int, bottom: int) -> Pixels:
        """The labels in the rows from `top` to before `bottom`, (bottom − top, width, 4), colours not premultiplied."""
        return self._drawn(top, bottom).copy()

    @property
    def span(self) -> tuple[int, int]:
        """Rows between which all labels lie, as far as these are on the page; empty where there is none."""
        first = min((first for _, first, _ in self._placed), default=0.0)
        last = max((last for _, _, last in self._placed), default=0.0)
        return max(0, math.floor(first)), min(self.height, math.ceil(last))

    def _drawn(self, top: int, bottom: int) -> Pixels:
        """As `rows`, until the next call."""
        # One canvas for all rows: a text keeps the canvas that it was drawn on.
        if self._canvas is None or self._canvas.height != bottom - top:
            self._canvas = _canvas(self.width, bottom - top, self._dpi)
        self._canvas.clear()
        # As high as its rows and what lies below them, for by that the text is placed.
        size = (self.width, self.height - top)
        self._canvas.get_canvas_width_height = lambda: size
        with matplotlib_settings():
            for text in self._texts(top, bottom):
                text.draw(self._canvas)
        return np.asarray(self._canvas.buffer_rgba(), dtype=np.uint8)

    def _texts(self, top: int, bottom: int) -> list[Text]:
        return [text for text, first, last in self._placed if first < bottom and last > top]


def label_layer(page: Page, width_px: int) -> Pixels:
    """The labels alone on a transparent ground, (height, width, 4), colours not premultiplied, rows from the top."""
    layer = LabelLayer(page, width_px)
    return layer.rows(0, layer.height)


def with_labels(picture: Pixels, page: Page) -> Pixels:
    """The labels of a page over a picture of it without text, (height, width, 3)."""
    return LabelLayer(page, picture.shape[1]).over(picture)


def ink_boxes(page: Page) -> FloatArray:
    """Where the ink of each label lies, halos too: left, bottom, right and top in points from the lower left, (n, 4).

    As far as it is at least half as strong as where it is strongest; NaN where a label leaves no ink.
    """
    width_px = max(1, round(INK_PER_POINT * page.width))
    boxes = np.full((len(page.labels), 4), np.nan)
    for box, label in zip(boxes, page.labels, strict=True):
        layer = LabelLayer(replace(page, items=(label,)), width_px)
        top, bottom = layer.span
        opacity = layer.rows(top, bottom)[..., 3] if top < bottom else np.zeros((0, 0), dtype=np.uint8)
        if opacity.any():
            rows, columns = np.nonzero(opacity >= opacity.max() / 2)
            edges = [
                columns.min(),
                layer.height - top - rows.max() - 1,
                columns.max() + 1,
                layer.height - top - rows.min(),
            ]
            box[:] = np.array(edges) * (page.width / width_px)
    return boxes


def _laid_over(rows: Pixels, layer: Pixels) -> Pixels:
    opacity = layer[..., 3:].astype(np.uint16)
    # At most 255² + 127, which fits into 16 bits.
    mixed = layer[..., :3] * opacity + rows * (255 - opacity)
    composed: Pixels = ((mixed + 127) // 255).astype(np.uint8)
    return composed


def _canvas(width: int, height: int, dpi: float) -> Any:
    """A canvas of matplotlib, which has no types; its foot is as far above that of the page as it is lower.

    Matplotlib turns the place of type round by the height that a canvas says it has, but paths, which type with a halo
    is drawn as, by the height that it has.
    """
    agg: Any = backend_agg
    canvas = agg.RendererAgg(width, height, dpi)
    draw_path = canvas.draw_path

    def lowered(gc: Any, path: Any, transform: Any, face: Any = None) -> None:
        below = canvas.get_canvas_width_height()[1] - height
        draw_path(gc, path, transform + Affine2D().translate(0.0, -below), face)

    canvas.draw_path = lowered
    return canvas


def _rows_of(text: Text, ruler: Any, height: int) -> tuple[float, float]:
    """The rows between which a text lies."""
    box = text.get_window_extent(ruler)
    # Ink may leave the box that a line of type is given, though never by the height of the type.
    reach = text.get_fontsize() * ruler.dpi / 72
    return height - box.y1 - reach, height - box.y0 + reach
