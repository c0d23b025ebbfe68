"""Claims P10 to P13: the rectangle on its own hemisphere."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.projections import RectangleLift
from stereodel.sphere import angular_distance, xyz_to_lonlat

SIDES = st.tuples(st.floats(0.01, 100), st.floats(0.01, 100))
UNIT = st.floats(-0.5, 0.5)
PAIRS = st.tuples(UNIT, UNIT, UNIT, UNIT)
CENTER = (3.0, -7.0)


def in_rectangle(lift, fractions):
    return np.reshape(fractions, (-1, 2)) * [lift.width, lift.height] + lift.center


@given(SIDES)
def test_p10_corners_on_the_equator_and_scale_1_to_half(sides):
    lift = RectangleLift(*sides, center=CENTER)
    corners = in_rectangle(lift, [-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5])
    assert lift.sphere.radius * 4 == pytest.approx(np.hypot(*sides), rel=1e-15)
    assert np.abs(lift.forward(corners)[:, 2]).max() < 1e-13
    assert lift.scale_factor(corners) == pytest.approx(0.5, rel=1e-13)
    assert lift.scale_factor(CENTER) == 1.0
    assert lift.forward(CENTER).tolist() == [0, 0, -1]
    assert lift.angular_radius == pytest.approx(90.0, abs=1e-12)


@given(SIDES, PAIRS)
def test_p11_scale_by_latitude(sides, fractions):
    lift = RectangleLift(*sides, center=CENTER)
    point = in_rectangle(lift, fractions[:2])[0]
    phi = -np.radians(xyz_to_lonlat(lift.forward(point))[1])
    assert lift.scale_factor(point) == pytest.approx((1 + np.sin(phi)) / 2, rel=1e-13)


@given(st.floats(5, 85), st.floats(-180, 180))
def test_p11_derivatives_of_the_scale(south, lon):
    # ∂s/∂φ = cos φ / 2 and ∂s/∂λ = 0, by central differences on the sphere.
    lift, step = RectangleLift(4.0, 3.0), 1e-3

    def scale(phi, lam):
        phi, lam = np.radians([phi, lam])
        vector = [np.cos(phi) * np.cos(lam), np.cos(phi) * np.sin(lam), -np.sin(phi)]
        return float(lift.scale_factor(lift.inverse(vector)))

    by_latitude = (scale(south + step, lon) - scale(south - step, lon)) / np.radians(2 * step)
    assert by_latitude == pytest.approx(np.cos(np.radians(south)) / 2, abs=1e-9)
    assert (scale(south, lon + step) - scale(south, lon - step)) / np.radians(2 * step) == pytest.approx(0, abs=1e-9)


@given(SIDES, PAIRS)
def test_p11_rate_by_latitude(sides, fractions):
    lift = RectangleLift(*sides, center=CENTER)
    point = in_rectangle(lift, fractions[:2])[0]
    south = np.radians(xyz_to_lonlat(lift.forward(point))[1])
    assert lift.scale_rate(point) == pytest.approx(np.cos(south) / 2, rel=1e-12, abs=1e-14)


def test_p11_rate_far_out_and_at_the_ends():
    lift = RectangleLift(4.0, 3.0)
    assert lift.scale_rate([0.0, 0.0]) == 0
    assert lift.scale_rate([[1e-320, 0.0], [1e200, 1e200], [1e290, 1e290]]) == pytest.approx(0, abs=1e-199)
    # North of the equator the same again: a point at t and one at 1/t have latitudes of opposite sign.
    assert lift.scale_rate([2.5 * 3, 0.0]) == pytest.approx(lift.scale_rate([2.5 / 3, 0.0]), rel=1e-15)


@given(SIDES, st.lists(st.tuples(UNIT, UNIT), min_size=2, max_size=6))
def test_p12_paths_shrink_by_a_factor_between_half_and_one(sides, fractions):
    lift = RectangleLift(*sides, center=CENTER)
    corners = in_rectangle(lift, fractions)
    t = np.linspace(0, 1, 400)[:, None]
    path = np.concatenate([a + t * (b - a) for a, b in pairwise(corners)])
    length = np.hypot(*np.diff(path, axis=0).T).sum()
    if length < 1e-6:
        return
    lifted = lift.forward(path)
    image = np.radians(angular_distance(lifted[:-1], lifted[1:])).sum() * lift.sphere.radius
    assert 0.5 * (1 - 1e-9) <= image / length <= 1 + 1e-9
    # The scale is the ratio of lengths all along.
    steps = np.hypot(*np.diff(path, axis=0).T) * lift.scale_factor((path[:-1] + path[1:]) / 2)
    assert image == pytest.approx(steps.sum(), rel=1e-4)


@given(SIDES, PAIRS)
def test_p13_separation(sides, fractions):
    lift = RectangleLift(*sides, center=CENTER)
    a, b = in_rectangle(lift, fractions)
    d = np.hypot(*(a - b))
    if d < 1e-9 * lift.diagonal:
        return
    lower, upper = lift.separation_bounds(d * (1 - 1e-15))
    angle = angular_distance(*lift.forward([a, b]))
    assert lower * (1 - 1e-6) <= angle <= upper * (1 + 1e-6)
    assert lower == pytest.approx(2 / np.pi * d / lift.diagonal * 180)
    assert upper == pytest.approx(4 / np.pi * d / lift.diagonal * 180)
    # The paper's constant ½ is weaker.
    assert angle > 0.5 * d / lift.diagonal * 180


def test_p13_both_constants_are_tight():
    lift, d = RectangleLift(3.0, 2.0), 1e-6
    lower, upper = lift.separation_bounds(d)
    corner = np.array([1.5, 1.0])
    at_corner = angular_distance(*lift.forward([corner, corner - [d, 0.0]]))
    at_center = angular_distance(*lift.forward([[0.0, 0.0], [d, 0.0]]))
    assert at_corner / lower == pytest.approx(1, abs=1e-5)
    assert at_center / upper == pytest.approx(1, abs=1e-9)


def test_fit_and_round_trip():
    points = np.random.default_rng(7).uniform([1, 10], [4, 12], size=(3000, 2))
    lift = RectangleLift.fit(points)
    assert (lift.width, lift.height) == tuple(np.ptp(points, axis=0))
    sphere = lift.forward(points)
    assert (sphere[:, 2] <= 1e-15).all()
    assert np.abs(lift.inverse(sphere) - points).max() < 1e-14
    assert lift == RectangleLift(lift.width, lift.height, center=lift.center)


def test_seen_from_below_the_rectangle_is_not_mirrored():
    lift = RectangleLift(4.0, 3.0)
    a, b, c = lift.forward([[0, 0], [1, 0], [0, 1]])
    # Counterclockwise seen from outside, which is from below.
    assert np.linalg.det([a, b, c]) > 0
    assert xyz_to_lonlat(b)[0] == 90
    assert xyz_to_lonlat(c)[0] == 0


def test_degenerate_rectangles():
    line = RectangleLift(2.0, 0.0)
    assert line.forward([1.0, 0.0]).tolist() == [0, 1, 0]
    assert RectangleLift.fit([[1, 1], [1, 5]]).diagonal == 4
