"""The point sets of the benchmarks are what they say."""

import numpy as np
import pytest

from benchmarks.distributions import FOR_DIRECTIONS, PLANE, REAL, SPHERE, make

ALL = [(space, name) for space, named in (("plane", PLANE), ("sphere", SPHERE)) for name in named if name not in REAL]


@pytest.mark.parametrize(("space", "name"), ALL)
def test_size_shape_and_seed(space, name):
    points = make(space, name, 3000)
    assert points.shape[1] == {"plane": 2, "sphere": 3}[space]
    assert 2500 < len(points) < 3500
    assert np.isfinite(points).all()
    assert points.flags.c_contiguous
    assert (points == make(space, name, 3000)).all()
    assert (points[:100] != make(space, name, 3000, seed=2)[:100]).any()
    if space == "sphere" and name not in FOR_DIRECTIONS:
        assert np.abs((points**2).sum(axis=1) - 1).max() < 1e-15


def test_the_exact_circle_is_one():
    points = make("plane", "exact circle", 20_000)
    norms = {int(x) ** 2 + int(y) ** 2 for x, y in points.tolist()}
    assert len(norms) == 1
    assert len(np.unique(points, axis=0)) == len(points) == 20_000


def test_the_graticule_repeats_its_poles_and_its_date_line():
    points = make("sphere", "graticule", 2000)
    k = 32
    assert len(points) == (2 * k + 1) * (k + 1)
    assert len(np.unique(points, axis=0)) == 2 * k * (k - 1) + 2
