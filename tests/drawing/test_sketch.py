"""Sketches: what is asked for is what the page holds."""

import numpy as np
import pytest

from stereodel.drawing import Scene, Sketch, View
from stereodel.drawing.page import Stroke
from stereodel.drawing.page.style import line
from stereodel.drawing.scene.sketch import GAP, HEAD, TICK, arc_path
from tests.figures.scripts import path_points


@pytest.mark.parametrize(("start", "stop"), [(0.0, 360.0), (-90.0, 20.0), (170.0, 200.0)])
def test_arcs_lie_on_their_circle(start, stop):
    path = arc_path((2.0, -1.0), 3.0, start, stop)
    points = path_points(path) - [2.0, -1.0]
    assert np.allclose(np.hypot(*points.T), 3.0, rtol=4e-7)
    ends = 3.0 * np.array([[np.cos(a), np.sin(a)] for a in np.radians([start, stop])])
    assert np.allclose(points[[0, -1]], ends, atol=1e-14)
    assert np.array_equal(path[1:, 0], path[:-1, 3])


def test_graph_of_a_cubic_is_exact():
    x = np.array([-1.0, 0.5, 2.0])
    (stroke,) = Sketch().add_graph(x, x**3 - x, 3 * x**2 - 1, name="accent1").page((-1, 2, -2, 6)).items
    px, py = path_points(stroke.path).T
    assert np.allclose(py, px**3 - px, atol=1e-14)


def test_graph_of_a_parabola_needs_no_slopes():
    x = np.array([-1.0, 0.5, 1.0, 3.0])
    (stroke,) = Sketch().add_graph(x, x**2 - x, name="accent1").page((-1, 3, -1, 6)).items
    px, py = path_points(stroke.path).T
    assert np.allclose(py, px**2 - px, atol=1e-14)
    with pytest.raises(ValueError, match="x has 2 knots, but a parabola needs 3"):
        Sketch().add_graph(x[:2], x[:2], name="accent1")


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


def test_an_angle_or_a_dimension_without_a_name_has_no_label():
    sketch = Sketch().add_angle((0, 0), (1, 0), (0, 1), 0.5, "", name="axis")
    assert not sketch.add_dimension((0, 0), (1, 0), "", name="frame").page((-1, 1, -1, 1)).labels


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


def test_errors_name_what_is_wrong():
    with pytest.raises(ValueError, match="name 'nothing' has no line style"):
        Sketch().add_segment((0, 0), (1, 1), name="nothing")
    with pytest.raises(ValueError, match=r"extent\[1\] - extent\[0\]"):
        Sketch().page((1, 1, 0, 1))
    for add in (Sketch().add_arrow, lambda a, b, name: Sketch().add_dimension(a, b, "d", name=name)):
        with pytest.raises(ValueError, match=r"a and b must be two points, got \(1, 2\) twice"):
            add((1, 2), (1, 2), name="axis")
