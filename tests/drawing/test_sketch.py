"""Sketches hold what is asked for, and legends its meaning, in points, whatever the unit of the page."""

from dataclasses import replace

import numpy as np
import pytest

from stereodel.drawing import DotStyle, LineStyle, Scene, Sketch, View, styled, with_legend
from stereodel.drawing.page import Dots, Fill, Label, Page, Polygons, Polylines, Stroke
from stereodel.drawing.page.style import LABEL_SIZE, line
from stereodel.drawing.scene.legend import ROW, SAMPLE
from stereodel.drawing.scene.sketch import GAP, HEAD, TICK, arc_path, arc_through
from tests.figures.scripts import path_points
from tests.refused import refused


@pytest.mark.parametrize(("start", "stop"), [(0.0, 360.0), (-90.0, 20.0), (170.0, 200.0)])
def test_arcs_lie_on_their_circle(start, stop):
    path = arc_path((2.0, -1.0), 3.0, start, stop)
    points = path_points(path) - [2.0, -1.0]
    assert np.allclose(np.hypot(*points.T), 3.0, rtol=4e-7)
    ends = 3.0 * np.array([[np.cos(a), np.sin(a)] for a in np.radians([start, stop])])
    assert np.allclose(points[[0, -1]], ends, atol=1e-14)
    assert np.array_equal(path[1:, 0], path[:-1, 3])


@pytest.mark.parametrize("middle", [(2.0, 1.5), (2.0, -0.1), (-1.0, 5.0), (1.0, 0.0)])
def test_an_arc_through_three_points(middle):
    """On the circle through them, from one end to the other past the middle; straight where they are on a line."""
    a, b = np.array([-1.0, 0.0]), np.array([3.0, 0.0])
    path = path_points(arc_through(a, middle, b), 129)
    assert path[0] == pytest.approx(a, abs=1e-12)
    assert path[-1] == pytest.approx(b, abs=1e-12)
    assert np.linalg.norm(path - middle, axis=1).min() < 0.05
    if middle[1] == 0:
        assert (path[:, 1] == 0).all()
    else:
        rise = ((middle[0] - 1) ** 2 + middle[1] ** 2 - 4) / (2 * middle[1])  # of the centre above the chord
        assert np.hypot(path[:, 0] - 1, path[:, 1] - rise) == pytest.approx(np.hypot(2, rise), rel=1e-6)


def test_graphs_of_cubics_are_exact_and_of_parabolas_without_slopes():
    x = np.array([-1.0, 0.5, 1.0, 3.0])
    for power, slopes in ((3, [3 * x**2 - 1]), (2, [])):
        (stroke,) = Sketch().add_graph(x, x**power - x, *slopes, name="accent1").page((-1, 3, -2, 24)).items
        px, py = path_points(stroke.path).T
        assert np.allclose(py, px**power - px, atol=1e-13)


def test_closed_polyline_returns_to_its_start():
    corners = np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]])
    (stroke,) = Sketch().add_polyline(corners, name="frame", closed=True).page((0, 2, 0, 1)).items
    assert stroke.closed
    assert np.array_equal(stroke.path[:, 0], corners)
    assert np.array_equal(stroke.path[-1, 3], corners[0])


def test_angle_runs_counterclockwise_with_its_name_on_the_bisector():
    arc, label = Sketch().add_angle((0, 0), (0, -1), (1, 0), 0.5, "x", name="axis", gap=10).page((-1, 1, -1, 1)).items
    assert np.allclose(arc.path[0, 0], [0, -0.5])
    assert np.allclose(arc.path[-1, 3], [0.5, 0])
    assert np.allclose(label.anchor, 0.5 * np.array([1, -1]) / np.sqrt(2))
    assert np.allclose(label.offset, 10 * np.array([1, -1]) / np.sqrt(2))
    unnamed = Sketch().add_angle((0, 0), (1, 0), (0, 1), 0.5, "", name="axis")
    assert not unnamed.add_dimension((0, 0), (1, 0), "", name="frame").page((-1, 1, -1, 1)).labels


@pytest.mark.parametrize(
    ("a", "b", "rotation", "valign", "left"),
    [
        ((0, 0), (2, 0), 0, "bottom", (0, 1)),
        ((2, 0), (0, 0), 0, "top", (0, -1)),
        ((0, 0), (0, 2), 90, "bottom", (-1, 0)),
        ((0, 2), (0, 0), 90, "top", (1, 0)),
        ((0, 0), (-1, -1), 45, "top", np.array([1, -1]) / np.sqrt(2)),
    ],
)
def test_a_dimension_has_ticks_in_points_and_its_name_on_the_left(a, b, rotation, valign, left):
    page = Sketch().add_dimension(a, b, "d", name="frame", size=7.0).page((-4, 4, -2, 3), width=200.0)
    shaft, *ticks, label = page.items
    a, b, left = (np.array(value, dtype=float) for value in (a, b, left))
    assert np.allclose(shaft.path[0, [0, 3]], [a, b])
    reach = TICK / 25.0 * left
    assert np.allclose([tick.path[0, [0, 3]] for tick in ticks], [[a - reach, a + reach], [b - reach, b + reach]])
    assert np.allclose(label.anchor, (a + b) / 2)
    assert np.allclose(label.offset, GAP * left)
    assert (label.rotation, label.valign, label.align, label.size) == (pytest.approx(rotation), valign, "center", 7.0)


