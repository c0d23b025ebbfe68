"""Picture files: the modes that Pillow knows, what panoramas say to viewers, colours that stay, what is refused."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PIL import Image, ImageCms

from stereodel import fisheye
from stereodel.curves.view import View
from stereodel.globe import Raster, save_panorama
from stereodel.globe.panoramas import write_photo
from stereodel.globe.raster import read_photo
from tests.globe.supersampling import zone_plate

LENS = fisheye((90.0, 0.0), magnification=4.0)
GPANO = "http://ns.google.com/photos/1.0/panorama/"
KINDS = ["jpg", "png", "webp"]


def picture(height=32):
    level = zone_plate(height)
    return np.dstack([level, 255 - level, level // 2])


def with_opacity(colour, opacity=255):
    return np.dstack([colour, np.broadcast_to(np.uint8(opacity), colour.shape[:2])])


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
    found = [each for node in ET.fromstring(text).iter() for each in node.attrib.items()]
    return {name.removeprefix(space): value for name, value in found if name.startswith(space)}


@pytest.mark.parametrize("kind", KINDS)
def test_viewers_are_told_the_new_panorama(tmp_path, kind):
    source = write_photo(tmp_path / "room.jpg", with_opacity(picture()))
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


@pytest.mark.parametrize("form", ["cubemap", "planet"])
def test_what_is_no_panorama_says_nothing_of_one(tmp_path, form):
    source = write_photo(tmp_path / "room.jpg", with_opacity(picture()))
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
    Image.fromarray(zone_plate(16)).save(tmp_path / "gray.png", icc_profile=b"of gray")
    assert read_photo(tmp_path / "gray.png")[1] == b""


def test_six_files(tmp_path):
    source = write_photo(tmp_path / "room.png", with_opacity(picture()))
    options = {"form": "cubemap", "size": 16, "view": View(20, 30)}
    files = save_panorama(source, tmp_path / "out.png", faces=True, **options)
    names = ["right", "left", "up", "down", "front", "back"]
    assert [file.name for file in files] == [f"out_{name}.png" for name in names]
    (strip,) = save_panorama(source, tmp_path / "strip.png", **options)
    found = np.concatenate([pixels_of(file) for file in files], axis=1)
    assert np.array_equal(found, pixels_of(strip))
    assert len({file.read_bytes() for file in files}) == 6


def test_transparent_parts_stay_and_are_refused_where_they_cannot(tmp_path):
    pixels = with_opacity(picture())
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
        ((8, 15), "out.jpg", {}, "room.png has 15 × 8 pixels, but a panorama of all directions is twice as wide"),
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


GRAY = np.arange(0, 256, 8, dtype=np.uint8).reshape(4, 8)
COLOUR = np.dstack([GRAY, 255 - GRAY, GRAY // 2])
OPACITY = np.where(GRAY > 100, 255, 0).astype(np.uint8)


@pytest.mark.parametrize(
    ("picture", "expected"),
    [
        (Image.fromarray(GRAY), with_opacity(np.dstack([GRAY] * 3))),
        (Image.fromarray(COLOUR), with_opacity(COLOUR)),
        (Image.fromarray(with_opacity(COLOUR, OPACITY)), with_opacity(COLOUR, OPACITY)),
        (Image.fromarray(np.dstack([GRAY, OPACITY])), with_opacity(np.dstack([GRAY] * 3), OPACITY)),
        (Image.fromarray(COLOUR).quantize(32, method=Image.Quantize.FASTOCTREE), None),
        (Image.fromarray(GRAY.astype(np.uint16) * 257), with_opacity(np.dstack([GRAY] * 3))),
        (Image.fromarray(GRAY > 100), with_opacity(np.dstack([OPACITY] * 3))),
    ],
    ids=["gray", "colour", "opacity", "gray with opacity", "palette", "16 bits", "1 bit"],
)
def test_modes(tmp_path, picture, expected):
    path = tmp_path / "map.png"
    picture.save(path)
    expected = np.asarray(picture.convert("RGBA")) if expected is None else expected
    assert np.array_equal(Raster.open(path).pixels, expected)
    for orientation, turned in ((3, np.s_[::-1, ::-1]), (2, np.s_[:, ::-1]), (4, np.s_[::-1])):
        exif = Image.Exif()
        exif[0x0112] = orientation  # how the picture lies
        picture.save(path, exif=exif)
        assert np.array_equal(Raster.open(path).pixels, expected[turned])


def test_kinds_of_files(tmp_path):
    """Also a palette with a transparent colour, and a part of the globe."""
    for kind in ("jpg", "webp", "tif", "bmp", "gif"):
        Image.new("RGB", (8, 4), (50, 100, 150)).save(tmp_path / f"map.{kind}")
        found = Raster.open(tmp_path / f"map.{kind}", bounds=(0, 10, 30, 40))
        assert found.bounds == (0, 10, 30, 40)
        assert np.abs(found.pixels.astype(int) - [50, 100, 150, 255]).max() <= 4
    picture = Image.new("P", (8, 4), 1)
    picture.putpalette([0, 0, 0, 10, 20, 30])
    picture.paste(0, (0, 0, 4, 4))
    picture.save(tmp_path / "map.png", transparency=0)
    found = Raster.open(tmp_path / "map.png").pixels
    assert found[0, 0, 3] == 0
    assert found[0, 7].tolist() == [10, 20, 30, 255]


def cut_off(path):
    Image.fromarray(np.random.default_rng(1).integers(0, 256, (100, 200, 3), dtype=np.uint8)).save(path)
    path.write_bytes(path.read_bytes()[:3000])


def of_millions_of_rows(path):
    """A TIFF of a few rows that says so: Pillow would make room for all of them, and leave them black."""
    Image.fromarray(np.zeros((15, 30, 3), np.uint8)).save(path)
    content = path.read_bytes()
    length = b"\x01\x01\x04\0\1\0\0\0"  # the tag of the height, a whole number of 32 bits
    assert content.count(length + b"\x0f") == 1
    path.write_bytes(content.replace(length + b"\x0f\0\0", length + b"\0\0\x20"))


POSTSCRIPT = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 20 10\n%%EndComments\nshowpage\n"
"""Pillow starts Ghostscript for what begins so, whatever the file is called."""


@pytest.mark.parametrize(
    ("name", "write", "message"),
    [
        ("map.jpg", cut_off, "is damaged or cut off"),
        ("map.tif", of_millions_of_rows, "is damaged or cut off: it has pixels of a part"),
        ("map.tif", Image.fromarray(np.zeros((4, 8), np.float32)).save, "holds floating-point numbers"),
        ("map.png", lambda path: path.write_bytes(POSTSCRIPT), "is not a picture of a kind that is read"),
    ],
)
def test_what_is_no_picture_is_named(tmp_path, monkeypatch, name, write, message):
    from PIL import EpsImagePlugin

    monkeypatch.setattr(EpsImagePlugin, "Ghostscript", lambda *given, **more: pytest.fail("started"))
    write(tmp_path / name)
    with pytest.raises(ValueError, match=f"{re.escape(name)} {message}"):
        Raster.open(tmp_path / name)
