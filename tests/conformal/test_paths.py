"""Paths between conformal maps: geodesics of hyperbolic space and even turns."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel.conformal import GroupPath, MoebiusMap, fisheye, flight
from tests.examples import examples
from tests.strategies import BETWEEN_POLES, ROTATIONS, decades, maps

MAPS = maps(decades(-4, 4))
TIMES = st.floats(0.01, 0.99)
POINTS = np.random.default_rng(31).normal(size=(20, 3))


def place(conformal):
    """The point of hyperbolic space where a map's fisheye stands: its Lorentz matrix takes it to (0, 0, 0, 1)."""
    return conformal.inverse().matrix[:, 3]


def distance(a, b):
    """Hyperbolic distance by the textbook formula."""
    return np.arccosh(max(1.0, a[3] * b[3] - a[:3] @ b[:3]))


@given(MAPS, MAPS)
@examples(0.2)
def test_ends_are_the_maps_and_nothing_jumps(start, end):
    path = GroupPath(start, end)
    assert (path(0.0), path(1.0)) == (start, end)
    for t, given_map in ((1e-9, start), (1 - 1e-9, end)):
        slack = 1e-7 * (1 + path.length) * (1 + given_map.scale_factor(POINTS))[:, None]
        assert (np.abs(path(t)(POINTS) - given_map(POINTS)) < slack).all()


@given(maps(st.floats(0.05, 20)), maps(st.floats(0.05, 20)), TIMES)
def test_the_fisheyes_follow_the_geodesic_at_constant_speed(start, end, t):
    path = GroupPath(start, end)
    a, b, c = place(start), place(end), place(path(t))
    assert path.length == pytest.approx(distance(a, b), abs=1e-6)
    assert distance(a, c) == pytest.approx(t * path.length, abs=1e-5)
    assert distance(c, b) == pytest.approx((1 - t) * path.length, abs=1e-5)


@given(ROTATIONS, ROTATIONS, TIMES)
def test_between_rotations_all_are_rotations(first, second, t):
    start, end = MoebiusMap.rotation(first), MoebiusMap.rotation(second)
    between = GroupPath(start, end)(t)
    assert between.magnification == 1
    if abs(np.trace((end @ start.inverse()).matrix[:3, :3]) + 1) > 1e-6:
        assert between.is_close((end @ start.inverse()).power(t) @ start, tolerance=1e-12)


@given(BETWEEN_POLES, BETWEEN_POLES, st.floats(1, 1e6), st.floats(1, 1e6), TIMES)
def test_a_flight_is_made_of_fisheyes(start, end, first, last, t):
    lens = flight(start, end, magnification=first, arrival=last)(t)
    assert lens.is_close(fisheye(lens.focus, magnification=lens.magnification), tolerance=1e-14)
    assert 1 <= lens.magnification <= max(first, last) * (1 + 1e-9)


@given(MAPS, MAPS, ROTATIONS, ROTATIONS, TIMES)
@examples(0.2)
def test_paths_turn_with_what_they_join(start, end, before, after, t):
    left, right = MoebiusMap.rotation(after), MoebiusMap.rotation(before)
    here, there = GroupPath(start, end), GroupPath(left @ start @ right, left @ end @ right)
    assert there.length == pytest.approx(here.length, rel=1e-9, abs=1e-9)
    if here(t).magnification < 1e3 and abs(here._turn[1] - 180) > 1e-3:
        assert there(t).is_close(left @ here(t) @ right, tolerance=1e-9)


def test_how_deep_a_flight_goes():
    # At a right angle the middle is at sinh η = √2 sinh η₁ / √(2 + 2 cosh² η₁), which tends to 1.
    assert flight((0, 0), (90, 0), magnification=1e8)(0.5).magnification == pytest.approx(1 + np.sqrt(2), rel=1e-12)
    assert flight((0, 0), (180, 0), magnification=1e3)(0.5).magnification == pytest.approx(1, rel=1e-9)
    assert flight((0, 0), (1, 0), magnification=1.5)(0.5).magnification == pytest.approx(1.5, rel=1e-4)
    assert flight((0, 0), (90, 0), magnification=0.125)(0.5).magnification == pytest.approx(2.31435990910008, rel=1e-12)
