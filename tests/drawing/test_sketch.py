"""Sketches: what is asked for is what the page holds."""

import numpy as np
import pytest

from stereodel.drawing import Sketch
from stereodel.drawing.page import Dots, Fill, Label, Stroke
from stereodel.drawing.sketch import arc_path


def bezier_points(path, steps=9):
    t = np.linspace(0, 1, steps)[:, None]
    a, b, c, d = (path[:, k, None, :] for k in range(4))
    return (a * (1 - t) ** 3 + 3 * b * (1 - t) ** 2 * t + 3 * c * (1 - t) * t**2 + d * t**3).reshape(-1, 2)


@pytest.mark.parametrize(("start", "stop"), [(0.0, 360.0), (-90.0, 20.0), (170.0, 200.0)])
def test_arcs_lie_on_their_circle(start, stop):
    path = arc_path((2.0, -1.0), 3.0, start, stop)
    points = bezier_points(path) - [2.0, -1.0]
    assert np.allclose(np.hypot(*points.T), 3.0, rtol=4e-7)
    ends = 3.0 * np.array([[np.cos(a), np.sin(a)] for a in np.radians([start, stop])])
    assert np.allclose(points[[0, -1]], ends, atol=1e-14)
    assert np.array_equal(path[1:, 0], path[:-1, 3])


def test_graph_of_a_cubic_is_exact():
    x = np.array([-1.0, 0.5, 2.0])
    (stroke,) = Sketch().add_graph(x, x**3 - x, 3 * x**2 - 1, name="accent1").page((-1, 2, -2, 6)).items
    px, py = bezier_points(stroke.path).T
    assert np.allclose(py, px**3 - px, atol=1e-14)


def test_items_come_in_the_order_of_the_calls():
    sketch = Sketch().add_disc((0, 0), 1, name="accent1").add_segment((0, 0), (1, 1), name="axis")
    page = sketch.add_points([1.0, 1.0], name="pole").add_label((1, 1), "p", (3, 4)).page((-1, 3, -1, 1), width=400.0)
    assert [type(item) for item in page.items] == [Fill, Stroke, Dots, Label]
    assert page.height == 200.0
    assert page.labels[0].offset == (3, 4)


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


def test_errors_name_what_is_wrong():
    with pytest.raises(ValueError, match="name 'nothing' has no line style"):
        Sketch().add_segment((0, 0), (1, 1), name="nothing")
    with pytest.raises(ValueError, match=r"extent\[1\] - extent\[0\]"):
        Sketch().page((1, 1, 0, 1))
