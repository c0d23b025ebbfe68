"""The labels of a page over the rows of its picture.

Text is drawn by matplotlib's Agg, whose canvas is as large as its picture. Here the canvas has the rows that are asked
for and the text keeps its place on the page, a whole number of pixels above or below them: the pixels are those of a
canvas for the whole page.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel.drawing.page import Page
from stereodel.render.canvas import drawn, matplotlib_settings, pixel_grid

with of_extra("draw"):
    from matplotlib.backends.backend_agg import RendererAgg
    from matplotlib.text import Text
    from matplotlib.transforms import Affine2D

ROWS: Final = 16
"""Rows over which labels are laid at once: that takes 32 bytes a pixel."""


def labelled(rows: Iterable[Pixels], page: Page, width: int) -> Iterator[Pixels]:
    """Rows of a picture `width` pixels wide, from the top, with the labels of its page on them."""
    layer, top = LabelLayer(page, width), 0
    for part in rows:
        yield layer.over(part, top)
        top += len(part)


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
                ruler = _Canvas(1, 1, self._dpi)
                self._placed = [(text, *_rows_of(text, ruler, self.height)) for text in canvas.axes[0].texts]

    def over(self, rows: Pixels, top: int = 0) -> Pixels:
        """Rows (k, width, 3) of the picture, the first of them row `top`, with the labels on them; rounded half up."""
        if not self._texts(top, top + len(rows)):
            return rows
        layer = self._drawn(top, top + len(rows))
        composed = rows.copy()
        for first in range(0, len(rows), ROWS):
            part = slice(first, first + ROWS)
            opacity = layer[part, :, 3:].astype(np.uint16)
            # At most 255² + 127, which fits into 16 bits.
            mixed = layer[part, :, :3] * opacity + rows[part] * (255 - opacity)
            composed[part] = (mixed + 127) // 255
        return composed

    def rows(self, top: int = 0, bottom: int | None = None) -> Pixels:
        """The labels in the rows from `top` to before `bottom`, (bottom − top, width, 4), colours not premultiplied."""
        return self._drawn(top, self.height if bottom is None else bottom).copy()

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
            self._canvas = _Canvas(self.width, bottom - top, self._dpi)
        self._canvas.clear()
        self._canvas.below = self.height - bottom
        with matplotlib_settings():
            for text in self._texts(top, bottom):
                text.draw(self._canvas)
        return np.asarray(self._canvas.buffer_rgba(), dtype=np.uint8)

    def _texts(self, top: int, bottom: int) -> list[Text]:
        return [text for text, first, last in self._placed if first < bottom and last > top]


class _Canvas(RendererAgg):
    """Some rows of a page, `below` of whose rows lie under them.

    Matplotlib turns the place of type round by the height that a canvas says it has, but paths, which type with a halo
    is drawn as, by the height that it has. So it says that it is as high as its rows and what lies below them, and
    lowers paths by the difference.
    """

    below = 0

    def __init__(self, width: int, height: int, dpi: float) -> None:
        super().__init__(width, height, dpi)  # type: ignore[no-untyped-call]

    def get_canvas_width_height(self) -> tuple[float, float]:
        return self.width, self.height + self.below

    def draw_path(self, gc: Any, path: Any, transform: Any, rgbFace: Any = None) -> None:
        super().draw_path(gc, path, transform + Affine2D().translate(0.0, -self.below), rgbFace)  # type: ignore[no-untyped-call]


def _rows_of(text: Text, ruler: _Canvas, height: int) -> tuple[float, float]:
    """The rows between which a text lies."""
    box = text.get_window_extent(ruler)
    # Ink may leave the box that a line of type is given, though never by the height of the type.
    reach = text.get_fontsize() * ruler.dpi / 72
    return height - box.y1 - reach, height - box.y0 + reach
