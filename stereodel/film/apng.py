"""APNG: a PNG with further frames, lossless, in true colours; of each frame only the rectangle that changed.

Pillow compresses the frames, one by one; its own writer of animations holds all of them. What is written here is the
container: a chunk of control before each frame, and the frames' data under the name that the specification gives them
(PNG, third edition, section 11.3.6).
"""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterator
from fractions import Fraction
from typing import BinaryIO, Final

from PIL import Image

from stereodel._arrays import FloatArray
from stereodel.film.gif import changed_box
from stereodel.film.reels import Pixels, Reel, frames_of

SIGNATURE: Final = b"\x89PNG\r\n\x1a\n"

LARGEST_DENOMINATOR: Final = 65535
"""Times are fractions of two numbers of 16 bits."""


def write_apng(reel: Reel, file: BinaryIO, seconds: FloatArray) -> None:
    """Write frames as an APNG that loops for ever; a frame is shown for a fraction of a second, 65535 s at most."""
    numbers = iter(range(2 * len(reel)))
    before: Pixels | None = None
    file.write(SIGNATURE)
    for number, picture in enumerate(frames_of(reel)):
        rows, columns = changed_box(picture, before)
        chunks = list(_chunks(picture[rows, columns]))
        if before is None:
            header = next(data for name, data in chunks if name == b"IHDR")
            file.write(_chunk(b"IHDR", header) + _chunk(b"acTL", struct.pack(">II", len(reel), 0)))
        box = (columns.stop - columns.start, rows.stop - rows.start, columns.start, rows.start)
        file.write(_chunk(b"fcTL", struct.pack(">IIIIIHHBB", next(numbers), *box, *_fraction(seconds[number]), 0, 0)))
        for name, data in chunks:
            if name == b"IDAT":
                later = before is not None
                file.write(_chunk(b"fdAT", struct.pack(">I", next(numbers)) + data) if later else _chunk(name, data))
        before = picture
    file.write(_chunk(b"IEND", b""))


def _chunks(picture: Pixels) -> Iterator[tuple[bytes, bytes]]:
    """Names and contents of the chunks of a PNG of one picture, its data in one piece."""
    stored = io.BytesIO()
    Image.fromarray(picture).save(stored, format="png")
    data = stored.getvalue()
    at, packed = len(SIGNATURE), b""
    while at < len(data):
        size, name = struct.unpack_from(">I4s", data, at)
        content = data[at + 8 : at + 8 + size]
        at += size + 12
        if name == b"IDAT":
            packed += content
        else:
            if name == b"IEND":
                yield b"IDAT", packed
            yield name, content


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def _fraction(seconds: float) -> tuple[int, int]:
    time = Fraction(float(seconds)).limit_denominator(LARGEST_DENOMINATOR)
    if time.numerator > LARGEST_DENOMINATOR:
        time = Fraction(round(time))
    return min(time.numerator, LARGEST_DENOMINATOR), time.denominator