def test_an_arrow_ends_in_its_tip_with_a_head_in_points():
    shaft, head = Sketch().add_arrow((1, 1), (1, 3), name="axis").page((0, 4, 0, 4), width=40.0).items
    length, half = np.array(HEAD) / 10.0
    assert np.allclose(shaft.path[0, [0, 3]], [[1, 1], [1, 3 - length]])
    corners = head.paths[0][:, 0]
    assert np.allclose(corners, [[1, 3], [1 - half, 3 - length], [1 + half, 3 - length]])
    assert np.array_equal(head.paths[0][-1, 3], corners[0])
    assert head.color == shaft.color == line("axis").color


def test_axes_have_their_numbers_where_they_belong():
    sketch = Sketch().add_axes((2, 1), 4.0, 3.0, {0: "0", 30: "a", 90: "b"}, {-1.0: "c", 1.0: "d"}, name="axis", size=8)
    page = sketch.page((0, 10, 0, 5), width=500.0)
    lines, *ticks = [item for item in page.items if isinstance(item, Stroke)]
    assert np.allclose(lines.path[:, 0], [[2, 4], [2, 1]])
    assert np.allclose(lines.path[-1, 3], [6, 1])
    feet = np.array([[2, 1], [2 + 4 / 3, 1], [6, 1], [2, 1], [2, 4]])
    out = TICK / 50.0 * np.array([[0, -1], [0, -1], [0, -1], [-1, 0], [-1, 0]])
    assert np.allclose([tick.path[0, [0, 3]] for tick in ticks], np.stack([feet, feet + out], axis=1))
    assert np.allclose([label.anchor for label in page.labels], feet)
    assert [label.text for label in page.labels] == ["0", "a", "b", "c", "d"]
    assert np.allclose([label.offset for label in page.labels], (GAP + TICK) * np.sign(out))
    assert [(label.align, label.valign) for label in page.labels[2:4]] == [("center", "top"), ("right", "center")]
    assert {label.size for label in page.labels} == {8}


def test_a_globe_on_a_sketch_is_what_its_scene_lays_out():
    scene, view = Scene(), View(20, 30)
    scene.add_points([[1, 0, 0]], name="sites")
    page = Sketch().add_disc((0, 0), 1, name="ball").add_scene(scene, view, at=(3.0, 1.0), scale=0.5).page((0, 4, 0, 2))
    expected = scene.layout(view, at=(3.0, 1.0), scale=0.5)
    assert [item.name for item in page.items] == ["ball", *(item.name for item in expected)]
    dots = page.items[-1]
    assert np.allclose(dots.centers, [3.0, 1.0] + 0.5 * view.project([1, 0, 0]))
    assert np.array_equal(page.views, [view.matrix])


LINE, DASHES, DOT = LineStyle("red", 0.7), LineStyle("blue", 1.0, (3.0, 2.0)), DotStyle("green", 2.0, "black", 0.5)
ENTRIES = {"lines": LINE, "dashes": DASHES, "dots": DOT, "tint": "orange", "more": LINE}


@pytest.fixture(params=[1.0, 0.02])
def page(request):
    """A page 100 points wide and 50 high, in two units."""
    unit = request.param
    extent = (-1.0 * unit, 3.0 * unit, 5.0 * unit, 7.0 * unit)
    return Page(
        extent, (Label("picture", (0.0, 0.0)),), width=100.0, background=(0.9, 0.9, 1.0, 1.0), views=(np.eye(3),)
    )


def in_points(page, xy):
    """From the upper left corner of a page to the right and down."""
    left, _, _, top = page.extent
    return (np.asarray(xy) - [left, top]) * page.points_per_unit * [1, -1]


def test_the_picture_stays_and_the_page_grows_downwards_by_its_rows(page):
    grown = with_legend(page, ENTRIES, columns=2)
    assert grown.items[0] is page.items[0]
    assert (grown.width, grown.background, grown.views) == (page.width, page.background, page.views)
    assert grown.points_per_unit == pytest.approx(page.points_per_unit)
    assert np.array_equal(np.delete(grown.extent, 2), np.delete(page.extent, 2))
    assert grown.height == pytest.approx(50 + LABEL_SIZE * ROW * 3.5)


