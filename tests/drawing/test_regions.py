"""Visible parts of regions: the outline encloses what the definition says, and the mesh covers it."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from matplotlib.path import Path as Polygon

from stereodel.drawing.regions import SphereRegion, near_hemisphere
from stereodel.drawing.space_curves import CircleArc
from stereodel.drawing.view import View
from stereodel.sphere import SphereCircle, lonlat_to_xyz

lonlats = st.tuples(st.floats(-180, 180), st.floats(-90, 90))
views = st.builds(View, st.floats(-180, 180), st.floats(-90, 90))
RNG = np.random.default_rng(5)
DISC = np.sqrt(RNG.uniform(0, 1, 500))[:, None] * np.column_stack(
    [f(RNG.uniform(0, 2 * np.pi, 500)) for f in (np.cos, np.sin)]
)
ON_PAGE = DISC / np.maximum(1, np.linalg.norm(DISC, axis=1, keepdims=True) * 1.02)


def cap(lonlat, radius):
    return SphereRegion((CircleArc.circle(SphereCircle.around(lonlat, radius)),), 1.0)


def polygons(runs):
    """The outlines as fine polygons, which may be off by 1e-5."""
    for run in runs:
        points = [c.sample(np.linspace(c.start, c.stop, 400)) for c in run]
        yield np.concatenate(points)[:, :2]


def assert_outline_is_right(region, sign):
    """Points of the page off every boundary are enclosed an odd number of times where the region is seen."""
    height = sign * np.sqrt(1 - np.sum(ON_PAGE**2, axis=1))
    expected = region.contains(np.column_stack([ON_PAGE, height]))
    outline = list(polygons((region if sign > 0 else region.far_side()).visible_outline()))
    count = np.zeros(len(ON_PAGE), dtype=int)
    clear = np.ones(len(ON_PAGE), dtype=bool)
    for polygon in outline:
        count += Polygon(polygon).contains_points(ON_PAGE)
        clear &= np.min(np.linalg.norm(ON_PAGE[:, None] - polygon[None, ::4], axis=2), axis=1) > 0.03
    assert np.array_equal((count % 2 == 1)[clear], expected[clear])
    for polygon in outline:
        assert np.linalg.norm(polygon[0] - polygon[-1]) < 1e-9


@given(lonlats, st.floats(5, 175), views, st.sampled_from([1, -1]))
def test_caps(lonlat, radius, view, sign):
    assert_outline_is_right(cap(lonlat, radius).turned(view.matrix), sign)


@given(lonlats, lonlats, lonlats, views, st.sampled_from([1, -1]))
def test_triangles(first, second, third, view, sign):
    a, b, c = lonlat_to_xyz([first, second, third])
    determinant = np.dot(a, np.cross(b, c))  # np.linalg.det divides by pivots, which may be subnormal
    assume(abs(determinant) > 0.05)
    corners = [a, b, c] if determinant > 0 else [a, c, b]
    arcs = tuple(CircleArc.great(corners[i], corners[(i + 1) % 3]) for i in range(3))
    assert_outline_is_right(SphereRegion(arcs, 1.0).turned(view.matrix), sign)


@pytest.mark.parametrize("radius", [20, 90, 160])
@pytest.mark.parametrize("lonlat", [(0, 90), (0, -90), (0, 0), (0, 20)])
def test_symmetric_caps_from_the_pole(lonlat, radius):
    """The limb itself, tangent circles and concentric ones: no tie tears the outline."""
    region = cap(lonlat, radius).turned(View(0, 90).matrix)
    assert_outline_is_right(region, 1)
    assert_outline_is_right(region, -1)


def area_of_mesh(vertices, faces):
    a, b, c = (vertices[faces[:, i], :2] for i in range(3))
    return np.sum((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


def area_of_outline(runs):
    return sum(np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1)) / 2 for p in polygons(runs))


@given(lonlats, st.floats(10, 170), views)
def test_mesh_covers_the_outline(lonlat, radius, view):
    region = cap(lonlat, radius).turned(view.matrix)
    vertices, faces = region.visible_mesh()
    runs = region.visible_outline()
    # Where the limb surrounds a hidden hole, its run and the hole's have opposite turns, and the sum is the area.
    assert area_of_mesh(vertices, faces) == pytest.approx(area_of_outline(runs), abs=5e-3)
    assert np.allclose(np.linalg.norm(vertices, axis=1), 1, rtol=0, atol=1e-9)
    assert np.all(vertices[:, 2] >= -1e-12)


def test_hemisphere_of_the_viewer():
    vertices, faces = near_hemisphere(2.0)
    assert area_of_mesh(vertices, faces) == pytest.approx(4 * np.pi, rel=1e-4)
    assert np.allclose(np.linalg.norm(vertices, axis=1), 2)
    assert faces.dtype == np.int32
