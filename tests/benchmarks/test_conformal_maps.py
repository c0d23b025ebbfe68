"""The measurement of conformal maps: every call is made in every round, both sides compute the same map."""

import numpy as np

from benchmarks.benchmark_page import conformal_maps as table
from benchmarks.conformal_maps import coastline, conformal_maps
from benchmarks.rounds import in_turns


def test_calls_take_turns():
    made = []
    found = in_turns({"a": lambda: made.append("a"), "b": lambda: made.append("b")}, "a", rounds=3)
    assert made == ["a", "b"] * 4
    assert len(found["b"]["rounds"]) == 3
    assert found["a"]["ratios"] == [1.0] * 3
    assert set(in_turns({"a": list}, rounds=2)["a"]) == {"seconds", "rounds"}


def test_coastline_points_are_as_many_as_asked_and_different():
    points = coastline(200_000)
    assert points.shape == (200_000, 2)
    assert len(np.unique(points, axis=0)) > 190_000


def test_both_sides_compute_the_same_map_and_the_page_tells_it():
    measured = conformal_maps(1000)
    assert measured["places"]["largest gap in degrees"] < 1e-9
    lines = table({"conformal maps": measured}).splitlines()
    assert len(lines) == 2 + 9