def test_entries_are_read_row_by_row(page):
    grown = with_legend(page, ENTRIES, columns=2, indent=8.0)
    words = grown.labels[1:]
    assert [label.text for label in words] == list(ENTRIES)
    row = LABEL_SIZE * ROW
    expected = [(8 + 42 * column, 50 + row * (down + 1)) for down in range(3) for column in range(2)][:5]
    assert np.allclose([in_points(grown, label.anchor) for label in words], expected)
    assert {label.offset for label in words} == {(SAMPLE[0] + 5.0, 0.0)}
    assert {(label.align, label.valign, label.size) for label in words} == {("left", "center", LABEL_SIZE)}


def test_samples_look_as_what_they_stand_for(page):
    grown = with_legend(page, ENTRIES)
    line, dashes, dots, tint, _ = [item for item in grown.items if not isinstance(item, Label)]
    assert (line.color, line.width, line.dash) == (LINE.color, LINE.width, None)
    assert (dashes.color, dashes.dash) == (DASHES.color, DASHES.dash)
    assert (dots.radius, dots.color, dots.rim, dots.rim_width) == (DOT.radius, DOT.color, DOT.rim, DOT.rim_width)
    assert tint.color == pytest.approx((1.0, 165 / 255, 0.0, 1.0))
    # All of one length, at the height of their words.
    length, height = SAMPLE
    anchors = [in_points(grown, label.anchor) for label in grown.labels[1:]]
    assert np.allclose(in_points(grown, line.path[0, [0, 3]]), [anchors[0], anchors[0] + [length, 0]])
    assert np.allclose(in_points(grown, dots.centers), [anchors[2] + [length / 2, 0]])
    corners = in_points(grown, tint.paths[0][:, 0])
    assert np.allclose(
        [corners.min(axis=0), corners.max(axis=0)], anchors[3] + [[0, -height / 2], [length, height / 2]]
    )


test_errors_say_what_is_wrong = refused(
    (lambda: Sketch().add_segment((0, 0), (1, 1), name="nothing"), "name 'nothing' has no line style"),
    (lambda: Sketch().page((1, 1, 0, 1)), r"extent\[1\] - extent\[0\]"),
    (lambda: Sketch().add_arrow((1, 2), (1, 2), name="axis"), r"a and b must be two points, got \(1, 2\) twice"),
    (lambda: Sketch().add_dimension((1, 2), (1, 2), "d", name="axis"), "a and b must be two points"),
    (lambda: Sketch().add_graph([0, 1], [0, 1], name="axis"), "x has 2 knots, but a parabola needs 3"),
    (lambda: with_legend(Page((0, 1, 0, 1)), ENTRIES, columns=0), "columns is 0, but must be at least 1"),
    (lambda: with_legend(Page((0, 1, 0, 1)), {"x": "no colour"}), "no colour"),
)


def test_samples_follow_what_they_explain_in_every_style(page, tmp_path):
    """They are named after what looks like them; what only resembles it, in width or in dashes, is another thing."""
    line = np.array([[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]])
    picture = (
        Stroke(line, LINE.color, LINE.width, name="coast"),
        Polylines(line[0], np.array([0, 4]), LINE.color, 2 * LINE.width, "roads"),
        Dots(line[0], DOT.radius, DOT.color, DOT.rim, DOT.rim_width, "sites"),
        Fill((line,), (1.0, 165 / 255, 0.0, 1.0), "land"),
        Polygons(line[0], np.array([0, 4]), np.array([0]), np.array([[0.0, 0.0, 1.0, 1.0]]), name="lakes"),
    )
    entries = ENTRIES | {"wide": LINE.scaled(2), "water": "blue"}
    told = with_legend(replace(page, items=picture), entries, columns=2)
    samples = {item.name: item for item in told.items[len(picture) :] if not isinstance(item, Label)}
    assert list(samples) == ["legend-coast", "legend", "legend-sites", "legend-land", "legend-roads", "legend-lakes"]
    file = tmp_path / "own.toml"
    file.write_text(
        "[lines]\ncoast = {color = 'lime', width = 3.0}\nroads = {width = 0.1}\n"
        "[dots.sites]\ncolor = 'red'\nradius = 1.0\n[fills]\nland = 'gold'\nlakes = 'navy'\n"
    )
    for styles in ((), ("dark",), (file,), ("dark", file)):
        items = {item.name: item for item in styled(told, *styles).items if not isinstance(item, Label)}
        for name in ("coast", "roads", "sites", "land", "lakes"):
            assert items[f"legend-{name}"]._look == items[name]._look, (styles, name)
    assert items["coast"]._look == LineStyle("lime", 3.0)
