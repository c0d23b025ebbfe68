"""Pictures written some rows at a time: the same bits as drawn at once, any size, whole or not at all."""

import itertools
from dataclasses import replace

import imageio.v3 as iio
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from stereodel.drawing import Label, Page, Scene, View
from stereodel.drawing.page import Dots, Fill, Polygons, Polylines, Stroke
from stereodel.drawing.page.style import BLACK, BLUE, VERMILION, with_opacity
from stereodel.drawing.scene.space_curves import CircleArc
from stereodel.render import gl, pixel_rows
from stereodel.render import save as saving
from stereodel.render.figure import Figure
from stereodel.render.gl import Window
from stereodel.render.pixel_rows import LabelLayer, PixelDigest, labelled, pixel_hash
from stereodel.render.tessellation import Batch, Batches, triangulate
from stereodel.render.vector import agg
from stereodel.sphere import SphereCircle
from tests.render.test_pages import box
from tests.tiers import by_day


def globe_page():
    """A lit ball with see-through regions and lines, type in several sizes, also beyond the edge."""
    rng = np.random.default_rng(5)
    scene = Scene()
    scene.add_cap(SphereCircle([0.9, 0.2, 0.4], 0.7), name="accent1", color=with_opacity(BLUE, 0.4))
    scene.add_arcs([CircleArc.great(*pair) for pair in rng.normal(size=(30, 2, 3))], name="delaunay")
    lines = Polylines(rng.uniform(-1.4, 1.4, (300, 2)), np.array([0, 100, 300]), with_opacity(VERMILION, 0.3), 2.0, "x")
    texts = (
        Label(r"$\frac{a}{b}\,S = 4$", (0.0, 0.3), size=30.0),
        Label("upside down", (0.1, -0.4), rotation=150.0, size=20.0, color=with_opacity(BLUE, 0.5)),
        Label("over the edge", (1.2, 1.19), size=25.0),
        Label("small", (-0.5, -0.7), size=4.0, offset=(0.3, 0.7)),
    )
    dots = Dots(rng.uniform(-1.2, 1.2, (20, 2)), 5.0, BLACK, rim_width=1.0)
    return Page((-1.2, 1.2, -1.2, 1.2), (*scene.layout(View(0, 10)), lines, dots, *texts), width=300.0)


@pytest.fixture(params=by_day([64, 256, 4096], 256))
def small_windows(request, monkeypatch):
    monkeypatch.setattr(gl, "COLUMNS", request.param)
    monkeypatch.setattr(gl, "BAND", {64: 32, 256: 128, 4096: 64}[request.param])


@pytest.mark.parametrize("size", by_day([1, 33, 200, 301], 1, 200))
def test_a_file_has_the_bits_of_the_picture_drawn_at_once(small_windows, tmp_path, size):
    page = globe_page()
    path = page.save(tmp_path / "globe.png", size=size)
    assert path == tmp_path / "globe.png"
    assert np.array_equal(iio.imread(path), page.pixels(size=size))
    bare = page.save(str(tmp_path / "bare.png"), size=size, text=False)
    assert np.array_equal(iio.imread(bare), page.pixels(size=size, text=False))
    assert np.array_equal(page.pixels(size=size, text=False), page.without_labels().pixels(size=size))


def test_a_window_needs_the_triangles_that_touch_it_and_no_other(small_windows):
    page, size = globe_page(), (600, 600)
    pieces = triangulate(page, *size)
    everything = pieces.within(Window(-9999, -9999, 29999, 29999))
    chosen, all_of_them = (
        np.concatenate(list(gl.bands(part, *size))) for part in (pieces.within, lambda window: everything)
    )
    assert np.array_equal(chosen, all_of_them)
    assert len(pieces.within(Window(0, 0, 64, 64)).faces) < len(everything.faces) / 10


