"""A page as rows of pixels, from the top: drawn through OpenGL or matplotlib's Agg, then labelled, encoded as PNG.

OpenGL draws twice as large with four samples per pixel, which are averaged as sRGB values, as in OpenGL's own
multisampling and matplotlib, so that thin dark lines keep their weight. Agg sets the labels on a canvas of the rows
asked for, with the pixels of one for the whole page. PNG is written here, as Pillow and imageio hold the whole picture.
"""

from __future__ import annotations

import hashlib
import struct
import zlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

from stereodel._arrays import Pixels, as_choice
from stereodel._extras import of_extra
from stereodel.drawing.page import Page
from stereodel.drawing.page.colors import Color
from stereodel.render import gl
from stereodel.render.tessellation import triangulate
from stereodel.render.vector.agg import drawn, matplotlib_settings, pixel_grid

with of_extra("draw"):
    from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
    from matplotlib.text import Text
    from matplotlib.transforms import Affine2D

Renderer = Literal["gl", "agg"]

SUPERSAMPLING: Final = 2
"""Pixels drawn per pixel of the picture, in each direction."""

AT_ONCE: Final = 2**25
"""Largest number of pixels that Agg draws at once: with a copy they take 256 MB."""

ROWS: Final = 16
"""Rows labelled in one block, which takes 32 bytes per pixel."""

FILTERED: Final = 32
"""Rows of a PNG with the same filter."""

SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"
METERS_PER_POINT: Final = 0.0254 / 72


def bare_rows(page: Page, width: int, renderer: Renderer) -> Iterator[Pixels]:
    """A picture of a page, `width` pixels wide, without its labels, in blocks of rows (k, width, 3)."""
    bare = page.without_labels()
    if as_choice(renderer, ("gl", "agg"), "renderer") == "agg":
        return agg_rows(bare, width)
    large = SUPERSAMPLING * width, SUPERSAMPLING * page.pixels_up(width)
    part, ground = triangulate(bare, *large).within, over_white(page.background)
    return gl.bands(part, *large, background=ground, finish=averaged)


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

    def passed(self, rows: Iterable[npt.NDArray[Any]]) -> Iterator[npt.NDArray[Any]]:
        """The rows unchanged, each added as it passes."""
        for part in rows:
            self._digest.update(np.ascontiguousarray(part).data)
            yield part

    def __str__(self) -> str:
        return self._digest.hexdigest()


def pixel_hash(picture: npt.NDArray[Any]) -> str:
    """SHA-256 of decoded pixels: shape, type and values in row order."""
    digest = PixelDigest(picture.shape, picture.dtype)
    list(digest.passed([picture]))
    return str(digest)


def over_white(color: Color) -> Color:
    """A colour composited on white paper, opaque, in 8 bits."""
    red, green, blue = (np.floor(255 * (1 - color[3] * (1 - value)) + 0.5) / 255 for value in color[:3])
    return (red, green, blue, 1.0)


def labelled(rows: Iterable[Pixels], page: Page, width: int) -> Iterator[Pixels]:
    """Rows of a picture `width` pixels wide, from the top, with the labels of its page on them."""
    layer, top = LabelLayer(page, width), 0
    for part in rows:
        yield layer.over(part, top)
        top += len(part)


class LabelLayer:
    """The labels of a page on a transparent background, `width_px` pixels wide."""

    def __init__(self, page: Page, width_px: int) -> None:
        self._dpi, (self.width, self.height) = pixel_grid(page, width_px)
        self._canvas: Any = None
        self.placed: list[tuple[Text, float, float]] = []
        if page.labels:
            with matplotlib_settings():
                canvas = drawn(replace(page, items=page.labels), self._dpi, (self.width, self.height))
                ruler = _RowCanvas(1, 1, self._dpi)  # type: ignore[no-untyped-call]
                for text in canvas.axes[0].texts:
                    # Ink may extend beyond the box of a line of type, but never by its height.
                    box, reach = text.get_window_extent(ruler), text.get_fontsize() * ruler.dpi / 72
                    self.placed.append((text, self.height - box.y1 - reach, self.height - box.y0 + reach))

    def over(self, rows: Pixels, top: int = 0) -> Pixels:
        """Rows (k, width, 3) of the picture, the first of them row `top`, with the labels on them; rounded half up."""
        if not self._texts(top, top + len(rows)):
            return rows
        layer = self.rows(top, top + len(rows))
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
        bottom = self.height if bottom is None else bottom
        # One canvas for all rows, since a text keeps a reference to its canvas.
        if self._canvas is None or self._canvas.height != bottom - top:
            self._canvas = _RowCanvas(self.width, bottom - top, self._dpi)  # type: ignore[no-untyped-call]
        self._canvas.clear()
        self._canvas.below = self.height - bottom
        with matplotlib_settings():
            for text in self._texts(top, bottom):
                text.draw(self._canvas)
        return np.array(self._canvas.buffer_rgba(), dtype=np.uint8)

    def _texts(self, top: int, bottom: int) -> list[Text]:
        return [text for text, first, last in self.placed if first < bottom and last > top]


