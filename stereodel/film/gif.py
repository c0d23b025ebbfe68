"""GIF: up to 255 colours that all frames share, and of each frame only what changed.

Frames are written one by one: Pillow's own writer of animations holds all of them. No frame is dithered, so that still
parts stay still.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator
from typing import BinaryIO, Final

import numpy as np
import numpy.typing as npt
from PIL import GifImagePlugin, Image

from stereodel._arrays import FloatArray
from stereodel.film.reels import Pixels, Reel, frames_of, whole_ticks

COLORS: Final = 255
"""Colours of the palette; the last of the 256 that a GIF has stands for "as in the frame before"."""

EXACT_COLORS: Final = 16
"""The most frequent colours, ground and fills among them, which the palette holds as they are."""

SAMPLED: Final = 12
"""Frames of which the palette is made."""

SHEET: Final = 3_000_000
"""Pixels that the palette is made of at most."""

FITTED: Final = 30_000
"""Colours that the palette is fitted to at most: the time grows with their number. More are rounded together."""

Indices = npt.NDArray[np.uint8]


def write_gif(reel: Reel, file: BinaryIO, seconds: FloatArray, *, colors: int = COLORS) -> None:
    """Write frames as a GIF that loops for ever.

    Parameters
    ----------
    reel : Reel
    file : binary file
    seconds : (n,) array
        How long each frame is shown; a GIF keeps hundredths.
    colors : int
        At most 255.
    """
    palette = _Palette(_shared_colors(reel, colors))
    height, width = reel[0].shape[:2]
    table = np.zeros((256, 3), dtype=np.uint8)
    table[: len(palette.colors)] = palette.colors
    # Header, screen with a table of 2^(7 + 1) colours, the table, and the block that asks for a loop without end.
    file.write(b"GIF89a" + struct.pack("<HHBBB", width, height, 0b1111_0111, 0, 0) + table.tobytes())
    file.write(b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00")
    before = None
    for ticks, picture in zip(whole_ticks(seconds, 100), frames_of(reel), strict=True):
        indices = palette.indices(picture)
        for part in _frame(indices, before, ticks):
            file.write(part)
        before = indices
    file.write(b";")


def _frame(indices: Indices, before: Indices | None, ticks: int) -> Iterator[bytes]:
    """The blocks of one frame: the rectangle that changed, see-through where it did not."""
    rows, columns = changed_box(indices, before)
    part = indices[rows, columns]
    if before is not None:
        part = np.where(part == before[rows, columns], np.uint8(COLORS), part)
    image = Image.fromarray(part)
    image.putpalette(bytes(768))  # left out of the file: the shared one counts
    options = {"duration": 10 * ticks, "transparency": COLORS, "disposal": 1, "interlace": 0}
    yield from GifImagePlugin.getdata(image, (columns.start, rows.start), include_color_table=False, **options)


def changed_box(now: npt.NDArray[np.uint8], before: npt.NDArray[np.uint8] | None) -> tuple[slice, slice]:
    """Rows and columns that hold all that differs from the frame before, one pixel at least; all when there is none.

    Parameters
    ----------
    now, before : (h, w) or (h, w, c) arrays

    Examples
    --------
    >>> now = np.zeros((4, 5), dtype=np.uint8)
    >>> now[1:3, 2] = 7
    >>> changed_box(now, np.zeros((4, 5), dtype=np.uint8))
    (slice(1, 3, None), slice(2, 3, None))
    """
    if before is None:
        return slice(0, now.shape[0]), slice(0, now.shape[1])
    differs = now != before
    differs = differs.any(axis=-1) if differs.ndim == 3 else differs
    spans = []
    for axis in (1, 0):
        at = np.flatnonzero(differs.any(axis=axis))
        spans.append(slice(int(at[0]), int(at[-1]) + 1) if at.size else slice(0, 1))
    return spans[0], spans[1]


def _shared_colors(reel: Reel, size: int) -> npt.NDArray[np.int64]:
    """At most `size` colours that serve frames spread over the whole film, (n, 3)."""
    chosen = np.linspace(0, len(reel) - 1, min(len(reel), SAMPLED)).round().astype(int)
    step = math.isqrt(len(chosen) * math.prod(reel[0].shape[:2]) // SHEET) + 1
    sheet = np.concatenate([reel[int(number)][::step, ::step] for number in chosen])
    # Medians, refined by k-means: a tenth of the mean error of a palette that covers the range evenly, which shows as
    # bands on a softly lit ball.
    found = Image.fromarray(_rounded_together(sheet)).quantize(size, method=Image.Quantize.MEDIANCUT, kmeans=3)
    colors: npt.NDArray[np.int64] = np.array(found.getpalette(), dtype=np.int64).reshape(-1, 3)[:size]
    codes, times = np.unique(_codes(sheet), return_counts=True)
    for exact in _from_codes(codes[np.argsort(times, kind="stable")[-EXACT_COLORS:]]):
        colors[np.argmin(np.sum((colors - exact) ** 2, axis=1))] = exact
    return colors


def _rounded_together(sheet: Pixels) -> Pixels:
    """The sheet with so many last bits of each channel set to their middle that at most `FITTED` colours are left."""
    rounded, bits = sheet, 0
    while len(np.unique(_codes(rounded))) > FITTED:
        bits += 1
        rounded = sheet >> np.uint8(bits) << np.uint8(bits) | np.uint8(1 << bits >> 1)
    return rounded


class _Palette:
    """Colours, and the nearest of them to every colour that was met so far."""

    def __init__(self, colors: npt.NDArray[np.int64]) -> None:
        from scipy.spatial import cKDTree

        self.colors = colors
        self._tree = cKDTree(colors)
        # Pillow's own mapping to a palette rounds to coarse cells first and turns white into gray.
        self._nearest: npt.NDArray[np.int16] = np.full(1 << 24, -1, dtype=np.int16)

    def indices(self, picture: Pixels) -> Indices:
        """The number of the nearest colour for each pixel, (h, w)."""
        codes = _codes(picture)
        found = self._nearest[codes]
        new = np.unique(codes[found < 0])
        if len(new):
            self._nearest[new] = self._tree.query(_from_codes(new))[1]
            found = self._nearest[codes]
        return found.astype(np.uint8).reshape(picture.shape[:2])


def _codes(picture: Pixels) -> npt.NDArray[np.int32]:
    """Each pixel's colour as one number, in a row."""
    red, green, blue = (picture[..., channel].astype(np.int32).ravel() for channel in range(3))
    return red << 16 | green << 8 | blue


def _from_codes(codes: npt.NDArray[np.int32]) -> npt.NDArray[np.int64]:
    return np.stack([codes >> 16, codes >> 8 & 255, codes & 255], axis=1).astype(np.int64)
