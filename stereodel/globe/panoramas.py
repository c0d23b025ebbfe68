"""Panorama files through lenses, with the tag by which viewers recognise an image of all directions."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import Pixels
from stereodel._extras import of_extra
from stereodel._tasks.whole_files import replacing
from stereodel.conformal import MoebiusMap
from stereodel.curves.view import View
from stereodel.globe.raster import FACES, PLANET_RADIUS, PanoramaForm, Raster, panorama_sides, read_photo

WRITTEN: Final[Mapping[str, Mapping[str, Any]]] = {
    "JPEG": {"quality": 95, "subsampling": 0},
    # For photographs, level 6 of zlib takes three times as long for files 2 % smaller.
    "PNG": {"compress_level": 3},
    "WEBP": {"quality": 92, "method": 4},
}
"""Formats that are written, without visible loss, by Pillow's names of them and of its settings."""


def save_panorama(
    source: str | os.PathLike[str],
    path: str | os.PathLike[str],
    lens: MoebiusMap | None = None,
    form: PanoramaForm = "equirectangular",
    *,
    view: View | None = None,
    size: int | None = None,
    angular_radius: float = PLANET_RADIUS,
    faces: bool = False,
) -> list[Path]:
    """Read a panorama and write it as seen through a lens.

    Parameters
    ----------
    source : path-like
        An image of all directions, twice as wide as high, as written by 360° cameras, in any format that Pillow reads.
    path : path-like
        File to write; its extension, .jpg, .png or .webp, gives the format. An existing file is replaced once the new
        one is complete.
    lens, form, view, size, angular_radius
        As for `Raster.panorama`. The faces of a cubemap are placed in a row.
    faces : bool
        Whether to write a cubemap as six files: NAME_right.jpg, NAME_left.jpg, NAME_up.jpg, NAME_down.jpg,
        NAME_front.jpg and NAME_back.jpg.

    Returns
    -------
    list of Path
        The files.

    Notes
    -----
    What cannot be read or written, such as transparent pixels as JPEG, is refused before drawing.

    An equirectangular file holds its projection and size for viewers, as the XMP data of Google's "Photo Sphere";
    cubemaps and planets, which viewers do not treat as panoramas, do not. Colours stay in the file's own ICC profile.
    An image stored sideways is rotated upright by its EXIF data. No other metadata are kept.

    Examples
    --------
    >>> import tempfile
    >>> from stereodel import fisheye
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     gray = np.full((8, 16, 4), 255, dtype=np.uint8)
    ...     room = write_photo(Path(folder, "room.png"), gray)
    ...     files = save_panorama(room, Path(folder, "desk.png"), fisheye((90, -10), magnification=3))
    ...     files[0].name, Raster.open(files[0]).pixels.shape
    ('desk.png', (8, 16, 4))
    """
    target = Path(path)
    photo, profile = read_photo(source)
    height, width = photo.shape[:2]
    if width != 2 * height:
        raise ValueError(
            f"{os.fspath(source)} has {width} × {height} pixels, but a panorama of all directions is twice as wide as "
            "high; extend it to 2:1 with a plain colour"
        )
    if faces and form != "cubemap":
        raise ValueError(f"faces are those of a cubemap, and form is {form!r}")
    columns, rows = panorama_sides(form, size, width)
    opaque = bool((photo[..., 3] == 255).all())
    check_photo(target.name, (rows if faces else columns, rows), opaque=opaque)
    pixels = Raster(photo).panorama(lens, form, view=view, size=size, angular_radius=angular_radius)
    if faces:
        return [write_photo(name, face, profile) for name, face in zip(face_paths(target), pixels, strict=True)]
    if form == "cubemap":
        pixels = np.concatenate(list(pixels), axis=1)
    return [write_photo(target, pixels, profile, _viewer_tag(columns, rows) if form == "equirectangular" else "")]


def face_paths(path: Path) -> list[Path]:
    """Paths of the six faces of a cubemap, such as room_right.jpg, in one folder."""
    return [path.with_name(f"{path.stem}_{face}{path.suffix}") for face in FACES]


def check_photo(name: str, size: tuple[int, int], *, opaque: bool) -> str:
    """Pillow's name of the format given by a file name; ValueError if it cannot hold an image of `size`, (w, h)."""
    with of_extra("draw"):
        from PIL import Image

    kind = Image.registered_extensions().get(Path(name).suffix.lower(), "")
    if kind not in WRITTEN:
        raise ValueError(f"path must end in .jpg, .png or .webp, got {name!r}")
    # The sides of other formats are longer than `MOST_TEXELS` allows.
    if kind == "WEBP" and max(size) > (most := 16_383):
        raise ValueError(f"{name} would have {size[0]} × {size[1]} pixels, but WebP has at most {most} a side")
    if kind == "JPEG" and not opaque:
        raise ValueError(f"{name}: JPEG has no opacity, and the picture is transparent in parts; write .png or .webp")
    return kind


def write_photo(path: str | os.PathLike[str], pixels: Pixels, profile: bytes = b"", xmp: str = "") -> Path:
    """Write an image with an ICC profile and XMP data as JPEG, PNG or WebP, by the extension."""
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


def _viewer_tag(width: int, height: int) -> str:
    """XMP data (ISO 16684-1) that call an image of these sides an equirectangular one of all directions.

    See https://developers.google.com/streetview/spherical-metadata.
    """
    told: dict[str, object] = {"ProjectionType": "equirectangular"}
    for name, pixels in (("Width", width), ("Height", height)):
        told |= {f"FullPano{name}Pixels": pixels, f"CroppedAreaImage{name}Pixels": pixels}
    told |= {"CroppedAreaLeftPixels": 0, "CroppedAreaTopPixels": 0}
    return (
        '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?><x:xmpmeta xmlns:x="adobe:ns:meta/">'
        '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"><rdf:Description rdf:about="" '
        'xmlns:GPano="http://ns.google.com/photos/1.0/panorama/" '
        + " ".join(f'GPano:{name}="{value}"' for name, value in told.items())
        + '/></rdf:RDF></x:xmpmeta><?xpacket end="w"?>'
    )
