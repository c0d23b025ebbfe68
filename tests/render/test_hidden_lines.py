"""What a page hides against what a depth buffer hides: an oracle that shares no formula with `stereodel.drawing`.

Every line becomes a thin tube of its own colour, which pyrender draws with the opaque ball and its own depth test,
without light or multisampling. Along each line, what is seen of the tube is compared with what the page has of the
line, to a pixel: where the page has a stroke, the tube is seen or another tube is before it; where it has none, it is
not.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial import cKDTree

from stereodel.constants import ON_BALL
from stereodel.drawing import CircleArc, LineStyle, Page, Scene, Segment, View
from stereodel.drawing.page import Stroke
from stereodel.drawing.scene.scene_items import SceneBall, SceneLines
from stereodel.drawing.scene.solid import PlacedScene, Solid
from stereodel.render import gl
from stereodel.render.space.bodies import to_trimesh
from stereodel.render.space.save_solid import page_box
from stereodel.sphere import SphereArc, SphereCircle
from tests.figures.scripts import path_points
from tests.tiers import by_day

SIZE = 700
"""Pixels across a ball and a tenth of its radius around it."""

HALF_WIDTH = 1.5
"""Radius of a tube in pixels: some pixel's middle is on its outer half, wherever it lies."""

NEAR = 2 * HALF_WIDTH + 1
"""Pixels from strokes, their ends and the limb, within which nothing hidden is asked for: tubes are round."""

ON_STROKE = 0.5
"""Pixels from a stroke to a point on it."""

SAMPLES = 40
"""Of each part of a line."""

LONGEST = np.pi / 4
"""Of a part of an arc that has a colour of its own."""


def parts(curve):
    """A line in parts, so that its near side and its far side have colours of their own."""
    count = 1 if isinstance(curve, Segment) else max(1, int(np.ceil((curve.stop - curve.start) / LONGEST)))
    bounds = np.linspace(curve.start, curve.stop, count + 1)
    return [curve.part(a, b) for a, b in pairwise(bounds.tolist())]


def alone(placed, reach):
    """An opaque ball with the parts of its lines as items of their own, on a page of `reach` radii each way."""
    layout = replace(placed.layout, style="solid", at=(0.0, 0.0), scale=1.0)
    x, y = layout.origin
    extent = (x - reach, x + reach, y - reach, y + reach)
    page = Page(extent, width=float(SIZE))
    style = LineStyle("black", 2 * HALF_WIDTH * 2 * reach / SIZE * page.points_per_unit)
    curves = [curve for item in placed.items if isinstance(item, SceneLines) for curve in item.curves]
    lines = [SceneLines((part,), style, "line") for curve in curves for part in parts(curve)]
    ball = SceneBall((1.0, 1.0, 1.0, 1.0), style)
    return page, layout, ball, lines


def seen_numbers(page, layout, ball, lines):
    """Number of what is seen at each pixel, rows from the bottom: 0 nothing, 1 the ball, from 2 on the lines."""
    solid = Solid(page, (PlacedScene(layout, (ball, *lines)),))
    scene, context = to_trimesh(solid), gl.context()
    nodes, pyrender = scene.graph.nodes_geometry, context.pyrender
    assert len(nodes) == 1 + len(lines)
    made, colors = pyrender.Scene(), {}
    for number, node in enumerate(nodes, start=1):
        pose, name = scene.graph.get(node)
        mesh = scene.geometry[name]
        primitive = pyrender.Primitive(mesh.vertices, indices=mesh.faces, poses=pose[None])
        colors[made.add(pyrender.Mesh([primitive]), name=gl.node_name(number))] = [*number.to_bytes(3)]
    window = gl.Window(0, 0, SIZE, SIZE)
    gl.aim(pyrender, made, page_box(solid, scene), SIZE, SIZE, window)
    pixels = context.draw_scene(made, window, pyrender.RenderFlags.SEG, seg_node_map=colors).astype(int)
    return (pixels @ [2**16, 2**8, 1])[::-1]


def strokes(layout, line, unit):
    """Points (n, 2) of what the page has of a line, half a pixel apart, and the ends of it."""
    laid = [item for _, item in line.lay(layout) if isinstance(item, Stroke)]
    points = [path_points(item.path, steps=2 + int(2 * np.ptp(item.path) / unit)) for item in laid]
    ends = [point for item in laid if not item.closed for point in (item.path[0, 0], item.path[-1, 3])]
    return np.concatenate([np.zeros((0, 2)), *points]), np.array(ends).reshape(-1, 2)


