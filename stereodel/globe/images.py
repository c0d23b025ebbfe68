"""Image files in the usual formats, by Pillow, with limits that are checked before anything is decoded."""

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
"""Pillow's modes for 16-bit gray."""

FORMATS: Final = ("PNG", "JPEG", "TIFF", "WEBP", "GIF", "BMP", "PPM", "TGA", "JPEG2000")
"""Formats that are opened: those that Pillow decodes itself. For others it starts programs such as Ghostscript."""

WRITTEN: Final[Mapping[str, tuple[str, int]]] = {
    ".jpg": ("JPEG", 65_500),
    ".jpeg": ("JPEG", 65_500),
    ".png": ("PNG", 2**31 - 1),
    ".webp": ("WEBP", 16_383),
}
"""Extensions of files that are written, with Pillow's name of the format and its longest side in pixels."""

SETTINGS: Final[Mapping[str, Mapping[str, Any]]] = {
    "JPEG": {"quality": 95, "subsampling": 0},
    # For photographs, level 6 of zlib takes three times as long for files 2 % smaller.
    "PNG": {"compress_level": 3},
    "WEBP": {"quality": 92, "method": 4},
}

LONGEST_XMP: Final = 65_502
"""Largest block of EXIF or XMP data in a JPEG, in bytes; longer data are left out."""

ORIENTATION: Final = 0x0112

KEPT_TAGS: Final = frozenset({0x010E, 0x010F, 0x0110, 0x0131, 0x0132, 0x013B, 0x8298})
"""EXIF tags: description, maker and model of the camera, software, date, author, rights."""

KEPT_PARTS: Final = (0x8769, 0x8825)
"""EXIF blocks: how and where the picture was taken."""

SIZES: Final = frozenset({0xA002, 0xA003, 0xA005})
"""Tags of the first of these blocks: columns and rows, and the position of the next block."""

DAMAGED: Final = (OSError, SyntaxError, ValueError, EOFError, struct.error, IndexError, TypeError)
"""Exceptions that Pillow's decoders raise on truncated or corrupt files."""


@dataclass(frozen=True, eq=False)
class Photo:
    """An image and its metadata.

    Parameters
    ----------
    pixels : (h, w, 4) uint8 array
        Colour, in sRGB or in the colour space of the profile, and opacity, not premultiplied; upright.
    profile : bytes
        ICC profile of the colours; empty for sRGB.
    exif : bytes
        Encoded EXIF data of the camera, place and rights; empty if there are none. Without sizes or orientation, as the
        pixels are upright.
    xmp : bytes
        Encoded XMP data.
    """

    pixels: Pixels
    profile: bytes = b""
    exif: bytes = b""
    xmp: bytes = b""


def read_image(path: str | os.PathLike[str]) -> Pixels:
    """The first image of a file, (h, w, 4): sRGB and opacity, not premultiplied; errors as for `read_photo`."""
    return read_photo(path).pixels


def read_photo(path: str | os.PathLike[str]) -> Photo:
    """The first image of a file, rotated upright according to its EXIF data.

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


def check_photo(name: str, size: tuple[int, int], *, opaque: bool) -> None:
    """Raise ValueError if the format given by a file name cannot hold an image of `size`, columns and rows."""
    kind, largest = _kind_of(name)
    if max(size) > largest:
        raise ValueError(f"{name} would have {size[0]} × {size[1]} pixels, but {kind} has at most {largest} a side")
    if kind == "JPEG" and not opaque:
        raise ValueError(f"{name}: JPEG has no opacity, and the picture is transparent in parts; write .png or .webp")


def write_photo(path: str | os.PathLike[str], photo: Photo) -> Path:
    """Write an image and its metadata as JPEG, PNG or WebP, by the extension; errors as for `check_photo`.

    JPEG and WebP are written without visible loss. An existing file is replaced once the new one is complete.
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
    """Pillow's name of a format, and its longest side."""
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
    # Profiles for gray or printing inks do not apply to the converted pixels.
    profile = image.info.get("icc_profile") if image.mode in ("RGB", "RGBA", "P") else None
    xmp = image.info.get("xmp") or image.info.get("XML:com.adobe.xmp") or b""
    return Photo(_converted(name, upright), profile or b"", exif, xmp.encode() if isinstance(xmp, str) else bytes(xmp))


def _kept_exif(said: Any) -> bytes:
    """The EXIF data that do not concern the storage of the pixels."""
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
