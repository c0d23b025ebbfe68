"""Picture files: the usual kinds, by Pillow, with limits that hold before anything is decoded."""

from __future__ import annotations

import os
import struct
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel._files import replacing
from stereodel.constants import MOST_TEXELS

SIXTEEN_BITS: Final = ("I", "I;16", "I;16B", "I;16L", "I;16N")
"""Modes of Pillow for gray of 16 bits."""

FORMATS: Final = ("PNG", "JPEG", "TIFF", "WEBP", "GIF", "BMP", "PPM", "TGA", "JPEG2000")
"""Kinds of pictures that are opened: those that Pillow decodes by itself. For others it starts Ghostscript and such."""

WRITTEN: Final[Mapping[str, tuple[str, int]]] = {
    ".jpg": ("JPEG", 65_500),
    ".jpeg": ("JPEG", 65_500),
    ".png": ("PNG", 2**31 - 1),
    ".webp": ("WEBP", 16_383),
}
"""Endings of files that are written: Pillow's name of the format, and the longest side that it has."""

SETTINGS: Final[Mapping[str, Mapping[str, Any]]] = {
    "JPEG": {"quality": 95, "subsampling": 0},
    # Photographs: level 6 of zlib takes three times as long for files 2 % smaller.
    "PNG": {"compress_level": 3},
    "WEBP": {"quality": 92, "method": 4},
}

LONGEST_XMP: Final = 65_502
"""Bytes that a JPEG has for it in one piece; what is longer is left out."""

ORIENTATION: Final = 0x0112

KEPT_TAGS: Final = frozenset({0x010E, 0x010F, 0x0110, 0x0131, 0x0132, 0x013B, 0x8298})
"""Of EXIF: description, maker and model of the camera, software, date, author, rights."""

KEPT_PARTS: Final = (0x8769, 0x8825)
"""Of EXIF: how the picture was taken, and where."""

SIZES: Final = frozenset({0xA002, 0xA003, 0xA005})
"""Of the first of these parts: columns and rows, and where the next part is stored."""

DAMAGED: Final = (OSError, SyntaxError, ValueError, EOFError, struct.error, IndexError, TypeError)
"""What the decoders of Pillow raise on a file that is cut off or garbled."""


@dataclass(frozen=True, eq=False)
class Photo:
    """A picture, and what its file says of it.

    Parameters
    ----------
    pixels : (h, w, 4) uint8 array
        sRGB, or the colours of the profile, and opacity, not premultiplied; upright.
    profile : bytes
        ICC profile of the colours; empty for sRGB.
    exif : bytes
        Of the camera, the place and the rights, as a file holds it; empty where there is nothing. Nothing of sizes, and
        no orientation, as the pixels are upright.
    xmp : bytes
        As the file holds it.
    """

    pixels: Pixels
    profile: bytes = b""
    exif: bytes = b""
    xmp: bytes = b""


def read_image(path: str | os.PathLike[str]) -> Pixels:
    """The first picture of a file, (h, w, 4): sRGB and opacity, not premultiplied; errors as for `read_photo`."""
    return read_photo(path).pixels


def read_photo(path: str | os.PathLike[str]) -> Photo:
    """The first picture of a file, turned upright where its EXIF data say that it lies.

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
                return _photo(name, image)
        except UnidentifiedImageError as error:
            raise ValueError(f"{name} is not a picture of a kind that is read: {', '.join(FORMATS)}") from error
        except Image.DecompressionBombError as error:
            raise ValueError(f"{name} has too many pixels: at most {MOST_TEXELS} are read; make it smaller") from error


def check_photo(name: str, size: tuple[int, int], *, opaque: bool) -> None:
    """A ValueError where the format of a file's name cannot hold a picture of so many columns and rows."""
    kind, largest = _kind_of(name)
    if max(size) > largest:
        raise ValueError(f"{name} would have {size[0]} × {size[1]} pixels, but {kind} has at most {largest} a side")
    if kind == "JPEG" and not opaque:
        raise ValueError(f"{name}: JPEG has no opacity, and the picture is transparent in parts; write .png or .webp")


def write_photo(path: str | os.PathLike[str], photo: Photo) -> Path:
    """Write a picture as JPEG, PNG or WebP, as the ending says, with what is said of it; errors as `check_photo`.

    JPEG and WebP at a quality at which the eye sees no loss. An existing file is replaced when the new one is complete.
    """
    with of_extra("draw"):
        from PIL import Image, PngImagePlugin

    target, pixels = Path(path), photo.pixels
    opaque = bool((pixels[..., 3] == 255).all())
    check_photo(target.name, (pixels.shape[1], pixels.shape[0]), opaque=opaque)
    kind, _ = _kind_of(target.name)
    said: dict[str, Any] = {"icc_profile": photo.profile or None, "exif": photo.exif or None}
    if kind == "PNG" and photo.xmp:
        said["pnginfo"] = PngImagePlugin.PngInfo()
        said["pnginfo"].add_itxt("XML:com.adobe.xmp", photo.xmp.decode("utf-8", "replace"))
    elif len(photo.xmp) <= LONGEST_XMP:
        said["xmp"] = photo.xmp or None
    with replacing(target) as temporary:
        image = Image.fromarray(pixels[..., :3] if opaque else pixels)
        image.save(temporary, format=kind, **SETTINGS[kind], **{key: value for key, value in said.items() if value})
    return target


def _kind_of(name: str) -> tuple[str, int]:
    """Pillow's name of a format, and its largest side."""
    ending = Path(name).suffix.lower()
    if ending not in WRITTEN:
        raise ValueError(f"path must end in {', '.join(WRITTEN)}, got {name!r}")
    return WRITTEN[ending]


def _check_size(name: str, size: tuple[int, int]) -> None:
    width, height = size
    if width * height > MOST_TEXELS:
        raise ValueError(
            f"{name} has {width} × {height} pixels, more than the {MOST_TEXELS} that are read; make it smaller"
        )


def _photo(name: str, image: Any) -> Photo:
    with of_extra("draw"):
        from PIL import ImageOps

    try:
        image.load()
        said = image.getexif()
        upright = ImageOps.exif_transpose(image) if said.get(ORIENTATION, 1) != 1 else image
        exif = _kept_exif(said)
    except DAMAGED as error:
        raise ValueError(f"{name} is damaged or cut off: {error}") from error
    # A profile of gray or of printing inks does not fit the colours that the pixels become.
    profile = image.info.get("icc_profile") if image.mode in ("RGB", "RGBA", "P") else None
    xmp = image.info.get("xmp") or image.info.get("XML:com.adobe.xmp") or b""
    return Photo(_converted(name, upright), profile or b"", exif, xmp.encode() if isinstance(xmp, str) else bytes(xmp))


def _kept_exif(said: Any) -> bytes:
    """What EXIF data say beside the way in which the pixels were stored."""
    with of_extra("draw"):
        from PIL import Image

    kept = Image.Exif()
    for tag in set(said) & KEPT_TAGS:
        kept[tag] = said[tag]
    for number in KEPT_PARTS:
        part = {tag: value for tag, value in said.get_ifd(number).items() if tag not in SIZES}
        if part:
            kept.get_ifd(number).update(part)
    return kept.tobytes() if len(kept) or any(kept.get_ifd(number) for number in KEPT_PARTS) else b""


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
