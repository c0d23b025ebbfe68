"""Rasters on pages: pixel for pixel through OpenGL, in painter's order, and as pictures in vector files."""

import base64
import io
import re
from functools import partial

import numpy as np
import pytest
from PIL import Image as Pillow

from stereodel import MoebiusMap, fisheye
from stereodel.curves.chart import Chart
from stereodel.curves.view import StereographicView, View
from stereodel.drawing.page import Fill, Page, Picture
from stereodel.globe import Globe, Raster
from stereodel.globe.layers import Image
from stereodel.globe.raster import RasterOnDisc
from stereodel.render.pixel_rows import SUPERSAMPLING
from stereodel.render.save import save_vector
from tests.globe.supersampling import noise, zone_plate

render, rasterize = Page.pixels, partial(Page.pixels, renderer="agg")

LENS = fisheye((10.0, 50.0), magnification=3.0)
COLOURED = Raster(np.dstack([zone_plate(128), noise(128), np.full((128, 256), 80, np.uint8)]))
VIEW = View(20, 40)
BLUE = (0.0, 0.0, 1.0, 1.0)


def page_of(*layers, lens=LENS, view=VIEW, background=BLUE):
    """A globe without limb, of the radius 0.9 on a page of 2 by 2."""
    chart = Chart(lens, view, (1.0, 1.0), 0.9)
    items = tuple(item for layer in layers for item in layer.lay(chart))
    return Page((0.0, 2.0, 0.0, 2.0), items, width=144.0, background=background)


def drawn(page, size):
    """What the painter of the first picture gives, averaged as the renderer averages."""
    fine = SUPERSAMPLING * size
    picture = next(item for item in page.items if isinstance(item, Picture))
    large = picture.painter.paint((0.0, 2.0, 2 / fine, 2 / fine), (fine, fine)).astype(float)
    return large.reshape(size, SUPERSAMPLING, size, SUPERSAMPLING, 4).mean(axis=(1, 3))


def distance(size):
    """Of pixels from the middle of the page."""
    x = (np.arange(size) + 0.5) * 2 / size - 1
    return np.hypot(x, x[:, None])


@pytest.mark.parametrize("view", [View(20, 40), StereographicView(20, 40, angular_radius=120)])
def test_opengl_draws_the_painters_pixels(view):
    """Over the edges of the windows in which a large picture is drawn, too."""
    size = 700
    page = page_of(Image(COLOURED, 1.0, "raster"), view=view)
    found, expected = render(page, size=size), drawn(page, size)[..., :3]
    inside = distance(size) < 0.9 - 2 / size
    assert np.abs(found - expected)[inside].max() <= 1
    assert (found[distance(size) > 0.9 + 2 / size] == (0, 0, 255)).all()


def test_the_edge_is_soft():
    size = 200
    found = render(page_of(Image(Raster(np.full((8, 16), 255, np.uint8)), 1.0, "raster")), size=size)[..., 0]
    edge = np.abs(distance(size) - 0.9) < 1 / size
    assert np.unique(found[edge]).size > 8


def test_what_is_transparent_shows_what_lies_below():
    texels = np.zeros((90, 180, 4), dtype=np.uint8)
    texels[:, 90:] = 0, 255, 0, 128
    page = page_of(Image(Raster(texels), 0.5, "raster"), lens=MoebiusMap.identity(), view=View(0, 0))
    for found in (render(page, size=100), rasterize(page, size=100)):
        assert found[50, 25].tolist() == [0, 0, 255]
        assert found[50, 75] == pytest.approx([0, 64, 191], abs=2)


@pytest.mark.parametrize("draw", [render, rasterize])
def test_painters_order(draw):
    page = page_of(Image(COLOURED, 1.0, "raster"))
    (picture,) = page.items
    red = Fill(picture.outline, (1.0, 0.0, 0.0, 1.0))
    below = Page(page.extent, (red, picture), 144.0)
    above = Page(page.extent, (red, picture, Fill(picture.outline, (1.0, 0.0, 0.0, 0.5))), 144.0)
    inside = distance(100) < 0.85
    plain, under, over = (draw(p, size=100).astype(float)[inside] for p in (page, below, above))
    assert np.array_equal(plain, under)
    assert np.abs(over - (plain + np.array([255, 0, 0])) / 2).max() <= 1.5


def test_two_pictures_on_one_page():
    half = np.zeros((90, 180, 4), dtype=np.uint8)
    half[:, 90:] = 255, 255, 0, 255
    page = page_of(
        Image(COLOURED, 1.0, "raster"), Image(Raster(half), 1.0, "half"), lens=MoebiusMap.identity(), view=View(0, 0)
    )
    found = render(page, size=100)
    assert found[50, 75].tolist() == [255, 255, 0]
    assert np.abs(found[50, 25] - drawn(page, 100)[50, 25, :3]).max() <= 1


def test_agg_agrees():
    page = page_of(Image(COLOURED, 1.0, "raster"))
    inside = distance(300) < 0.88
    apart = np.abs(render(page, size=300).astype(float) - rasterize(page, size=300))[inside]
    # Agg draws each pixel once, OpenGL four times.
    assert apart.mean() < 4


@pytest.mark.parametrize("kind", ["svg", "pdf"])
def test_vector_files_hold_one_picture_cut_along_the_limb(tmp_path, kind):
    path = save_vector(page_of(Image(COLOURED, 1.0, "raster")), tmp_path / f"globe.{kind}")
    data = path.read_bytes()
    if kind == "svg":
        assert data.count(b"<image") == 1
        assert b'id="raster"' in data
        assert re.search(rb"clip-path=\"url\(#", data)
        embedded = re.search(rb"data:image/png;base64,([^\"]*)", data).group(1)
        # Two inches at 300 dpi, of which the disc takes nine tenths.
        assert Pillow.open(io.BytesIO(base64.b64decode(embedded))).size == (540, 540)
    else:
        assert data.count(b"/Subtype /Image") >= 1
    assert path.read_bytes() == save_vector(page_of(Image(COLOURED, 1.0, "raster")), path).read_bytes()


def test_painted_where_it_lies_on_the_page():
    """Moved and scaled on the page, the same pixels."""
    plain = RasterOnDisc(COLOURED, Chart(LENS, View(0, 0)))
    moved = RasterOnDisc(COLOURED, Chart(LENS, View(0, 0), (8.0, -4.0), 4.0))
    found = moved.paint((4.0, 0.0, 1 / 16, 1 / 16), (128, 128))
    assert np.array_equal(found, plain.paint((-1.0, 1.0, 1 / 64, 1 / 64), (128, 128)))


def test_files_have_the_latitude_of_the_globe(tmp_path):
    Pillow.fromarray(COLOURED.pixels).save(tmp_path / "map.png")
    for latitude in ("spherical", "geodetic"):
        globe = Globe(latitude=latitude)
        globe.add_raster(tmp_path / "map.png")
        globe.add_raster(COLOURED.pixels)
        globe.add_raster(COLOURED)
        kinds = [item.painter.raster.latitude for item in globe.page(LENS).items if isinstance(item, Picture)]
        assert kinds == [latitude, latitude, "spherical"]
