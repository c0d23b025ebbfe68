"""Picture files: every mode that Pillow knows, and what is wrong with the others."""

import numpy as np
import pytest
from PIL import Image

from stereodel.globe import Raster

GRAY = np.arange(0, 256, 8, dtype=np.uint8).reshape(4, 8)
COLOUR = np.dstack([GRAY, 255 - GRAY, GRAY // 2])
OPACITY = np.where(GRAY > 100, 255, 0).astype(np.uint8)


def with_opacity(colour, opacity=255):
    return np.dstack([colour, np.broadcast_to(np.uint8(opacity), colour.shape[:2])])


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


def test_palette_with_a_transparent_colour(tmp_path):
    picture = Image.new("P", (8, 4), 1)
    picture.putpalette([0, 0, 0, 10, 20, 30])
    picture.paste(0, (0, 0, 4, 4))
    picture.save(tmp_path / "map.png", transparency=0)
    found = Raster.open(tmp_path / "map.png").pixels
    assert found[0, 0, 3] == 0
    assert found[0, 7].tolist() == [10, 20, 30, 255]


@pytest.mark.parametrize("kind", ["jpg", "webp", "tif", "bmp", "gif"])
def test_kinds_of_files(tmp_path, kind):
    Image.new("RGB", (8, 4), (50, 100, 150)).save(tmp_path / f"map.{kind}")
    found = Raster.open(tmp_path / f"map.{kind}").pixels.astype(int)
    assert np.abs(found - [50, 100, 150, 255]).max() <= 4


def test_a_part_of_the_globe(tmp_path):
    Image.new("L", (30, 30)).save(tmp_path / "part.png")
    assert Raster.open(tmp_path / "part.png", bounds=(0, 10, 30, 40)).bounds == (0, 10, 30, 40)


def test_damaged_files_are_named(tmp_path):
    path = tmp_path / "map.jpg"
    Image.fromarray(np.random.default_rng(1).integers(0, 256, (100, 200, 3), dtype=np.uint8)).save(path)
    path.write_bytes(path.read_bytes()[:3000])
    with pytest.raises(ValueError, match=r"map\.jpg is damaged or cut off"):
        Raster.open(path)


def test_a_tiff_of_a_few_rows_that_says_it_has_millions(tmp_path):
    """Pillow would make room for all of them, and leave them black."""
    path = tmp_path / "map.tif"
    Image.fromarray(np.zeros((15, 30, 3), np.uint8)).save(path)
    content = path.read_bytes()
    length = b"\x01\x01\x04\0\1\0\0\0"  # the tag of the height, a whole number of 32 bits
    assert content.count(length + b"\x0f") == 1
    path.write_bytes(content.replace(length + b"\x0f\0\0", length + b"\0\0\x20"))
    with pytest.raises(ValueError, match=r"map\.tif is damaged or cut off: it has pixels of a part"):
        Raster.open(path)


def test_floating_point_numbers_are_no_picture(tmp_path):
    Image.fromarray(np.zeros((4, 8), np.float32)).save(tmp_path / "heights.tif")
    with pytest.raises(ValueError, match=r"heights\.tif holds floating-point numbers"):
        Raster.open(tmp_path / "heights.tif")


def test_what_pillow_gives_to_other_programs_is_not_opened(tmp_path, monkeypatch):
    """Pillow starts Ghostscript for what begins as PostScript, whatever the file is called."""
    from PIL import EpsImagePlugin

    monkeypatch.setattr(EpsImagePlugin, "Ghostscript", lambda *given, **more: pytest.fail("started"))
    (tmp_path / "map.png").write_bytes(b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 20 10\n%%EndComments\nshowpage\n")
    with pytest.raises(ValueError, match=r"map\.png is not a picture of a kind that is read"):
        Raster.open(tmp_path / "map.png")
