"""What a ball hides, against a dense sample of the definition, and the visible parts of regions."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from matplotlib.path import Path as Polygon

from stereodel.constants import LIMB_DEPTH
from stereodel.curves.view import View
from stereodel.drawing.scene.space_curves import CircleArc, Segment
from stereodel.drawing.scene.visibility import (
    Place,
    SphereRegion,
    lies_on_ball,
    limb,
    page_area,
    place_of,
    split_by_ball,
)
from stereodel.sphere import SphereArc, SphereCircle

from .test_space_curves import arcs, vectors

views = st.builds(View, st.floats(-180, 180), st.floats(-90, 90))
ORIGIN = np.zeros(3)


@st.composite
def circles_on_the_ball(draw):
    lonlat = (draw(st.floats(-180, 180)), draw(st.floats(-90, 90)))
    return CircleArc.circle(SphereCircle.around(lonlat, draw(st.floats(0.01, 179.99))))


def places(curve):
    """The places of the pieces of one curve, about a ball of radius 1."""
    [pieces] = split_by_ball([curve], 1.0)
    return [place for _, place in pieces]


def assert_pieces_cover(curve, pieces):
    """Pieces follow each other and make up the whole curve."""
    for (before, _), (after, _) in pairwise(pieces):
        assert before.stop == after.start
    span = pieces[-1][0].stop - pieces[0][0].start
    assert np.isclose(span, curve.stop - curve.start, rtol=1e-12)


@given(st.one_of(arcs(), st.builds(lambda a, b: Segment.between(3 * a, 3 * b), vectors, vectors)), st.floats(0.2, 3))
def test_circles_and_segments_of_space(curve, radius):
    """By the definition: the line toward the viewer meets the open ball; but for points where that may change."""
    [pieces] = split_by_ball([curve], radius)
    assert_pieces_cover(curve, pieces)
    for piece, place in pieces:
        points = piece.sample(np.linspace(piece.start, piece.stop, 203)[1:-1])
        beside, away = np.hypot(points[:, 0], points[:, 1]), np.linalg.norm(points, axis=1)
        clear = np.minimum(np.abs(beside - radius), np.abs(away - radius)) > 1e-6
        covered = (beside < radius) & (points[:, 2] < np.sqrt(np.maximum(radius**2 - beside**2, 0)))
        assert np.all(covered[clear] == (place in (Place.BEHIND, Place.INSIDE)))
        assert (place is Place.INSIDE) or np.all(away[clear] > radius)


@given(circles_on_the_ball(), views)
def test_circles_of_the_sphere(circle, view):
    curve = circle.moved(view.matrix, ORIGIN)
    assert lies_on_ball(curve, 1.0)
    [pieces] = split_by_ball([curve], 1.0)
    assert_pieces_cover(curve, pieces)
    # Cut at two points, the part across the start of the parameter must not be in two.
    assert len(pieces) == len({place for _, place in pieces})
    for piece, place in pieces:
        depth = piece.sample(np.linspace(piece.start, piece.stop, 201))[:, 2]
        assert np.all(depth >= -2e-12) if place is Place.FRONT else np.all(depth <= 1e-12)


def test_a_curve_on_the_limb_is_seen_and_stays_whole():
    equator = CircleArc.circle(SphereCircle((0.0, 90.0), 0.0))
    for view in (View(12, 90), View(77, -90)):
        [[(piece, place)]] = split_by_ball([equator.moved(view.matrix, ORIGIN)], 1.0)
        assert place is Place.FRONT
        assert piece.closed
    meridian = CircleArc.of(SphereArc(SphereCircle((123, 0), 0.0), (33, -90), (33, 90)))
    [[(_, place)]] = split_by_ball([meridian.moved(View(123, 0).matrix, ORIGIN)], 1.0)
    assert place is Place.FRONT


def test_a_parallel_that_touches_the_limb_is_not_torn():
    parallel = CircleArc.circle(SphereCircle.around((0, 90), 50))
    assert places(parallel.moved(View(0, 50).matrix, ORIGIN)) == [Place.FRONT]
    south = CircleArc.circle(SphereCircle.around((0, -90), 49.999))
    assert places(south.moved(View(0, 50).matrix, ORIGIN)) == [Place.BEHIND]


def test_a_meridian_is_cut_where_it_meets_the_equator_from_the_pole():
    meridian = CircleArc.of(SphereArc(SphereCircle((120, 0), 0.0), (30, -90), (30, 90)))
    [pieces] = split_by_ball([meridian.moved(View(0, 90).matrix, ORIGIN)], 1.0)
    assert [place for _, place in pieces] == [Place.BEHIND, Place.FRONT]
    assert np.isclose(pieces[0][0].stop, np.pi / 2, rtol=0, atol=1e-11)


def test_chords_are_inside_and_tangents_are_not():
    a, b = np.array([0.6, 0.0, 0.8]), np.array([-0.6, 0.0, 0.8])
    assert places(Segment.between(a, b)) == [Place.INSIDE]
    along = np.array([0.8, 0.0, -0.6])
    assert places(Segment.between(a + along, a - along)) == [Place.FRONT]


@given(st.lists(st.one_of(circles_on_the_ball(), arcs()), max_size=6), views)
def test_curves_are_cut_together_as_one_by_one(curves, view):
    moved = [curve.moved(view.matrix, ORIGIN) for curve in curves]
    together = split_by_ball(moved, 1.0)
    assert len(together) == len(moved)
    for curve, pieces in zip(moved, together, strict=True):
        [alone] = split_by_ball([curve], 1.0)
        found, expected = ([(p.start, p.stop, place) for p, place in some] for some in (pieces, alone))
        assert found == expected


def test_an_arc_that_leaves_at_the_limb_has_no_piece_of_no_length():
    """Its first point is the limb's, exactly or up to the depth that counts as seen; the rest of it is behind."""
    for depth in (0.0, -LIMB_DEPTH):
        start = np.array([np.sqrt(1 - depth**2), 0.0, depth])
        [pieces] = split_by_ball([CircleArc.great(start, [0.0, 0.6, -0.8])], 1.0)
        assert all(piece.stop > piece.start for piece, _ in pieces)
        assert pieces[-1][1] is Place.BEHIND


def test_places_of_points():
    for place, points in {
        Place.FRONT: [(0, 0, 1), (1, 0, 0), (0.5, 0, 3)],
        Place.BEHIND: [(0.8, 0, -0.6), (0.999, 0, -3), (0.5, 0, -3)],
        Place.INSIDE: [(0, 0, 0.5)],
        Place.OUTSIDE: [(2, 0, -5), (1.001, 0, -3)],
    }.items():
        assert {place_of(np.array(point, dtype=float), 1.0) for point in points} == {place}


lonlats = st.tuples(st.floats(-180, 180), st.floats(-90, 90))
sides = st.sampled_from([1, -1])
RNG = np.random.default_rng(5)
DISC = np.sqrt(RNG.uniform(0, 1, 500))[:, None] * np.column_stack(
    [f(RNG.uniform(0, 2 * np.pi, 500)) for f in (np.cos, np.sin)]
)
ON_PAGE = DISC / np.maximum(1, np.linalg.norm(DISC, axis=1, keepdims=True) * 1.02)


def cap(lonlat, radius):
    return SphereRegion((CircleArc.circle(SphereCircle.around(lonlat, radius)),), 1.0)


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
    corners = vertices[::-1] if inside_out else vertices
    sides = tuple(CircleArc.great(*pair) for pair in zip(corners, np.roll(corners, -1, 0), strict=True))
    region = SphereRegion(sides, 1.0).turned(view.matrix)
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
