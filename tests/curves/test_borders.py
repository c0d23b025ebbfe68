"""Borders: how far along, what lies between, where arcs cross; the circle of what is seen."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import MoebiusMap, SphereCircle, fisheye, lonlat_to_xyz
from stereodel.curves.borders import Antimeridian, Box, Cap, crossings
from stereodel.curves.chart import Chart
from stereodel.curves.ragged import Ragged
from stereodel.curves.trace import great
from stereodel.curves.view import StereographicView, View
from tests import sets
from tests.curves.oracle import units, whole_circles
from tests.examples import examples
from tests.strategies import LONLAT, SEEDS

BOX = Box(-1.0, 3.0, -2.0, 1.0)
CAP = Cap(View(0, 0), 1e-3)


@given(SEEDS)
def test_places_along_a_box(seed):
    """On each side the place grows counterclockwise, by lengths, from the lower right corner."""
    rng = np.random.default_rng(seed)
    place = np.sort(rng.uniform(0, BOX.length, 6))
    corners = np.append(BOX.corners, BOX.corners[:1], axis=0)
    marks = np.array([0, 3, 7, 10, 14.0])
    flat = np.column_stack([np.interp(place, marks, corners[:, k]) for k in (0, 1)])
    np.testing.assert_allclose(BOX.place(flat), place, atol=1e-12)
    assert BOX.place(corners[:4]).tolist() == marks[:4].tolist()


def test_a_point_beside_a_box_is_on_its_nearest_side():
    assert BOX.place(np.array([[2.9, 0.0], [0.0, 0.95]])).tolist() == [2.0, 6.0]


def test_corners_between_places():
    ways = BOX.between(np.array([1.0, 9.0, 1.0, 13.0, 3.0]), np.array([8.0, 2.0, 2.0, 13.0 + 5, 10.0]))
    expected = [[[3, 1], [-1, 1]], [[-1, 1], [3, 1]], [], [[3, -2], [3, 1]], [[-1, 1]]]
    assert [way.tolist() for way in ways] == expected
    np.testing.assert_array_equal(BOX.once(), np.append(BOX.corners, BOX.corners[:1], axis=0))


@given(st.floats(0, 6.28), st.floats(-6.28, 12.5))
def test_the_rim_between_places(start, way):
    points = CAP.between(np.array([start]), np.array([start + way])).values
    np.testing.assert_allclose(np.hypot(*points.T), 1, rtol=1e-15)
    angles = np.concatenate(
        [[start], np.unwrap(np.concatenate([[start], np.arctan2(*points.T[::-1])]))[1:], [start + way]]
    )
    steps = np.diff(angles)
    steps = np.mod(steps + np.pi, 2 * np.pi) - np.pi
    assert (steps * np.sign(way) > -1e-15).all()
    # The chord's distance from the rim is a thousandth of the tolerance.
    assert (1 - np.cos(np.abs(steps) / 2)).max() <= 1e-6 * (1 + 1e-9)
    np.testing.assert_allclose(CAP.place(points), np.mod(np.arctan2(points[:, 1], points[:, 0]), 2 * np.pi))


def test_all_round_the_rim():
    once = CAP.once()
    x, y = once.T
    assert (once[0] == once[-1]).all()
    assert 0 < np.pi - np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) / 2 < 1e-5


@given(SEEDS)
@examples(0.5)
def test_crossings_of_a_plane(seed):
    rng = np.random.default_rng(seed)
    p, q = units(rng.normal(size=(2, 20, 3)))
    arcs = great(p, q).through(fisheye(units(rng.normal(size=3)), magnification=float(10 ** rng.uniform(-1, 2))))
    direction, level = units(rng.normal(size=3)), rng.uniform(-1, 1)
    arc, t, above = crossings(arcs, direction, float(np.arccos(level)))
    points = arcs.points(arc, t)
    assert np.abs(points @ direction - level).max(initial=0) < 1e-8
    assert ((t >= arcs.begin[arc]) & (t <= arcs.stop[arc])).all()
    assert (above == (arcs.start @ direction >= level)).all()
    # As often as the sides of the ends want it, and where finely sampled arcs change sides.
    count = np.bincount(arc, minlength=len(arcs))
    assert (count % 2 == (above != (arcs.end @ direction >= level))).all()
    fine = arcs.spread(np.full(len(arcs), 2000))
    sides = (fine.values @ direction >= level).reshape(len(arcs), -1)
    assert (np.count_nonzero(sides[:, 1:] != sides[:, :-1], axis=1) <= count).all()
    heights = np.abs(fine.values @ direction - level).reshape(len(arcs), -1).min(axis=1)
    touching = heights < 1e-5
    assert (np.count_nonzero(sides[:, 1:] != sides[:, :-1], axis=1) == count)[~touching].all()


def test_an_end_on_the_plane_is_where_it_crosses():
    """Zero counts as above: an arc down from the plane crosses at its start, one that only touches it does not."""
    start = np.array([[1.0, 0, 0], [1, 0, 0], [0, 0, 1]])
    end = units([[1.0, 0, -1], [1, 0, 1], [1, 0, 0]])
    arc, t, above = crossings(great(start, end), np.array([0.0, 0, 1]), np.pi / 2)
    assert arc.tolist() == [0]
    assert t.tolist() == [0.0]
    assert above.tolist() == [True, True, True]


@pytest.mark.parametrize("view", [View(20, 30), StereographicView(-60, 10, angular_radius=130.0)])
def test_pieces_of_circles_in_sight(rng, view):
    """Ends against the closed form: where the circle's plane meets the plane of the rim."""
    circles = [SphereCircle.around(rng.uniform((-180, -90), (180, 90)), rng.uniform(1, 179)) for _ in range(200)]
    arcs, _ = whole_circles(circles)
    arcs = arcs.turned(view.matrix)
    pieces = Cap(view, 1e-4).cut(arcs)
    np.testing.assert_allclose(np.linalg.norm(pieces.arcs.start, axis=1), 1, rtol=1e-12)
    np.testing.assert_allclose(pieces.arcs.start[pieces.opens][:, 2], view.edge, atol=2e-12)
    number = pieces.arcs.edge // 2
    for k, circle in enumerate(circles):
        normal = view.matrix @ circle.normal
        # Points (x, y, edge) of the unit sphere with normal·(x, y, edge) = offset: one line cut with one circle.
        across = np.hypot(*normal[:2])
        foot = (circle.offset - normal[2] * view.edge) / across
        half = 1 - view.edge**2 - foot**2
        cuts = pieces.arcs.start[pieces.opens & (number == k)]
        assert len(cuts) == (2 if half > 0 else 0)
        if half > 0:
            along = np.array([-normal[1], normal[0]]) / across
            wanted = foot * normal[:2] / across + np.array([[1.0], [-1.0]]) * np.sqrt(half) * along
            gaps = np.abs(cuts[:, None, :2] - wanted[None]).max(axis=2).min(axis=1)
            assert gaps.max() < 1e-11 / min(1, half**0.5)
    # In sight or not as the middles are.
    middle = pieces.arcs.points(np.arange(len(pieces.arcs)), (pieces.arcs.begin + pieces.arcs.stop) / 2)
    far = np.abs(middle[:, 2] - view.edge) > 1e-9
    assert (pieces.seen == (middle[:, 2] > view.edge))[far].all()


