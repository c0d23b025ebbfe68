"""Scenes: what is drawn, what is left out, and in which order."""

import numpy as np
import pytest

from stereodel.curves.view import View
from stereodel.drawing.page import Ball, Dots, Fill, Label, Stroke
from stereodel.drawing.page.colors import as_color
from stereodel.drawing.page.style import LINES, LineStyle
from stereodel.drawing.scene.scene import Scene
from stereodel.drawing.scene.scene_items import Layer
from stereodel.drawing.scene.space_curves import CircleArc
from stereodel.sphere import SphereCircle, graticule, lonlat_to_xyz
from tests.refused import refused

PLANE = np.array([[-2.0, -2.0, -1.0], [2.0, -2.0, -1.0], [2.0, 2.0, -1.0], [-2.0, 2.0, -1.0]])
FRONT, BACK = View(0, 90), View(0, -90)


def of(items, kind, name=None):
    return [item for item in items if isinstance(item, kind) and (name is None or item.name == name)]


def names(items):
    return [item.name for item in items]


def test_an_opaque_ball_hides_its_far_side():
    scene = Scene()
    scene.add_points(lonlat_to_xyz([(0, 60), (0, -60), (0, 0)]))
    scene.add_edges(lonlat_to_xyz([(0, 60), (90, 60), (0, -60), (90, -60)]), [[0, 1], [2, 3]], name="delaunay")
    items = scene.layout(FRONT)
    assert names(items) == ["ball", "delaunay", "limb", "sites"]
    assert of(items, Dots)[0].centers.shape == (2, 2)


@pytest.mark.parametrize("length", [1e-200, 1e200])
def test_lengths_of_directions_do_not_matter(length):
    def places(points):
        scene = Scene()
        scene.add_points(points)
        scene.add_edges(points, [[0, 1]], name="delaunay")
        items = scene.layout(View(20, 30))
        return [of(items, Dots)[0].centers, *(item.path for item in of(items, Stroke, "delaunay"))]

    points = np.array([[1.0, 0.0, 0.0], [0.0, 3.0, 4.0]])
    for found, expected in zip(places(length * points), places(points), strict=True):
        np.testing.assert_allclose(found, expected, atol=1e-15)


def test_a_glass_ball_shows_it_fainter_and_first():
    scene = Scene(style="glass")
    scene.add_arcs(graticule(30), name="graticule")
    items = scene.layout(View(10, 20))
    ball = names(items).index("ball")
    behind, front = items[:ball], items[ball + 1 : -1]
    assert behind
    assert front
    assert {item.color for item in front} == {LINES["graticule"].color}
    assert {item.color for item in behind} == {LINES["graticule"].hidden.color}
    assert items[-1].name == "limb"


def test_without_a_ball_nothing_is_hidden():
    scene = Scene(style="none")
    scene.add_arcs(graticule(30), name="graticule")
    items = scene.layout(FRONT)
    assert len(items) == len(graticule(30))
    assert all(item.closed == arc.closed for item, arc in zip(items, graticule(30), strict=True))


def test_at_and_scale_place_the_origin():
    scene = Scene(radius=2.0, center=(0.0, 0.0, 2.0))
    [limb] = of(scene.layout(View(0, 0), at=(10.0, 20.0), scale=0.5), Stroke, "limb")
    points = limb.path[:, 0]
    assert np.allclose(points.mean(axis=0), [10.0, 21.0])
    assert np.allclose(np.hypot(*(points - [10.0, 21.0]).T), 1.0)


def test_a_plane_below_the_ball_is_painted_first_and_from_below_last():
    scene = Scene()
    scene.add_flat_polygon(PLANE)
    scene.add_points([[0, 0, 1], [0, 0, -1]])
    scene.add_space_points([[1.5, 0, -1]], name="points")
    assert names(scene.layout(View(0, 30))) == ["plane", "ball", "limb", "sites", "points"]
    assert names(scene.layout(View(0, -30))) == ["ball", "limb", "plane", "sites", "points"]


def test_lines_below_a_plane_are_painted_under_it():
    scene = Scene()
    scene.add_flat_polygon(PLANE)
    scene.add_segments([1.8, 0, 1], [1.8, 0, -3], name="ray")
    items = scene.layout(View(90, 30))
    assert names(items)[:3] == ["ray", "plane", "ray"]
    upper, lower = (item for item in (items[2], items[0]))
    assert upper.path[0, 3] == pytest.approx(lower.path[0, 0], abs=1e-8)


