"""What comes before the first facet."""

import numpy as np
import pytest

from stereodel.triangulation.hull_insertion import insertion_order, spanning_points
from stereodel.triangulation.sites import PlaneSites, RaySites


def spanning(points):
    array = np.array(points, dtype=float)
    sites = PlaneSites() if array.shape[1] == 2 else RaySites()
    sites.extend(array)
    return spanning_points(sites, range(len(array)))


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        (np.zeros((0, 2)), []),
        ([[1, 1]], [0]),
        ([[1, 1], [2, 2], [3, 3]], [0, 1]),
        ([[1, 1], [2, 2], [3, 3], [1e-300, 0]], [0, 1, 3]),
        ([[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]], [0, 1]),
        ([[0, 0], [0.1, 0.3], [0.2, 0.6], [0.3, 0.9]], [0, 1, 3]),  # 0.9 is not three times the double 0.3
        ([[1, 0, 0], [-1, 0, 0]], [0, 1]),
        ([[1, 0, 0], [-2, 0, 0], [0, 1, 0], [0, -1, 0]], [0, 2]),
        ([[1, 0, 0], [-2, 0, 0], [0, 1, 0], [0, -1, 1e-300]], [0, 2, 3]),
        ([[1, 2, 3], [2, 4, 7], [3, 6, 1], [0, 0, 1]], [0, 1]),
    ],
)
def test_the_first_points_that_span(points, expected):
    assert spanning(points) == expected


@pytest.mark.parametrize("scale", [1.0, 1e300, 1e-310])
@pytest.mark.parametrize("dimension", [2, 3])
def test_the_order_of_insertion_takes_each_point_once(scale, dimension):
    points = np.random.default_rng(0).normal(size=(500, dimension)) * scale
    assert sorted(insertion_order(points)) == list(range(500))


def test_the_order_of_insertion_goes_short_ways():
    points = np.random.default_rng(0).random((4096, 2))
    steps = np.linalg.norm(np.diff(points[insertion_order(points)], axis=0), axis=1)
    assert np.median(steps) < 0.05 < np.median(np.linalg.norm(np.diff(points, axis=0), axis=1))


def test_the_order_of_no_points_and_equal_points():
    assert insertion_order(np.zeros((0, 2))).tolist() == []
    assert sorted(insertion_order(np.ones((3, 2)))) == [0, 1, 2]
