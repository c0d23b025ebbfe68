"""Picture files as pixels: the usual kinds, by Pillow, with limits that hold before anything is decoded."""

from __future__ import annotations

import os
import struct
import warnings
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel.constants import MOST_TEXELS

SIXTEEN_BITS: Final = ("I", "I;16", "I;16B", "I;16L", "I;16N")
"""Modes of Pillow for gray of 16 bits."""

FORMATS: Final = ("PNG", "JPEG", "TIFF", "WEBP", "GIF", "BMP", "PPM", "TGA", "JPEG2000")
"""Kinds of pictures that are opened: those that Pillow decodes by itself. For others it starts Ghostscript and such."""

DAMAGED: Final = (OSError, SyntaxError, ValueError, EOFError, struct.error, IndexError, TypeError)
"""What the decoders of Pillow raise on a file that is cut off or garbled."""


def read_image(path: str | os.PathLike[str]) -> Pixels:
    """The first picture of a file, (h, w, 4): sRGB and opacity, not premultiplied.

    Raises
    ------
    OSError
        Where the file is missing or cannot be read.
    ValueError
        When it is no picture, has more than `MOST_TEXELS` pixels, is damaged, or holds floating-point numbers.
    """
    with of_extra("draw"):
        from PIL import Image, UnidentifiedImageError

    name = os.fspath(path)
    # Pillow warns of half of what it refuses, which is more than our own limit.
    with open(name, "rb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            with Image.open(file, formats=FORMATS) as image:
                _check_size(name, image.size)
                return _converted(name, image)
        except UnidentifiedImageError as error:
            raise ValueError(f"{name} is not a picture of a kind that is read: {', '.join(FORMATS)}") from error
        except Image.DecompressionBombError as error:
            raise ValueError(f"{name} has too many pixels: at most {MOST_TEXELS} are read; make it smaller") from error


def _check_size(name: str, size: tuple[int, int]) -> None:
    width, height = size
    if width * height > MOST_TEXELS:
        raise ValueError(
            f"{name} has {width} × {height} pixels, more than the {MOST_TEXELS} that are read; make it smaller"
        )


def _converted(name: str, image: Any) -> Pixels:
    try:
        image.load()
    except DAMAGED as error:
        raise ValueError(f"{name} is damaged or cut off: {error}") from error
    if image.mode == "F":
        raise ValueError(f"{name} holds floating-point numbers; scale them to 0 to 255 and give them as an array")
    if image.mode not in SIXTEEN_BITS:
        return np.asarray(image.convert("RGBA"))
    gray = np.asarray(image)
    if gray.max(initial=0) > 65535 or gray.min(initial=0) < 0:
        raise ValueError(f"{name} holds numbers beyond 16 bits; scale them to 0 to 255 and give them as an array")
    levels = ((gray.astype(np.uint32) + 128) // 257).astype(np.uint8)
    return np.dstack([levels, levels, levels, np.full_like(levels, 255)])
