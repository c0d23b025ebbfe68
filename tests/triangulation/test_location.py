"""find_simplex and nearest, against asking everything."""

import itertools
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf, workdps

from stereodel import _kernel_probe as probe
from stereodel.predicates import orient2d
from stereodel.triangulation import PlanarDelaunay, SphericalDelaunay

GRID_POINT = st.tuples(st.integers(-4, 4), st.integers(-4, 4))
HALF_POINT = st.tuples(st.integers(-9, 9), st.integers(-9, 9)).map(lambda p: (p[0] / 2, p[1] / 2))
SMALL = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)


def holders(triangulation, query):
    """All triangles that hold a query, boundary included."""
    corners = triangulation.points[triangulation.simplices]
    if corners.shape[2] == 2:
        inside = [orient2d(corners[:, k - 2], corners[:, k - 1], query) >= 0 for k in range(3)]
        return np.flatnonzero(np.all(inside, axis=0))
    queries = np.broadcast_to(np.asarray(query, dtype=float), corners[:, 0].shape)
    inside = [probe.turn(corners[:, k - 2], corners[:, k - 1], queries) >= 0 for k in range(3)]
    return np.flatnonzero(np.all(inside, axis=0) & ~triangulation.closing)


def lowest_holder(triangulation, query):
    return int(min(holders(triangulation, query), default=-1))


@given(st.lists(GRID_POINT, min_size=3, max_size=12), st.lists(HALF_POINT, min_size=1, max_size=8))
def test_find_simplex_on_edges_and_vertices_of_the_plane(points, queries):
    triangulation = PlanarDelaunay(points)
    assert triangulation.find_simplex(queries).tolist() == [lowest_holder(triangulation, q) for q in queries]


@given(st.lists(SMALL, min_size=3, max_size=12), st.lists(SMALL, min_size=1, max_size=8))
def test_find_simplex_on_edges_and_vertices_of_the_sphere(points, queries):
    triangulation = SphericalDelaunay(points)
    assert triangulation.find_simplex(queries).tolist() == [lowest_holder(triangulation, q) for q in queries]


@pytest.mark.parametrize("spread", [1.0, 1e-3, 1e-9, 1e-13])
def test_find_simplex_in_clusters(spread):
    rng = np.random.default_rng(0)
    center = rng.normal(size=3)
    triangulation = SphericalDelaunay(center + spread * rng.normal(size=(80, 3)))
    queries = center + spread * rng.normal(size=(60, 3))
    found = triangulation.find_simplex(queries)
    assert found.tolist() == [lowest_holder(triangulation, q) for q in queries]
    if spread < 1:
        assert (triangulation.find_simplex(-triangulation.points) == -1).all()


def test_find_simplex_in_a_large_plane():
    rng = np.random.default_rng(1)
    triangulation = PlanarDelaunay(rng.random((800, 2)))
    queries = rng.random((400, 2)) * 1.2 - 0.1
    assert triangulation.find_simplex(queries).tolist() == [lowest_holder(triangulation, q) for q in queries]


@pytest.mark.parametrize("scale", [1e150, 1e-150, 5e-324])
def test_find_simplex_far_out_of_range(scale):
    points = np.array(list(itertools.product(range(5), repeat=2))) * scale
    triangulation = PlanarDelaunay(points)
    queries = np.vstack([points, points + scale, [[0.0, 0.0]]])
    assert triangulation.find_simplex(queries).tolist() == [lowest_holder(triangulation, q) for q in queries]


def test_a_vertex_is_found_in_its_lowest_triangle():
    triangulation = PlanarDelaunay(np.array(list(itertools.product(range(6), repeat=2)), dtype=float))
    first = [int(np.flatnonzero((triangulation.simplices == v).any(axis=1))[0]) for v in range(36)]
    assert triangulation.find_simplex(triangulation.points).tolist() == first


def exact_nearest_in_plane(points, query):
    squares = [sum((Fraction(x) - Fraction(y)) ** 2 for x, y in zip(p, query, strict=True)) for p in points]
    return squares.index(min(squares))


def exact_nearest_on_sphere(points, query):
    """With 60 digits; equal cosines of small integers agree to all of them."""
    with workdps(60):
        cosines = []
        for p in points:
            length = mp.sqrt(mp.fsum(mpf(float(x)) ** 2 for x in p))
            cosines.append(mp.fsum(mpf(float(x)) * mpf(float(y)) for x, y in zip(p, query, strict=True)) / length)
        return next(k for k, c in enumerate(cosines) if c > max(cosines) - mpf(10) ** -50)


@given(st.lists(GRID_POINT, min_size=1, max_size=10), st.lists(HALF_POINT, min_size=1, max_size=8))
def test_nearest_in_the_plane_with_ties(points, queries):
    expected = [exact_nearest_in_plane(points, q) for q in queries]
    assert PlanarDelaunay(points).nearest(queries).tolist() == expected


