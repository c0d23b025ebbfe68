"""Files of panoramas: what they say to viewers, what stays of what they said, what is refused."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PIL import Image, ImageCms

from stereodel import fisheye
from stereodel.drawing.view import View
from stereodel.globe import Raster, save_panorama
from stereodel.globe.images import Photo, read_photo, write_photo
from stereodel.globe.panoramas import GPANO
from tests.globe.supersampling import zone_plate

LENS = fisheye((90.0, 0.0), magnification=4.0)
XMP = """<?xpacket begin="" id="W5M0MpCehiHzreSzNTczkc9d"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/" x:xmptk="a camera"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description rdf:about="" xmlns:GPano="http://ns.google.com/photos/1.0/panorama/"
 xmlns:dc="http://purl.org/dc/elements/1.1/" xmlns:GAudio="http://ns.google.com/photos/1.0/audio/"
 GPano:FullPanoWidthPixels="9999" GPano:PosePitchDegrees="3.5" GAudio:Mime="audio/mp4">
<GPano:PoseHeadingDegrees>350.5</GPano:PoseHeadingDegrees><GPano:InitialViewHeadingDegrees>12</GPano:InitialViewHeadingDegrees>
<dc:title><rdf:Alt><rdf:li xml:lang="x-default">A room &amp; a desk</rdf:li></rdf:Alt></dc:title>
</rdf:Description></rdf:RDF></x:xmpmeta><?xpacket end="w"?>"""
KINDS = ["jpg", "png", "webp"]


def picture(height=32):
    level = zone_plate(height)
    return np.dstack([level, 255 - level, level // 2])


def said_to_viewers(path):
    """What the XMP data of a file say of a panorama, by name."""
    with Image.open(path) as image:
        xmp = image.info.get("xmp") or image.info.get("XML:com.adobe.xmp")
    if not xmp:
        return None
    text = xmp.decode() if isinstance(xmp, bytes) else xmp
    assert text.startswith("<?xpacket begin=")
    assert "ns0:" not in text
    root = ET.fromstring(text)
    space = f"{{{GPANO}}}"
    found = {name.removeprefix(space): value for node in root.iter() for name, value in node.attrib.items()
             if name.startswith(space)}  # fmt: skip
    return found | {node.tag.removeprefix(space): node.text for node in root.iter() if node.tag.startswith(space)}


@pytest.mark.parametrize("kind", KINDS)
def test_viewers_are_told_the_new_panorama(tmp_path, kind):
    source = write_photo(tmp_path / "room.jpg", Photo(opaque(picture()), xmp=XMP.encode()))
    (file,) = save_panorama(source, tmp_path / f"desk.{kind}", LENS, size=80)
    assert said_to_viewers(file) == {
        "UsePanoramaViewer": "True",
        "ProjectionType": "equirectangular",
        "FullPanoWidthPixels": "80",
        "FullPanoHeightPixels": "40",
        "CroppedAreaImageWidthPixels": "80",
        "CroppedAreaImageHeightPixels": "40",
        "CroppedAreaLeftPixels": "0",
        "CroppedAreaTopPixels": "0",
        # 90° from the focus is shown what was 2·atan(1/4) from it.
        "PoseHeadingDegrees": f"{(350.5 + 90 - 2 * np.degrees(np.arctan(1 / 4))) % 360:.4f}",
    }
    text = read_photo(file).xmp.decode()
    assert "A room &amp; a desk" in text
    assert 'xmptk="a camera"' in text
    assert "GAudio" not in text
    again = Raster(read_photo(source).pixels).panorama(LENS, size=80)
    if kind == "png":
        assert np.array_equal(read_photo(file).pixels, again)
    else:
        assert np.abs(read_photo(file).pixels.astype(float) - again).mean() < 6


def opaque(rgb):
    return np.dstack([rgb, np.full(rgb.shape[:2], 255, dtype=np.uint8)])


@pytest.mark.parametrize("form", ["cubemap", "planet"])
def test_what_is_no_panorama_says_nothing_of_one(tmp_path, form):
    source = write_photo(tmp_path / "room.jpg", Photo(opaque(picture()), xmp=XMP.encode()))
    (file,) = save_panorama(source, tmp_path / "out.jpg", form=form, size=16)
    assert said_to_viewers(file) == {}
    assert "A room &amp; a desk" in read_photo(file).xmp.decode()
    assert read_photo(file).pixels.shape[:2] == {"cubemap": (16, 96), "planet": (16, 16)}[form]


@pytest.mark.parametrize("xmp", [b"", b"no XMP", b"<a", b'<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>', b"<a/>"])
def test_xmp_that_is_not_there_or_cannot_be_read(tmp_path, xmp):
    source = write_photo(tmp_path / "room.png", Photo(opaque(picture()), xmp=xmp))
    (file,) = save_panorama(source, tmp_path / "out.png", size=16)
    said = said_to_viewers(file)
    assert (said["FullPanoWidthPixels"], said["ProjectionType"]) == ("16", "equirectangular")
    assert "PoseHeadingDegrees" not in said


@pytest.mark.parametrize("kind", KINDS)
def test_camera_place_and_colours_stay(tmp_path, kind):
    exif = Image.Exif()
    exif[0x010F], exif[0x0112], exif[0x0100] = "A maker", 3, 999
    exif.get_ifd(0x8769).update({0x9003: "2026:11:22 10:00:00", 0xA002: 999, 0xA003: 999})
    exif.get_ifd(0x8825).update({1: "N", 2: (48.0, 24.0, 0.0)})
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    Image.fromarray(picture()).save(tmp_path / "room.jpg", exif=exif, icc_profile=profile, quality=95)
    (file,) = save_panorama(tmp_path / "room.jpg", tmp_path / f"out.{kind}", size=40)
    with Image.open(file) as image:
        said = image.getexif()
        assert said[0x010F] == "A maker"
        assert said.get(0x0112, 1) == 1
        assert said.get_ifd(0x8769)[0x9003] == "2026:11:22 10:00:00"
        assert 0xA002 not in said.get_ifd(0x8769)
        assert said.get_ifd(0x8825)[1] == "N"
        assert [float(part) for part in said.get_ifd(0x8825)[2]] == [48.0, 24.0, 0.0]
        assert said.get(0x0100, 40) == 40
        assert image.info["icc_profile"] == profile


@pytest.mark.parametrize(("orientation", "turned"), [(3, np.s_[::-1, ::-1]), (2, np.s_[:, ::-1]), (4, np.s_[::-1])])
def test_pictures_that_lie_are_turned_upright(tmp_path, orientation, turned):
    exif = Image.Exif()
    exif[0x0112] = orientation
    Image.fromarray(picture()).save(tmp_path / "room.png", exif=exif)
    assert np.array_equal(read_photo(tmp_path / "room.png").pixels[..., :3], picture()[turned])


def test_profiles_of_gray_are_not_kept_for_colours(tmp_path):
    Image.fromarray(zone_plate(16)).save(tmp_path / "gray.png", icc_profile=b"of gray")
    assert read_photo(tmp_path / "gray.png").profile == b""


def test_six_files(tmp_path):
    source = write_photo(tmp_path / "room.png", Photo(opaque(picture())))
    options = {"form": "cubemap", "size": 16, "view": View(20, 30)}
    files = save_panorama(source, tmp_path / "out.png", faces=True, **options)
    names = ["right", "left", "up", "down", "front", "back"]
    assert [file.name for file in files] == [f"out_{name}.png" for name in names]
    (strip,) = save_panorama(source, tmp_path / "strip.png", **options)
    found = np.concatenate([read_photo(file).pixels for file in files], axis=1)
    assert np.array_equal(found, read_photo(strip).pixels)
    assert len({file.read_bytes() for file in files}) == 6


def test_transparent_parts_stay_and_are_refused_where_they_cannot(tmp_path):
    pixels = opaque(picture())
    pixels[:8, :, 3] = 0
    source = write_photo(tmp_path / "room.png", Photo(pixels))
    (file,) = save_panorama(source, tmp_path / "out.webp")
    assert (read_photo(file).pixels[:6, :, 3] < 20).all()
    with pytest.raises(ValueError, match="JPEG has no opacity"):
        save_panorama(source, tmp_path / "out.jpg")
    assert not (tmp_path / "out.jpg").exists()


@pytest.mark.parametrize(
    ("shape", "name", "options", "message"),
    [
        (
            (8, 15),
            "out.jpg",
            {},
            "room.png has 15 × 8 pixels, but a panorama of all directions is twice as wide as high",
        ),
        ((8, 16), "out.gif", {}, "path must end in .jpg"),
        ((8, 16), "out.webp", {"form": "cubemap", "size": 3000}, "out.webp would have 18000 × 3000 pixels"),
        ((8, 16), "out.jpg", {"faces": True}, "faces are those of a cubemap"),
    ],
)
def test_what_is_refused_is_refused_before_it_is_drawn(tmp_path, monkeypatch, shape, name, options, message):
    Image.fromarray(np.zeros(shape, dtype=np.uint8)).save(tmp_path / "room.png")
    monkeypatch.setattr(Raster, "panorama", None)
    with pytest.raises(ValueError, match=re.escape(message)):
        save_panorama(tmp_path / "room.png", tmp_path / name, **options)
    assert [path.name for path in tmp_path.iterdir()] == ["room.png"]