def test_windows_leave_no_seam(monkeypatch):
    page = globe_page()
    whole = page.pixels(size=150)
    ground = Page(page.extent, (Fill((box(*page.extent),), with_opacity(BLUE, 0.5)),))
    even = ground.pixels(size=100)
    monkeypatch.setattr(gl, "COLUMNS", 128)
    monkeypatch.setattr(gl, "BAND", 96)
    assert np.array_equal(ground.pixels(size=100), even)
    # OpenGL cuts triangles at the edges of windows and rounds the new corners: one sample here and there.
    apart = np.abs(page.pixels(size=150).astype(int) - whole)
    assert (apart.max(axis=-1) > 0).mean() < 0.01
    assert (apart.max(axis=-1) > 48).mean() < 1e-4


@pytest.mark.parametrize("far", [(8192, 0), (12000, 30), (3 * 8192 + 5, 8192), (90_001, 60_007)])
def test_pixels_far_from_the_corner_are_those_near_it(rng, far):
    corners, colors = rng.uniform(2, 38, (60, 3, 2)), np.repeat(rng.integers(0, 256, (60, 1, 4)) / 255, 3, axis=1)
    pieces, moved = (
        Batches(enumerate(Batch(c[None] + move, k[None]) for c, k in zip(corners, colors, strict=True)))
        for move in ((0, 0), far)
    )
    near, away = Window(0, 0, 40, 40), Window(*far, 40, 40)
    door = gl.context()
    expected = door.draw(pieces.within(near), near, (1.0, 1.0, 1.0, 1.0))
    assert len(np.unique(expected)) > 50
    assert np.array_equal(door.draw(moved.within(away), away, (1.0, 1.0, 1.0, 1.0)), expected)


@pytest.mark.parametrize("cuts", [(1,), (100, 101, 150), (64, 128, 192, 256)])
@pytest.mark.parametrize(("halo", "off"), [(0.0, 0), (1.5, 1)])
def test_labels_are_those_of_matplotlib(cuts, halo, off):
    """In any rows; of halos, the roundings of curves by one level. Type in the wrong rows would be off by 255."""
    page = globe_page()
    page = replace(page, items=tuple(replace(label, halo=halo) for label in page.labels))
    layer = LabelLayer(page, 297)
    whole = layer.rows(0, layer.height).astype(int)
    ends = [0, *cuts, layer.height]
    parts = np.concatenate([layer.rows(*pair) for pair in itertools.pairwise(ends)])
    assert np.abs(parts - whole).max() <= off
    assert (whole[..., 3] > 0).mean() > 0.01
    with agg.matplotlib_settings():
        figure = agg.drawn(page, *agg.pixel_grid(page, 297))
        figure.set_facecolor((1.0, 1.0, 1.0, 0.0))
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    assert np.array_equal(whole, canvas.buffer_rgba())


def test_a_stage_hands_rows_on_as_they_come():
    """Nothing is held back or asked for before it is wanted."""
    page, asked = globe_page(), []
    picture = page.pixels(size=100, text=False)

    def drawn():
        for top in range(0, 100, 30):
            asked.append(top)
            yield picture[top : top + 30]

    digest = PixelDigest(picture.shape)
    stages = labelled(digest.passed(drawn()), page, 100)
    assert asked == []
    first = next(stages)
    assert asked == [0]
    assert np.array_equal(np.concatenate([first, *stages]), page.pixels(size=100))
    assert str(digest) == pixel_hash(picture)


def test_agg_draws_large_pictures_in_parts(monkeypatch):
    page = replace(globe_page(), items=tuple(i for i in globe_page().items if isinstance(i, (Stroke, Polylines, Dots))))
    whole = page.pixels(size=300, renderer="agg")
    monkeypatch.setattr(pixel_rows, "AT_ONCE", 300 * 70)
    assert [len(part) for part in pixel_rows.agg_rows(page, 300)] == [70, 70, 70, 70, 20]
    apart = np.abs(page.pixels(size=300, renderer="agg").astype(int) - whole)
    # Agg cuts lines at the edge of its canvas and rounds the new corners to a 256th of a pixel.
    assert (apart > 0).mean() < 0.01
    assert (apart > 32).mean() < 1e-4


