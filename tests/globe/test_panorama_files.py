"""Files of panoramas: what they say to viewers, the colours that stay, what is refused."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PIL import Image, ImageCms

from stereodel import fisheye
from stereodel.curves.view import View
from stereodel.globe import Raster, save_panorama
from stereodel.globe.images import read_photo, write_photo
from tests.globe.supersampling import zone_plate

LENS = fisheye((90.0, 0.0), magnification=4.0)
GPANO = "http://ns.google.com/photos/1.0/panorama/"
KINDS = ["jpg", "png", "webp"]


def picture(height=32):
    level = zone_plate(height)
    return np.dstack([level, 255 - level, level // 2])


def pixels_of(path):
    return read_photo(path)[0]


def said_to_viewers(path):
    """What the XMP data of a file say of a panorama, by name."""
    with Image.open(path) as image:
        xmp = image.info.get("xmp")
    if not xmp:
        return None
    text = xmp.decode()
    assert text.startswith("<?xpacket begin=")
    space = f"{{{GPANO}}}"
    return {
        name.removeprefix(space): value
        for node in ET.fromstring(text).iter()
        for name, value in node.attrib.items()
        if name.startswith(space)
    }


@pytest.mark.parametrize("kind", KINDS)
def test_viewers_are_told_the_new_panorama(tmp_path, kind):
    source = write_photo(tmp_path / "room.jpg", opaque(picture()))
    (file,) = save_panorama(source, tmp_path / f"desk.{kind}", LENS, size=80)
    assert said_to_viewers(file) == {
        "ProjectionType": "equirectangular",
        "FullPanoWidthPixels": "80",
        "FullPanoHeightPixels": "40",
        "CroppedAreaImageWidthPixels": "80",
        "CroppedAreaImageHeightPixels": "40",
        "CroppedAreaLeftPixels": "0",
        "CroppedAreaTopPixels": "0",
    }
    again = Raster.open(source).panorama(LENS, size=80)
    if kind == "png":
        assert np.array_equal(pixels_of(file), again)
    else:
        assert np.abs(pixels_of(file).astype(float) - again).mean() < 6


def opaque(rgb):
    return np.dstack([rgb, np.full(rgb.shape[:2], 255, dtype=np.uint8)])


@pytest.mark.parametrize("form", ["cubemap", "planet"])
def test_what_is_no_panorama_says_nothing_of_one(tmp_path, form):
    source = write_photo(tmp_path / "room.jpg", opaque(picture()))
    (file,) = save_panorama(source, tmp_path / "out.jpg", form=form, size=16)
    assert said_to_viewers(file) is None
    assert pixels_of(file).shape[:2] == {"cubemap": (16, 96), "planet": (16, 16)}[form]


@pytest.mark.parametrize("kind", KINDS)
def test_colours_stay(tmp_path, kind):
    """The profile goes along; of what a camera says nothing does, least of all how the picture lay."""
    exif = Image.Exif()
    exif[0x010F], exif[0x0112] = "A maker", 3
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    Image.fromarray(picture()).save(tmp_path / "room.jpg", exif=exif, icc_profile=profile, quality=95)
    (file,) = save_panorama(tmp_path / "room.jpg", tmp_path / f"out.{kind}", size=40)
    with Image.open(file) as image:
        assert image.info["icc_profile"] == profile
        assert dict(image.getexif()) == {}


@pytest.mark.parametrize(("orientation", "turned"), [(3, np.s_[::-1, ::-1]), (2, np.s_[:, ::-1]), (4, np.s_[::-1])])
def test_pictures_that_lie_are_turned_upright(tmp_path, orientation, turned):
    exif = Image.Exif()
    exif[0x0112] = orientation
    Image.fromarray(picture()).save(tmp_path / "room.png", exif=exif)
    assert np.array_equal(pixels_of(tmp_path / "room.png")[..., :3], picture()[turned])


def test_profiles_of_gray_are_not_kept_for_colours(tmp_path):
    Image.fromarray(zone_plate(16)).save(tmp_path / "gray.png", icc_profile=b"of gray")
    assert read_photo(tmp_path / "gray.png")[1] == b""


def test_six_files(tmp_path):
    source = write_photo(tmp_path / "room.png", opaque(picture()))
    options = {"form": "cubemap", "size": 16, "view": View(20, 30)}
    files = save_panorama(source, tmp_path / "out.png", faces=True, **options)
    names = ["right", "left", "up", "down", "front", "back"]
    assert [file.name for file in files] == [f"out_{name}.png" for name in names]
    (strip,) = save_panorama(source, tmp_path / "strip.png", **options)
    found = np.concatenate([pixels_of(file) for file in files], axis=1)
    assert np.array_equal(found, pixels_of(strip))
    assert len({file.read_bytes() for file in files}) == 6


def test_transparent_parts_stay_and_are_refused_where_they_cannot(tmp_path):
    pixels = opaque(picture())
    pixels[:8, :, 3] = 0
    source = write_photo(tmp_path / "room.png", pixels)
    (file,) = save_panorama(source, tmp_path / "out.webp")
    assert (pixels_of(file)[:6, :, 3] < 20).all()
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