def test_flat_polygons_inside_the_ball():
    corners = lonlat_to_xyz([(0, 0), (90, 0), (0, 90)])
    for style, expected in (
        ("solid", ["ball", "limb"]),
        ("glass", ["chordal", "chord", "chord", "chord", "ball", "limb"]),
    ):
        scene = Scene(style=style)
        scene.add_flat_polygon(corners, name="chordal")
        scene.add_outline(corners, name="chord")
        assert names(scene.layout(View(45, 30))) == expected


def test_a_polygon_that_cuts_the_ball_is_refused():
    scene = Scene()
    scene.add_flat_polygon(PLANE * [1, 1, 0.5])
    with pytest.raises(ValueError, match="cuts the ball"):
        scene.layout(FRONT)


def test_caps_and_triangles_are_lit_in_front_and_faint_behind():
    scene = Scene(style="glass", radius=2.0, center=(0.0, 0.0, 1.0))
    circle = SphereCircle.around((0, 40), 30)
    scene.add_cap(circle, name="small_bubble")
    scene.add_cap(circle, name="large_bubble", side="outside")
    scene.add_patch(lonlat_to_xyz([(0, 0), (60, 0), (30, 50)]), color="tab:red")
    view = View(0, 40)
    fills = of(scene.layout(view, at=(5.0, 6.0), scale=0.5), Fill)
    lit, flat = [item for item in fills if item.ball], [item for item in fills if not item.ball]
    assert names(lit) == ["ball", "small_bubble", "large_bubble", "triangle"]
    assert names(flat) == ["large_bubble"]
    assert len(of(lit, Fill, "large_bubble")[0].paths) == 2
    assert lit[-1].color == as_color("tab:red")
    assert {item.ball for item in lit} == {Ball((5.0, 6.0 + 0.5 * view.project((0, 0, 1))[1]), 1.0)}


def test_pages_hold_the_ball_by_default():
    scene = Scene(radius=2.0, center=(0.0, 0.0, 2.0))
    scene.add_points([[0, 0, 1]])
    view = View(0, 0)
    page = scene.page(view, width=300.0, background="k")
    assert page.extent == pytest.approx((-2.04, 2.04, -0.04, 4.04))
    assert (page.width, page.background) == (300.0, (0.0, 0.0, 0.0, 1.0))
    assert np.array_equal(page.views, [view.matrix])
    assert scene.page(view, extent=(-3.0, 3.0, -1.0, 4.0)).extent == (-3.0, 3.0, -1.0, 4.0)


def test_labels_vanish_with_their_points_unless_told():
    scene = Scene()
    scene.add_label((0, 0, 1), "front", offset=(3, 4))
    scene.add_label((0, 0, -1), "back")
    scene.add_label((0, 0, -1), "always", always=True)
    labels = of(scene.layout(FRONT), Label)
    assert [label.text for label in labels] == ["front", "always"]
    assert labels[0].anchor == (0.0, 0.0)
    assert labels[0].offset == (3, 4)


def test_style_and_layer_can_be_given():
    scene = Scene()
    style = LineStyle((1.0, 0.0, 0.0, 1.0), 3.0, (2.0, 2.0))
    scene.add_curves([CircleArc.circle(SphereCircle.around((0, 90), 30))], name="mine", style=style, layer=Layer.OVER)
    items = scene.layout(FRONT)
    assert names(items) == ["ball", "limb", "mine"]
    assert (items[2].width, items[2].dash, items[2].cap, items[2].closed) == (3.0, (2.0, 2.0), "butt", True)


test_bad_input_is_named = refused(
    (lambda s: Scene(style="foggy"), "style is 'foggy'"),
    (lambda s: Scene(radius=0), "radius"),
    (lambda s: s.add_arcs(graticule(30), name="nothing"), "name 'nothing' has no line style"),
    (lambda s: s.add_points([[0, 0, 1]], name="nothing"), "name 'nothing' has no dot style"),
    (lambda s: s.add_points([[0, 0, 0]]), "points"),
    (lambda s: s.add_flat_polygon(PLANE, name="nothing"), "name 'nothing' has no fill style"),
    (lambda s: s.add_edges([[0, 0, 1]], [[0, 1]], name="delaunay"), "pairs"),
    (lambda s: s.add_label([0, 1], "x"), "point"),
    (lambda s: s.layout(FRONT, scale=-1), "scale"),
    (lambda s: s.page(FRONT, extent=(1, -1, -1, 1)), r"extent\[1\] - extent\[0\]"),
    (lambda s: s.page(FRONT, width=0), "width"),
    (lambda s: s.page(FRONT, background="sky"), "background is 'sky'"),
    (lambda s: s.add_patch(np.eye(3), color=(1, 2, 3)), "color is"),
    (lambda s: s.add_region([CircleArc.great([1, 0, 0], [0, 1, 0])], name="cell"), "boundary"),
    call=lambda draw: draw(Scene()),
)
