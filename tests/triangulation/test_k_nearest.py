"""The k nearest points against sorting all of them by exact distance."""

from fractions import Fraction
from functools import cmp_to_key

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from stereodel import PlanarDelaunay, SphericalDelaunay, check_delaunay
from stereodel.predicates.integers import sign_of_roots
from stereodel.predicates.rays import ray

GRID_POINT = st.tuples(st.integers(-3, 3), st.integers(-3, 3))
HALF_POINT = st.tuples(st.integers(-8, 8), st.integers(-8, 8)).map(lambda p: (p[0] / 2, p[1] / 2))
DIRECTION = st.tuples(*[st.integers(-3, 3)] * 3).filter(any)
PLANE_SETS = {
    "one": [[1, 2]],
    "all the same": [[1, 2]] * 4,
    "line": [[k * k, 2 * k * k] for k in range(7)],
    "grid": [[i, j] for i in range(4) for j in range(4)],
    "circle": [[3, 4], [4, 3], [5, 0], [-3, 4], [0, -5], [-4, -3], [0, 0]],
    "cluster": [[1 + i * 1e-12, j * 1e-12] for i in range(3) for j in range(3)] + [[0, 0], [9, 9]],
    "large and small": [[1e150, 0], [0, 1e150], [1e-150, 0], [0, 0], [5e-324, 0], [-1, -1]],
}
SPHERE_SETS = {
    "one": [[0, 0, 2]],
    "opposite": [[0, 0, 1], [0, 0, -3]],
    "great circle": [[1, 0, 0], [0, 2, 0], [-1, 0, 0], [1, 1, 0], [2, 2, 0]],
    "small circle": [[3, 4, 1], [4, 3, 1], [5, 0, 1], [-3, 4, 1], [0, -5, 1]],
    "octahedron": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1], [0, 0, 7]],
    "hemisphere": [[i, j, 4] for i in range(-2, 3) for j in range(-2, 3)],
    "cluster": [[i * 1e-12, j * 1e-12, 1] for i in range(3) for j in range(3)] + [[1, 0, 0], [0, 0, -1]],
}


def plane_order(points, query):
    """All points by exact distance, then index."""
    exact = [Fraction(x) for x in query]

    def square(k):
        return sum((Fraction(x) - y) ** 2 for x, y in zip(points[k], exact, strict=True))

    return sorted(range(len(points)), key=lambda k: (square(k), k))


def sphere_order(points, query):
    """All directions by exact angle, then index."""
    q, rays = ray(query), [ray(p) for p in points]
    dots = [sum(x * y for x, y in zip(q[:3], r[:3], strict=True)) for r in rays]

    def compare(a, b):
        return sign_of_roots(((dots[b], rays[a][3]), (-dots[a], rays[b][3]))) or a - b

    return sorted(range(len(points)), key=cmp_to_key(compare))