@pytest.mark.parametrize("renderer", ["gl", "agg"])
def test_a_figure_is_written_in_rows_and_knows_its_hash(small_windows, monkeypatch, tmp_path, renderer):
    monkeypatch.setattr(pixel_rows, "AT_ONCE", 150 * 40)
    figure = Figure("globe", dict, lambda g: globe_page(), renderer=renderer)
    record = figure.save(tmp_path, size=150)
    assert np.array_equal(iio.imread(tmp_path / "globe.png"), figure.pixels(size=150))
    assert record["pixel_hash"] == pixel_hash(figure.pixels(size=150, text=False))
    assert record["size"] == 150


@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError])
def test_a_failure_on_the_way_leaves_no_half_file(small_windows, tmp_path, monkeypatch, error):
    path = tmp_path / "globe.png"
    path.write_bytes(b"the picture of yesterday")
    calls = []

    def fails(layer, part, top=0):
        calls.append(top)
        if top:
            raise error
        return part

    monkeypatch.setattr(LabelLayer, "over", fails)
    monkeypatch.setattr(gl, "BAND", 64)
    with pytest.raises(error):
        globe_page().save(path, size=100)
    assert calls == [0, 32]
    assert path.read_bytes() == b"the picture of yesterday"
    assert [file.name for file in tmp_path.iterdir()] == ["globe.png"]


def test_pictures_in_vector_files_are_no_finer_than_print(monkeypatch):
    triangle = np.array([[-0.5, -0.5], [0.5, -0.5], [0.0, 0.5], [-0.5, -0.5]])
    colors = np.linspace(0, 1, 400).reshape(100, 4)
    many = Polygons(np.tile(triangle, (100, 1)), np.arange(0, 401, 4), np.arange(100), colors)
    page = Page((-1.0, 1.0, -1.0, 1.0), (many,), width=7.2)
    assert [picture.shape for picture in saving.region_pictures(page, 20)] == [(20, 20, 3)]
    assert [picture.shape for picture in saving.region_pictures(page, 9000)] == [(60, 60, 3)]


@pytest.mark.parametrize(
    ("name", "options", "error", "message"),
    [
        ("globe.jpg", {}, ValueError, "path must end in .png, .svg or .pdf, got 'globe.jpg'"),
        ("globe", {}, ValueError, "path must end in"),
        ("globe.png", {"size": 0}, ValueError, "size is 0, but must be at least 1"),
        ("globe.png", {"size": 65_536}, ValueError, "size is 65536, but must be at most 65535"),
        ("globe.svg", {"size": -4}, ValueError, "size is -4"),
        ("globe.png", {"size": 10.5}, TypeError, "size must be one integer"),
        *((f"no/folder/globe.{kind}", {"size": 10}, FileNotFoundError, "folder") for kind in ("png", "svg")),
        ("globe.png", {"renderer": "svg"}, ValueError, "renderer is 'svg', but must be one of 'gl', 'agg'"),
    ],
)
def test_what_cannot_be_written_is_explained(tmp_path, name, options, error, message):
    with pytest.raises(error, match=message):
        globe_page().save(tmp_path / name, **options)
    assert list(tmp_path.iterdir()) == []


def test_without_opengl_the_error_says_what_needs_none(tmp_path, monkeypatch):
    monkeypatch.setattr(gl, "context", gl.context.__wrapped__)
    monkeypatch.setattr(gl, "can_open", lambda platform: False)
    for variable in (gl.VARIABLE, "PYOPENGL_PLATFORM"):
        monkeypatch.delenv(variable, raising=False)
    page = globe_page()
    with pytest.raises(OSError, match=r"install it.*\.svg and \.pdf of lines and plain fills need no OpenGL"):
        page.save(tmp_path / "globe.png", size=10)
    assert list(tmp_path.iterdir()) == []
    assert page.save(tmp_path / "globe.PDF").read_bytes()[:5] == b"%PDF-"
    page.save(tmp_path / "globe.png", size=10, renderer="agg")
    with pytest.raises(gl.OpenGLError, match="neither OSMesa nor EGL"):
        page.pixels(size=10)
