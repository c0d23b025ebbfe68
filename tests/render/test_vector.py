"""Vector files: true curves, exact size, the same bytes every time."""

import re
import xml.etree.ElementTree as ET
from functools import partial

import matplotlib as mpl
import numpy as np
import pytest

from stereodel.drawing.page import Dots, Fill, Label, Page, Stroke
from stereodel.drawing.scene import Scene
from stereodel.drawing.style import BLACK
from stereodel.drawing.view import View
from stereodel.render.rows import agg_rows
from stereodel.render.sizes import pixel_height
from stereodel.render.text import LabelLayer
from stereodel.render.vector import save_vector
from stereodel.sphere import SphereCircle, graticule

rasterize = partial(Page.pixels, renderer="agg")

SVG = "{http://www.w3.org/2000/svg}"


def globe():
    scene = Scene(style="glass")
    scene.add_arcs(graticule(30), name="graticule")
    scene.add_cap(SphereCircle.around((20, 10), 40), name="small_bubble")
    scene.add_points([[1, 0, 0]], name="sites")
    scene.add_label((0, 0, 1), r"$\varphi$ north", offset=(0, 6))
    return Page((-1.1, 1.1, -1.1, 1.2), scene.layout(View(20, 35)), width=200.0)


@pytest.mark.parametrize("kind", ["svg", "pdf"])
def test_bytes_are_the_same_twice_and_under_any_user_settings(tmp_path, kind):
    first = save_vector(globe(), tmp_path / f"a.{kind}").read_bytes()
    with mpl.rc_context({"font.size": 30, "svg.fonttype": "none", "lines.linewidth": 9, "pdf.fonttype": 3}):
        again = save_vector(globe(), tmp_path / f"b.{kind}").read_bytes()
    assert first == again
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"a.{kind}", f"b.{kind}"]
    for word in (b"Date", b"matplotlib.org", b"/Producer", b"<dc:date"):
        assert word not in first


def test_svg_has_the_exact_size_and_a_group_for_each_name(tmp_path):
    root = ET.parse(save_vector(globe(), tmp_path / "globe.svg")).getroot()
    assert root.get("width") == "200pt"
    assert float(root.get("height").removesuffix("pt")) == pytest.approx(globe().height, abs=1e-4)
    names = [group.get("id") for group in root.iter(f"{SVG}g") if group.get("id")]
    assert len(names) == len(set(names))
    assert {"graticule", "graticule-2", "ball", "limb", "small_bubble", "sites", "label"} <= set(names)


def test_pdf_has_the_exact_size_and_text_that_can_be_searched(tmp_path):
    with mpl.rc_context({"pdf.compression": 0}):
        content = save_vector(globe(), tmp_path / "globe.pdf").read_bytes()
    width, height = map(float, re.search(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", content).groups())
    assert (width, height) == pytest.approx((200.0, globe().height), abs=1e-3)
    assert b"/Type0" in content
    assert b"STIXGeneral" in content


def test_curves_stay_curves(tmp_path):
    """A circle is twelve cubics; the one straight piece, of no length, is how matplotlib closes it."""
    scene = Scene(style="none")
    scene.add_circles([SphereCircle.around((0, 90), 30)])
    page = Page((-1, 1, -1, 1), scene.layout(View(0, 60)))
    root = ET.parse(save_vector(page, tmp_path / "circle.svg")).getroot()
    [group] = [g for g in root.iter(f"{SVG}g") if g.get("id") == "circle"]
    [path] = group.iter(f"{SVG}path")
    assert path.get("d").count("C") == 12
    assert path.get("d").count("L") <= 1


def test_endings_other_than_svg_and_pdf_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"\.svg or \.pdf"):
        save_vector(globe(), tmp_path / "globe.png")


def test_a_failed_write_leaves_nothing(tmp_path):
    with pytest.raises(OSError, match="nowhere"):
        save_vector(globe(), tmp_path / "nowhere" / "globe.svg")
    assert list(tmp_path.iterdir()) == []


def square(low, high):
    corners = np.array([(low, low), (high, low), (high, high), (low, high), (low, low)], dtype=float)
    return np.linspace(corners[:-1], corners[1:], 4, axis=1)


@pytest.mark.parametrize("turn", [slice(None), slice(None, None, -1)])
def test_fills_follow_the_even_odd_rule_whatever_the_sense_of_the_runs(turn):
    runs = (square(0, 10), square(2, 8)[turn, turn], square(4, 6))
    picture = rasterize(Page((0, 10, 0, 10), (Fill(runs, BLACK),), width=72.0), size=100)
    assert [int(picture[50, x, 0]) for x in (10, 30, 50)] == [0, 255, 0]


def test_dots_have_their_radius_in_points():
    page = Page((0, 4, 0, 4), (Dots(np.array([[2.0, 2.0]]), 18.0, BLACK, (1.0, 0.0, 0.0, 1.0), 6.0),), width=72.0)
    row = rasterize(page, size=72)[36].astype(int)
    assert row[:, 1] == pytest.approx([255] * 18 + [0] * 36 + [255] * 18, abs=8)
    assert row[:, 0] == pytest.approx([255] * 24 + [0] * 24 + [255] * 24, abs=8)


def test_strokes_have_their_width_in_points():
    line = np.linspace([0.0, 2.0], [4.0, 2.0], 4)[None]
    column = rasterize(Page((0, 4, 0, 4), (Stroke(line, BLACK, 6.0),), width=72.0), size=72)[:, 36, 0]
    assert np.flatnonzero(column == 0).tolist() == list(range(33, 39))


@pytest.mark.parametrize("size", [1, 7, 199, 2008])
def test_pixel_sizes_are_whole_and_agree(size):
    page = Page((0, 3, 0, 2), (Label("x", (1, 1)),), width=481.89)
    height = pixel_height(page, size)
    assert rasterize(page, size=size).shape == (height, size, 3)
    assert LabelLayer(page, size).rows().shape == (height, size, 4)


def test_the_label_layer_holds_the_labels_alone():
    page = globe()
    bare, (full,), layer = rasterize(page, size=400, text=False), agg_rows(page, 400), LabelLayer(page, 400)
    ink = layer.rows()[..., 3]
    touched = np.any(bare != full, axis=2)
    assert touched.any()
    assert not (touched & (ink == 0)).any()
    assert np.abs(layer.over(bare).astype(int) - full).max() <= 3
    assert np.array_equal(layer.over(bare), rasterize(page, size=400))
    assert LabelLayer(page.without_labels(), 400).over(bare) is bare


def test_labels_are_placed_and_aligned():
    page = Page((0, 10, 0, 10), (Label("MM", (5, 5), offset=(10, 0), align="left", valign="bottom"),), width=100.0)
    rows, columns = np.nonzero(LabelLayer(page, 100).rows()[..., 3])
    assert 60 <= columns.min() <= 62
    assert 46 <= rows.max() <= 50