def chains(arcs, border):
    """What is drawn of single arcs, in degrees."""
    pieces = border.cut(arcs)
    samples = pieces.arcs.spread(np.full(len(pieces.arcs), 4))
    return pieces, list(Ragged(border.flat(samples), samples.offsets))


def test_arcs_over_180_and_over_a_pole():
    border = Antimeridian()
    start, end = lonlat_to_xyz([[170, 10], [40, 60], [40, -60]]), lonlat_to_xyz([[-170, 10], [-140, 60], [-140, -60]])
    pieces, flat = chains(great(start, end), border)
    assert pieces.arcs.edge.tolist() == [0, 0, 1, 1, 2, 2]
    assert flat[0][-1, 0] == 180
    assert flat[1][0, 0] == -180
    assert flat[0][-1, 1] == flat[1][0, 1]
    np.testing.assert_allclose(flat[2], np.column_stack([np.full(5, 40.0), np.linspace(60, 90, 5)]), atol=1e-12)
    np.testing.assert_allclose(flat[5], np.column_stack([np.full(5, -140.0), np.linspace(-90, -60, 5)]), atol=1e-12)
    assert pieces.seen.all()
    assert not pieces.along.any()


@pytest.mark.parametrize("off", [1e-16, 8e-16, -1e-16])
def test_points_within_rounding_of_the_border_are_on_it(off):
    """Also inside of a chain, when it is flattened: else a side along ±180° zigzags between both sides of the map."""
    start = units([[-1.0, 0, -0.2]])
    end = units([[-1.0, off, 0.3]])
    pieces, flat = chains(great(start, end), Antimeridian())
    assert pieces.along.all()
    assert (flat[0][:, 0] == 180).all()
    border = Antimeridian()
    inside = Ragged(units([[-1.0, 0.1, 0], [-1.0, 1e-17, 0.1], [-1.0, 0.1, 0.2]]), np.array([0, 3]))
    assert border.flat(inside)[1, 0] == 180
    below = Ragged(inside.values * [1, -1, 1], inside.offsets)
    assert border.flat(below)[1, 0] == -180


