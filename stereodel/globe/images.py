"""Image files in the usual formats, by Pillow, with limits that are checked before anything is decoded."""

from __future__ import annotations

import os
import struct
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel._files import replacing
from stereodel.constants import MOST_TEXELS

SIXTEEN_BITS: Final = ("I", "I;16", "I;16B", "I;16L", "I;16N")
"""Pillow's modes for 16-bit gray."""

FORMATS: Final = ("PNG", "JPEG", "TIFF", "WEBP", "GIF", "BMP", "PPM", "TGA", "JPEG2000")
"""Formats that are opened: those that Pillow decodes itself. For others it starts programs such as Ghostscript."""

WRITTEN: Final[Mapping[str, Mapping[str, Any]]] = {
    "JPEG": {"quality": 95, "subsampling": 0},
    # For photographs, level 6 of zlib takes three times as long for files 2 % smaller.
    "PNG": {"compress_level": 3},
    "WEBP": {"quality": 92, "method": 4},
}
"""Formats that are written, without visible loss, by Pillow's names of them and of its settings."""

WEBP_SIDE: Final = 16_383
"""Longest side of a WebP in pixels; the sides of the other formats are longer than `MOST_TEXELS` allows."""

DAMAGED: Final = (OSError, SyntaxError, ValueError, EOFError, struct.error, IndexError, TypeError)
"""Exceptions that Pillow's decoders raise on truncated or corrupt files."""


def read_photo(path: str | os.PathLike[str]) -> tuple[Pixels, bytes]:
    """The first image of a file, rotated upright according to its EXIF data, and its colour profile.

    Returns
    -------
    pixels : (h, w, 4) uint8 array
        Colour, in sRGB or in the colour space of the profile, and opacity, not premultiplied.
    profile : bytes
        ICC profile of the colours; empty for sRGB.

    Raises
    ------
    OSError
        If the file is missing or cannot be read.
    ValueError
        If it is not an image, has more than `MOST_TEXELS` pixels, is damaged, or holds floating-point numbers.
    """
    with of_extra("draw"):
        from PIL import Image, UnidentifiedImageError

    name = os.fspath(path)
    # Pillow warns at half the size that it refuses, which exceeds our own limit.
    with open(name, "rb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            opened = Image.open(file, formats=FORMATS)
        except UnidentifiedImageError as error:
            raise ValueError(f"{name} is not a picture of a kind that is read: {', '.join(FORMATS)}") from error
        except Image.DecompressionBombError as error:
            raise ValueError(f"{name} has too many pixels: at most {MOST_TEXELS} are read; make it smaller") from error
        except DAMAGED as error:
            raise ValueError(f"{name} is damaged or cut off: {error}") from error
        with opened as image:
            _check_size(name, image.size)
            boxes = [tile[1] or (0, 0, 0, 0) for tile in image.tile]
            covered = sum((right - left) * (low - top) for left, top, right, low in boxes)
            if image.format == "TIFF" and covered < image.width * image.height:
                raise ValueError(f"{name} is damaged or cut off: it has pixels of a part of its size alone")
            return _photo(name, image)


def check_photo(name: str, size: tuple[int, int], *, opaque: bool) -> str:
    """Pillow's name of the format given by a file name; ValueError if it cannot hold an image of `size`, (w, h)."""
    with of_extra("draw"):
        from PIL import Image

    kind = Image.registered_extensions().get(Path(name).suffix.lower(), "")
    if kind not in WRITTEN:
        raise ValueError(f"path must end in .jpg, .png or .webp, got {name!r}")
    if kind == "WEBP" and max(size) > WEBP_SIDE:
        raise ValueError(f"{name} would have {size[0]} × {size[1]} pixels, but WebP has at most {WEBP_SIDE} a side")
    if kind == "JPEG" and not opaque:
        raise ValueError(f"{name}: JPEG has no opacity, and the picture is transparent in parts; write .png or .webp")
    return kind


def write_photo(path: str | os.PathLike[str], pixels: Pixels, profile: bytes = b"", xmp: str = "") -> Path:
    """Write an image with an ICC profile and XMP data as JPEG, PNG or WebP, by the extension.

    An existing file is replaced once the new one is complete. Errors as for `check_photo`.
    """
    with of_extra("draw"):
        from PIL import Image, PngImagePlugin

    target, opaque = Path(path), bool((pixels[..., 3] == 255).all())
    kind = check_photo(target.name, (pixels.shape[1], pixels.shape[0]), opaque=opaque)
    told: dict[str, Any] = {"icc_profile": profile} if profile else {}
    if xmp and kind == "PNG":  # for which Pillow has no argument `xmp`
        told["pnginfo"] = PngImagePlugin.PngInfo()
        told["pnginfo"].add_itxt("XML:com.adobe.xmp", xmp)
    elif xmp:
        told["xmp"] = xmp.encode()
    with replacing(target) as temporary:
        Image.fromarray(pixels[..., :3] if opaque else pixels).save(temporary, format=kind, **WRITTEN[kind], **told)
    return target


def _check_size(name: str, size: tuple[int, int]) -> None:
    width, height = size
    if width * height > MOST_TEXELS:
        raise ValueError(
            f"{name} has {width} × {height} pixels, more than the {MOST_TEXELS} that are read; make it smaller"
        )


def _photo(name: str, image: Any) -> tuple[Pixels, bytes]:
    with of_extra("draw"):
        from PIL import ImageOps

    try:
        image.load()
        ImageOps.exif_transpose(image, in_place=True)
    except DAMAGED as error:
        raise ValueError(f"{name} is damaged or cut off: {error}") from error
    # Profiles for gray or printing inks do not apply to the converted pixels.
    profile = image.info.get("icc_profile") if image.mode in ("RGB", "RGBA", "P") else None
    return _converted(name, image), profile or b""


def _converted(name: str, image: Any) -> Pixels:
    if image.mode == "F":
        raise ValueError(f"{name} holds floating-point numbers; scale them to 0 to 255 and give them as an array")
    if image.mode not in SIXTEEN_BITS:
        return np.asarray(image.convert("RGBA"))
    gray = np.asarray(image)
    if gray.max(initial=0) > 65535 or gray.min(initial=0) < 0:
        raise ValueError(f"{name} holds numbers beyond 16 bits; scale them to 0 to 255 and give them as an array")
    levels = ((gray.astype(np.uint32) + 128) // 257).astype(np.uint8)
    return np.dstack([levels, levels, levels, np.full_like(levels, 255)])