class _RowCanvas(RendererAgg):
    """A canvas for some rows of a page, with `below` rows of the page under them.

    Matplotlib flips the position of text by the height that a canvas reports, but that of paths, as which text with a
    halo is drawn, by its actual height. So the canvas reports the height of its rows and those below, and lowers paths
    by the difference.
    """

    below = 0

    def get_canvas_width_height(self) -> tuple[float, float]:
        return self.width, self.height + self.below

    def draw_path(self, gc: Any, path: Any, transform: Any, rgbFace: Any = None) -> None:
        super().draw_path(gc, path, transform + Affine2D().translate(0.0, -self.below), rgbFace)  # type: ignore[no-untyped-call]


# PNG


def png_chunks(
    rows: Iterable[Pixels], width: int, height: int, *, page_width: float, texts: Mapping[str, str], channels: int = 3
) -> Iterator[bytes]:
    """The chunks of a PNG file; ValueError if rows have another width or type, or their number is not `height`.

    rows: the picture from the top, any number of rows at a time.
    page_width: width in print in points, from which the resolution in the file follows.
    texts: by the format's keywords: Title, Description. Empty texts are left out.
    channels: 3 for red, green and blue; 4 for those, not premultiplied, and opacity.
    """
    density, kind = round(width / (page_width * METERS_PER_POINT)), {3: 2, 4: 6}[channels]
    yield SIGNATURE
    yield _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))
    yield _chunk(b"pHYs", struct.pack(">IIB", density, density, 1))
    yield from (_text_chunk(keyword.encode("ascii"), text) for keyword, text in texts.items() if text)
    # Level 9 takes eight times as long for files 3 % smaller.
    packer, above, missing = zlib.compressobj(6, memLevel=9), np.zeros((1, width, channels), dtype=np.uint8), height
    for part in rows:
        if part.shape[1:] != (width, channels) or part.dtype != np.uint8 or len(part) > missing:
            left = (missing, width, channels)
            raise ValueError(f"rows has shape {part.shape} and type {part.dtype}; at most {left} of uint8 are left")
        missing -= len(part)
        for first in range(0, len(part), FILTERED):
            block = part[first : first + FILTERED]
            # Lines on flat colours repeat and compress a quarter better unfiltered, photographs a third better as
            # differences from the row above; the other filters would only save another twentieth on photographs.
            differences = block - np.concatenate([above, block[:-1]])  # of bytes, modulo 256
            choices = [
                np.pad(lines.reshape(len(lines), -1), ((0, 0), (1, 0)), constant_values=number).tobytes()
                for number, lines in ((0, block), (2, differences))
            ]
            data = packer.compress(min(choices, key=lambda lines: len(zlib.compress(lines, 1))))
            above = block[-1:].copy()  # a view would keep all the rows
            if data:
                yield _chunk(b"IDAT", data)
    if missing:
        raise ValueError(f"{missing} rows of the picture are missing")
    yield _chunk(b"IDAT", packer.flush())
    yield _chunk(b"IEND", b"")


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _text_chunk(key: bytes, text: str) -> bytes:
    """A text chunk: Latin-1 if possible, which every program reads, otherwise UTF-8."""
    if all(letter <= "\xff" for letter in text):
        return _chunk(b"tEXt", key + b"\0" + text.encode("latin-1"))
    # Not compressed, no language, no translated keyword.
    return _chunk(b"iTXt", key + b"\0\0\0\0\0" + text.encode())
