"""`stereodel.spatial.Voronoi`: attribute by attribute against SciPy, and where SciPy has no answer."""

import numpy as np
import pytest
import scipy.spatial
from hypothesis import given
from hypothesis import strategies as st

from stereodel.spatial import Voronoi
from tests import sets
from tests.spatial.oracle import SMALL_SETS, cycle, random_points, vertex_numbers


@pytest.mark.parametrize("points", [random_points(), sets.plane("small grid").points], ids=["random", "grid"])
@pytest.mark.parametrize("options", [None, "Qbb Qc", "Qc Qz"])
def test_same_cells_and_ridges(points, options):
    ours, theirs = Voronoi(points, qhull_options=options), scipy.spatial.Voronoi(points, qhull_options=options)
    number = vertex_numbers(theirs, ours)
    assert len(ours.regions) == len(theirs.regions)
    assert ours.regions.count([]) == theirs.regions.count([])
    for mine, other in zip(ours.point_region, theirs.point_region, strict=True):
        assert cycle(ours.regions[mine]) == cycle([number[v] for v in theirs.regions[other]])

    def ridges(diagram, number):
        rows = zip(diagram.ridge_points.tolist(), diagram.ridge_vertices, strict=True)
        return sorted((sorted(pair), sorted(number[v] for v in ends)) for pair, ends in rows)

    assert ridges(ours, [*range(len(ours.vertices)), -1]) == ridges(theirs, number)
    assert {frozenset(pair): sorted(ends) for pair, ends in ours.ridge_dict.items()} == {
        frozenset(pair): sorted(number[v] for v in ends) for pair, ends in theirs.ridge_dict.items()
    }
    for name in ("ndim", "npoints", "furthest_site"):
        assert getattr(ours, name) == getattr(theirs, name)
    for name in ("points", "min_bound", "max_bound"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))


def test_a_duplicate_has_the_region_of_its_point():
    points = np.concatenate([random_points(20), random_points(20)[:6], random_points(20)[:6] + 1e-14])
    ours, theirs = Voronoi(points), scipy.spatial.Voronoi(points[:26])
    np.testing.assert_array_equal(ours.point_region[20:26], ours.point_region[:6])
    np.testing.assert_array_equal(theirs.point_region[20:26], theirs.point_region[:6])
    assert len(ours.regions) == 1 + 26
    assert len(set(ours.point_region[:20]) | set(ours.point_region[26:])) == 26
    assert Voronoi(points, qhull_options="Qz").point_region[20:26].tolist() == [-1] * 6


@given(SMALL_SETS, st.lists(SMALL_SETS, max_size=3))
def test_adding_points_gives_the_diagram_of_all_points(first, others):
    vor = Voronoi(first, incremental=True)
    for k, more in enumerate(others):
        assert vor.point_region.shape == (vor.npoints,)
        vor.add_points(np.reshape(more, (-1, 2)), restart=bool(k % 2))
    vor.close()
    whole = Voronoi(vor.points, qhull_options="Qc")
    assert vor.regions == whole.regions
    assert vor.ridge_dict == whole.ridge_dict
    np.testing.assert_array_equal(vor.vertices, whole.vertices)
    np.testing.assert_array_equal(vor.point_region, whole.point_region)


@pytest.mark.parametrize(
    ("points", "regions", "ridges"),
    [
        (np.zeros((0, 2)), [[]], []),
        ([[1, 2]], [[], [-1]], []),
        ([[0, 0], [1, 1]], [[], [-1], [-1]], [[-1, -1]]),
        ([[0, 0], [1, 1], [3, 3], [0, 0]], [[], [-1], [-1], [-1]], [[-1, -1], [-1, -1]]),
        ([[0, 0], [1, 0], [0, 1]], [[], [-1, 0], [-1, 0], [-1, 0]], [[-1, 0]] * 3),
    ],
)
def test_small_sets(points, regions, ridges):
    vor = Voronoi(points)
    assert vor.regions == regions
    assert vor.ridge_vertices == ridges
    if len(vor.vertices) == 0:
        with pytest.raises((scipy.spatial.QhullError, ValueError)):
            scipy.spatial.Voronoi(points)
