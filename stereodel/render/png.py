"""PNG files written while the picture is made: rows go in, a file comes out, and no more than some rows are held.

Pillow and the libraries over it hold the whole picture, and pypng, which does not, filters no row and was last
released in 2022. The format is that of the third edition of the PNG specification (W3C, 2025): 8 bits, red, green and
blue, no interlace.
"""

from __future__ import annotations

import struct
import zlib
from typing import BinaryIO, Final

import numpy as np
import numpy.typing as npt

Pixels = npt.NDArray[np.uint8]

SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"

CHANNELS: Final = 3

LEVEL: Final = 6
"""Of zlib: 9 takes eight times as long for files 3 % smaller."""

QUICK: Final = 1
"""Level at which it is tried what packs better."""

ROWS: Final = 32
"""Rows that are packed alike: all filtered, or none."""

METERS_PER_POINT: Final = 0.0254 / 72


class PngWriter:
    """A PNG file that is written row by row.

    Parameters
    ----------
    file : binary file
        Open for writing.
    width, height : int
        In pixels.
    page_width : float
        Width in print, points; the file says how large it is meant to be.

    Examples
    --------
    >>> import io
    >>> file = io.BytesIO()
    >>> writer = PngWriter(file, 3, 2, page_width=72.0)
    >>> for row in ([[255, 0, 0], [0, 255, 0], [0, 0, 255]], [[0, 0, 0], [99, 99, 99], [255, 255, 255]]):
    ...     writer.write(np.array([row], dtype=np.uint8))
    >>> writer.finish()
    >>> from PIL import Image
    >>> Image.open(file).getpixel((1, 1))
    (99, 99, 99)
    """

    def __init__(self, file: BinaryIO, width: int, height: int, *, page_width: float) -> None:
        self._file = file
        self._missing = height
        self._above: Pixels = np.zeros((1, width, CHANNELS), dtype=np.uint8)
        self._packer = zlib.compressobj(LEVEL, memLevel=9)
        file.write(SIGNATURE)
        self._chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        density = round(width / (page_width * METERS_PER_POINT))
        self._chunk(b"pHYs", struct.pack(">IIB", density, density, 1))

    def write(self, rows: Pixels) -> None:
        """Add rows (k, width, 3), from the top; a ValueError for rows of another width or more than there are."""
        if rows.shape[1:] != self._above.shape[1:] or rows.dtype != np.uint8 or len(rows) > self._missing:
            left = (self._missing, *self._above.shape[1:])
            raise ValueError(f"rows has shape {rows.shape} and type {rows.dtype}; at most {left} of uint8 are left")
        self._missing -= len(rows)
        for first in range(0, len(rows), ROWS):
            block = rows[first : first + ROWS]
            # Lines on flat colours repeat themselves and are better left as they are; photographs are not.
            choices = [lines.tobytes() for lines in (unfiltered(block), filtered(block, self._above))]
            data = self._packer.compress(min(choices, key=lambda lines: len(zlib.compress(lines, QUICK))))
            self._above = block[-1:].copy()
            if data:
                self._chunk(b"IDAT", data)

    def finish(self) -> None:
        """Write what ends the file; a ValueError when rows are missing."""
        if self._missing:
            raise ValueError(f"{self._missing} rows of the picture are missing; write them first")
        self._chunk(b"IDAT", self._packer.flush())
        self._chunk(b"IEND", b"")

    def _chunk(self, kind: bytes, data: bytes) -> None:
        self._file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def unfiltered(rows: Pixels) -> Pixels:
    """Rows as they are, behind the number of that kind of filter, (k, 1 + w·c)."""
    return np.concatenate([np.zeros((len(rows), 1), dtype=np.uint8), rows.reshape(len(rows), -1)], axis=1)


def filtered(rows: Pixels, above: Pixels) -> Pixels:
    """Rows as a PNG holds them: each byte less a guess from its neighbours, the kind of guess before each row.

    Of the five kinds the one is taken whose differences, as signed bytes, have the least sum of magnitudes: the rule
    that the specification recommends.

    Parameters
    ----------
    rows : (k, w, c) uint8 array
    above : (1, w, c) uint8 array
        The row before them; zeros before the first.

    Returns
    -------
    (k, 1 + w·c) uint8 array
    """
    up = np.concatenate([above, rows[:-1]])
    left, corner = np.zeros_like(rows), np.zeros_like(rows)
    left[:, 1:], corner[:, 1:] = rows[:, :-1], up[:, :-1]
    nothing = np.zeros_like(rows)
    guesses = np.stack([nothing, left, up, _average(left, up), _paeth(left, up, corner)])
    differences = (rows - guesses).reshape(len(guesses), len(rows), -1)
    # Bytes are taken modulo 256: the magnitude of a signed one is the smaller of itself and its negative.
    cost = np.minimum(differences, 0 - differences).sum(axis=2, dtype=np.int64)
    kind = cost.argmin(axis=0)
    best = differences[kind, np.arange(len(rows))]
    return np.concatenate([kind[:, None].astype(np.uint8), best], axis=1)


def _average(left: Pixels, up: Pixels) -> Pixels:
    # Half the sum, rounded down, without a ninth bit.
    return (left & up) + ((left ^ up) >> 1)


def _paeth(left: Pixels, up: Pixels, corner: Pixels) -> Pixels:
    """Of the three neighbours the one next to left + up − corner; of equally near ones the first named."""
    a, b, c = (neighbor.astype(np.int16) for neighbor in (left, up, corner))
    to_left, to_up, to_corner = np.abs(b - c), np.abs(a - c), np.abs(a + b - 2 * c)
    guess: Pixels = np.where(
        (to_left <= to_up) & (to_left <= to_corner), left, np.where(to_up <= to_corner, up, corner)
    )
    return guess
