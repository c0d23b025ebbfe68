"""Streaming PNG encoder: rows go in, bytes come out, and only a few rows are held in memory.

Pillow and the libraries built on it, such as imageio, hold the whole picture; pypng does not, but applies no filters
and was last released in 2022. The format is that of the third edition of the PNG specification (W3C, 2025): 8 bits,
red, green, blue and optionally opacity, no interlacing.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

import numpy as np

from stereodel._arrays import Pixels

SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"

KINDS: Final = {3: 2, 4: 6}
"""Colour types of the format, by number of channels."""

LEVEL: Final = 6
"""Compression level of zlib: 9 takes eight times as long for files 3 % smaller."""

QUICK: Final = 1
"""Compression level of trials."""

UNFILTERED: Final = 0
UP: Final = 2
"""Filter types: none, and the difference from the row above, byte by byte.

Lines on flat colours repeat and compress a quarter better unfiltered, photographs a third better as differences. The
other types of the specification would only save another twentieth on photographs.
"""

ROWS: Final = 32
"""Rows with the same filter."""

METERS_PER_POINT: Final = 0.0254 / 72


def png_chunks(
    rows: Iterable[Pixels],
    width: int,
    height: int,
    *,
    page_width: float,
    texts: Mapping[str, str] | None = None,
    channels: int = 3,
) -> Iterator[bytes]:
    """The chunks of a PNG file; ValueError if rows have another width or type, or their number is not `height`.

    rows: the picture from the top, any number of rows at a time.
    page_width: width in print in points, from which the resolution in the file follows.
    texts: texts by the format's keywords: Title, Description. Empty texts are left out.
    channels: 3 for red, green and blue; 4 for those, not premultiplied, and opacity.

    >>> import io
    >>> from PIL import Image
    >>> rows = ([[255, 0, 0], [0, 255, 0], [0, 0, 255]], [[0, 0, 0], [99, 99, 99], [255, 255, 255]])
    >>> file = b"".join(png_chunks((np.array([row], dtype=np.uint8) for row in rows), 3, 2, page_width=72.0))
    >>> Image.open(io.BytesIO(file)).getpixel((1, 1))
    (99, 99, 99)
    """
    density = round(width / (page_width * METERS_PER_POINT))
    yield SIGNATURE
    yield _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, KINDS[channels], 0, 0, 0))
    yield _chunk(b"pHYs", struct.pack(">IIB", density, density, 1))
    yield from (_text_chunk(keyword, text) for keyword, text in (texts or {}).items() if text)
    packer, above, missing = zlib.compressobj(LEVEL, memLevel=9), np.zeros((1, width, channels), dtype=np.uint8), height
    for part in rows:
        if part.shape[1:] != (width, channels) or part.dtype != np.uint8 or len(part) > missing:
            left = (missing, width, channels)
            raise ValueError(f"rows has shape {part.shape} and type {part.dtype}; at most {left} of uint8 are left")
        missing -= len(part)
        for first in range(0, len(part), ROWS):
            block = part[first : first + ROWS]
            differences = block - np.concatenate([above, block[:-1]])  # of bytes, modulo 256
            choices = _filtered(block, UNFILTERED), _filtered(differences, UP)
            data = packer.compress(min(choices, key=lambda lines: len(zlib.compress(lines, QUICK))))
            above = block[-1:].copy()  # a view would keep all the rows
            if data:
                yield _chunk(b"IDAT", data)
    if missing:
        raise ValueError(f"{missing} rows of the picture are missing")
    yield _chunk(b"IDAT", packer.flush())
    yield _chunk(b"IEND", b"")


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _text_chunk(keyword: str, text: str) -> bytes:
    """A text chunk: Latin-1 if possible, which every program reads, otherwise UTF-8."""
    key = keyword.encode("latin-1")
    try:
        return _chunk(b"tEXt", key + b"\0" + text.encode("latin-1"))
    except UnicodeEncodeError:
        # Not compressed, no language, no translated keyword.
        return _chunk(b"iTXt", key + b"\0\0\0\0\0" + text.encode())


def _filtered(rows: Pixels, kind: int) -> bytes:
    """Filtered rows, each preceded by the number of its filter type."""
    return np.pad(rows.reshape(len(rows), -1), ((0, 0), (1, 0)), constant_values=kind).tobytes()