def test_rounding_along_180_cuts_nothing(rng):
    """Arcs along the meridian but for rounding, which has them cross it twice by 1e-16: one piece each."""
    lat = np.radians(np.sort(rng.uniform(-60, 60, (300, 2)), axis=1))
    ends = np.stack([-np.cos(lat), 4e-16 * rng.uniform(-1, 1, lat.shape), np.sin(lat)], axis=-1)
    pieces, flat = chains(great(ends[:, 0], ends[:, 1]), Antimeridian())
    assert len(pieces.arcs) == 300
    assert pieces.along.all()
    assert all((line[:, 0] == 180).all() for line in flat)


@given(SEEDS)
def test_rings_leave_a_chart_as_often_as_they_enter_it(seed):
    """Vertices on the rim, on the meridian, at the poles, doubled: signs tell how many crossings there are."""
    rng = np.random.default_rng(seed)
    points = units(sets.cube_grid(1))[rng.permutation(26)[: rng.integers(3, 9)]]
    following = np.roll(points, -1, axis=0)
    opposite = np.abs(points + following).max(axis=1) < 1e-9
    normal = np.where(opposite[:, None], units(np.cross(points, units(rng.normal(size=points.shape)))), 0.0)
    arcs = great(points, following, normal).through(MoebiusMap.identity())
    for border in (Cap(View(0, 0), 1e-4), Cap(View(45, 0), 1e-4), Antimeridian()):
        pieces = border.cut(arcs)
        # All pieces but the first of their edge begin where the one before ends, and cuts come in pairs.
        assert (pieces.arcs.start[1:] == pieces.arcs.end[:-1])[np.diff(pieces.arcs.edge) == 0].all()
        if isinstance(border, Cap):
            assert np.count_nonzero(pieces.seen != np.roll(pieces.seen, 1)) % 2 == 0
            assert (pieces.opens[1:] == pieces.shuts[:-1]).all()


@given(LONLAT, LONLAT, st.floats(-9, 9), st.floats(-7, 2.2) | st.just(None))
def test_the_circle_of_what_is_seen(focus, toward, power, size):
    """Its normal and radius are those that twice the precision gives, to a few roundings of the radius."""
    lens = fisheye(focus, magnification=10.0**power)
    view = View(*toward) if size is None else StereographicView(*toward, angular_radius=10.0**size)
    exact = lens.inverse().image_of(SphereCircle.around(view.matrix[2], view.angular_radius))
    found = Chart(lens, view).source
    assert found.radius == pytest.approx(np.radians(exact.angular_radius), rel=1e-9)
    # As far as the double precision of the view's direction lets it be known, which the lens magnifies.
    assert np.linalg.norm(found.normal - exact.normal) < 1e-14 * max(1.0, 10.0 ** abs(power))
    assert np.hypot(found.cosine, found.sine) == pytest.approx(1, abs=1e-12)