def distance(points, others):
    """From each point to the nearest of the others, infinite where there are none."""
    if not len(others):
        return np.full(len(points), np.inf)
    return cKDTree(others).query(points)[0]


def around(numbers, points, number, reach):
    """Of each point in pixels whether that number, or that of another line, is seen within `reach` pixels."""
    offsets = np.mgrid[-2:3, -2:3].reshape(2, -1).T
    cells = np.floor(points)[:, None].astype(int) + offsets
    inside = np.sqrt(((cells + 0.5 - points[:, None]) ** 2).sum(axis=-1)) <= reach
    found = numbers[np.clip(cells[..., 1], 0, SIZE - 1), np.clip(cells[..., 0], 0, SIZE - 1)]
    return ((found == number) & inside).any(axis=1), ((found > 1) & inside).any(axis=1)


def disagreements(placed, reach):
    """Samples where page and depth buffer say different things, how many were seen, hidden, and covered by others."""
    page, layout, ball, lines = alone(placed, reach)
    numbers = seen_numbers(page, layout, ball, lines)
    unit = 2 * reach / SIZE
    corner, middle = np.array(page.extent[::2]), (np.array(layout.origin) - page.extent[::2]) / unit
    wrong, seen, hidden, covered = [], 0, 0, 0
    for number, line in enumerate(lines, start=2):
        (curve,) = line.curves
        t = np.linspace(curve.start, curve.stop, SAMPLES + 2)[1:-1]
        points = layout.axes(curve.sample(t))
        at = (layout.on_page(points) - corner) / unit
        path, ends = strokes(layout, line, unit)
        away = distance(at, (path - corner) / unit)
        drawn = away <= ON_STROKE
        asked = distance(at, (ends - corner) / unit) > NEAR
        asked &= (at > 2).all(axis=1) & (at < SIZE - 2).all(axis=1)
        # The tube is half within the ball, all within it or all without.
        height = np.abs(np.sqrt((points**2).sum(axis=1)) - layout.radius)
        asked &= (height > (HALF_WIDTH + 1) * unit) | (height.max() < ON_BALL * layout.radius)
        in_limb = np.sqrt(((at - middle) ** 2).sum(axis=1)) < layout.radius / unit - NEAR
        asked &= drawn | (in_limb & (away > NEAR))
        own, any_line = around(numbers, at, number, HALF_WIDTH)
        close, _ = around(numbers, at, number, 1.0)
        wrong += [(number, float(s)) for s in t[asked & drawn & ~any_line]]
        wrong += [(number, float(s)) for s in t[asked & ~drawn & close]]
        seen += int((asked & drawn & own).sum())
        covered += int((asked & drawn & ~own & any_line).sum())
        hidden += int((asked & ~drawn).sum())
    return wrong, seen, hidden, covered


def random_scene(seed):
    """Arcs of circles on a ball, and segments and circles in it and about it; a view of it."""
    rng = np.random.default_rng(seed)
    radius, center = float(rng.uniform(0.4, 1.0)), rng.uniform(-0.2, 0.2, 3)
    scene = Scene(radius=radius, center=center)
    for _ in range(12):
        circle = SphereCircle.around(rng.uniform((-180, -85), (180, 85)), float(rng.uniform(10, 150)))
        start, end = circle.sample(50)[rng.choice(50, 2, replace=False)]
        scene.add_arcs([SphereArc(circle, start, end)], name="arc")
    ends = center + 1.4 * radius * rng.uniform(-1, 1, (2, 10, 3))
    scene.add_segments(*ends, name="chord")
    for _ in range(6):
        u, v, _ = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        size = float(rng.uniform(0.2, 1.2)) * radius
        scene.add_curves([CircleArc(center + 0.3 * radius * rng.normal(size=3), size * u, size * v)], name="circle")
    view = View(*rng.uniform((-180, -90, -180), (180, 90, 180)))
    return scene, view


@pytest.mark.parametrize("seed", by_day(range(4), 0))
def test_random_scenes_hide_what_a_depth_buffer_hides(seed):
    scene, view = random_scene(seed)
    wrong, seen, hidden, covered = disagreements(scene.placed(view), 2.2 * scene.radius)
    assert wrong == []
    assert min(seen, hidden) > 300
    assert covered < seen / 4