def prove(triangulation, queries):
    """For all k: the first k of all points in order, whatever the number of threads."""
    check_delaunay(triangulation)
    order = plane_order if triangulation.points.shape[1] == 2 else sphere_order
    points, size = triangulation.points.tolist(), len(triangulation.points)
    wanted = [order(points, query) for query in np.array(queries, dtype=float).tolist()]
    assert triangulation.nearest(queries, k=size, workers=2).tolist() == wanted
    for k in {1, 2, size // 2} & set(range(1, size)):
        assert triangulation.nearest(queries, k=k).tolist() == [row[:k] for row in wanted]
    assert triangulation.nearest(queries).tolist() == [row[0] for row in wanted]


@given(st.lists(GRID_POINT, min_size=1, max_size=20), st.lists(HALF_POINT, min_size=1, max_size=8))
def test_plane_with_ties_and_duplicates(points, queries):
    prove(PlanarDelaunay(points), queries)


@given(st.lists(DIRECTION, min_size=1, max_size=20), st.lists(DIRECTION, min_size=1, max_size=8))
def test_sphere_with_ties_and_duplicates(points, queries):
    prove(SphericalDelaunay(points), queries)


@pytest.mark.parametrize("name", PLANE_SETS)
def test_awkward_sets_of_the_plane(name):
    prove(PlanarDelaunay(PLANE_SETS[name]), [*PLANE_SETS[name], [0.5, 0.5], [1e-3, -1e5], [1.5, 1.5]])


@pytest.mark.parametrize("name", SPHERE_SETS)
def test_awkward_sets_of_the_sphere(name):
    queries = [[0, 0, 1], [0, 0, -1], [1, 2, 3], [1e-12, 0, 1], [-1, 1e-3, 0], [1e200, 1e200, 0]]
    prove(SphericalDelaunay(SPHERE_SETS[name]), [*SPHERE_SETS[name], *queries])


SMALL = st.integers(-4, 4)
STEP = st.tuples(SMALL, SMALL).filter(any)
SCALE = st.sampled_from([1.0, 2.0**-30, 2.0**-990, 5e-324, 2.0**500])  # nothing is rounded


@given(st.lists(SMALL, min_size=1, max_size=12), STEP, SCALE, st.lists(HALF_POINT, min_size=1, max_size=6))
def test_points_of_one_line(places, step, scale, queries):
    """Any of them may be equal. Queries at the points and between them are exactly as near to two."""
    points = np.multiply.outer(places, step) * scale
    line = PlanarDelaunay(points)
    assert line.dimension == min(len(set(places)), 2) - 1
    prove(line, np.vstack([points, points / 2, np.array(queries) * scale]))


@given(st.lists(STEP, min_size=1, max_size=12), DIRECTION, DIRECTION, SCALE, st.lists(DIRECTION, max_size=5))
def test_directions_of_one_great_circle(places, u, v, scale, queries):
    """Also opposite ones, equal ones of different length, within half a circle; ends of the axis are as near to all."""
    axis = np.cross(u, v)
    plane = np.array([u, v])[: 2 if axis.any() else 1]
    points = np.array(places)[:, : len(plane)] @ plane
    points = points[points.any(axis=1)]
    if len(points):
        circle = SphericalDelaunay(points * scale)
        assert circle.dimension < 2
        asked = np.vstack([points, -points, points + points[0], axis, -axis, 1000 * axis + points[0], *queries])
        prove(circle, asked[asked.any(axis=1)] * scale)


@given(st.integers(1, 40), st.integers(0, 2**32 - 1), st.booleans())
def test_rounded_directions_of_one_great_circle(size, seed, is_short):
    """Doubles of length one around the equator or a small part of it: distances differ by roundings."""
    rng = np.random.default_rng(seed)
    angle = rng.random(size) * (1e-9 if is_short else 2 * np.pi)
    points = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(size)])
    near_axis = rng.normal(size=(3, 3)) * [1e-12, 1e-12, 1]
    prove(SphericalDelaunay(points), np.vstack([points[:3], rng.normal(size=(2, 3)), near_axis, [[0, 0, 1]]]))


@pytest.mark.parametrize("turn", range(8))
@pytest.mark.parametrize(
    "plane", [[[1, 0, 0], [0, 1, 0]], [[0, 1, 0], [0, 0, 1]], [[0, 0, 1], [1, 0, 0]], [[1, 2, 3], [4, 0, -1]]]
)
def test_around_a_great_circle_from_any_start(turn, plane):
    """Opposite directions among them, in every order; queries exactly between the last one and the first."""
    around = np.array([[1, 0], [4, 1], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [4, -1]])
    points = np.random.default_rng(turn).permutation(around) @ plane
    prove(SphericalDelaunay(points), np.vstack([points, around @ plane * 2 + points[0], np.cross(*plane)]))
    prove(SphericalDelaunay(np.array([[4, -1], [4, 1], [-1, 0], [0, 1]]) @ plane), [plane[0]])
    prove(SphericalDelaunay(np.array([[0, 1], [0, -1], [1, 0], [-1, 0]]) @ plane), points)


@pytest.mark.parametrize("width", [2, 3])
def test_many_equal_points_take_no_time(width):
    """Comparing all of them would take minutes."""
    rng = np.random.default_rng(4)
    make = PlanarDelaunay if width == 2 else SphericalDelaunay
    queries = rng.normal(size=(20_000, width))
    equal = make(np.ones((100_000, width)))
    assert not equal.nearest(queries).any()
    assert (equal.nearest(queries, k=8) == np.arange(8)).all()
    places = np.arange(100_000) % 50_000
    flat = make(np.column_stack([places, np.ones(100_000), np.zeros(100_000)])[:, :width])
    assert flat.dimension == 1
    asked = rng.integers(0, 50_000, 20_000)
    assert np.array_equal(flat.nearest(flat.points[asked]), asked)
    assert np.array_equal(flat.nearest(flat.points[asked], k=2), np.column_stack([asked, asked + 50_000]))
    if width == 3:
        assert not flat.nearest(np.tile([0, 0, 1], (20_000, 1))).any()


