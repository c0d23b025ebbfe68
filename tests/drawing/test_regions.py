"""Visible parts of regions: the outline encloses what the definition says, however the region lies."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from matplotlib.path import Path as Polygon

from stereodel.curves.view import View
from stereodel.drawing.scene.space_curves import CircleArc
from stereodel.drawing.scene.visibility import SphereRegion, limb, page_area
from stereodel.sphere import SphereCircle

lonlats = st.tuples(st.floats(-180, 180), st.floats(-90, 90))
views = st.builds(View, st.floats(-180, 180), st.floats(-90, 90))
sides = st.sampled_from([1, -1])
RNG = np.random.default_rng(5)
DISC = np.sqrt(RNG.uniform(0, 1, 500))[:, None] * np.column_stack(
    [f(RNG.uniform(0, 2 * np.pi, 500)) for f in (np.cos, np.sin)]
)
ON_PAGE = DISC / np.maximum(1, np.linalg.norm(DISC, axis=1, keepdims=True) * 1.02)


def cap(lonlat, radius):
    return SphereRegion((CircleArc.circle(SphereCircle.around(lonlat, radius)),), 1.0)


def ring(corners):
    """The region on the left of great-circle arcs."""
    return SphereRegion(
        tuple(CircleArc.great(*pair) for pair in zip(corners, np.roll(corners, -1, 0), strict=True)), 1.0
    )


def left_of_all(region):
    """Membership in a convex region, or a cap: on the left of each arc's plane."""

    def holds(points):
        inside = np.ones(len(points), dtype=bool)
        for arc in region.boundary:
            inside &= (points - arc.center) @ np.cross(arc.u, arc.v) > 0
        return inside

    return holds


def polygon_of(run):
    """A loop as a fine polygon, which may be off by 1e-5."""
    return np.concatenate([c.sample(np.linspace(c.start, c.stop, 400)) for c in run])[:, :2]


def assert_outline_is_right(region, holds, sign):
    """Points of the page off every boundary are enclosed once where the region is seen, and otherwise not at all."""
    points = np.column_stack([ON_PAGE, sign * np.sqrt(1 - np.sum(ON_PAGE**2, axis=1))])
    loops = (region if sign > 0 else region.far_side()).visible_outline()
    count, clear = np.zeros(len(points), dtype=int), np.ones(len(points), dtype=bool)
    for loop in loops:
        polygon = polygon_of(loop)
        assert np.linalg.norm(polygon[0] - polygon[-1]) < 1e-9
        count += np.where(Polygon(polygon).contains_points(ON_PAGE), np.sign(page_area(loop)), 0).astype(int)
        clear &= np.min(np.linalg.norm(ON_PAGE[:, None] - polygon[None, ::4], axis=2), axis=1) > 0.03
    np.testing.assert_array_equal(count[clear], holds(points)[clear].astype(int))


@given(lonlats, st.floats(5, 175), views, sides)
def test_caps(lonlat, radius, view, sign):
    region = cap(lonlat, radius).turned(view.matrix)
    assert_outline_is_right(region, left_of_all(region), sign)


@given(
    st.lists(st.tuples(st.floats(0.3, 1.0), st.floats(10, 85)), min_size=3, max_size=12),
    lonlats,
    st.booleans(),
    views,
    sides,
)
def test_stars_and_all_but_stars(corners, lonlat, inside_out, view, sign):
    """Not convex: a star about a point, whose sides are straight in the gnomonic plane there, or all but the star."""
    steps, radii = np.array(corners).T
    assume(2 * np.pi * steps.max() / steps.sum() < 2.8)
    angle = 2 * np.pi * np.cumsum(steps) / steps.sum()
    axes = View(*lonlat).matrix
    flat = np.tan(np.radians(radii))[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    vertices = np.column_stack([flat, np.ones(len(flat))]) @ axes
    region = ring(vertices[::-1] if inside_out else vertices).turned(view.matrix)
    star = Polygon(np.concatenate([flat, flat[:1]]), closed=True)

    def holds(points):
        local = points @ view.matrix @ axes.T
        before = local[:, 2] > 0
        held = before & star.contains_points(local[:, :2] / np.where(before, local[:, 2], 1.0)[:, None])
        return held != inside_out

    assert_outline_is_right(region, holds, sign)


@pytest.mark.parametrize("radius", [20, 90, 160])
@pytest.mark.parametrize("lonlat", [(0, 90), (0, -90), (0, 0), (0, 20)])
@pytest.mark.parametrize("sign", [1, -1])
def test_symmetric_caps_from_the_pole(lonlat, radius, sign):
    """The limb itself, tangent circles and concentric ones: no tie tears the outline."""
    region = cap(lonlat, radius).turned(View(0, 90).matrix)
    assert_outline_is_right(region, left_of_all(region), sign)


@pytest.mark.parametrize("tilt", [0.0, 1e-13, 1e-11, 1e-10])
def test_a_hemisphere_bounded_by_the_limb_is_all_or_nothing(tilt):
    """However rounding, or a conformal map, has turned its boundary: no slivers along the limb."""
    u, v = np.array([np.cos(tilt), 0.0, np.sin(tilt)]), np.array([0.0, 1.0, 0.0])
    near = SphereRegion((CircleArc(np.zeros(3), u, v),), 1.0)
    far = SphereRegion((CircleArc(np.zeros(3), u, -v),), 1.0)
    assert sum(map(page_area, near.visible_outline())) == pytest.approx(np.pi, rel=1e-9)
    assert far.visible_outline() == []


def test_a_cap_much_smaller_than_a_pixel_is_there():
    loops = cap((10, 20), 1e-6).turned(View(20, 30).matrix).visible_outline()
    assert sum(map(page_area, loops)) == pytest.approx(np.pi * np.radians(1e-6) ** 2, rel=0.1)


@given(lonlats, st.floats(1, 179), views)
def test_areas_on_the_page_are_those_of_fine_polygons(lonlat, radius, view):
    for loop in cap(lonlat, radius).turned(view.matrix).visible_outline():
        x, y = polygon_of(loop).T
        assert page_area(loop) == pytest.approx(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2, abs=2e-4)
    assert page_area([limb(2.0)]) == pytest.approx(4 * np.pi)


def test_a_boundary_with_a_gap_is_refused():
    a, b, c = np.eye(3)
    arcs = (CircleArc.great(a, b), CircleArc.great(b, c))
    with pytest.raises(
        ValueError, match=r"boundary\[1\] does not end where boundary\[0\] begins; give the arcs of a closed"
    ):
        SphereRegion(arcs, 1.0)