@given(st.lists(SMALL, min_size=1, max_size=10), st.lists(SMALL, min_size=1, max_size=8))
def test_nearest_on_the_sphere_with_ties(points, queries):
    expected = [exact_nearest_on_sphere(points, q) for q in queries]
    assert SphericalDelaunay(points).nearest(queries).tolist() == expected


@pytest.mark.parametrize("spread", [1.0, 1e-6, 1e-12, 1e-15])
def test_nearest_in_clusters(spread):
    rng = np.random.default_rng(2)
    center = rng.normal(size=3)
    points, queries = center + spread * rng.normal(size=(60, 3)), center + spread * rng.normal(size=(20, 3))
    expected = [exact_nearest_on_sphere(points, q) for q in queries]
    assert SphericalDelaunay(points).nearest(queries).tolist() == expected


@given(st.lists(st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 2), min_size=1, max_size=5), st.data())
def test_nearest_of_any_doubles(points, data):
    query = data.draw(st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 2))
    assert PlanarDelaunay(points).nearest(query) == exact_nearest_in_plane(points, query)


def test_nearest_on_a_circle_of_rounded_points():
    """Their squared distances differ by less than those are rounded."""
    rng = np.random.default_rng(0)
    for query in rng.random((20, 2)):
        angle = rng.random(400) * 2 * np.pi
        points = query + 3 * np.column_stack([np.cos(angle), np.sin(angle)])
        assert PlanarDelaunay(points).nearest(query) == exact_nearest_in_plane(points.tolist(), query.tolist())


def test_nearest_where_squares_underflow():
    """As doubles the squared distances are 0 + 0 and 5e-324."""
    assert PlanarDelaunay(np.array([[1.5, 1.5], [1.6, 0.0]]) * 1e-162).nearest([0, 0]) == 1


def test_nearest_in_parts():
    rng = np.random.default_rng(3)
    points, queries = rng.random((3000, 2)), rng.random((1000, 2))
    squares = ((queries[:, None] - points[None]) ** 2).sum(axis=2)
    assert np.array_equal(PlanarDelaunay(points).nearest(queries), squares.argmin(axis=1))


@pytest.mark.parametrize("length", range(3, 20))
def test_nearest_below_the_error_of_the_unit_vectors(length):
    """Directions 1e-40 rad apart: the unit vectors themselves are off by 1e-32 or so."""
    points = [[1, 1, 1e-40], [length, length, length * 2e-40]]
    queries = [[7, 7, 7 * 1.9e-40], [5, 5, 5 * 1.1e-40], [11, 11, 0]]
    assert SphericalDelaunay(points).nearest(queries).tolist() == [1, 0, 0]


def test_nearest_to_the_antipode():
    points = [[0, 0, 1], [1e-9, 0, 1], [0, 1e-9, 1]]
    assert SphericalDelaunay(points).nearest([-1e-9, -1e-10, -1.0]) == 2
    assert SphericalDelaunay(points).nearest([1e-9, 0, -1.0]) == 1


def test_shapes():
    plane, sphere = PlanarDelaunay(np.random.default_rng(0).random((9, 2))), SphericalDelaunay(np.eye(3))
    for triangulation, width in ((plane, 2), (sphere, 3)):
        for method in (triangulation.find_simplex, triangulation.nearest):
            assert method(np.ones((4, 5, width))).shape == (4, 5)
            assert method(np.ones((4, width))).dtype == np.int32
            assert type(method(np.ones(width))) is int
            assert method(np.ones((0, width))).shape == (0,)


@pytest.mark.parametrize(
    "triangulation",
    [
        PlanarDelaunay([[0, 0]]),
        PlanarDelaunay([[0, 0], [1, 1], [2, 2]]),
        PlanarDelaunay([]),
    ],
    ids=repr,
)
def test_no_triangles_hold_nothing(triangulation):
    assert triangulation.find_simplex([[0, 0], [1, 1]]).tolist() == [-1, -1]
    assert triangulation.find_simplex([0, 0]) == -1


def test_flat_sets_have_nearest_points():
    assert PlanarDelaunay([[0, 0], [1, 1], [2, 2]]).nearest([[3, 3], [0.4, 0.4], [0, 1]]).tolist() == [2, 0, 0]
    assert SphericalDelaunay([[1, 0, 0], [-1, 0, 0]]).nearest([[0, 1, 0], [-1, 9, 0]]).tolist() == [0, 1]


@pytest.mark.parametrize("triangulation", [PlanarDelaunay([]), SphericalDelaunay([])], ids=repr)
def test_nothing_is_nearest_among_no_points(triangulation):
    with pytest.raises(ValueError, match="at least one point"):
        triangulation.nearest(np.ones((1, triangulation.points.shape[1])))


def test_bad_queries_are_named():
    with pytest.raises(ValueError, match=r"xy must have shape"):
        PlanarDelaunay([[0, 0]]).find_simplex([1, 2, 3])
    with pytest.raises(ValueError, match=r"xyz\[0\] is the zero vector"):
        SphericalDelaunay(np.eye(3)).nearest([[0, 0, 0]])