@pytest.mark.parametrize("width", [2, 3])
def test_many_equal_points_at_four_places_take_no_time(width):
    rng = np.random.default_rng(5)
    places = np.array([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])[:, :width]
    chosen = rng.integers(0, 4, 100_000)
    triangulation = (PlanarDelaunay if width == 2 else SphericalDelaunay)(places[chosen])
    queries = places * [[1.1, 1, 1]] if width == 3 else places * [[1.1, 1]]
    expected = [np.flatnonzero(chosen == place)[:8] for place in range(4)]
    assert np.array_equal(triangulation.nearest(np.repeat(queries, 500, axis=0), k=8), np.repeat(expected, 500, axis=0))
    center = np.tile([[0, 0, 1]], (500, 1))[:, :width]
    assert (triangulation.nearest(center, k=8) == np.arange(8)).all()
    rest = np.flatnonzero(chosen == 0)[:3000]
    assert triangulation.nearest(queries[0], k=len(expected[0]) + 3000).tolist()[:3000] == rest.tolist()


def test_in_a_cluster_far_from_everything():
    """Points 1e-13 rad apart, of any length: squared chords in doubles tell nothing."""
    rng = np.random.default_rng(1)
    points = np.array([0.3, -0.5, 0.8]) + 1e-13 * rng.normal(size=(25, 3))
    prove(SphericalDelaunay(points * rng.uniform(0.5, 9, size=(25, 1))), points[:6] * 3)


@pytest.mark.parametrize("width", [2, 3])
def test_many_against_a_tree(width):
    rng = np.random.default_rng(2)
    points, queries = rng.normal(size=(2, 5000, width))
    if width == 3:
        points /= np.linalg.norm(points, axis=1)[:, None]
        queries /= np.linalg.norm(queries, axis=1)[:, None]
    triangulation = (PlanarDelaunay if width == 2 else SphericalDelaunay)(points)
    check_delaunay(triangulation)
    found = triangulation.nearest(queries, k=40)
    assert np.array_equal(found, cKDTree(points).query(queries, k=40)[1])
    assert np.array_equal(triangulation.nearest(queries.reshape(50, 2, 50, width), k=7).reshape(-1, 7), found[:, :7])


def test_after_changes():
    rng = np.random.default_rng(3)
    triangulation = PlanarDelaunay(rng.integers(0, 12, size=(60, 2)))
    triangulation.insert(rng.integers(0, 12, size=(3, 2)))
    triangulation.remove([5, 17, 30])
    prove(triangulation, rng.integers(0, 24, size=(10, 2)) / 2)


def test_flat_sets_after_changes():
    """The order along the line is that of the points that are there."""
    line = PlanarDelaunay([[0, 0], [4, 4], [2, 2], [2, 2]])
    assert line.nearest([3, 3], k=4).tolist() == [1, 2, 3, 0]
    line.insert([[3, 3], [9, 9]])
    prove(line, [[3, 3], [0, 1], [7, 7]])
    line.remove([2, 4])
    prove(line, [[3, 3], [0, 1], [7, 7]])
    line.insert([[0, 9]])
    assert line.dimension == 2
    prove(line, [[3, 3], [0, 1], [7, 7]])
    line.remove([len(line.points) - 1])
    assert line.dimension == 1
    prove(line, [[3, 3], [0, 1], [7, 7]])


def test_shapes():
    triangulation = PlanarDelaunay([[0, 0], [1, 0], [0, 1]])
    assert triangulation.nearest([0.1, 0.2], k=2).shape == (2,)
    assert triangulation.nearest(np.zeros((0, 2)), k=2).shape == (0, 2)
    assert triangulation.nearest(np.zeros((4, 5, 2)), k=1).shape == (4, 5, 1)
    assert triangulation.nearest([0.1, 0.2], k=np.int64(3)).dtype == np.int32


@pytest.mark.parametrize(
    ("k", "error", "message"),
    [
        (0, ValueError, "k is 0, but must be at least 1"),
        (4, ValueError, "k is 4, but must be at most 3"),
        (1.5, TypeError, "k must be one integer"),
        (True, TypeError, "k must be one integer"),
    ],
)
def test_wrong_k(k, error, message):
    with pytest.raises(error, match=message):
        PlanarDelaunay([[0, 0], [1, 0], [0, 1]]).nearest([0, 0], k=k)
