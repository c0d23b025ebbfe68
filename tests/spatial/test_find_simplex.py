"""`Delaunay.find_simplex`: exact inside, SciPy's tolerance at the hull and around triangles without a transform."""

import itertools

import numpy as np
import pytest
import scipy.spatial
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay
from stereodel.spatial import Delaunay, barycentric
from tests.spatial.oracle import random_points


def coordinates(tri, found, queries):
    first = np.einsum("nij,nj->ni", tri.transform[found, :2], queries - tri.transform[found, 2])
    return np.column_stack([first, 1 - first.sum(axis=1)])


def hull_queries(tri, seed=0):
    """Points of the hull's sides as floating point gives them: half of them are just outside."""
    a, b = tri.points[tri.convex_hull].transpose(1, 0, 2)
    share = np.random.default_rng(seed).random((len(a), 200, 1))
    return ((1 - share) * a[:, None] + share * b[:, None]).reshape(-1, 2)


def test_inside_as_scipy_and_as_exact():
    points = random_points()
    ours, theirs = Delaunay(points), scipy.spatial.Delaunay(points)
    queries = np.random.default_rng(1).uniform(-0.2, 1.2, (3000, 2))
    mine, other = ours.find_simplex(queries), theirs.find_simplex(queries)
    np.testing.assert_array_equal(mine < 0, other < 0)
    np.testing.assert_array_equal(
        np.sort(ours.simplices[mine[mine >= 0]]), np.sort(theirs.simplices[other[other >= 0]])
    )
    np.testing.assert_array_equal(ours.find_simplex(queries, True), mine)
    np.testing.assert_array_equal(PlanarDelaunay(points).find_simplex(queries), mine)


@pytest.mark.parametrize(("offset", "tol"), [(0.0, 1e-12), (100.0, 1e-10)])
def test_rounded_points_of_the_hull_are_inside(offset, tol):
    ours = Delaunay(random_points() + offset)
    theirs = scipy.spatial.Delaunay(ours.points)
    queries = hull_queries(ours)
    exact = ours.find_simplex(queries, tol=0)
    assert (exact < 0).any()
    np.testing.assert_array_equal(exact, PlanarDelaunay(ours.points).find_simplex(queries))
    found = ours.find_simplex(queries, tol=tol)
    assert (theirs.find_simplex(queries, tol=tol) >= 0).all()
    assert (found >= 0).all()
    assert coordinates(ours, found, queries).min() >= -tol


@given(st.integers(0, 2**32), st.sampled_from([1e-12, 1e-6, 1e-3]))
def test_no_coordinate_is_below_the_tolerance(seed, tol):
    rng = np.random.default_rng(seed)
    tri = Delaunay(rng.random((12, 2)))
    ends = tri.points[tri.convex_hull]
    outward = (ends[:, 1] - ends[:, 0])[:, ::-1] * [1, -1]
    queries = (ends.mean(axis=1)[:, None] + outward[:, None] * rng.uniform(0, 3 * tol, (1, 40, 1))).reshape(-1, 2)
    every = barycentric.coordinates(tri.transform, queries[:, None]).min(axis=2)
    found = tri.find_simplex(queries, tol=tol)
    inside = found >= 0
    assert (every[np.flatnonzero(inside), found[inside]] >= -tol).all()
    assert not inside[(every < -tol).all(axis=1)].any()


def test_points_of_triangles_without_transform_are_given_to_a_neighbor_with_one():
    line = np.column_stack([np.linspace(0, 1, 30), np.linspace(0, 1, 30) / 3])
    tri = Delaunay(np.concatenate([line, [[0.5, 2.0], [0.2, -2.0]]]))
    assert (
        np.isnan(tri.transform[:, 0, 0]).any() == np.isnan(scipy.spatial.Delaunay(tri.points).transform[:, 0, 0]).any()
    )
    hull = Delaunay(np.concatenate([line, [[0.5, 2.0]]]))
    assert np.isnan(hull.transform[:, 0, 0]).any()
    slivers = hull.points[hull.simplices[np.isnan(hull.transform[:, 0, 0])]].mean(axis=1)
    found = hull.find_simplex(slivers)
    assert (found >= 0).all()
    assert coordinates(hull, found, slivers).min() > -1e-7
    assert (hull.find_simplex(hull_queries(hull)) >= 0).all()


def test_leeway_towards_a_triangle_without_transform():
    assert Delaunay([[0, 0], [1, 1e-14], [2, 0]]).find_simplex([[1, 1e-15], [1, 1]]).tolist() == [0, -1]
    tri = Delaunay([[0, 0], [2, 0], [1, 1.5e-13], [1, 1]])
    thin = int(np.flatnonzero(np.isnan(tri.transform[:, 0, 0]))[0])
    inside = tri.points[tri.simplices[thin]].mean(axis=0)
    assert [tri.find_simplex(inside, tol=tol) for tol in (0, 1e-30)] == [thin, thin]
    other = tri.find_simplex(inside, tol=1e-15)
    assert other in tri.neighbors[thin]
    assert -3e-8 < barycentric.coordinates(tri.transform[other], inside).min() < -1e-15


@pytest.mark.parametrize("corners", [5, 40, 200])
def test_a_larger_tolerance_loses_nothing(corners):
    turn = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    tri = Delaunay(np.column_stack([np.cos(turn), np.sin(turn)]))
    queries = hull_queries(tri)
    inside = [tri.find_simplex(queries, tol=tol) >= 0 for tol in (0, 1e-16, None, 1e-12, 1e-9, 1e-6, 1e-3, 1)]
    for less, more in itertools.pairwise(inside):
        assert not (less & ~more).any()
    assert inside[-1].all()


@pytest.mark.parametrize("shape", [(), (0,), (5,), (2, 3)])
def test_shape_and_type(shape):
    found = Delaunay(random_points()).find_simplex(np.full((*shape, 2), 0.5))
    assert isinstance(found, np.ndarray)
    assert found.shape == shape
    assert found.dtype == np.int32


@pytest.mark.parametrize("size", [1e-310, 1e-200, 1e-20, 1e150, 1e300])
def test_any_size(size):
    tri = Delaunay(random_points() * size)
    queries = np.concatenate([random_points(50, 1) * size, [[-3 * size, size], [1.7e308, -1.7e308], [-1e-320, 0]]])
    exact = PlanarDelaunay(tri.points).find_simplex(queries)
    np.testing.assert_array_equal(tri.find_simplex(queries, tol=0), exact)
    np.testing.assert_array_equal(tri.find_simplex(queries, True), exact)
    assert (tri.find_simplex(tri.points) >= 0).all()


def test_what_is_not_finite_is_outside():
    tri = Delaunay(random_points())
    queries = [[0.5, 0.5], [np.nan, 0.5], [0.5, np.inf], [-np.inf, np.nan]]
    expected = scipy.spatial.Delaunay(tri.points).find_simplex(queries) >= 0
    assert (tri.find_simplex(queries) >= 0).tolist() == expected.tolist() == [True, False, False, False]


def test_adding_points_forgets_what_was_known_of_the_hull():
    tri = Delaunay([[0, 0], [1, 0], [0, 1]], incremental=True)
    outside = [[1 + 1e-15, 0]]
    assert tri.find_simplex(outside) == [0]
    tri.add_points([[2, 0]])
    assert tri.find_simplex([[2 + 1e-15, 0]]) >= 0
    assert tri.find_simplex(outside) >= 0
