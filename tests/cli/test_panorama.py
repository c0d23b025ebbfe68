"""`stereodel panorama`: 360° pictures through a lens."""

import io

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from stereodel import fisheye
from stereodel.cli import app
from stereodel.drawing import View
from stereodel.globe import Raster
from tests.globe.supersampling import zone_plate
from tools.baselines import read_picture


@pytest.fixture
def room(folder):
    Image.fromarray(zone_plate(32)).save(folder / "room.png")
    return folder


ASKED = {
    "as it is": ([], {}),
    "desk": (["--focus=90,-10", "--magnify", 3], {"lens": fisheye((90, -10), magnification=3.0)}),
    "wide": (["--size", 100], {"size": 100}),
    "middle": (["--magnify", 3], {"lens": fisheye((0, 0), magnification=3.0)}),
    "view": (["--magnify", 3, "--view=30,20"], {"lens": fisheye((30, 20), magnification=3.0), "view": View(30, 20)}),
    "cube": (["--to", "cubemap", "--size", 12], {"form": "cubemap", "size": 12}),
    "planet": (["--to", "planet", "--angular-radius", 100], {"form": "planet", "angular_radius": 100.0}),
    "nadir": (["--to", "planet", "--magnify", 2], {"form": "planet", "lens": fisheye((0, -90), magnification=2.0)}),
}  # fmt: skip


@pytest.mark.parametrize("asked", ASKED)
def test_the_picture_that_was_asked_for(room, run, asked):
    options, wanted = ASKED[asked]
    run("panorama", "room.png", "-o", "out.png", *options)
    expected = Raster(zone_plate(32)).panorama(**wanted)[..., :3]
    if wanted.get("form") == "cubemap":
        expected = np.concatenate(list(expected), axis=1)
    assert np.array_equal(read_picture(room / "out.png"), expected)


def test_faces_are_six_files_that_are_not_replaced_unasked(room, run):
    options = ("panorama", "room.png", "--to", "cubemap", "--faces", "--size", 8, "-o", "c.png")
    run(*options)
    assert len(list(room.glob("c_*.png"))) == 6
    assert not (room / "c.png").exists()
    (room / "c_up.png").unlink()
    assert "c_right.png: already exists" in run(*options, code=2)
    assert not (room / "c_up.png").exists()
    run(*options, "--overwrite")
    assert (room / "c_up.png").exists()


def test_stdout_is_a_jpeg_unless_said_otherwise(room):
    for options, kind in (([], "JPEG"), (["--format", "webp"], "WEBP")):
        ran = CliRunner().invoke(app, ["panorama", "room.png", "-o", "-", *options])
        assert Image.open(io.BytesIO(ran.stdout_bytes)).format == kind
