"""SVG files as librsvg shows them, for file managers, GNOME and Wikipedia: the pictures of our renderer."""

import subprocess
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from stereodel import PlanarVoronoi, SphericalVoronoi, fisheye
from stereodel.drawing import View, diagram_page
from stereodel.globe import Globe

SIZE, BLOCK = 400, 8
POINTS = np.random.default_rng(1).normal(size=(60, 3))


def globe():
    found = Globe(title="Europe")
    found.add_land(resolution="110m")
    found.add_graticule(30)
    found.add_coastlines(resolution="110m")
    found.add_points([[10, 50], [0, 20]])
    found.add_labels([[10, 50]], ["Ulm & 'Neu-Ulm' <2>"])
    return found


PAGES = {
    "plane": lambda: diagram_page(PlanarVoronoi(POINTS[:, :2])),
    "sphere": lambda: diagram_page(SphericalVoronoi(POINTS), view=(10, 48)),
    "globe": lambda: globe().page(fisheye((10, 48), magnification=4.0), width=200),
    "dark": lambda: globe().page(None, View(10.0, 20.0), width=200, style="dark"),
}


def shown(path, size=SIZE):
    """What librsvg makes of a file, (h, size, 3), on white."""
    command = ["rsvg-convert", "--width", str(size), "--background-color", "white", str(path)]
    ran = subprocess.run(command, capture_output=True, check=True, timeout=60)
    assert ran.stderr == b""
    return np.asarray(Image.open(BytesIO(ran.stdout)).convert("RGB")).astype(float)


def in_blocks(picture, block=BLOCK):
    """Means over squares of pixels: smoothing of edges evens out."""
    rows, columns = (side // block for side in picture.shape[:2])
    cut = picture[: rows * block, : columns * block].reshape(rows, block, columns, block, -1)
    return cut.mean(axis=(1, 3))


def apart(ours, theirs, block=BLOCK):
    """By how much the means of blocks differ, in the channel where it is most."""
    assert abs(len(theirs) - len(ours)) <= 1  # librsvg rounds a height up
    rows = min(len(theirs), len(ours))
    return np.abs(in_blocks(theirs[:rows], block) - in_blocks(ours[:rows], block)).max(axis=2)


@pytest.mark.parametrize("name", PAGES)
def test_librsvg_shows_our_picture(tmp_path, name):
    """Lines, fills, gradients and clips; type apart, which is the machine's own there."""
    page = PAGES[name]()
    theirs, ours = shown(page.save(tmp_path / "page.svg", text=False)), page.pixels(size=SIZE, text=False).astype(float)
    off = apart(ours, theirs)
    assert off.max() < 16  # without the shading of the ball 46
    assert off.mean() < 1


@pytest.mark.parametrize("name", ["globe", "dark"])
def test_librsvg_writes_titles_and_labels(tmp_path, name):
    """Where we do, give or take the width of another font."""
    page = PAGES[name]()
    written = [shown(page.save(tmp_path / f"{text}.svg", text=text)) for text in (True, False)]
    ours = [page.pixels(size=SIZE, text=text).astype(float) for text in (True, False)]
    their_ink, our_ink = (np.abs(with_type - without).max(axis=2) > 60 for with_type, without in (written, ours))
    assert 0.6 < their_ink.sum() / our_ink.sum() < 1.6
    (rows, columns), (our_rows, our_columns) = np.nonzero(their_ink), np.nonzero(our_ink)
    assert abs(rows.min() - our_rows.min()) < 8
    assert abs(rows.max() - our_rows.max()) < 8
    assert abs(columns.mean() - our_columns.mean()) < 20  # the label of 130 pixels may be a quarter longer or shorter
