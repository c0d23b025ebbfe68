"""Motions: where they begin and end, that they go smoothly and by the shortest way, and what is refused."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from stereodel import MoebiusMap, fisheye, lonlat_to_xyz
from stereodel.conformal import GroupPath
from stereodel.drawing import StereographicView, View
from stereodel.film import Flight, Morph, Spin, Stop
from stereodel.film.shots import eased
from stereodel.sphere import angular_distance
from tests.examples import examples
from tests.refused import refused

PARIS, NEW_YORK, TOKYO = (2.35, 48.86), (-74.0, 40.7), (139.7, 35.7)
PLACES = st.tuples(st.floats(-180, 180), st.floats(-89, 89))
STOPS = st.builds(Stop, PLACES, st.floats(1, 50), st.floats(0, 3))


def far_from_opposite(stops):
    xyz = lonlat_to_xyz([stop.focus for stop in stops])
    return angular_distance(xyz[1:], xyz[:-1]).max() < 175


def middle(view):
    return lonlat_to_xyz((view.lon, view.lat))


@given(st.lists(STOPS, min_size=2, max_size=3))
def test_stops_are_held_and_between_them_nothing_jumps(stops):
    assume(far_from_opposite(stops))
    trip = Flight(stops)
    assert (trip(-5.0), trip(1e6)) == (trip(0.0), trip(trip.seconds))
    at = stops[0].hold
    ends = [0.0, at]
    for leg, stop in zip(trip._legs, stops[1:], strict=True):
        at += leg.seconds
        ends += [at, at + stop.hold]
        at += stop.hold
    assert trip.seconds == pytest.approx(at)
    for time, stop in zip(ends, np.repeat(stops, 2), strict=True):
        lens, view = trip(time)
        assert lens.is_close(stop.lens, tolerance=1e-6)
        assert np.allclose(view.matrix, View(*stop.focus).matrix, atol=1e-6)


@examples(0.5)
@given(STOPS, STOPS)
def test_the_globe_turns_no_faster_than_it_may(start, end):
    assume(far_from_opposite([start, end]))
    trip = Flight([start, end])
    times = np.linspace(start.hold, trip.seconds - end.hold, 40)
    middles = np.stack([middle(trip(time)[1]) for time in times])
    step = (trip.seconds - start.hold - end.hold) / 39
    # Twice as long for 1 rad as for e, and at most 1.5 times the mean speed by the easing; legs are cut into 256 parts.
    assert np.radians(angular_distance(middles[1:], middles[:-1])).max() <= 1.5 * 0.5 * step * 1.1 + 1e-6


def test_the_way_is_a_great_circle_and_the_lens_lets_go_no_more_than_it_must():
    trip = Flight([Stop(NEW_YORK, 8.0, hold=0.0), Stop(TOKYO, 8.0, hold=0.0)])
    normal = np.cross(lonlat_to_xyz(NEW_YORK), lonlat_to_xyz(TOKYO))
    sizes = []
    for time in np.linspace(0, trip.seconds, 41):
        lens, view = trip(time)
        assert abs(middle(view) @ normal) < 1e-12
        assert angular_distance(lens.focus, middle(view)) < 12
        sizes.append(lens.magnification)
    assert sizes == pytest.approx(sizes[::-1])
    lowest = int(np.argmin(sizes))
    assert lowest == 20
    assert (np.diff(sizes[:21]) < 0).all()
    # The middle of the chord of two points of the hyperboloid, at distance ln 8 in directions δ apart.
    a, delta = np.log(8.0), np.radians(angular_distance(lonlat_to_xyz(NEW_YORK), lonlat_to_xyz(TOKYO)))
    assert sizes[20] == pytest.approx(np.exp(np.arctanh(np.tanh(a) * np.cos(delta / 2))))


def test_up_turns_evenly_near_a_pole():
    """From coast to coast of the Arctic: north is up at both ends, and the picture does not whirl in between."""
    trip = Flight([Stop((0.0, 85.0), hold=0.0), Stop((170.0, 85.0), hold=0.0)])
    matrices = [trip(time)[1].matrix for time in np.linspace(0, trip.seconds, 200)]
    turns = [np.degrees(np.arccos(np.clip((np.trace(a.T @ b) - 1) / 2, -1, 1))) for a, b in pairwise(matrices)]
    assert sum(turns) < 185
    assert max(turns) < 3


def test_growing_on_the_spot_is_even_in_ratios():
    trip = Flight([Stop(PARIS, hold=0.0), Stop(PARIS, 8.0, hold=0.0)], pace=2.0)
    assert trip.seconds == pytest.approx(2 * np.log(8))
    lens, view = trip(trip.seconds / 2)
    assert lens.magnification == pytest.approx(8**0.5)
    assert (view.lon, view.lat, view.roll) == pytest.approx((*PARIS, 0.0))


def test_spinning_is_eastward_and_closes():
    spin = Spin(fisheye(PARIS, magnification=4.0), seconds=8.0, lon=10.0, lat=-30.0)
    assert spin(0.0) == (fisheye(PARIS, magnification=4.0), View(10.0, -30.0))
    assert spin(2.0)[1] == View(-80.0, -30.0)
    assert np.allclose(spin(8.0)[1].matrix, View(10.0, -30.0).matrix)
    assert Spin(turns=-0.5)(10.0)[1] == View(180.0, 20.0)
    assert Spin()(1.0)[0] == MoebiusMap.identity()


def test_a_morph_follows_its_path_there_and_back():
    path = GroupPath(MoebiusMap.identity(), fisheye(TOKYO, magnification=9.0))
    there, back = (Morph(path, StereographicView(*TOKYO), seconds=2.0, back=back) for back in (False, True))
    assert all(there(time)[0] == path(t) for time, t in ((-1.0, 0.0), (1.0, 0.5), (2.0, 1.0), (9.0, 1.0)))
    assert all(back(time)[0] == path(t) for time, t in ((0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (1.5, 0.5), (2.0, 0.0)))
    assert there(0.3)[1] == StereographicView(*TOKYO)


@given(st.floats(0, 1), st.floats(0, 1))
def test_easing_rises_and_is_symmetric(one, other):
    low, high = sorted((one, other))
    assert 0 <= eased(low) <= eased(high) + 1e-15 <= 1 + 1e-15
    assert eased(1 - one) == pytest.approx(1 - eased(one), abs=1e-12)


test_bad_motions_are_refused = refused(
    (lambda: Flight([Stop(PARIS)]), "stops has 1 entries, but a flight has two or more"),
    (lambda: Flight([Stop(PARIS), Stop((10, 20)), Stop((-170, -20))]), r"stops\[2\] is opposite stops\[1\]"),
    (lambda: Flight([Stop(PARIS), Stop(TOKYO)], pace=0.0), "pace"),
    *((lambda wrong=wrong: Stop(PARIS, wrong), "magnification") for wrong in (0.0, 0.9, -1.0, np.nan, np.inf)),
    (lambda: Stop((48.86, 235.0)), "focus"),
    (lambda: Stop(PARIS, hold=-1.0), "hold"),
    *((lambda wrong=wrong: Spin(seconds=wrong), "seconds") for wrong in (0.0, np.nan)),
    (lambda: Morph(GroupPath(MoebiusMap.identity(), MoebiusMap.identity()), View(0, 0), seconds=0.0), "seconds"),
)
