"""Panorama files through lenses: images of all directions with the metadata that viewers need.

Viewers recognise a panorama by the XMP data of Google's "Photo Sphere". These are rewritten for the new image; all
other XMP data, the colour profile and the camera's EXIF data are kept.
"""

from __future__ import annotations

import io
import os
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import as_choice
from stereodel.conformal import MoebiusMap
from stereodel.drawing.view import View
from stereodel.globe.images import Photo, check_photo, read_photo, write_photo
from stereodel.globe.raster import FACES, PANORAMA_FORMS, PLANET_RADIUS, SHARES, PanoramaForm, Raster, panorama_size
from stereodel.render.xmp import META, RDF, xmp_packet
from stereodel.sphere import xyz_to_lonlat

VIEWERS: Final = "http://ns.google.com/photos/1.0/"
"""XMP namespaces for viewers, and for sound and depth data that a file may also hold."""

SPHERE: Final = "equirectangular"

GPANO: Final = f"{VIEWERS}panorama/"


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

    Raises
    ------
    OSError
        If a file is missing, or cannot be read or written.
    ValueError
        If the source is not an image, is damaged, is not 2:1 or has more than `MOST_TEXELS` pixels; if the extension is
        unknown, `faces` is used without a cubemap, or a JPEG would have transparent pixels; and as for
        `Raster.panorama`. All this is checked before drawing.

    Notes
    -----
    An equirectangular file holds its size for viewers, and the compass bearing of its centre if the source has one. The
    tilt of the camera and the initial view are left out, as directions have changed; cubemaps and planets, which
    viewers do not treat as panoramas, have none of these data. EXIF data keep camera, exposure, date, place and rights;
    an image stored sideways is rotated upright. Colours stay in the file's own colour profile.

    Examples
    --------
    >>> import tempfile
    >>> from stereodel import fisheye
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     gray = np.full((8, 16, 4), 255, dtype=np.uint8)
    ...     room = write_photo(Path(folder, "room.png"), Photo(gray))
    ...     files = save_panorama(room, Path(folder, "desk.png"), fisheye((90, -10), magnification=3))
    ...     files[0].name, read_photo(files[0]).pixels.shape
    ('desk.png', (8, 16, 4))
    """
    target, photo = Path(path), read_photo(source)
    height, width = photo.pixels.shape[:2]
    if width != 2 * height:
        raise ValueError(
            f"{os.fspath(source)} has {width} × {height} pixels, but a panorama of all directions is twice as wide as "
            "high; extend it to 2:1 with a plain colour"
        )
    if faces and form != "cubemap":
        raise ValueError(f"faces are those of a cubemap, and form is {form!r}")
    as_choice(form, PANORAMA_FORMS, "form")
    side = panorama_size(max(1, width // SHARES[form]) if size is None else size, form)
    columns, rows = {"equirectangular": (side, side // 2), "cubemap": (6 * side, side), "planet": (side, side)}[form]
    opaque = bool((photo.pixels[..., 3] == 255).all())
    check_photo(target.name, (side if faces else columns, rows), opaque=opaque)
    seen = View(0.0, -90.0 if form == "planet" else 0.0) if view is None else view
    raster = Raster(photo.pixels)
    pixels = raster.panorama(lens, form, view=seen, size=side, angular_radius=angular_radius)
    told = replace(photo, xmp=_xmp(photo.xmp, _said(photo, lens, seen, columns, rows) if form == SPHERE else {}))
    if not faces:
        whole = np.concatenate(list(pixels), axis=1) if form == "cubemap" else pixels
        return [write_photo(target, replace(told, pixels=whole))]
    return [
        write_photo(name, replace(told, pixels=face)) for name, face in zip(face_paths(target), pixels, strict=True)
    ]


def face_paths(path: Path) -> list[Path]:
    """Paths of the six faces of a cubemap, in one folder.

    Examples
    --------
    >>> [name.name for name in face_paths(Path("room.jpg"))][:2]
    ['room_right.jpg', 'room_left.jpg']
    """
    return [path.with_name(f"{path.stem}_{face}{path.suffix}") for face in FACES]


def _said(photo: Photo, lens: MoebiusMap | None, view: View, width: int, height: int) -> dict[str, str]:
    """Metadata for viewers of an equirectangular image of all directions."""
    said = {
        "UsePanoramaViewer": "True",
        "ProjectionType": SPHERE,
        "FullPanoWidthPixels": f"{width}",
        "FullPanoHeightPixels": f"{height}",
        "CroppedAreaImageWidthPixels": f"{width}",
        "CroppedAreaImageHeightPixels": f"{height}",
        "CroppedAreaLeftPixels": "0",
        "CroppedAreaTopPixels": "0",
    }
    bearing = _bearing(photo.xmp)
    if bearing is not None:
        middle = view.matrix[2] if lens is None else lens.inverse()(view.matrix[2])
        said["PoseHeadingDegrees"] = f"{(bearing + float(xyz_to_lonlat(middle)[0])) % 360.0:.4f}".rstrip("0").rstrip(
            "."
        )
    return said


def _bearing(xmp: bytes) -> float | None:
    """The compass bearing of the centre of a panorama in degrees; None if unknown."""
    root, name = _parsed(xmp), f"{{{GPANO}}}PoseHeadingDegrees"
    found = (
        [] if root is None else [*(node.get(name) for node in root.iter()), *(node.text for node in root.iter(name))]
    )
    try:
        return next((float(text) for text in found if text), None)
    except ValueError:
        return None


def _xmp(xmp: bytes, said: Mapping[str, str]) -> bytes:
    """XMP data with the metadata for viewers replaced by `said`, or removed."""
    root = _parsed(xmp)
    if root is None:
        if not said:
            return b""
        root = ET.Element(f"{{{META}}}xmpmeta")
    whole = root.find(f".//{{{RDF}}}RDF") if root.tag != f"{{{RDF}}}RDF" else root
    if whole is None:
        whole = ET.SubElement(root, f"{{{RDF}}}RDF")
    for part in whole.iter():
        for name in [name for name in part.attrib if name.startswith(f"{{{VIEWERS}")]:
            del part.attrib[name]
        for child in [child for child in part if str(child.tag).startswith(f"{{{VIEWERS}")]:
            part.remove(child)
    if said:
        names: dict[str, str] = {f"{{{RDF}}}about": ""}
        names.update({f"{{{GPANO}}}{name}": text for name, text in said.items()})
        ET.SubElement(whole, f"{{{RDF}}}Description", names)
    return xmp_packet(ET.tostring(root, encoding="unicode"))


def _parsed(xmp: bytes) -> ET.Element | None:
    """XMP data as a tree; None if there are none or they are invalid."""
    # Entities could expand without limit, and XMP has none.
    if not xmp or b"<!" in xmp:
        return None
    root: Any = None
    try:
        # Programs look for known prefixes, so existing ones are kept.
        for event, found in ET.iterparse(io.BytesIO(xmp.strip(b"\0 \n\r\t")), events=("start-ns", "start")):
            if event == "start-ns":
                _name_prefix(*found)
            elif root is None:
                root = found
    except (ET.ParseError, UnicodeDecodeError, LookupError):
        return None
    return root


def _name_prefix(prefix: str, space: str) -> None:
    if prefix and not prefix.startswith("ns"):
        ET.register_namespace(prefix, space)


for _prefix, _space in (("x", META), ("rdf", RDF), ("GPano", GPANO)):
    ET.register_namespace(_prefix, _space)
