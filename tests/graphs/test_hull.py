"""Corners of hulls against what they must do: hold all points, turn left at each corner, or not exist."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay, orient2d
from stereodel.graphs import hull
from stereodel.predicates.integers import sign
from stereodel.predicates.rays import ray, turn_ray

GRID_POINT = st.tuples(st.integers(-3, 3), st.integers(-3, 3))
DIRECTION = st.tuples(*[st.integers(-2, 2)] * 3).filter(any)


def triangulate(points):
    points = np.asarray(points, dtype=float)
    triangulation = (PlanarDelaunay if points.shape[1] == 2 else SphericalDelaunay)(points)
    check_delaunay(triangulation)
    return triangulation


def corners(triangulation):
    found = hull(triangulation)
    assert found.dtype == np.int32
    assert not found.flags.writeable
    assert not set(found.tolist()) & set(triangulation.duplicates[:, 0].tolist())
    assert len(found) == 0 or found[0] == found.min()
    return found.tolist()


def prove_in_plane(points):
    triangulation = triangulate(points)
    found, points = corners(triangulation), triangulation.points
    if triangulation.dimension < 2:
        ends = sorted(set(map(tuple, points.tolist())))
        assert {tuple(points[k]) for k in found} == {*ends[:1], *ends[-1:]}
        return
    for a, b, c in zip(found, np.roll(found, -1), np.roll(found, -2), strict=True):
        assert orient2d(points[a], points[b], points[c]) > 0
        assert (orient2d(points[a], points[b], points) >= 0).all()


def cross(a, b):
    (x, y, z), (u, v, w) = a[:3], b[:3]
    return y * w - z * v, z * u - x * w, x * v - y * u


def holds_centre(rays):
    """Whether the centre lies in the convex hull of directions: in a segment, triangle or tetrahedron of them."""

    def dot(a, b):
        return sum(x * y for x, y in zip(a[:3], b[:3], strict=True))

    def pair(a, b):
        return not any(cross(a, b)) and dot(a, b) < 0

    def triple(a, b, c):
        """Of a plane through the centre: all three turns the same way."""
        if turn_ray(a, b, c):
            return False
        products = [cross(a, b), cross(b, c), cross(c, a)]
        return all(dot(p, q) > 0 for p, q in combinations(products, 2))

    def quadruple(*four):
        """The centre is on the inner side of all faces."""
        sides = {(-1) ** k * turn_ray(*four[:k], *four[k + 1 :]) for k in range(4)}
        return sides in ({1}, {-1})

    tests = ((pair, 2), (triple, 3), (quadruple, 4))
    return any(test(*some) for test, size in tests for some in combinations(rays, size))


def prove_on_sphere(points):
    triangulation = triangulate(points)
    found = corners(triangulation)
    rays = [ray(p) for p in triangulation.points.tolist()]
    assert (found == []) == (len(rays) == 0 or holds_centre(sorted(set(rays))))
    for a, b, c in zip(found, np.roll(found, -1), np.roll(found, -2), strict=True):
        if len(found) > 2:
            assert turn_ray(rays[a], rays[b], rays[c]) > 0
            assert min(turn_ray(rays[a], rays[b], r) for r in rays) >= 0
    if len(found) == 2:
        a, b = (rays[k] for k in found)
        assert all(turn_ray(a, b, r) == 0 for r in rays)
        assert all(is_between(a, r, b) for r in rays)


def is_between(a, r, b):
    """On the short arc: not beyond either end, as seen along the axis."""
    axis = cross(a, b)
    normal = (*axis, sum(x * x for x in axis))
    return turn_ray(normal, a, r) >= 0 and turn_ray(normal, r, b) >= 0


@given(st.lists(GRID_POINT, min_size=1, max_size=15))
def test_plane(points):
    prove_in_plane(points)


@given(st.lists(DIRECTION, min_size=1, max_size=9))
def test_sphere(points):
    prove_on_sphere(points)


@given(st.lists(DIRECTION.filter(lambda p: p[2] > 0), min_size=1, max_size=12))
def test_within_a_hemisphere(points):
    prove_on_sphere(points)


def test_awkward_sets_of_the_plane(plane_set):
    prove_in_plane(plane_set)


def test_awkward_sets_of_the_sphere(sphere_set):
    prove_on_sphere(sphere_set)


@pytest.mark.parametrize("spread", [1e-3, 1e-12, 1e-15])
def test_cluster(spread):
    """A few ulps across, so that many points lie within sides."""
    rng = np.random.default_rng(6)
    prove_on_sphere(np.array([0.3, -0.5, 0.8]) + spread * rng.normal(size=(40, 3)))
    prove_in_plane(np.array([0.3, -0.5]) + spread * rng.normal(size=(40, 2)))


def test_same_as_the_plane_seen_from_the_centre():
    """The gnomonic projection keeps hulls."""
    flat = np.random.default_rng(7).normal(size=(200, 2))
    lifted = np.column_stack([flat, np.ones(200)])
    assert np.array_equal(hull(flat), hull(lifted))
    assert sign(len(hull(np.vstack([lifted, -lifted[:1]])))) == 0
