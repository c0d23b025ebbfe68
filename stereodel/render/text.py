"""The labels of a page over the rows of its picture.

Text is drawn by matplotlib's Agg, whose canvas is normally as large as its picture. Here the canvas has only the
requested rows, and text is shifted by a whole number of pixels, so that the pixels equal those of a canvas for the
whole page.
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
"""Rows labelled in one block, which takes 32 bytes per pixel."""


def labelled(rows: Iterable[Pixels], page: Page, width: int) -> Iterator[Pixels]:
    """Rows of a picture `width` pixels wide, from the top, with the labels of its page on them."""
    layer, top = LabelLayer(page, width), 0
    for part in rows:
        yield layer.over(part, top)
        top += len(part)


class LabelLayer:
    """The labels of a page on a transparent background.

    width_px: width of the picture in pixels.

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
            # At most 255² + 127, which fits in 16 bits.
            mixed = layer[part, :, :3] * opacity + rows[part] * (255 - opacity)
            composed[part] = (mixed + 127) // 255
        return composed

    def rows(self, top: int = 0, bottom: int | None = None) -> Pixels:
        """The labels in the rows from `top` to before `bottom`, (bottom − top, width, 4), colours not premultiplied."""
        return self._drawn(top, self.height if bottom is None else bottom).copy()

    @property
    def span(self) -> tuple[int, int]:
        """Range of rows that contains all labels on the page; empty if there are none."""
        first = min((first for _, first, _ in self._placed), default=0.0)
        last = max((last for _, _, last in self._placed), default=0.0)
        return max(0, math.floor(first)), min(self.height, math.ceil(last))

    def _drawn(self, top: int, bottom: int) -> Pixels:
        """As for `rows`, valid until the next call."""
        # One canvas for all rows, since a text keeps a reference to its canvas.
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
    """A canvas for some rows of a page, with `below` rows of the page under them.

    Matplotlib flips the position of text by the height that a canvas reports, but that of paths, as which text with a
    halo is drawn, by its actual height. So the canvas reports the height of its rows and those below, and lowers paths
    by the difference.
    """

    below = 0

    def __init__(self, width: int, height: int, dpi: float) -> None:
        super().__init__(width, height, dpi)  # type: ignore[no-untyped-call]

    def get_canvas_width_height(self) -> tuple[float, float]:
        return self.width, self.height + self.below

    def draw_path(self, gc: Any, path: Any, transform: Any, rgbFace: Any = None) -> None:
        super().draw_path(gc, path, transform + Affine2D().translate(0.0, -self.below), rgbFace)  # type: ignore[no-untyped-call]


def _rows_of(text: Text, ruler: _Canvas, height: int) -> tuple[float, float]:
    """The range of rows of a text."""
    box = text.get_window_extent(ruler)
    # Ink may extend beyond the box of a line of type, but never by its height.
    reach = text.get_fontsize() * ruler.dpi / 72
    return height - box.y1 - reach, height - box.y0 + reach
